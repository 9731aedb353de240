// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Every law of the library with values that something real could have: what tests go over. A new law adds its row, and all of them are tried on it.
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

/// A law's scale and the rows of a grid file: not separable, with a different curve at each preset.
inline std::vector<double> typical_grid() {
  std::vector<double> out{1};
  for (const double p : {0.0, 0.4, 0.8, 1.2})
    for (const double d : {-0.5, -0.3, -0.15, 0.0, 0.15, 0.3, 0.5})
      out.insert(out.end(), {d, (2 + 8 * p * p) * d + 30 * (1 + p) * d * d * d, p});
  return out;
}

struct Typical {
  std::vector<double> values;     ///< in the order of the law's parameters, then its file's rows
  double deflection_rad;          ///< tried up to here: |q − x₀|, or of two springs |q − (x₀ + x₁)/2|
  double preset;                  ///< and here
  double rest_preset, stiffness;  ///< σ at rest at this preset, by hand from the equation
};
inline const std::map<std::string_view, Typical>& typical() {
  static const std::map<std::string_view, Typical> all{
      {"bi_stiffness", {{5, 15, 2.5}, 0.5, 2.5, 1, 5 + 15 * 0.289792}},
      {"cam_roller", {{20000, 0.02, 0.002, 0.001}, 0.4, 2, 1, 2 * 20000 * 0.02 * (0.002 + 0.001)}},
      {"lever_cardan", {{8000, 0.03, 0.6, 0.5, 2.2}, 0.4, 2.5, 1, 2 * 8000 * 0.03 * 0.03 * std::pow(std::tan(0.5 * 1.1), 4)}},
      {"lever_pivot", {{10, 0.05, 0.015, 0.005, 0.01, 0.025}, 0.4, 2, 1, 2 * 10 * std::pow(0.05 / 0.015 * 0.015 / 0.035, 2)}},
      {"lever_spring", {{8000, 0.005, 0.02}, 0.4, 2.5, 1, 2 * 8000 * 0.025 * 0.025}},
      {"maccepa", {{323, 0.03, 0.18, 0.010}, 1.5, 2.5, 2, 323 * 0.010 * 2 * 0.03 * 0.18 / 0.15}},
      {"maccepa_2", {{323, 0.03, 0.18, 0.010, 0.05}, 1.2, 2.5, 2, 323 * 0.010 * 2 * 0.03 * 0.18 / 0.15}},
      {"series_hardening", {{10, 50}, 0.5, 0, 0, 10}},
      {"series_spring", {{10}, 0.5, 0, 0, 10}},
      {"series_travel", {{10, 50}, 0.5, 0, 0, 10}},
      {"table", {typical_grid(), 0.5, 1.2, 0.4, 2 + 8 * 0.4 * 0.4 + 30 * 1.4 * 0.15 * 0.15}},
      {"two_cams", {{20000, 0.03}, 0.4, 0.5, 0.3, 8 * 20000 * 0.03 * 0.03 * 0.3 * 0.3}},
      {"two_exp",
       {{0.38, 0.38, 8.71, 0.508}, 0.25, 0.25, 0.2, 2 * 8.71 * 0.38 * (std::exp(8.71 * 0.2) + 0.508 * std::exp(-8.71 * 0.2))}},
      {"two_quadratic", {{10, 10, 0.05}, 0.5, 0.8, 0.3, 4 * 10 * (0.3 + 0.05)}},
      {"two_sinh", {{0.022, 6.85, 0.022, 6.85}, 0.5, 0.5, 0.3, 2 * 6.85 * 0.022 * std::cosh(6.85 * 0.3)}},
      {"two_sinh_linear",
       {{8e-4, 12.3, 0.27, 9e-4, 12.1, 0.25, 0.6},
        0.5,
        0.5,
        0.3,
        8e-4 * 12.3 * std::cosh(12.3 * 0.3) + 0.27 + 9e-4 * 12.1 * std::cosh(12.1 * 0.3) + 0.25}},
  };
  return all;
}

struct SomeLaw {
  std::string name;
  std::shared_ptr<const elastic::Transmission> law;
  double deflection_rad, preset;
};

/// Each law as it is typically, and `more` times with every value off by up to a factor of two.
inline constexpr char kDraw = 12;  // none so near a lever's pole that a millisecond is long
inline std::vector<SomeLaw> all_laws(int more) {
  std::vector<SomeLaw> out;
  for (const auto& [name, values] : typical()) {
    const auto has = [&name = name](const elastic::Law* law) { return law->name == name; };
    if (std::none_of(elastic::laws().begin(), elastic::laws().end(), has))
      throw std::runtime_error(std::string(name) + ": no such law in src/elastic/laws");
  }
  for (const elastic::Law* law : elastic::laws()) {
    std::string seed(law->name);  // of its own, so that a new law changes no other's numbers
    seed.push_back(kDraw);
    std::seed_seq by_name(seed.begin(), seed.end());
    std::mt19937 random(by_name);
    std::uniform_real_distribution<double> exponent(-1, 1);
    const auto row = typical().find(law->name);
    if (row == typical().end()) throw std::runtime_error(std::string(law->name) + ": no row in all_laws.hpp");
    for (int n = 0; n <= more; ++n) {
      std::vector<double> values = row->second.values;
      for (std::size_t i = 0; n > 0 && i < law->parameters.size(); ++i)
        values[i] = std::clamp(values[i] * std::exp2(exponent(random)), law->parameters[i].min, law->parameters[i].max);
      if (law->fault != nullptr && law->fault(values)) continue;
      out.push_back({std::string(law->name) + (n > 0 ? " " + std::to_string(n) : ""), law->make(values), row->second.deflection_rad,
                     row->second.preset});
    }
  }
  return out;
}

/// A place within that.
inline elastic::Positions random_place(const SomeLaw& of, std::mt19937& random) {
  std::uniform_real_distribution<double> part(-1, 1);
  const double equilibrium = part(random), preset = of.preset * 0.5 * (1 + part(random));
  return {equilibrium + of.deflection_rad * part(random), of.law->references({equilibrium, preset})};
}

}  // namespace vsa::test
