// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What an actuator can do at constant speed, from its law and its drive alone: torque, speed and stiffness that go together.
//
//   V     = bridge(1, limit)                                    full voltage: supply, firmware's limit, driver's drop
//   M⁺(ω) = (K_τ V/R − τ_c − (K_τ K_b/R + b) ω)/(1 + λ)         most that a motor gives to its pulley, driving it at ω ≥ 0
//   M⁻(ω) = −(K_τ V/R + τ_c + (K_τ K_b/R + b) ω)                most that it brakes it with; friction helps
//
// or, where the bridge's enable pin is modulated, K_τ ī(d, K_b ω) − b ω in place of K_τ V/R − (K_τ K_b/R + b) ω, with the circuit's
// own mean current at full duty d (drive/pwm_cycle.hpp), and V := ī(d, 0) R; all at the pulley; τ_c Coulomb friction, λ the
// friction that grows with the load (K_τ, K_b, b, τ_c after the gearbox). The bridge's dead band has no part in V: full output
// gives full voltage. With a servo K_τ I_max ∓ b ω bounds both, and full voltage is the supply.
//
// While the shaft turns at ω against a load it stays behind its equilibrium by d, and the law's inputs follow the equilibrium with
// ẋ_i = r_i ω, r_i = ∂x_ref,i/∂θ. Motor i carries M_i = −load_i(q₀ − d, x_ref(0, p)). (ω, p) is reachable with every lag from d₀ up
// to d for which, d₀ being that of the shaft at rest: 0 if the springs are alike, else of either sign (elastic/inverse.hpp)
//
//   M⁻(|r_i ω|) ≤ sign(r_i ω) M_i ≤ M⁺(|r_i ω|)  for all motors;    an input that stands (r_i = 0):  (1 − λ_b)|M_i| ≤ K_τ V/R + τ_c
//   σ ≥ 0                                         beyond the law's largest torque the joint gives way
//
// Torque at the shaft: τ(q₀ − d) − τ_shaft; stiffness: σ there. At the largest p the motors hold each other: pretension costs
// torque. Holding (ω = 0, friction helps): (1 − λ_b)|M_i| ≤ K_τ V/R + τ_c, without voltage ≤ τ_c, and the shaft's friction adds.
// What friction doesn't hold costs current, and the windings turn it into heat:
//
//   I_i = max(0, (1 − λ_b)|M_i| − τ_c)/K_τ,    P = Σ R I_i²
//
// Valid for rotary inputs and steady motion: no heat, no inertia, no controller error (the attained preset, not the commanded one).
// Friction along the springs (tendon.*) changes the deflection at which a torque passes, not the torque that the motors can pass.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "vsa/device/unit.hpp"

namespace vsa::experiment {

/// A motor with its gearbox at full voltage, at the pulley.
struct MotorLine {
  double full_duty = 0;                 ///< of the supply, at full output
  double voltage_V = 0;                 ///< V
  double stall_Nm = 0;                  ///< K_τ V/R, before friction; with a servo no more than its current gives
  double stall_current_A = 0;           ///< V/R, or the servo's limit
  double friction_Nm = 0;               ///< τ_c
  double back_Nms_per_rad = 0;          ///< K_τ K_b/R + b
  double torque_constant_Nm_per_A = 0,  ///< K_τ
      resistance_Ohm = 0;               ///< R in the way of V
  double full_Nm = 0;                   ///< K_τ V/R whatever limits the current
  double limit_Nm = std::numeric_limits<double>::infinity();  ///< K_τ I_max of a servo
  double viscous_Nms_per_rad = 0;                             ///< b
  double load_loss = 0;                                       ///< λ
  double back_loss = 0;                                       ///< λ where the load drives the motor back
  /// The enable pin is modulated: the motor at full duty, both ways.
  struct Chopped {
    drive::PwmCycle along,  ///< full duty, driving the motor
        against;            ///< full duty, braking it
    /// K_τ, K_b, b at the pulley.
    double torque_constant_Nm_per_A = 0,  ///< K_τ
        back_emf_Vs_per_rad = 0,          ///< K_b
        viscous_Nms_per_rad = 0;          ///< b
    /// M of a cycle at a speed.
    [[nodiscard]] double torque_Nm(const drive::PwmCycle& cycle, double speed_rad_per_s) const noexcept {
      return torque_constant_Nm_per_A * cycle.mean(back_emf_Vs_per_rad * speed_rad_per_s).current -
             viscous_Nms_per_rad * speed_rad_per_s;
    }
  };
  std::optional<Chopped> chopped;  ///< of a bridge whose enable pin is modulated

  [[nodiscard]] double most_Nm(double speed_rad_per_s) const noexcept;   ///< M⁺; negative beyond the no-load speed
  [[nodiscard]] double least_Nm(double speed_rad_per_s) const noexcept;  ///< M⁻
  [[nodiscard]] double no_load_speed_rad_per_s() const noexcept;         ///< where M⁺ is 0; 0: friction holds the motor
};
/// Of motor 0 or 1.
[[nodiscard]] MotorLine motor_line(const device::UnitConfig& unit, std::size_t motor);

/// Mean voltage that a standing motor gets at a controller output, V: its current times the resistance in its way.
[[nodiscard]] double standing_voltage(const device::UnitConfig& unit, std::size_t motor, double output, double full_duty) noexcept;

/// What the actuator is to do with its load.
enum class Task {
  move,      ///< turn against the load at a speed; at speed 0: begin to
  hold,      ///< stand still, both motors at full voltage
  unpowered  ///< stand still without voltage, by friction alone
};

/// The end of the reachable range: the largest load. NaN where not even an unloaded shaft is reachable.
struct Reach {
  double deflection_rad = 0;        ///< d, from the equilibrium; ≥ 0 where the springs are alike
  double torque_Nm = 0;             ///< at the shaft, in the direction of motion
  double stiffness_Nm_per_rad = 0;  ///< σ there
  double energy_J = 0;              ///< H there
};

/// One point of the boundary of the torque–speed–stiffness workspace.
struct WorkspacePoint {
  double speed_rad_per_s = 0;  ///< ω
  Reach reach;                 ///< the largest load at it
};

/// Output power at its largest along a boundary.
struct BestPower {
  double power_W = 0,       ///< P = τω
      torque_Nm = 0,        ///< τ there
      speed_rad_per_s = 0;  ///< ω there
};
/// The point of the boundary with the most power.
[[nodiscard]] BestPower best_power(const std::vector<WorkspacePoint>& boundary);

/// What a place at standstill costs. NaN where full voltage doesn't hold it, or the law doesn't.
struct Holding {
  double current_A = 0;  ///< Σ I_i
  double power_W = 0;    ///< P
};

/// The law under an external load at a preset, pulleys held: what a torque–deflection curve shows.
struct LawPoint {
  double deflection_rad = 0,     ///< δ, from the equilibrium
      load_Nm = 0,               ///< external
      stiffness_Nm_per_rad = 0;  ///< σ
};

/// Which torque, speed and stiffness an actuator reaches together at constant speed, from its law and its drive alone.
class Workspace {
 public:
  explicit Workspace(const device::UnitConfig& unit);  ///< parameters that device::validate() passes

  /// Of each motor; where the law has one, it twice.
  [[nodiscard]] const std::array<MotorLine, 2>& lines() const noexcept { return lines_; }
  /// The largest preset that both motors can wind the unloaded springs to, at most the unit's limit; 0 for a law without preset.
  [[nodiscard]] double attainable_preset() const;
  /// `direction` +1 or −1: which way the shaft is driven; they differ for unequal springs.
  [[nodiscard]] Reach reach(double preset, double speed_rad_per_s, Task task = Task::move, int direction = 1) const;
  /// The largest load that it begins to move in both directions.
  [[nodiscard]] double moves_Nm(double preset) const;
  /// The largest speed of the unloaded shaft; `direction` as reach() has it.
  [[nodiscard]] double no_load_speed(double preset, int direction = 1) const;
  /// From standstill to the no-load speed, evenly spaced.
  [[nodiscard]] std::vector<WorkspacePoint> boundary(double preset, int points, int direction = 1) const;
  /// Between the largest loads that the motors move in both directions.
  [[nodiscard]] std::vector<LawPoint> law_curve(double preset, int points) const;
  [[nodiscard]] double stiffness_at_rest(double preset) const;  ///< σ with the shaft unloaded
  /// H with the shaft unloaded.
  [[nodiscard]] double energy_at_rest(double preset) const;
  /// σ with the pulleys held under an external load; NaN beyond what the motors move.
  [[nodiscard]] double stiffness_under(double preset, double load_Nm) const;
  /// With the shaft under an external load, its own friction left out.
  [[nodiscard]] Holding holding(double preset, double load_Nm = 0) const;

 private:
  [[nodiscard]] elastic::Response at(double preset, double lag_rad, int direction) const;
  [[nodiscard]] double lag_at_rest(double preset, int direction) const;
  [[nodiscard]] bool carries(const elastic::Response& r, const std::array<double, 2>& rates, double speed, Task task) const;
  [[nodiscard]] bool winds(double preset) const;
  [[nodiscard]] std::optional<double> lag_under(double preset, double load_Nm, Task task) const;

  device::UnitConfig unit_;
  std::array<MotorLine, 2> lines_;
};

}  // namespace vsa::experiment
