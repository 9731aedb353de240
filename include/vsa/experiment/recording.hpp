// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Load-test recordings: external torque against deflection, and the branch means that they are compared by.
//
//   load_torque_Nm   external torque on the shaft about +q; equal to −τ at rest, so that a positive load gives a positive deflection
//   deflection_rad   δ = shaft − mean of the two pulleys, as the unit's own encoders read it
//
// CSV columns, in any order: load_torque_Nm, deflection_rad, and optionally time_s or sample (increasing). Other columns are
// ignored if their names end in a unit ("preset_rad", "current_1_A"). A column without its unit, or with another, is an error that
// names the column that was expected.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vsa::experiment {

/// A load test: what a sweep gave, sample by sample.
struct LoadRecording {
  double preset = 0;                ///< commanded, in the law's preset unit; from the file's name (stiffness_preset_P.PPPPrad…)
  std::string preset_unit = "rad";  ///< as the file's name has it
  std::string source;               ///< file, or what made it
  std::vector<double> time_s;       ///< empty where the recording has no time base
  std::vector<double> torque_Nm;    ///< external, about +q
  std::vector<double> deflection_rad;  ///< δ, as the encoders read it
};

/// The rising-torque and the falling-torque branch on a torque grid. Each value is the height at its grid point of a straight line
/// fitted to the branch's samples within half a grid step (all cycles pooled); the scatter is that of the residuals, their root
/// mean square. Samples on both sides of the grid point are needed: nothing is extrapolated.
struct Branches {
  std::vector<double> torque_Nm;      ///< of the grid, growing
  std::vector<double> rising_rad,     ///< NaN where that branch has no samples
      falling_rad;                    ///< NaN where that branch has no samples
  std::vector<double> sd_rising_rad,  ///< scatter about the line
      sd_falling_rad;                 ///< scatter about the line

  /// The least step of the grid, N·m; rows of it may be missing. Needs two.
  [[nodiscard]] double spacing_Nm() const {
    double least = torque_Nm[1] - torque_Nm[0];
    for (std::size_t i = 2; i < torque_Nm.size(); ++i) least = std::min(least, torque_Nm[i] - torque_Nm[i - 1]);
    return least;
  }
};

/// Torque's direction is judged between turning points: a maximum counts as one when the torque has since fallen by
/// `turn_fraction` of the largest |τ|, a minimum likewise. So noise and encoder steps don't flip it, and no time base is needed;
/// on the shipped recordings any fraction between 0.02 and 0.3 gives the same branches.
/// Half cycles are counted by sign changes of the torque, at most one between two turning points.
struct BranchOptions {
  double grid_Nm = 0.05;       ///< of the grid
  double max_Nm = 1.4;         ///< of the grid, on both sides of 0
  double skip_cycles = 0.5;    ///< a multiple of 0.5; the first half cycle is left out
  double turn_fraction = 0.1;  ///< of the largest |τ|
};

/// Throws InputError with every problem (the first twenty): unreadable file, missing or unknown unit, fewer than two samples, not a
/// number, time that doesn't increase, torque beyond ±limit_Nm, no preset in the file's name.
[[nodiscard]] LoadRecording read_load_recording(const std::filesystem::path& csv, double limit_Nm = 10.0);
/// Written beside it first, then renamed. Throws InputError.
void write_load_recording(const LoadRecording& recording, const std::filesystem::path& csv);

/// The branch means of a recording on the options' grid. Throws InputError for options out of range.
[[nodiscard]] Branches branches(const LoadRecording& recording, const BranchOptions& options = {});
/// The same from a file of branch means: load_torque_Nm,deflection_rising_rad,deflection_falling_rad,sd_rising_rad,sd_falling_rad.
/// An empty cell is a branch without samples there; the torques have one spacing, but for missing rows. Throws InputError as read_load_recording, but for the
/// file's name; torques up to 1e4 N·m.
[[nodiscard]] Branches read_branches(const std::filesystem::path& csv);

/// Places at rest, each reached for itself: load_torque_Nm,deflection_rad, in any order. As branches they are all "rising", upwards by
/// torque, and there is no other. Throws InputError as read_load_recording, but for the file's name.
/// Of a linear actuator: load_force_N,deflection_m.
[[nodiscard]] Branches read_points(const std::filesystem::path& csv, bool linear = false, double limit_Nm = 1e4);

/// a − b on the torques that both have; NaN where one has no value. Without scatter.
[[nodiscard]] Branches subtract(const Branches& a, const Branches& b);

/// Root mean square of (a − b) over both branches, on the points that both have. Throws InputError where the grids share none.
struct Difference {
  double both_rad = 0,     ///< over both branches
      rising_rad = 0,      ///< NaN without a common point
      falling_rad = 0;     ///< NaN without a common point
  std::size_t points = 0;  ///< that both have, on both branches
};
/// Throws InputError where the grids share no torque.
[[nodiscard]] Difference difference(const Branches& a, const Branches& b);

/// The same in torque: at each recorded deflection, the simulated branch's torque there less the recorded one. For a stiff joint
/// this is the larger error, for a soft one the smaller: RMS in deflection alone counts a soft preset many times over.
///
/// The simulated branch δ(τ) is first made monotone: neighbours that fall back (an encoder's count, the turn of a loop) are pooled
/// to their means (isotonic regression), each pool one knot; τ(δ) is linear between the knots. A recorded deflection beyond the
/// last knot is followed along the line through that knot and the farthest one within 0.5 N·m of it, and counted as `extrapolated`.
struct TorqueDifference {
  double both_Nm = 0,      ///< root mean square over both branches
      rising_Nm = 0,       ///< NaN without points
      falling_Nm = 0;      ///< NaN without points
  std::size_t points = 0,  ///< recorded ones, compared
      extrapolated = 0;    ///< of these, beyond the simulated branch's last knot
};
/// All NaN, no points, where neither simulated branch has two knots.
[[nodiscard]] TorqueDifference torque_difference(const Branches& simulated, const Branches& recorded);

/// Torque of a simulated branch at a deflection, as above; `beyond` tells that it is extrapolated. NaN with fewer than two knots.
struct BranchTorque {
  double torque_Nm = 0;  ///< NaN with fewer than two knots
  bool beyond = false;   ///< whether it is extrapolated
};
/// A simulated branch read backwards: deflections to torques.
class BranchInverse {
 public:
  /// What isn't finite is left out.
  BranchInverse(const std::vector<double>& torque_Nm, const std::vector<double>& deflection_rad);
  [[nodiscard]] BranchTorque at(double deflection_rad) const;                      ///< at one recorded deflection
  [[nodiscard]] std::size_t knots() const noexcept { return deflection_.size(); }  ///< fewer than two: at() gives NaN

 private:
  std::vector<double> deflection_, torque_;  ///< strictly increasing, increasing
};

/// A quantity over time: columns time_s (strictly increasing) and `column`.
struct TimeSeries {
  std::vector<double> time_s,  ///< strictly increasing
      value;                   ///< of the column
};
/// Throws InputError as read_load_recording() does.
[[nodiscard]] TimeSeries read_series(const std::filesystem::path& csv, std::string_view column);

/// The commanded preset in a file's name and its unit: "stiffness_preset_0.6903rad_samples.csv" → 0.6903, "rad".
struct NamedPreset {
  double value = 0;  ///< as the file's name has it
  std::string unit;  ///< "rad"
};
/// Throws InputError where the name has none.
[[nodiscard]] NamedPreset preset_of_name(const std::filesystem::path& csv);

}  // namespace vsa::experiment
