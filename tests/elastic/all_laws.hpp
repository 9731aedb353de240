// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Every law of the library with values that something real could have: what tests go over. A new law adds its row.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "vsa/elastic/law.hpp"

namespace vsa::test {

/// Values in the order of the law's parameters.
inline const std::map<std::string_view, std::vector<double>>& typical_values() {
  static const std::map<std::string_view, std::vector<double>> all{
      {"cam_roller", {20000, 0.02, 0.002, 0.001}},
      {"lever_pivot", {10, 0.05, 0.015, 0.005, 0.01, 0.025}},
      {"lever_spring", {8000, 0.005, 0.02}},
      {"maccepa", {323, 0.03, 0.18, 0.010}},
      {"series_hardening", {10, 50}},
      {"series_spring", {10}},
      {"two_cams", {20000, 0.03}},
      {"two_exp", {0.38, 0.38, 8.71, 0.508}},
      {"two_quadratic", {10, 10, 0.05}},
      {"two_sinh", {0.022, 6.85, 0.022, 6.85}},
      {"two_sinh_linear", {8e-4, 12.3, 0.27, 9e-4, 12.1, 0.25, 0.6}},
  };
  return all;
}

struct SomeLaw {
  std::string name;
  std::shared_ptr<const elastic::Transmission> law;
  elastic::LawReach reach;
};

/// Each law as it is typically, and `more` times with every value off by up to a factor of two.
inline std::vector<SomeLaw> all_laws(int more, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> exponent(-1, 1);
  std::vector<SomeLaw> out;
  for (const elastic::Law* law : elastic::laws()) {
    const auto typical = typical_values().find(law->name);
    if (typical == typical_values().end()) throw std::runtime_error(std::string(law->name) + ": no row in all_laws.hpp");
    for (int n = 0; n <= more; ++n) {
      std::vector<double> values = typical->second;
      for (std::size_t i = 0; n > 0 && i < values.size(); ++i)
        values[i] = std::clamp(values[i] * std::exp2(exponent(random)), law->parameters[i].min, law->parameters[i].max);
      if (law->fault != nullptr && law->fault(values)) continue;
      out.push_back({std::string(law->name) + (n > 0 ? " " + std::to_string(n) : ""), law->make(values), law->reach(values)});
    }
  }
  return out;
}

/// A place within the law's reach.
inline elastic::Positions random_place(const SomeLaw& of, std::mt19937& random) {
  std::uniform_real_distribution<double> part(-1, 1);
  const double equilibrium = part(random), preset = of.reach.preset * 0.5 * (1 + part(random));
  return {equilibrium + of.reach.deflection_rad * part(random), of.law->references({equilibrium, preset})};
}

}  // namespace vsa::test
