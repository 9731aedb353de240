// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Numbers and texts out of a TOML table, checked; problems are collected with the key's whole name.
#pragma once

#include <fmt/format.h>
#include <toml++/toml.h>

#include <optional>
#include <set>
#include <sstream>
#include <string>

#include "vsa/errors.hpp"
#include "vsa/units.hpp"

namespace vsa::motion {

inline constexpr double kDegree = kPi / 180;
struct Bounds {
  double min, max;
  std::optional<double> fallback{};
};

class Reader {
 public:
  Reader(std::string file, Problems& problems) : file_(std::move(file)), problems_(problems) {}

  void problem(const std::string& key, const std::string& value, const std::string& message, const std::string& allowed) {
    problems_.add({file_, key, value, message, allowed});
  }

  double number(const toml::table& table, const std::string& scope, const char* key, const Bounds& bounds) {
    const toml::node* node = table.get(key);
    if (node == nullptr && bounds.fallback) return *bounds.fallback;
    const std::string allowed = fmt::format("{} … {}", bounds.min, bounds.max);
    const auto value = node == nullptr || !node->is_number() ? std::nullopt : node->value<double>();
    if (!value) {
      problem(scope + key, shown(node), node == nullptr ? "missing" : "not a number", allowed);
      return bounds.fallback.value_or(bounds.min);
    }
    if (!(*value >= bounds.min && *value <= bounds.max)) problem(scope + key, fmt::format("{}", *value), "out of range", allowed);
    return *value;
  }

  std::string text(const toml::table& table, const std::string& scope, const char* key) {
    const toml::node* node = table.get(key);
    const auto value = node == nullptr ? std::nullopt : node->value<std::string>();
    if (!value) problem(scope + key, shown(node), node == nullptr ? "missing" : "not a text", "");
    return value.value_or("");
  }

  void only(const toml::table& table, const std::string& scope, const std::set<std::string_view>& known) {
    for (const auto& [key, node] : table) {
      if (!known.contains(key.str()))
        problem(scope + std::string(key.str()), shown(&node), "unknown key", fmt::format("{}", list(known)));
    }
  }

 private:
  static std::string shown(const toml::node* node) {
    if (node == nullptr || node->is_table() || node->is_array()) return "";
    if (const auto text = node->value_exact<std::string>()) return '"' + *text + '"';
    std::ostringstream out;
    node->visit([&out](const auto& value) { out << value; });
    return out.str();
  }
  static std::string list(const std::set<std::string_view>& words) {
    std::string all;
    for (const auto word : words) all += (all.empty() ? "" : ", ") + std::string(word);
    return all;
  }

  std::string file_;
  Problems& problems_;
};

}  // namespace vsa::motion
