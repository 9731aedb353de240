// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/reading.hpp"

#include "vsa/firmware/arithmetic.hpp"
#include "vsa/firmware/exchange.hpp"

namespace vsa::device {

UnitReading read(const Unit& unit, const UnitState& state) noexcept {
  actuator::ActuatorState now = state.actuator;
  // Springs and pulleys stand where the coupling has the shaft, at y = q − dt/2·q̇: here they come to where the shaft is.
  for (drive::MotorState& motor : now.motor) motor.angle += 0.5 * state.last_dt * motor.speed;
  const actuator::Actuator& physics = unit.physics();
  UnitReading r;
  const auto attained = unit.config().actuator.transmission->attained({now.motor[0].angle, now.motor[1].angle});
  r.equilibrium_rad = attained.equilibrium;
  r.preset = attained.preset;
  r.shaft_rad = state.reached.angle;
  r.shaft_speed_rad_per_s = state.reached.speed;
  const elastic::Response response = physics.response(now, r.shaft_rad);
  r.stiffness_Nm_per_rad = response.curvature.qq;
  r.torque_Nm = response.torque;
  r.mean_torque_Nm = state.applied_torque;
  for (int m = 0; m < physics.motors(); ++m) {
    r.motor_rad[m] = now.motor[m].angle;
    r.motor_speed_rad_per_s[m] = now.motor[m].speed;
    r.motor_torque_Nm[m] = response.load[m];
    r.current_A[m] = physics.motor_current(now, m, state.held.voltage[m], state.held.terminal[m], state.held.supply_V);
  }
  return r;
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
