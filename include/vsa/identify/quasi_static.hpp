// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The load test without dynamics: what it shows if the sweep is so slow that nothing but springs, friction and the motors' static
// torque counts. A hundredth of a simulation's cost or less, so that a global search can try thousands of parameter sets.
//
// The shaft goes along the sweep's path, from rest to the one turning point, to the other, and back, in steps of the torque grid.
// With the law taken at q = 0 (it is the same at every equilibrium), external torque τ = −M g r sin q, pulleys x, references
// x_ref(θ, p), and bristles u that friction bends by no more than its presliding (drive/friction.hpp) in each step:
//
//   φ_i = μ u_w,i/w_max,  u_w,i += Δw_i                                    tendon friction of spring i, w its signed energy
//   l_i = load_i(q, x) + φ_i |load_i|                                      on pulley i                                  N·m
//   F_i = K_g u_g,i within ±(τ_c + λ|l_i|),  u_g,i += Δx_i + Δq            gearbox; λ = back_loss where l_i drives the motor
//   0   = M(x_ref,i − x_i) + l_i − F_i                                     a motor that slides or sticks                N·m
//   0   = τ + τ_law(q, x) − Σ φ_i|load_i| − K_s u_s,  u_s += Δq            the shaft
//
// M is the position loop's static drive: error → duty by the unit's own program → mean current at standstill by the bridge's
// own cycle → torque at the pulley (StaticDrive). Unknown are the pulleys, each by bracketing, and around them θ. The reading is
// δ = shaft_zero − attained(x).
//
// Range: |τ| below M g r. It doesn't see inertia, viscous and electrical damping, the sweep's speed, encoders' steps, or that a
// motor sticks and slips between two of them; against the simulated bench it errs by 2 to 5 mrad (docs/howto/identify.md).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "vsa/device/unit.hpp"
#include "vsa/drive/friction.hpp"
#include "vsa/experiment/recording.hpp"

namespace vsa::identify {

/// Mean motor torque at the pulley for a position error, at standstill.
class StaticDrive {
 public:
  /// Of motor 0 or 1. See unsupported().
  StaticDrive(const device::UnitConfig& unit, std::size_t motor);
  /// Between the program's steps the straight line through the middle of their risers: a motor that creeps waits at a riser.
  /// Constant beyond the ends. N·m for rad; grows with the error.
  [[nodiscard]] double torque_Nm(double error_rad) const noexcept;

 private:
  std::vector<double> error_rad_, torque_Nm_;
};

/// Why a unit's loop has no static drive curve: another control mode than position, an integral gain, a loop that drives away from
/// its reference. None: it has one.
[[nodiscard]] std::optional<std::string> unsupported(const device::UnitConfig& unit);

/// Where the sweep turns: with the shaft at an angle, or with the command at an amplitude, rad.
struct Turn {
  double shaft_rad = 0;                 ///< farthest angle
  std::optional<double> amplitude_rad;  ///< given: it decides, and `shaft_rad` is the farthest that is tried
};

/// The load test of one unit without dynamics: springs, frictions and the motors' static torque along the sweep.
class QuasiStatic {
 public:
  /// `load_peak_Nm`: M g r of the bench. The unit must not be unsupported().
  QuasiStatic(const device::UnitConfig& unit, double load_peak_Nm);

  /// Both branches on a grid of torques that grow, as the unit's encoders tell them; NaN where there is no equilibrium or the sweep
  /// doesn't come; scatter 0.
  [[nodiscard]] experiment::Branches branches(double preset, const std::vector<double>& torques_Nm, const Turn& turn) const;

 private:
  /// Where a sweep is: the shaft, the command and the pulleys against it, the bent bristles and the springs' energies.
  struct Place {
    double q = 0, equilibrium = 0;
    std::array<double, 2> x{}, w{};
    double shaft_u = 0;
    std::array<double, 2> gear_u{}, tendon_u{};
  };
  /// A step of the shaft from a place.
  struct Step {
    const Place& from;
    double q, preset;
    double sense;  ///< of q: +1, −1
    std::array<double, 2> ref{};
  };
  [[nodiscard]] Place at_rest(double preset) const;
  /// φ of a spring, N·m a N·m, with its energy at w.
  [[nodiscard]] double rub(const Step& s, int spring, double w) const;
  /// A gearbox's friction under a load, with the pulley turning in a sense.
  [[nodiscard]] drive::FrictionOf<double> gear(std::size_t motor, double load, double sense) const;
  [[nodiscard]] double pulley_residual(const Step& s, std::array<double, 2> x, int i, double xi) const;
  [[nodiscard]] bool solve_pulleys(Step& s, double equilibrium, std::array<double, 2>& x) const;
  [[nodiscard]] double shaft_residual(const Step& s, const std::array<double, 2>& x) const;
  /// Moves the shaft to q; false, and nothing moves: there is no equilibrium there.
  bool go(Place& place, double preset, double q) const;
  /// From rest to the first turning point, which is returned: as far as the motors can.
  double go_to_turn(Place& place, double preset, const Turn& turn) const;
  /// What is read at each torque on the way to the next turning point.
  [[nodiscard]] std::vector<double> follow(Place& place, double preset, const std::vector<double>& torques_Nm, double turn) const;

  device::UnitConfig unit_;
  std::array<StaticDrive, 2> drive_;
  double load_peak_Nm_;
  std::array<drive::Friction, 2> gear_;
  drive::Friction shaft_, tendon_;
  double shaft_zero_rad_;
  int motors_, springs_;
};

}  // namespace vsa::identify
