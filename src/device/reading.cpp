// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/reading.hpp"

#include <algorithm>
#include <cmath>

#include "vsa/firmware/arithmetic.hpp"
#include "vsa/firmware/exchange.hpp"

namespace vsa::device {
namespace {

/// Springs and pulleys stand where the coupling has the shaft, at y = q − dt/2·q̇: here they come to where the shaft is.
std::array<double, 2> pulleys_with_the_shaft(const UnitState& state) noexcept {
  std::array<double, 2> out;
  for (std::size_t m = 0; m < out.size(); ++m) {
    const drive::MotorState& motor = state.actuator.motor[m];
    out[m] = motor.angle + 0.5 * state.last_dt * motor.speed;
  }
  return out;
}

actuator::ActuatorState with_the_shaft(const UnitState& state) noexcept {
  actuator::ActuatorState now = state.actuator;
  const std::array<double, 2> pulleys = pulleys_with_the_shaft(state);
  for (std::size_t m = 0; m < pulleys.size(); ++m) now.motor[m].angle = pulleys[m];
  return now;
}

}  // namespace

UnitReading read(const Unit& unit, const UnitState& state, Torques torques) noexcept {
  const actuator::Actuator& physics = unit.physics();
  const elastic::Transmission& law = *unit.config().actuator.transmission;
  UnitReading r;
  r.shaft_rad = state.reached.angle;
  r.shaft_speed_rad_per_s = state.reached.speed;
  r.mean_torque_Nm = state.applied_torque;
  const std::array<double, 2> pulleys = pulleys_with_the_shaft(state);
  for (int m = 0; m < physics.motors(); ++m) {
    r.motor_rad[m] = pulleys[m];
    r.motor_speed_rad_per_s[m] = state.actuator.motor[m].speed;
    r.current_A[m] = physics.motor_current(state.actuator, m, state.held.voltage[m], state.held.terminal[m], state.held.supply_V);
  }
  const auto attained = law.attained(pulleys);
  r.equilibrium_rad = attained.equilibrium;
  r.preset = unit.config().is(control::ServoKind::torque_servo) ? state.servo.command.preset : attained.preset;
  if (torques == Torques::left_out) {
    r.stiffness_Nm_per_rad = law.evaluate({r.shaft_rad, pulleys}).curvature.qq;
    return r;
  }
  const elastic::Response response = physics.response(with_the_shaft(state), r.shaft_rad);
  r.stiffness_Nm_per_rad = response.curvature.qq;
  r.torque_Nm = response.torque;
  for (int m = 0; m < physics.motors(); ++m) r.motor_torque_Nm[m] = response.load[m];
  return r;
}

double torque_slope(const Unit& unit, const UnitState& state) noexcept {
  const actuator::ActuatorState now = with_the_shaft(state);
  const actuator::ActuatorParams& p = unit.config().actuator;
  const elastic::Transmission& law = *p.transmission;
  const elastic::Positions at{state.reached.angle, {now.motor[0].angle, now.motor[1].angle}};
  const elastic::Response spring = law.evaluate(at);
  double slope = -spring.curvature.qq;
  const drive::Friction rub(actuator::shaft_friction(p));
  if (std::abs(at.q - now.shaft_anchor) <= rub.presliding_rad) slope -= rub.stiffness;
  if (p.tendon.friction <= 0 || p.tendon.presliding_J <= 0) return slope;
  // −κ u_i |T_i| with u_i = clamp(w_i − z_i), ∂w_i/∂q = |T_i| and ∂T_i/∂q = −H_qi (vsa/actuator/actuator.hpp).
  const double kappa = p.tendon.friction / p.tendon.presliding_J, most = p.tendon.presliding_J;
  const std::array<double, 2> w = law.signed_energies(at);
  for (int i = 0; i < law.spring_count(); ++i) {
    const double bend = w[i] - now.tendon_anchor[i], tension = std::abs(spring.load[i]);
    if (std::abs(bend) <= most) slope -= kappa * tension * tension;
    slope -= kappa * std::clamp(bend, -most, most) * std::copysign(1.0, spring.load[i]) * -spring.curvature.qx[i];
  }
  return slope;
}

std::array<Ticks, 3> measured(const Unit& unit, const UnitState& state) noexcept {
  if (unit.servo() != nullptr) {
    std::array<Ticks, 3> out;
    for (std::size_t i = 0; i < 3; ++i)
      out[i] = {firmware::cut_16(static_cast<std::int32_t>(state.servo.raw[i] >> unit.config().memory.resolution[i]))};
    return out;
  }
  return firmware::positions(unit.config().program.model, state.program.memory.stored, state.program.loop);
}

}  // namespace vsa::device
