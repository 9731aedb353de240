// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What an actuator type's values were fitted or set by, so that nobody takes for a prediction what was put in.
//
//   [evidence]
//   calibrated_on = { value = ["stiffness.0.0000", "stiffness.0.6903", "speed.0.7500"], source = "vsa identify …" }
//
// An experiment is named as `vsa validate` names what it measures: stiffness.P and speed.P, P the commanded preset with four
// decimals; preset_step.no_load; preset_step.loaded. It stands for everything that is measured in it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vsa::config {

/// What a type's file says of its own fit.
struct Evidence {
  std::vector<std::string> calibrated_on;  ///< may be empty: nothing was fitted to any of them
  std::string source;                      ///< how it was fitted
};

/// For messages: how experiments are named.
inline constexpr std::string_view kExperimentNames =
    "stiffness.0.6903, speed.0.7500 (commanded preset, four decimals), preset_step.no_load, preset_step.loaded";

/// "stiffness.0.6903"
[[nodiscard]] bool names_experiment(std::string_view name);
/// "stiffness", 0.6903 → "stiffness.0.6903"
[[nodiscard]] std::string experiment_name(std::string_view experiment, double preset);
/// Whether a quantity ("stiffness.0.6903.rms_rad") or an experiment was calibrated on.
[[nodiscard]] bool covers(const Evidence& evidence, std::string_view quantity);

}  // namespace vsa::config
