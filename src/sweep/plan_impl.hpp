// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "vsa/scenario/scenario.hpp"
#include "vsa/sweep/plan.hpp"

namespace vsa::sweep {

struct Plan::Impl {
  std::filesystem::path file;
  std::string text;
  std::string title;
  toml::table base;                 ///< the scenario's tables
  std::filesystem::path base_file;  ///< where they stand
  bool own_motion = false;          ///< but for [motion], which is the plan's
  std::vector<Axis> axes;
  std::vector<Measure> measures;
  Start start;
  std::optional<Search> search;
  std::vector<std::vector<double>> candidates;  ///< none: all searched axes in their middle
  std::size_t repetitions = 1, samples = 1, cells = 1;
  std::uint64_t seed = 1, fingerprint = 0;
  double limit_s = 3600;

  [[nodiscard]] std::vector<Value> values(std::size_t point) const;
  /// A file that the plan names is beside the plan, wherever its scenario is. Throws InputError: no such file.
  [[nodiscard]] Value placed(const std::string& key, const Value& value) const;
  [[nodiscard]] bool is_study() const { return base.contains("study"); }
  /// The scenario with these values, of which those of parameters have no place in it. Throws InputError.
  [[nodiscard]] scenario::Scenario scenario_with(const std::vector<Value>& values, std::size_t repetition) const;
};

/// A study (vsa/study/) with these values of the plan's axes: what has to be right before it runs. Throws InputError.
void check_study(const Plan::Impl& plan, const std::vector<Value>& values);
/// Its numbers, one a measure; none: not wanted any more. Throws what a study throws.
[[nodiscard]] std::optional<std::vector<double>> run_study(const Plan::Impl& plan, const std::vector<Value>& values,
                                                           const std::function<bool()>& wanted);

/// Puts a value where a scenario's key is. Throws InputError where there is no such place.
void put(toml::table& scenario, const std::string& key, const Value& value);

}  // namespace vsa::sweep
