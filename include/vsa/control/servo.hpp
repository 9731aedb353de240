// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Controllers that aren't the qbmove's program: servo drives as other actuators have them, on an ideal bus.
//
// A TICK every T = 1 ms, sample and hold: encoders and supply are read, the voltages found here stand until the next tick. A command
// is in force at the first tick that finds it. All angles, speeds and torques are at the pulleys.
//   x̂, q̂   angles of motors and shaft as their encoders have them, turns counted                                       rad
//   ω̂      their speeds: ω̂ += T/(T + T_f)·(Δx̂/T − ω̂), T_f the filter's time constant                               rad/s
//
// THE DRIVE turns a wanted torque τ_w into a voltage, as one with a current loop far faster than T does; between two ticks the
// voltage stands and the current follows the speed:
//   i = clamp(τ_w/K_τ, ±I_max),   V = clamp(R i + K_b ω̂, ±supply)                R with the bridge's switches
//
// POSITION SERVO, each motor by itself; x* = clamp(the law's reference for equilibrium and preset, ±x_max), in whole counts of the
// encoder, so that a motor that stands on it has no error to integrate:
//   ω* = clamp(k_x (x* − x̂), ±ω_max)
//   τ_w = k_ω (ω* − ω̂) + ξ,    ξ += k_ξ T (ω* − ω̂)
//
// TORQUE SERVO, of a law with one motor and H(q − x), a series elastic unit; τ̂ is the law's own torque at (q̂, x̂), and the command
// makes the joint a spring of the stiffness k about the equilibrium θ. The preset (N·m/rad) is added to the stiffness k₀ that the
// type has; τ_c is a torque commanded besides, 0 at first:
//   τ* = −k (q̂ − θ) − d ω̂_q + τ_c,    k = max(k₀ + preset, 0)
//   τ_w = h (τ* + k_τ (τ* − τ̂)) + ξ − d_x ω̂_x,    ξ += h k_ξ T dead_zone(τ* − τ̂)
// h is 1 where pulley and shaft turn together. In a linear actuator, whose q̂ is in m and τ in N, it is the lead, m/rad
// (elastic::shaft_per_pulley), and the shaft's encoder counts a turn in so many metres.
// A spring behind it can't be passive if it shall be stiffer than the unit's own: k ≤ ∂²H/∂q².
//
// MOTOR VOLTAGES: V = clamp(what was commanded, ±supply). For who closes the loops.
//
// WINDUP: ξ stops growing while current or supply limit the torque in the sense of the error; |ξ| ≤ K_τ I_max.
// SOURCE: cascades of P, PI and current limit are every maker's; torque from the spring's deflection with motor damping: Pratt &
// Williamson, Series Elastic Actuators (1995); k ≤ the spring's: Vallery et al., Passive and accurate torque control of series elastic
// actuators (2007). Written from the equations; no product's program.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string_view>

#include "vsa/drive/motor.hpp"
#include "vsa/elastic/transmission.hpp"
#include "vsa/errors.hpp"
#include "vsa/state_fields.hpp"

namespace vsa::control {

inline constexpr double kTick_s = 1e-3;  ///< T
/// Beyond it a double has no counts left to tell; states of integers have more.
inline constexpr double kFarthest_rad = 1e9;

/// Which servo: a cascade on each motor's position, one on the spring's torque, or none, voltages as they are commanded.
enum class ServoKind : std::uint8_t { position_servo, torque_servo, motor_voltages };
[[nodiscard]] std::string_view name_of(ServoKind kind) noexcept;  ///< as files write it

/// A position servo's gains and limit: ω* = clamp(k_x (x* − x̂), ±ω_max), τ_w = k_ω (ω* − ω̂) + ξ; for both motors, at the pulley.
struct PositionServoParams {
  double gain_per_s = 0;              ///< k_x
  double speed_max_rad_per_s = 0;     ///< ω_max
  double speed_gain_Nms_per_rad = 0;  ///< k_ω
  double integral_Nm_per_rad = 0;     ///< k_ξ; 0: none
  bool operator==(const PositionServoParams&) const = default;
};

/// A torque servo's gains, and the joint that it makes: τ* = −k (q̂ − θ) − d ω̂_q + τ_c, k = max(k₀ + preset, 0).
struct TorqueServoParams {
  double gain = 0;                       ///< k_τ
  double integral_per_s = 0;             ///< k_ξ; 0: none
  double dead_zone_Nm = 0;               ///< of the integral: what the encoders can't tell
  double motor_damping_Nms_per_rad = 0;  ///< d_x
  double stiffness_Nm_per_rad = 0;       ///< k₀
  double damping_Nms_per_rad = 0;        ///< d
  bool operator==(const TorqueServoParams&) const = default;
};

/// A servo's parameters: those of its kind, and what all have.
struct ServoParams {
  ServoKind kind = ServoKind::position_servo;  ///< which one it is
  double current_max_A = 0;                    ///< I_max; not of motor_voltages
  double speed_filter_s = 0;                   ///< T_f; not of motor_voltages
  double reference_max_rad = 0;                ///< x_max; of position_servo
  PositionServoParams position;                ///< counts with position_servo
  TorqueServoParams torque;                    ///< counts with torque_servo
  bool operator==(const ServoParams&) const = default;
};

/// Adds what is out of range of the kind's own parameters; `where` leads each key.
void validate(const ServoParams& params, std::string_view where, Problems& problems);

/// What a unit with a servo was told last.
struct ServoCommand {
  double equilibrium = 0,          ///< rad
      preset = 0;                  ///< in the law's unit; of a torque servo added to k₀, N·m/rad
  std::array<double, 2> direct{};  ///< torque servo: τ_c, N·m; motor voltages: V
  static auto fields(auto& s, auto&& visit) {
    return visit("equilibrium", "rad", s.equilibrium, "preset", "the preset's", s.preset, "direct", "V or N·m", s.direct);
  }
};

/// All that changes of a servo, from tick to tick.
struct ServoState {
  ServoCommand command;               ///< in force
  std::array<std::int64_t, 3> raw{};  ///< motor 1, motor 2, shaft as counted, 65536 per turn
  std::array<double, 3> speed{};      ///< ω̂
  std::array<double, 2> integral{};   ///< ξ, N·m
  std::array<double, 2> voltage{};    ///< V since the last tick
  bool fresh = true;                  ///< no tick yet: where the shaft is will be known at the first
  double begun_rad = 0;               ///< where it was thought to be
  static auto fields(auto& s, auto&& visit) {
    return visit("command", "", s.command, "counted", "raw", s.raw, "speed", "rad/s", s.speed, "integral", "N·m", s.integral,
                 "voltage", "V", s.voltage, "fresh", "", s.fresh, "begun", "rad", s.begun_rad);
  }
  [[nodiscard]] const char* impossible() const noexcept;
};

/// What the electronics read at a tick.
struct ServoReadings {
  std::array<std::int32_t, 3> encoder{};  ///< motor 1, motor 2, shaft within the turn (sensor::encoder_sample)
  double supply_V = 0;                    ///< at the bridge
};

/// Where motors and shaft are, and how fast, as encoders would have it that count turns.
struct ServoPlace {
  std::array<double, 3> angle{},  ///< of motor 1, motor 2, shaft, rad
      speed{};                    ///< likewise, rad/s
  std::array<double, 2> held{};   ///< torque of each motor that holds its spring, N·m
};

/// A motor at its pulley, with all the resistance that its current meets, and a count of the encoder there.
struct ServoMotor {
  drive::MotorParams motor;  ///< as drive::at_pulley gives it
  double count_rad = 0;      ///< of the encoder
  double shaft_per_rad =
      1;  ///< how far the shaft goes with a radian of the pulley where the spring doesn't give (elastic/travel.hpp)
};

/// One unit's servo drive: once a tick of 1 ms it turns encoders and command into the motors' voltages. A state belongs to whoever
/// owns time.
class Servo {
 public:
  /// Parameters that validate() takes, torque constants above 0.
  /// `shaft_per_rad`: of the shaft's encoder, 1 where that turns with the shaft.
  Servo(const ServoParams& params, const std::array<ServoMotor, 2>& motors, std::shared_ptr<const elastic::Transmission> law,
        double shaft_per_rad = 1);

  [[nodiscard]] const ServoParams& params() const noexcept { return params_; }  ///< as given
  /// x*, before counts.
  [[nodiscard]] std::array<double, 2> references(const ServoCommand& command) const noexcept;
  /// k of the joint that a torque servo makes.
  [[nodiscard]] double stiffness(double preset) const noexcept {
    return std::fmax(params_.torque.stiffness_Nm_per_rad + preset, 0.0);
  }
  /// Where the pulley of a torque servo stands when all is at rest: its spring gives −k (q − θ) + τ_c.
  [[nodiscard]] double pulley(const ServoCommand& command, double shaft_rad) const noexcept;

  /// One tick; the voltages are the state's.
  void step(ServoState& state, const ServoReadings& readings) const noexcept;
  /// As if it had stood there for long, or gone on so: counts, speeds, and what holds the springs.
  void settle(ServoState& state, const ServoReadings& readings, const ServoPlace& at) const noexcept;
  /// A tick without power: no voltage, filters and integrals are gone; encoders go on counting turns, as those with a battery do.
  void rest(ServoState& state, const ServoReadings& readings) const noexcept;

 private:
  struct Driven {
    double volts = 0;
    double missing = 0;  ///< sign of the torque that a limit took
  };
  void sense(ServoState& state, const ServoReadings& readings) const noexcept;
  [[nodiscard]] Driven drive(int i, double torque, double speed, double supply_V) const noexcept;
  void integrate(ServoState& state, int i, double rate, const Driven& driven) const noexcept;
  /// The torque of motor i with all the current that it may have.
  [[nodiscard]] double most(int i) const noexcept { return motor_[i].motor.torque_constant_Nm_per_A * params_.current_max_A; }
  void position(ServoState& state, double supply_V) const noexcept;
  void torque(ServoState& state, double supply_V) const noexcept;

  ServoParams params_;
  std::array<ServoMotor, 2> motor_;
  std::shared_ptr<const elastic::Transmission> law_;
  double shaft_per_rad_;
  int motors_;
  double filter_;  // T/(T + T_f)
};

/// A torque that is inside the zone counts for nothing, one outside by what it is more.
[[nodiscard]] double dead_zone(double torque, double zone) noexcept;

}  // namespace vsa::control
