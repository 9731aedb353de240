// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A unit whose controller is a servo: its ticks, how it begins and where it can be put.
#include <algorithm>
#include <cmath>
#include <string>

#include "device/pulley_speeds.hpp"
#include "vsa/checks.hpp"
#include "vsa/device/unit.hpp"
#include "vsa/elastic/travel.hpp"

namespace vsa::device {

std::string_view UnitConfig::preset_unit() const noexcept {
  if (is(control::ServoKind::torque_servo)) return actuator.linear() ? "N/m" : "N·m/rad";
  return actuator.transmission ? actuator.transmission->preset_unit() : "";
}

control::ServoReadings Unit::read_servo(UnitState& s, double shaft_rad) const noexcept {
  return {read_sensors(s, shaft_rad).encoder, supply_V(s)};
}

void Unit::tick_servo(UnitState& s, double shaft_rad) const noexcept {
  if (s.servo.fresh) find_shaft(s, shaft_rad);
  const control::ServoReadings readings = read_servo(s, shaft_rad);
  if (s.faults.powered) {
    servo_->step(s.servo, readings);
  } else {
    servo_->rest(s.servo, readings);
  }
  drive_bridges(s);
}

void Unit::run_servo(UnitState& s, StepPlan& plan, std::int64_t at_ns) noexcept {
  if (s.servo.fresh) find_shaft(s, plan.in.angle);
  tick_servo(s, walk(s, plan, at_ns));
  plan.held[plan.held_count++] = s.held;
}

std::array<double, 2> Unit::resting_pulleys(const control::ServoCommand& command, double shaft_rad) const noexcept {
  if (config_.is(control::ServoKind::torque_servo)) return {servo_->pulley(command, shaft_rad), 0.0};
  if (config_.is(control::ServoKind::position_servo)) return servo_->references(command);
  return config_.actuator.transmission->references({command.equilibrium, command.preset});
}

void Unit::settle_servo(UnitState& s, const std::array<double, 2>& x, double shaft_rad) const noexcept {
  s.actuator = actuator_.initial(x, s.actuator.shaft);
  const elastic::Response spring = config_.actuator.transmission->evaluate({shaft_rad, x});
  control::ServoPlace at{{x[0], x[1], shaft_rad}, {}, {-spring.load[0], -spring.load[1]}};
  const actuator::ActuatorParams& p = config_.actuator;
  for (std::size_t i = 0; i < 2; ++i) at.angle[i] += p.side[i].encoder.zero_rad;
  at.angle[2] = p.shaft_scale * shaft_rad + (p.shaft_encoder.zero_rad + p.shaft_zero_rad);
  servo_->settle(s.servo, read_servo(s, shaft_rad), at);
}

double Unit::lead() const noexcept { return elastic::shaft_per_pulley(*config_.actuator.transmission, 0); }

/// The first tick finds the shaft. What a torque servo has on its spring stays as it is: the pulley is found where it goes with that.
void Unit::find_shaft(UnitState& s, double shaft_rad) const noexcept {
  std::array<double, 2> x{s.actuator.motor[0].angle, s.actuator.motor[1].angle};
  if (config_.is(control::ServoKind::torque_servo)) x[0] += (shaft_rad - s.servo.begun_rad) / lead();
  settle_servo(s, x, shaft_rad);
  s.servo.fresh = false;
}

void Unit::place_servo(UnitState& placed, const UnitPlace& at) const noexcept {
  control::ServoCommand& command = placed.servo.command;
  command.equilibrium = at.equilibrium;
  command.preset = at.preset;
  settle_servo(placed, resting_pulleys(command, at.shaft_rad), at.shaft_rad);
  const bool series = config_.is(control::ServoKind::torque_servo);
  const auto speed = series ? std::array{at.speed / lead(), 0.0} : pulley_speeds(*config_.actuator.transmission, at);
  std::array<double, 2> x{placed.actuator.motor[0].angle, placed.actuator.motor[1].angle};
  for (std::size_t i = 0; i < 2; ++i) x[i] -= at.lag_s * speed[i];
  placed.actuator = actuator_.initial(x, at.shaft_rad - at.lag_s * at.speed, speed);
  placed.servo.speed = {speed[0], speed[1], config_.actuator.shaft_scale * at.speed};
  placed.servo.fresh = false;
}

void Unit::check_servo_place(const UnitPlace& at, std::string_view where, Problems& problems) const {
  if (!config_.references_limited()) return;
  const auto x = config_.actuator.transmission->references({at.equilibrium, at.preset});
  const double most = config_.servo->reference_max_rad;
  for (int i = 0; i < actuator_.motors(); ++i) {
    if (std::abs(x[i]) <= most) continue;
    problems.add({"", std::string(where) + "equilibrium_rad", Checks::text(at.equilibrium),
                  "with this preset asks motor " + std::to_string(i + 1) + " for more than control.reference_max_rad",
                  "references of ±" + Checks::text(most) + " rad"});
    return;
  }
}

void Unit::command(UnitState& s, double equilibrium_rad, double preset) const noexcept {
  if (!servo_) return set_inputs(s, inputs_for(equilibrium_rad, preset));
  if (config_.is(control::ServoKind::motor_voltages)) return;
  s.servo.command.equilibrium = equilibrium_rad;
  s.servo.command.preset = std::clamp(preset, -config_.preset_max, config_.preset_max);
}

void Unit::command_direct(UnitState& s, const std::array<double, 2>& values) noexcept { s.servo.command.direct = values; }

}  // namespace vsa::device
