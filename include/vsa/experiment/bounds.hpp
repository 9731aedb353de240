// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Stated bounds: a TOML file that says what is held to, and why (data/bounds.toml).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vsa::experiment {

struct Bound {
  std::string quantity;  ///< "stiffness.0.6903.rms_rad"
  std::optional<double> min, max;
  std::string why;
};

/// What others reach on a recording.
struct Published {
  double preset = 0;
  double rms_2015_rad = 0, rms_2015_branches_rad = 0;  ///< the authors' simulation, point by point and as branch means
  double repeatability_rad = 0;                        ///< of the hardware
  std::string source;
};

struct BoundsFile {
  std::vector<Bound> bounds;
  std::vector<Published> published;
};

/// Throws InputError with every problem: unreadable, no TOML, unknown or missing keys, neither min nor max, min above max, no
/// reason.
[[nodiscard]] BoundsFile read_bounds(const std::filesystem::path& file);

struct Verdict {
  Bound bound;
  double value = 0;
  bool held = false;  ///< false where the value isn't a number
};
/// Throws InputError for every bound on a quantity that isn't there.
[[nodiscard]] std::vector<Verdict> judge(const std::vector<Bound>& bounds, const std::map<std::string, double>& quantities);
[[nodiscard]] bool all_held(const std::vector<Verdict>& verdicts);

/// "0.7 … 1.3", "at most 0.02", "at least 3"
[[nodiscard]] std::string bound_text(const Bound& bound);

}  // namespace vsa::experiment
