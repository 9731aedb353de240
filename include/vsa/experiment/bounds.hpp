// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Stated bounds: a TOML file that says what is held to, and why (data/bounds.toml).
//
//   [[bound]]       quantity, min, max or both, why; optional kind = "calibrated" | "predicted"
//   [[published]]   what others reach on a recording
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/config/evidence.hpp"

namespace vsa::experiment {

/// A figure is predicted where nothing was fitted or set to meet it. A calibrated one tells how well a fit went: its bound is a
/// guard against regressions, no evidence.
enum class Kind { calibrated, predicted };
[[nodiscard]] const char* kind_text(Kind kind);

struct Bound {
  std::string quantity;  ///< "stiffness.0.6903.rms_rad"
  std::optional<double> min, max;
  std::string why;
  std::optional<Kind> kind;  ///< none: by the type's evidence
  std::string place;         ///< "file:line"
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
/// reason, a kind that is none.
[[nodiscard]] BoundsFile read_bounds(const std::filesystem::path& file);

/// What a quantity or an experiment ("stiffness.0.4602") is to an actuator type. One that doesn't say what it was calibrated on
/// predicts nothing.
[[nodiscard]] Kind kind_of(const std::optional<config::Evidence>& evidence, std::string_view quantity);

/// Throws InputError for every bound that is called predicted though the type was calibrated on it.
void check_kinds(const std::vector<Bound>& bounds, const std::optional<config::Evidence>& evidence);

struct Verdict {
  Bound bound;
  double value = 0;
  bool held = false;  ///< false where the value isn't a number
  Kind kind = Kind::calibrated;
};
/// The kind is the bound's where it has one, else kind_of(). Throws InputError for every bound on a quantity that isn't there, and
/// as check_kinds() does.
[[nodiscard]] std::vector<Verdict> judge(const std::vector<Bound>& bounds, const std::map<std::string, double>& quantities,
                                         const std::optional<config::Evidence>& evidence);
[[nodiscard]] bool all_held(const std::vector<Verdict>& verdicts);

/// How many bounds of a kind there are, and how many of them are held.
struct Count {
  std::size_t held = 0, all = 0;
};
[[nodiscard]] Count count(const std::vector<Verdict>& verdicts, Kind kind);

/// "0.7 … 1.3", "at most 0.02", "at least 3"
[[nodiscard]] std::string bound_text(const Bound& bound);

}  // namespace vsa::experiment
