// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the models need of a unit's parameters.
#include <string>

#include "vsa/checks.hpp"
#include "vsa/device/unit.hpp"
#include "vsa/elastic/travel.hpp"

namespace vsa::device {

namespace {

/// What a servo asks of the rest.
void validate_servo(const UnitConfig& c, std::string_view where, Problems& problems) {
  const actuator::ActuatorParams& p = c.actuator;
  control::validate(*c.servo, where, problems);
  Checks check(where, problems);
  for (std::size_t i = 0; i < p.sides(); ++i) {
    const actuator::SideParams& side = p.side[i];
    const std::string drive = i == 0 || side == p.side[0] ? "drive." : "drive_2.";
    if (side.bridge.pin != drive::PwmPin::input)
      check.refuse(drive + "pwm_pin", "enable", "a servo's drive gives mean voltages, which a modulated enable pin doesn't",
                   "input");
    if (side.bridge.dead_band != 0)
      check.refuse(drive + "dead_band", Checks::text(side.bridge.dead_band), "a servo's drive gives the voltages that it is told",
                   "0");
    if (!(side.motor.torque_constant_Nm_per_A > 0))
      check.refuse(drive + "torque_constant_Nm_per_A", Checks::text(side.motor.torque_constant_Nm_per_A),
                   "a servo needs a motor that turns current into torque", "above 0");
    if (side == p.side[1]) break;
  }
  if (p.transmission && c.is(control::ServoKind::torque_servo) && p.transmission->motor_count() != 1)
    check.refuse("control.kind", "torque_servo", "is of a law with one motor, a series elastic unit",
                 "position_servo, motor_voltages, qbmove");
}

}  // namespace

UnitConfig at_pinion(UnitConfig unit, double radius_m) {
  actuator::ActuatorParams& p = unit.actuator;
  const double square = radius_m * radius_m;
  const bool series = unit.is(control::ServoKind::torque_servo);
  if (p.transmission) p.transmission = elastic::with_pinion(p.transmission, radius_m);
  p.shaft_friction.coulomb_Nm *= radius_m;
  p.shaft_friction.presliding_rad /= radius_m;
  p.shaft_inertia_kgm2 *= square;
  p.shaft_scale *= radius_m;
  if (series) unit.preset_max *= square;
  if (!unit.servo) return unit;
  unit.servo->torque.stiffness_Nm_per_rad *= square;
  unit.servo->torque.damping_Nms_per_rad *= square;
  unit.servo->torque.dead_zone_Nm *= radius_m;
  return unit;
}

void validate(const UnitConfig& c, std::string_view where, Problems& problems) {
  actuator::validate(c.actuator, where, problems);
  const std::string firmware = std::string(where) + "firmware.";
  firmware::validate(c.program, firmware, problems);
  firmware::validate(c.memory, firmware, problems);
  Checks check(where, problems);
  check.within("limits.preset_max", c.preset_max, 0, 1e5);
  if (c.servo) validate_servo(c, where, problems);
  if (!c.servo && c.actuator.linear())
    check.refuse("control.kind", "qbmove", "the qbmove's program is of a turning shaft, and this law's slides",
                 "position_servo, torque_servo, motor_voltages");
  check.within("physics.substep_max_s", c.substep_max_s, 1e-6, 1e-3);
}

bool alike(const UnitConfig& a, const UnitConfig& b) noexcept {
  if (!a.actuator.transmission || !b.actuator.transmission) return false;
  if (a.actuator.transmission == b.actuator.transmission) return a == b;
  if (!a.actuator.transmission->equals(*b.actuator.transmission)) return false;
  UnitConfig same_law = a;
  same_law.actuator.transmission = b.actuator.transmission;
  return same_law == b;
}

}  // namespace vsa::device
