// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/fmu/variables.hpp"

#include <algorithm>
#include <array>

#include "vsa/config/text.hpp"

namespace vsa::fmu {
namespace {

struct Replacement {
  std::string_view from, to;
};
constexpr std::array<Replacement, 6> kAscii{{{"·", "."}, {"²", "2"}, {"³", "3"}, {"Ω", "Ohm"}, {"°", "deg"}, {"µ", "u"}}};

struct Symbol {
  std::string_view name;
  std::array<int, 5> exponents;  // kg, m, s, A, rad
};
constexpr std::array<std::string_view, 5> kBase{"kg", "m", "s", "A", "rad"};
constexpr std::array<Symbol, 11> kSymbols{{{"kg", {1, 0, 0, 0, 0}},
                                           {"m", {0, 1, 0, 0, 0}},
                                           {"s", {0, 0, 1, 0, 0}},
                                           {"A", {0, 0, 0, 1, 0}},
                                           {"rad", {0, 0, 0, 0, 1}},
                                           {"N", {1, 1, -2, 0, 0}},
                                           {"J", {1, 2, -2, 0, 0}},
                                           {"V", {1, 2, -3, -1, 0}},
                                           {"Ohm", {1, 2, -3, -2, 0}},
                                           {"H", {1, 2, -2, -2, 0}},
                                           {"1", {0, 0, 0, 0, 0}}}};

}  // namespace

std::string unit_name(std::string_view unit) {
  if (unit == "1") return {};
  std::string out(unit);
  for (const Replacement& r : kAscii) {
    for (std::size_t at = out.find(r.from); at != std::string::npos; at = out.find(r.from, at + r.to.size()))
      out.replace(at, r.from.size(), r.to);
  }
  return out;
}

std::optional<std::map<std::string, int>> base_units(std::string_view unit) {
  std::map<std::string, int> out;
  int sign = 1;  // after the "/" everything divides
  while (!unit.empty()) {
    const std::size_t end = std::min(unit.find_first_of("./"), unit.size());
    std::string_view symbol = unit.substr(0, end);
    int power = 1;
    if (symbol.size() > 1 && symbol.back() >= '2' && symbol.back() <= '9') {
      power = symbol.back() - '0';
      symbol.remove_suffix(1);
    }
    const auto at = std::find_if(kSymbols.begin(), kSymbols.end(), [&](const Symbol& s) { return s.name == symbol; });
    if (at == kSymbols.end()) return std::nullopt;
    for (std::size_t i = 0; i < kBase.size(); ++i)
      if (at->exponents[i] != 0) out[std::string(kBase[i])] += sign * power * at->exponents[i];
    if (end < unit.size() && unit[end] == '/') sign = -1;
    unit.remove_prefix(std::min(end + 1, unit.size()));
  }
  return out;
}

std::optional<Variable> variable_of(const config::Entry& e) {
  Variable v;
  v.name = e.key;
  v.description = e.meaning;
  v.causality = Causality::parameter;
  v.variability = Variability::fixed;
  v.start = e.number;
  switch (e.kind) {
    case config::Kind::number:
    case config::Kind::integer:
      v.kind = e.kind == config::Kind::number ? Kind::real : Kind::integer;
      v.unit = unit_name(e.unit);
      v.min = e.min;
      v.max = e.max;
      return v;
    case config::Kind::toggle:
      v.kind = Kind::boolean;
      return v;
    case config::Kind::word:
      v.kind = Kind::enumeration;
      v.words = config::split(e.bounds, ',');
      for (std::string& w : v.words) w = std::string(config::trim(w));
      v.start = e.number + 1;
      v.min = 1;
      v.max = static_cast<double>(v.words.size());
      return v;
    case config::Kind::file:
      break;
  }
  return std::nullopt;
}

std::string value_text(const Variable& variable, double value) {
  switch (variable.kind) {
    case Kind::real:
      return config::number_text(value);
    case Kind::integer:
      return std::to_string(static_cast<std::int64_t>(value));
    case Kind::boolean:
      return value != 0 ? "true" : "false";
    case Kind::enumeration:
      return variable.words.at(static_cast<std::size_t>(value) - 1);
  }
  return {};
}

}  // namespace vsa::fmu
