// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A ball on a lever, axis upright (world bench_throw). The equilibrium swings back by an angle, and after a while forward: the
// spring takes up energy from the lever's motion and from the motors, and gives it back at the right moment. How fast does the ball
// get, against the fastest that the motors turn?
//
//   ratio = max |q̇| / max |θ̇|,  θ = (x₁ + x₂)/2 the pulleys' mean: 1 for a stiff joint; 2 for a spring whose motor runs at constant
//   speed, without friction (the ball swings about the moving equilibrium); more with a back swing.
#pragma once

#include <vector>

namespace vsa::stiffness_uses {

struct ThrowTrace {
  std::vector<double> time_s, equilibrium_rad, link_rad, link_rad_per_s, motor_rad_per_s;
};

struct ThrowRun {
  double preset_rad = 0, attained_rad = 0;
  double swing_back_s = 0;     ///< from the command back to the command forward; 0: forward only
  double link_rad_per_s = 0;   ///< fastest, forward
  double motor_rad_per_s = 0;  ///< fastest, either way
  double spring_J = 0;         ///< most that the springs held above their energy at rest, after the forward command
  double supply_J = 0;         ///< drawn until the ball is fastest
  double kinetic_J = 0;        ///< of lever and ball then
  double release_deg = 0;      ///< where the lever is then
  double imbalance_J = 0;      ///< of the energy ledger at the end
  ThrowTrace trace;            ///< empty unless asked for
  [[nodiscard]] double ratio() const { return motor_rad_per_s > 0 ? link_rad_per_s / motor_rad_per_s : 0; }
};

struct ThrowPlan {
  double preset_rad = 0.2;
  double swing_rad = 1.0;  ///< from −swing to +swing; from 0 where there is no back swing
  double swing_back_s = 0.4;
  bool trace = false;
};

[[nodiscard]] ThrowRun run_throw(const ThrowPlan& plan);

/// The plan with each of the times for swinging back; best_of: the run with the fastest ball.
[[nodiscard]] std::vector<ThrowRun> sweep_throw(ThrowPlan plan, const std::vector<double>& swing_back_s);
[[nodiscard]] const ThrowRun& best_of(const std::vector<ThrowRun>& runs);

}  // namespace vsa::stiffness_uses
