// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One unit about a point at which it stands still, as a linear system: ẋ = A x + B u, y = C x + D u, all deviations from that point.
//
//   M q̈   = −H_qq q − Σ H_qi x_i − d q̇ + τ_load                         M, d: inertia and damping of all that the shaft turns
//   J ω̇_i = −H_iq q − Σ H_ij x_j − b ω_i + K_τ I_i                       H: the law's second derivatives at the point
//   L İ_i = V_i − R I_i − K_b ω_i,   or without an inductance            R with the bridge's switches
//   I_i   = V_i/R − (K_b/R) ω_i;     with a modulated enable pin  I_i = (∂ī/∂d)/V_s V_i + (∂ī/∂e) K_b ω_i   (drive/pwm_cycle.hpp)
//
// All at the pulleys. The inputs beside the load torque τ_load (about +q) depend on what the firmware does:
//   frozen    V_i, V: the bridges' mean voltages; the program does nothing
//   averaged  r_i, rad: V_i = G_i (P (r_i − x_i) − D T ω_i), in continuous time. Valid far below the loop's rate
//   sampled   r_i, rad, in force at a loop: x(k+1) = A x(k) + B u(k) over its period T (1 or 2 ms), held voltages, from the matrix
//             exponential; V_i(k) = G_i (P (r_i − x_i(k)) + D (x_i(k−1) − x_i(k))), the last loop's angles as states; τ_load is held
// P, D: the position loop's gains, % per rad. G_i: volts per %, with supply, the firmware's limit and the bridge's dead band, at the
// voltage at which motor i stands there: where that lies inside the dead band, G_i is 0.
//
// THE POINT: pulleys where they attain equilibrium and preset, the shaft where it is said to be or where a load puts it, everything at
// rest. The motors carry their springs' loads, K_τ I_i = −load_i; what needs more than full voltage is refused.
//
// DRY FRICTION is constant where it slides and so has no slope:
//   sliding   left out: gears, shaft and tendons turn without it; so does what a gear loses with its load
//   stuck     each bristle is a spring, bent little and from a relaxed state: τ_c/z_max at each gear and at the shaft; for a tendon
//             κ = (μ/w_max) T_i² between shaft and pulley, with the damper κ T_d. Good for swings smaller than the preslidings
// Also left out: quantisation of encoders and duty, and all limits.
//
// A SERVO (vsa/control/servo.hpp) is taken the same three ways; its filters and integrals are states, and sampled its last angles. A
// torque servo has its equilibrium as input, and the point is that of its pulley.
//
// The laws of elastic/ are smooth but for the edges of their pieces, where H is the one of the side they call their own.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "vsa/device/unit.hpp"

namespace vsa::linear {

/// How the unit's program is taken: not at all, voltages being the inputs; as a loop in continuous time; or from loop to loop.
enum class Firmware { frozen, averaged, sampled };
/// How dry friction, which has no slope, is taken: left out, or each bristle as a spring.
enum class DryFriction { sliding, stuck };

/// Where a unit stands when it is made linear.
struct OperatingPoint {
  double equilibrium_rad = 0;            ///< attained by the pulleys
  double preset = 0;                     ///< attained; the law's unit, within the unit's preset_max
  std::optional<double> shaft_rad{};     ///< none: where load_Nm puts it
  double load_Nm = 0;                    ///< external torque about +q; counts where no shaft_rad is given
  std::optional<double> inertia_kgm2{};  ///< M > 0; none: the unit's bare flange
  double damping_Nms_per_rad = 0;        ///< d ≥ 0
};

/// How the unit stands at the point.
struct Rest {
  elastic::Positions at;            ///< shaft and pulleys, rad
  double load_Nm = 0;               ///< external torque about +q that holds the shaft
  std::array<double, 2> motor_V{},  ///< mean voltage of each motor
      motor_A{};                    ///< current of each motor
};

/// One of a system's states, inputs or outputs.
struct Signal {
  std::string name,  ///< "motor 1 speed"
      unit;          ///< "rad/s"
};

/// A linear system about a point: ẋ = A x + B u, or from loop to loop, and y = C x + D u.
struct System {
  Firmware firmware = Firmware::frozen;  ///< how the program was taken
  double period_s = 0;                   ///< sampled: T; else 0
  std::vector<Signal> states,            ///< rows of A
      inputs,                            ///< columns of B
      outputs;                           ///< rows of C
  Eigen::MatrixXd a,                     ///< A: states × states
      b,                                 ///< B: states × inputs
      c,                                 ///< C: outputs × states
      d;                                 ///< D: outputs × inputs
  Eigen::Index torques = 1;              ///< how many inputs, the first ones, are load torques, each on a shaft or joint of its own
  /// Sampled: the continuous system between two loops, inputs load torques and voltages; its states are the first of `states`.
  Eigen::MatrixXd held_a,            ///< A; empty where it isn't sampled
      held_b;                        ///< B, likewise
  std::vector<std::string> notices;  ///< what a user should know of this point
};

/// One unit about a point: the system, and how it stands there.
struct Model : System {
  Rest rest;                               ///< how it stands there
  double inertia_kgm2 = 0,                 ///< M
      damping_Nms_per_rad = 0;             ///< d
  double held_stiffness_Nm_per_rad = 0;    ///< seen at the shaft with the pulleys held: the law's, and stuck frictions
  double static_stiffness_Nm_per_rad = 0;  ///< with the motors yielding as the firmware lets them: 0 where it is frozen
};

/// Throws InputError: parameters that no unit has, a point that its program can't hold or its motors can't carry, an inertia or
/// damping out of range; averaged and sampled: a program that isn't a plain position loop (mode 0, references from the bus, no
/// integral); stuck: a gear without presliding.
[[nodiscard]] Model linearize(const device::UnitConfig& unit, const OperatingPoint& point, Firmware firmware,
                              DryFriction friction = DryFriction::sliding);

/// A pole of a system, with its frequency and damping ratio.
struct Pole {
  std::complex<double> s;    ///< 1/s; sampled: ln(z)/T
  double frequency_Hz = 0;   ///< |s|/2π
  double damping_ratio = 0;  ///< −Re s/|s|; 1 for s = 0
};
/// Those with Im s ≥ 0, by frequency; 0 as often as the motion has it, to within rounding of A. Sampled: without z = 0, which is over
/// after one period.
[[nodiscard]] std::vector<Pole> poles(const System& system);
/// How the states share in each pole's motion: states × poles(), columns of length 1.
[[nodiscard]] Eigen::MatrixXcd shapes(const System& system);

/// The states' phasors under a load torque of 1 N·m e^{jωt}: states × torques. Sampled: torques in continuous time, states at the
/// loops. Throws InputError for a frequency that isn't above 0, sampled: and below 1/(2T).
[[nodiscard]] Eigen::MatrixXcd answers(const System& system, double frequency_Hz);

/// What answers a sinusoidal torque at the shaft: impedance, compliance, and the actuator's own stiffness and damping.
struct Response {
  double frequency_Hz = 0;          ///< of the torque
  std::complex<double> impedance;   ///< Z = τ_load/q̇, N·m·s/rad, inertia and damping of the shaft included
  std::complex<double> compliance;  ///< q/τ_load, rad/(N·m)
  /// Of the actuator alone, jω(Z − jωM − d) = stiffness + jω damping:
  double stiffness_Nm_per_rad = 0;  ///< Re jω(Z − jωM − d)
  double damping_Nms_per_rad = 0;   ///< Im of it, over ω
};
/// At frequencies as answers().
[[nodiscard]] Response response(const Model& model, double frequency_Hz);
/// `per_decade` a decade, both ends included.
[[nodiscard]] std::vector<double> logarithmic(double from, double to, int per_decade);

}  // namespace vsa::linear
