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
[[nodiscard]] const char* kind_text(Kind kind);  ///< "calibrated", "predicted"

/// What a quantity is held to.
struct Bound {
  std::string quantity;       ///< "stiffness.0.6903.rms_rad"
  std::optional<double> min,  ///< none: whatever is small is held
      max;                    ///< none: whatever is large is held
  std::string why;            ///< the reason, in a sentence
  std::optional<Kind> kind;   ///< none: by the type's evidence
  std::string place;          ///< "file:line"
};

/// What others reach on a recording.
struct Published {
  double preset = 0;              ///< of the recording
  double rms_2015_rad = 0,        ///< the authors' simulation, point by point
      rms_2015_branches_rad = 0;  ///< as branch means
  double repeatability_rad = 0;   ///< of the hardware
  std::string source;             ///< where it is from
};

/// A file of bounds.
struct BoundsFile {
  std::vector<Bound> bounds;         ///< in the file's order
  std::vector<Published> published;  ///< what others reach, by preset
};

/// Throws InputError with every problem: unreadable, no TOML, unknown or missing keys, neither min nor max, min above max, no
/// reason, a kind that is none.
[[nodiscard]] BoundsFile read_bounds(const std::filesystem::path& file);

/// What a quantity or an experiment ("stiffness.0.4602") is to an actuator type. One that doesn't say what it was calibrated on
/// predicts nothing.
[[nodiscard]] Kind kind_of(const std::optional<config::Evidence>& evidence, std::string_view quantity);

/// Throws InputError for every bound that is called predicted though the type was calibrated on it.
void check_kinds(const std::vector<Bound>& bounds, const std::optional<config::Evidence>& evidence);

/// What became of a bound.
struct Verdict {
  Bound bound;                   ///< that was judged
  double value = 0;              ///< of the quantity; NaN: it has none
  bool held = false;             ///< false where the value isn't a number
  Kind kind = Kind::calibrated;  ///< as judged
};
/// The kind is the bound's where it has one, else kind_of(). Throws InputError for every bound on a quantity that isn't there, and
/// as check_kinds() does.
[[nodiscard]] std::vector<Verdict> judge(const std::vector<Bound>& bounds, const std::map<std::string, double>& quantities,
                                         const std::optional<config::Evidence>& evidence);
[[nodiscard]] bool all_held(const std::vector<Verdict>& verdicts);  ///< of any bound

/// How many bounds of a kind there are, and how many of them are held.
struct Count {
  std::size_t held = 0,  ///< of that kind
      all = 0;           ///< of that kind, held or not
};
[[nodiscard]] Count count(const std::vector<Verdict>& verdicts, Kind kind);  ///< of one kind

/// "0.7 … 1.3", "at most 0.02", "at least 3"
[[nodiscard]] std::string bound_text(const Bound& bound);

}  // namespace vsa::experiment
