// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the experiments measure, from samples alone: simulated or recorded.
#pragma once

#include <array>
#include <vector>

#include "vsa/experiment/recording.hpp"

namespace vsa::experiment {

/// Hysteresis of a torque–deflection loop, over the torques at which both branches are known.
struct Loop {
  double area_Nm_rad = 0;         ///< ∫(falling − rising) dτ by trapezoids; > 0 where energy is lost
  double mean_width_rad = 0;      ///< mean of (falling − rising)
  double mean_abs_width_rad = 0;  ///< mean of |falling − rising|
  double largest_width_rad = 0,   ///< of falling − rising
      smallest_width_rad = 0;     ///< of falling − rising; negative: they cross
  double peak_rising_rad = 0,     ///< largest abs(δ) of the rising branch
      peak_falling_rad = 0;       ///< of the falling branch
};
/// All NaN with fewer than two common points.
[[nodiscard]] Loop loop(const Branches& branches);
/// Of two at the torques at which both have a width: what one of them lacks is no difference of the two.
[[nodiscard]] std::array<Loop, 2> loops(const Branches& a, const Branches& b);

/// Stiffness against deflection, σ = dτ/dδ. About each torque of the grid a cubic τ(δ) is fitted by least squares to the points of
/// each branch within ±window/2; its slope in the middle and that slope's standard error follow from the residuals; then the
/// mean of the branches. A point is left out where a branch doesn't fill the window or a slope isn't positive. The law's own
/// curvature biases σ by less than 3 % for the qbmove maker pro's law from preset 0.3 rad up, and 9 % below (tests).
struct StiffnessPoint {
  double deflection_rad = 0,          ///< δ
      torque_Nm = 0,                  ///< τ
      stiffness_Nm_per_rad = 0,       ///< σ there
      standard_error_Nm_per_rad = 0;  ///< of σ
};
/// Increasing in the deflection; empty where nothing fits.
[[nodiscard]] std::vector<StiffnessPoint> stiffness_curve(const Branches& branches, double window_Nm = 0.4);

/// A step response y(t), commanded from `from` to `to`, time in s. "Attained change" is final value − from. Rates are per second in
/// y's unit, positive towards the final value. NaN where there is nothing to measure: y never left `from`, or never reached 90 %.
struct StepMeasures {
  double rise_s = 0;         ///< 10–90 % of the attained change, crossings interpolated
  double rise_start_s = 0;   ///< when 10 % was reached, on the clock of time_s
  double mean_speed = 0;     ///< Δy/Δt over the rise, eq. (9): rad/s
  double peak_slope = 0;     ///< largest dy/dt between neighbouring samples, towards the final value
  double overshoot_pct = 0;  ///< of the attained change
  double ringing_Hz = 0;     ///< dominant, by the extrema after 90 %; NaN: fewer than two swings (one period) beyond the floor
  double damping_ratio = 0;  ///< by the logarithmic decrement of successive swings; NaN where fewer than two can be measured
  double final_value = 0;    ///< mean of the last tenth
  double steady_error = 0;   ///< final value − commanded
};
/// Twice a count of the qbmove's 12-bit encoder: what flickers by one count swings by less.
inline constexpr double kRingingFloor_rad = 2 * 6.283185307179586 / 4096;

/// Swings (peak to peak) up to `ringing_floor`, in y's unit, are noise; so are those below a twentieth of the largest.
[[nodiscard]] StepMeasures step_measures(const std::vector<double>& time_s, const std::vector<double>& y, double from, double to,
                                         double ringing_floor = kRingingFloor_rad);

}  // namespace vsa::experiment
