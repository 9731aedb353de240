// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/control/servo.hpp"

#include <algorithm>
#include <utility>

#include "vsa/units.hpp"

namespace vsa::control {
namespace {

constexpr std::int64_t kTurn_raw = 65536;
constexpr double kRad_per_raw = 2.0 * kPi / static_cast<double>(kTurn_raw);

double rad(std::int64_t raw) noexcept { return static_cast<double>(raw) * kRad_per_raw; }

/// The way from one word within the turn to another, the shorter one.
std::int64_t way(std::int64_t counted, std::int32_t word) noexcept {
  return static_cast<std::int16_t>(
      static_cast<std::uint16_t>(static_cast<std::uint64_t>(word) - static_cast<std::uint64_t>(counted)));
}

/// The count of turns that goes with an angle's word.
std::int64_t counted(double angle_rad, std::int32_t word) noexcept {
  const double turns = std::clamp(angle_rad, -kFarthest_rad, kFarthest_rad) / (2.0 * kPi) - static_cast<double>(word) / kTurn_raw;
  return word + std::llround(turns) * kTurn_raw;
}

}  // namespace

double dead_zone(double torque, double zone) noexcept { return torque - std::clamp(torque, -zone, zone); }

Servo::Servo(const ServoParams& params, const std::array<ServoMotor, 2>& motors, std::shared_ptr<const elastic::Transmission> law,
             double shaft_per_rad)
    : params_(params),
      motor_(motors),
      law_(std::move(law)),
      shaft_per_rad_(shaft_per_rad),
      motors_(law_->motor_count()),
      filter_(kTick_s / (kTick_s + params.speed_filter_s)) {}

std::array<double, 2> Servo::references(const ServoCommand& command) const noexcept {
  std::array<double, 2> x = law_->references({command.equilibrium, command.preset});
  for (double& v : x) v = std::clamp(v, -params_.reference_max_rad, params_.reference_max_rad);
  return x;
}

double Servo::pulley(const ServoCommand& command, double shaft_rad) const noexcept {
  const double wanted = -stiffness(command.preset) * (shaft_rad - command.equilibrium) + command.direct[0];
  const auto short_of = [&](double x) { return law_->evaluate({shaft_rad, {x, 0.0}}).torque < wanted; };
  const double slack = shaft_rad / motor_[0].shaft_per_rad;  // where its spring has no tension
  double reach = 1e-3;
  while (reach < 100 && (short_of(slack + reach) || !short_of(slack - reach))) reach *= 2;
  double low = slack - reach, high = slack + reach;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (short_of(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

void Servo::sense(ServoState& s, const ServoReadings& readings) const noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t moved = way(s.raw[i], readings.encoder[i]);
    s.raw[i] += moved;
    s.speed[i] += filter_ * (rad(moved) / kTick_s - s.speed[i]);
  }
}

Servo::Driven Servo::drive(int i, double torque, double speed, double supply_V) const noexcept {
  const drive::MotorParams& m = motor_[i].motor;
  const double wanted_A = torque / m.torque_constant_Nm_per_A;
  const double allowed_A = std::clamp(wanted_A, -params_.current_max_A, params_.current_max_A);
  const double back_V = m.back_emf_Vs_per_rad * speed;
  const double wanted_V = m.resistance_Ohm * allowed_A + back_V;
  const double volts = std::clamp(wanted_V, -supply_V, supply_V);
  const double got_A = volts == wanted_V ? allowed_A : (volts - back_V) / m.resistance_Ohm;
  const double lost = wanted_A - got_A;
  return {volts, lost > 0 ? 1.0 : lost < 0 ? -1.0 : 0.0};
}

void Servo::integrate(ServoState& s, int i, double rate, const Driven& driven) const noexcept {
  if (rate * driven.missing > 0) return;
  s.integral[i] = std::clamp(s.integral[i] + rate * kTick_s, -most(i), most(i));
}

void Servo::position(ServoState& s, double supply_V) const noexcept {
  const PositionServoParams& p = params_.position;
  const std::array<double, 2> x = references(s.command);
  for (int i = 0; i < motors_; ++i) {
    const double target = std::floor(x[i] / motor_[i].count_rad) * motor_[i].count_rad;
    const double wish = std::clamp(p.gain_per_s * (target - rad(s.raw[i])), -p.speed_max_rad_per_s, p.speed_max_rad_per_s);
    const double error = wish - s.speed[i];
    const Driven driven = drive(i, p.speed_gain_Nms_per_rad * error + s.integral[i], s.speed[i], supply_V);
    integrate(s, i, p.integral_Nm_per_rad * error, driven);
    s.voltage[i] = driven.volts;
  }
}

void Servo::torque(ServoState& s, double supply_V) const noexcept {
  const TorqueServoParams& p = params_.torque;
  const double q = shaft_per_rad_ * rad(s.raw[2]), x = rad(s.raw[0]), h = motor_[0].shaft_per_rad;
  const double damping = p.damping_Nms_per_rad * (shaft_per_rad_ * s.speed[2]);
  const double wish = -stiffness(s.command.preset) * (q - s.command.equilibrium) - damping + s.command.direct[0];
  const double error = wish - law_->evaluate({q, {x, 0.0}}).torque;
  const Driven driven =
      drive(0, h * (wish + p.gain * error) + s.integral[0] - p.motor_damping_Nms_per_rad * s.speed[0], s.speed[0], supply_V);
  integrate(s, 0, h * p.integral_per_s * dead_zone(error, p.dead_zone_Nm), driven);
  s.voltage[0] = driven.volts;
}

void Servo::step(ServoState& s, const ServoReadings& readings) const noexcept {
  sense(s, readings);
  s.fresh = false;
  switch (params_.kind) {
    case ServoKind::position_servo:
      return position(s, readings.supply_V);
    case ServoKind::torque_servo:
      return torque(s, readings.supply_V);
    case ServoKind::motor_voltages:
      for (std::size_t i = 0; i < 2; ++i) s.voltage[i] = std::clamp(s.command.direct[i], -readings.supply_V, readings.supply_V);
  }
}

void Servo::settle(ServoState& s, const ServoReadings& readings, const ServoPlace& at) const noexcept {
  for (std::size_t i = 0; i < 3; ++i) s.raw[i] = counted(at.angle[i], readings.encoder[i]);
  s.speed = at.speed;
  s.integral = {};
  const bool integrates = params_.kind == ServoKind::position_servo && params_.position.integral_Nm_per_rad > 0;
  for (int i = 0; i < motors_ && integrates; ++i) s.integral[i] = std::clamp(at.held[i], -most(i), most(i));
  s.voltage = {};
}

void Servo::rest(ServoState& s, const ServoReadings& readings) const noexcept {
  sense(s, readings);
  s.fresh = false;
  s.speed = {};
  s.integral = {};
  s.voltage = {};
}

}  // namespace vsa::control
