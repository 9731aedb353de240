// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "sweep/plan_parts.hpp"
#include "vsa/config/text.hpp"

namespace vsa::sweep {
namespace {

using config::TomlSection;

std::optional<Value> value_of(const toml::node& node) {
  if (const auto whole = node.value_exact<std::int64_t>()) return Value(*whole);
  if (const auto number = node.value_exact<double>()) return std::isfinite(*number) ? std::optional<Value>(*number) : std::nullopt;
  if (const auto flag = node.value_exact<bool>()) return Value(*flag);
  if (const auto text = node.value_exact<std::string>()) return Value(*text);
  return std::nullopt;
}

std::vector<Value> listed(TomlSection& s) {
  std::vector<Value> out;
  const toml::node* node = s.find("list");
  if (node == nullptr) return out;
  if (!node->is_array() || node->as_array()->empty()) {
    s.add("list", "", "isn't a list with values", "[1.0, 2.0], [\"a\", \"b\"]");
    return out;
  }
  for (const toml::node& item : *node->as_array()) {
    const auto value = value_of(item);
    if (!value) s.add("list[" + std::to_string(out.size()) + "]", "", "isn't a value", "a number, a text, true or false");
    out.push_back(value.value_or(Value(0.0)));
  }
  return out;
}

std::optional<std::array<double, 2>> pair_of(TomlSection& s, const char* key) {
  const toml::node* node = s.find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_array() || node->as_array()->size() != 2) {
    s.add(key, "", "isn't a pair of numbers", "[from, to]");
    return std::array<double, 2>{0, 1};
  }
  const auto numbers = s.numbers(key, -kAny, kAny);
  return std::array<double, 2>{numbers[0], numbers[1]};
}

/// a, …, b; exact at both ends, and to 14 digits between.
std::vector<Value> spaced(double a, double b, std::size_t count, bool log) {
  std::vector<Value> out;
  for (std::size_t i = 0; i < count; ++i) {
    const double part = count == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(count - 1);
    const double between = log ? a * std::pow(b / a, part) : a + (b - a) * part;
    // A third of 0.3 is to be read as 0.1.
    const double short_one = config::parse_number(fmt::format("{:.14g}", between)).value_or(between);
    out.emplace_back(i == 0 ? a : i + 1 == count ? b : short_one);
  }
  return out;
}

void read_spaced(TomlSection& s, Axis& axis, const char* key, bool log) {
  const auto ends = pair_of(s, key);
  if (!ends) return;
  const auto count = s.need("count", "how many values, 2 …").whole("count", 2, kMostSamples);
  const auto [a, b] = *ends;
  if (a == b) s.add(key, config::number_text(a), "is empty: both ends are the same", "from < to");
  if (log && !(a > 0 && b > 0)) s.add(key, "", "a logarithmic range needs numbers above 0", "0 < from, to");
  if (count && (!log || (a > 0 && b > 0))) {
    axis.values = spaced(a, b, static_cast<std::size_t>(*count), log);
    axis.spaced = true;
  }
}

void read_drawn(TomlSection& s, Axis& axis, const char* key) {
  const auto ends = pair_of(s, key);
  if (!ends) return;
  const std::string way = key;
  axis.kind = way == "random" ? Axis::Kind::random : way == "sobol" ? Axis::Kind::sobol : Axis::Kind::searched;
  std::tie(axis.a, axis.b) = std::tie((*ends)[0], (*ends)[1]);
  if (axis.kind != Axis::Kind::sobol) {
    std::vector<std::string> laws{"uniform", "log_uniform"};
    if (axis.kind == Axis::Kind::random) laws.emplace_back("normal");
    const auto law = s.word("law", laws).value_or("uniform");
    axis.law = law == "normal" ? Axis::Law::normal : law == "log_uniform" ? Axis::Law::log_uniform : Axis::Law::uniform;
  }
  if (axis.law == Axis::Law::normal) {
    if (!(axis.b >= 0)) s.add(key, "", "a standard deviation below 0", "[mean, standard deviation ≥ 0]");
  } else if (!(axis.a < axis.b) || (axis.law == Axis::Law::log_uniform && !(axis.a > 0))) {
    s.add(key, "", "is empty", axis.law == Axis::Law::uniform ? "[from, to], from < to" : "[from, to], 0 < from < to");
  }
}

/// One, or a list of those that go together.
void read_keys(TomlSection& s, Axis& axis) {
  constexpr const char* kAllowed = "scenario.…, set.…, motion.…, command.N.…, or a parameter of actuators or links; a list of them";
  const toml::node* node = s.need("key", kAllowed).find("key");
  if (node != nullptr && node->is_array()) {
    axis.keys = s.texts("key");
    if (axis.keys.empty()) s.add("key", "[]", "is empty", kAllowed);
  } else {
    axis.keys = {s.text("key").value_or("")};
  }
  if (axis.keys.empty()) axis.keys.emplace_back();
  std::size_t parameters = 0;
  for (const std::string& key : axis.keys) {
    const std::string first = key.substr(0, key.find('.'));
    parameters += std::find(std::begin(kParts), std::end(kParts), first) == std::end(kParts) ? 1 : 0;
    for (const char* name : kOutside)
      if (key == std::string("scenario.") + name) s.add("key", key, "changes none of a run's numbers", "another key");
  }
  axis.parameter = parameters > 0;
  if (axis.parameter && parameters < axis.keys.size())
    s.add("key", config::join(axis.keys), "mixes the scenario's keys and parameters", "one kind");
}

}  // namespace

Axis read_axis(TomlSection s) {
  Axis axis;
  read_keys(s, axis);
  axis.name = s.text("name").value_or(axis.keys.front());
  axis.of = s.text("of").value_or("");
  axis.factor = s.flag("factor").value_or(false);
  if (!axis.parameter && !axis.of.empty()) s.add("of", axis.of, "is for parameters; this key is the scenario's", "no of");
  if (!axis.parameter && axis.factor) s.add("factor", "true", "is for parameters; this key is the scenario's", "no factor");
  int ways = 0;
  std::string found;
  for (const char* way : {"list", "range", "log", "random", "sobol", "search"}) {
    if (s.find(way) == nullptr) continue;
    ++ways;
    found += (found.empty() ? "" : ", ") + std::string(way);
  }
  if (ways != 1)
    s.add("list", found, ways == 0 ? "nothing says which values" : "several say which values",
          "one of list, range, log, random, sobol, search");
  axis.values = listed(s);
  if (axis.factor && std::any_of(axis.values.begin(), axis.values.end(), [](const Value& v) { return v.index() >= 2; }))
    s.add("list", "", "a factor is a number", "numbers");
  read_spaced(s, axis, "range", false);
  read_spaced(s, axis, "log", true);
  read_drawn(s, axis, "random");
  read_drawn(s, axis, "sobol");
  read_drawn(s, axis, "search");
  s.refuse_others();
  return axis;
}

}  // namespace vsa::sweep
