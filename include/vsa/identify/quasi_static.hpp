// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The load test without dynamics: what it shows if the sweep is so slow that nothing but springs, friction and the motors' static
// torque counts. A thousandth of a simulation's cost, so that a global search can try thousands of parameter sets.
//
//   s = +1 on the rising branch, −1 on the falling: springs are bent further (sign of δ̇), motors and shaft turn the other way, −s.
//   With the shaft at q = 0 (a law is the same at every equilibrium), external torque τ, pulleys x, references x_ref(θ, p):
//
//   l_i = load_i(q, x) + μ s |load_i|                                     spring and tendon friction on pulley i       N·m
//   F_i = τ_c + λ |l_i|                                                   gearbox; λ = back_loss where l_i drives the motor
//   0   = M(x_ref,i − x_i) + l_i + s F_i                                  a motor that slides                          N·m
//   0   = τ + τ_law(q, x) − μ s Σ|load_i| + s f                           the shaft, f its Coulomb friction            N·m
//
// M is the position loop's static drive: error → duty by the unit's own program → mean current at standstill by the bridge's
// own cycle → torque at the pulley (StaticDrive). Unknown are the pulleys, each by bracketing, and around them θ. The reading is
// δ = shaft_zero − attained(x).
//
// Range: |τ| below M g r, branches away from the turning points. It doesn't see inertia, viscous and electrical damping,
// presliding, the sweep's speed, or encoders' steps; against the simulated bench it errs by a few mrad (docs/11-identify.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vsa/device/unit.hpp"
#include "vsa/experiment/recording.hpp"

namespace vsa::identify {

/// Mean motor torque at the pulley for a position error, at standstill.
class StaticDrive {
 public:
  /// Of motor 1; both motors of a unit have one loop. See unsupported().
  explicit StaticDrive(const device::UnitConfig& unit);
  /// Between the program's steps the straight line through the middle of their risers: a motor that creeps waits at a riser.
  /// Constant beyond the ends. N·m for rad; grows with the error.
  [[nodiscard]] double torque_Nm(double error_rad) const noexcept;

 private:
  std::vector<double> error_rad_, torque_Nm_;
};

/// Why a unit's loop has no static drive curve: another control mode than position, an integral gain, a loop that drives away from
/// its reference. None: it has one.
[[nodiscard]] std::optional<std::string> unsupported(const device::UnitConfig& unit);

class QuasiStatic {
 public:
  /// `load_peak_Nm`: M g r of the bench. The unit must not be unsupported().
  QuasiStatic(const device::UnitConfig& unit, double load_peak_Nm);

  /// The deflection that the unit's encoders read at this torque, as its shaft encoder tells it; NaN where there is no equilibrium.
  [[nodiscard]] double deflection_rad(double preset, double torque_Nm, bool rising) const;
  /// Both branches on a grid, NaN where there is no equilibrium; scatter 0.
  [[nodiscard]] experiment::Branches branches(double preset, const std::vector<double>& torques_Nm) const;

 private:
  /// Pulleys and commanded equilibrium of the last solution: where the next begins.
  struct Place {
    double equilibrium = 0;
    std::array<double, 2> x{};
  };
  struct Branch {
    double preset, sense;  ///< s
  };
  [[nodiscard]] double pulley_residual(const Branch& b, const std::array<double, 2>& ref, std::array<double, 2> x, int i,
                                       double xi) const;
  [[nodiscard]] bool solve_pulleys(const Branch& b, double equilibrium, std::array<double, 2>& x) const;
  [[nodiscard]] double shaft_residual(const Branch& b, double torque_Nm, const std::array<double, 2>& x) const;
  [[nodiscard]] double solve(const Branch& b, double measured_torque_Nm, std::optional<Place>& place) const;

  device::UnitConfig unit_;
  StaticDrive drive_;
  double load_peak_Nm_, gear_friction_Nm_, back_loss_, shaft_zero_rad_;
  int motors_, springs_;
};

}  // namespace vsa::identify
