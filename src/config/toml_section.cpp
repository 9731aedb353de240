// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/config/toml_section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "vsa/config/text.hpp"
#include "vsa/files.hpp"

namespace vsa::config {
namespace {

constexpr const char* kText = "some text";

/// As it stands in the file; a table or a list isn't repeated.
std::string shown(const toml::node& node) {
  if (node.is_table() || node.is_array()) return "";
  if (const auto text = node.value_exact<std::string>()) return '"' + *text + '"';
  if (const auto number = node.value_exact<double>()) return number_text(*number);
  std::ostringstream out;
  node.visit([&out](const auto& value) { out << value; });
  return out.str();
}

std::string value_text(const toml::node& node) {
  if (const auto word = node.value_exact<std::string>()) return *word;
  if (const auto flag = node.value_exact<bool>()) return *flag ? "true" : "false";
  if (const auto whole = node.value_exact<std::int64_t>()) return std::to_string(*whole);
  const auto number = node.value_exact<double>();
  return number && std::isfinite(*number) ? number_text(*number) : "";
}

}  // namespace

toml::table parse_toml(const std::filesystem::path& file) {
  const auto text = read_file(file);
  if (!text) throw InputError({file.string(), "", "", "can't be read", "a TOML file"});
  try {
    return toml::parse(*text, file.string());
  } catch (const toml::parse_error& error) {
    throw InputError(
        {file.string() + ":" + std::to_string(error.source().begin.line), "", "", std::string(error.description()), "TOML"});
  }
}

std::string place_of(const std::filesystem::path& file, const toml::node& node) {
  return file.string() + ":" + std::to_string(node.source().begin.line);
}

TomlSection::TomlSection(const toml::table* table, std::string place, std::string scope, Problems& problems)
    : table_(table), place_(std::move(place)), scope_(std::move(scope)), problems_(problems) {}

void TomlSection::add(const std::string& key, const std::string& value, const std::string& message,
                      const std::string& allowed) const {
  problems_.add({place_, scope_ + key, value, message, allowed});
}

const toml::node* TomlSection::find(const char* key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.emplace_back(key);
  return table_ == nullptr ? nullptr : table_->get(key);
}

TomlSection& TomlSection::need(const char* key, std::string_view allowed) {
  if (find(key) == nullptr) add(key, "", "is missing", std::string(allowed));
  return *this;
}

const toml::node* TomlSection::wrong(const char* key, const toml::node& node, const std::string& allowed) const {
  add(key, shown(node), "isn't what it should be", allowed);
  return nullptr;
}

std::optional<std::string> TomlSection::text(const char* key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  auto value = node->value_exact<std::string>();
  if (value && !value->empty()) return value;
  wrong(key, *node, kText);
  return std::nullopt;
}

std::optional<bool> TomlSection::flag(const char* key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  const auto value = node->value_exact<bool>();
  if (!value) wrong(key, *node, "true, false");
  return value;
}

std::optional<double> TomlSection::checked(const std::string& key, const toml::node& node, double min, double max,
                                           bool whole) const {
  auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (value && !std::isfinite(*value)) value.reset();
  const std::string allowed =
      max == std::numeric_limits<double>::max() ? "a number" : (whole ? "a whole number, " : "") + range_text(min, max);
  const bool fits = value && (!whole || *value == std::trunc(*value));
  if (fits && *value >= min && *value <= max) return value;
  add(key, shown(node), fits ? "out of range" : value ? "not a whole number" : "not a number", allowed);
  return std::nullopt;
}

std::optional<double> TomlSection::number(const char* key, double min, double max) {
  const toml::node* node = find(key);
  return node == nullptr ? std::nullopt : checked(key, *node, min, max, false);
}

std::optional<std::int64_t> TomlSection::whole(const char* key, double min, double max) {
  const toml::node* node = find(key);
  const auto value = node == nullptr ? std::nullopt : checked(key, *node, min, max, true);
  return value ? std::optional(static_cast<std::int64_t>(*value)) : std::nullopt;
}

std::vector<double> TomlSection::numbers(const char* key, double min, double max) {
  std::vector<double> out;
  const toml::node* node = find(key);
  if (node == nullptr) return out;
  if (!node->is_array()) return wrong(key, *node, "a list of numbers"), out;
  for (const toml::node& item : *node->as_array()) {
    const std::string name = std::string(key) + "[" + std::to_string(out.size()) + "]";
    out.push_back(checked(name, item, min, max, false).value_or(min));
  }
  return out;
}

std::vector<std::string> TomlSection::texts(const char* key) {
  std::vector<std::string> out;
  const toml::node* node = find(key);
  if (node == nullptr) return out;
  if (!node->is_array()) return wrong(key, *node, "a list of texts"), out;
  for (const toml::node& item : *node->as_array()) {
    const auto value = item.value_exact<std::string>();
    if (!value) add(std::string(key) + "[" + std::to_string(out.size()) + "]", shown(item), "isn't what it should be", kText);
    out.push_back(value.value_or(""));
  }
  return out;
}

std::optional<std::string> TomlSection::word(const char* key, const std::vector<std::string>& words) {
  auto value = text(key);
  if (!value || std::find(words.begin(), words.end(), *value) != words.end()) return value;
  add(key, *value, "isn't one of the words", join(words));
  return std::nullopt;
}

std::vector<Override> TomlSection::overrides(const char* key) {
  std::vector<Override> out;
  const toml::table* all = table(key);
  if (all == nullptr) return out;
  for (const auto& [name, value] : *all) {
    out.push_back({std::string(name.str()), value_text(value)});
    if (out.back().value.empty())
      add(std::string(key) + ".\"" + out.back().key + '"', "", "isn't a value",
          "a number, a text, true or false; keys with a point in quotes");
  }
  return out;
}

const toml::table* TomlSection::table(const char* key) {
  const toml::node* node = find(key);
  if (node == nullptr || node->is_table()) return node == nullptr ? nullptr : node->as_table();
  add(key, shown(*node), "isn't a table", "[" + std::string(key) + "]");
  return nullptr;
}

std::vector<const toml::table*> TomlSection::tables(const char* key) {
  std::vector<const toml::table*> out;
  const toml::node* node = find(key);
  if (node == nullptr) return out;
  const toml::array* array = node->as_array();
  if (array == nullptr || !array->is_homogeneous<toml::table>()) {
    add(key, shown(*node), "isn't an array of tables", "[[" + std::string(key) + "]]");
    return out;
  }
  for (const toml::node& element : *array) out.push_back(element.as_table());
  return out;
}

void TomlSection::refuse_others() const {
  if (table_ == nullptr) return;
  for (const auto& [key, node] : *table_) {
    const std::string name(key.str());
    if (std::find(asked_.begin(), asked_.end(), name) != asked_.end()) continue;
    add(name, "", "unknown key" + did_you_mean(name, asked_), join(asked_));
  }
}

}  // namespace vsa::config
