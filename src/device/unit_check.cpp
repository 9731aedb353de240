// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the models need of a unit's parameters.
#include <cmath>
#include <limits>
#include <string>

#include "device/text.hpp"
#include "vsa/device/unit.hpp"

namespace vsa::device {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTiny = std::numeric_limits<double>::min();

class Bounds {
 public:
  Bounds(std::string_view where, Problems& problems) : where_(where), problems_(problems) {}

  void within(const char* key, double v, double min, double max) {
    if (std::isfinite(v) && v >= min && v <= max) return;
    std::string allowed = min <= 0 ? "≥ " + text_of(min) : min == kTiny ? "above 0" : "≥ " + text_of(min);
    if (max != kInfinity) allowed = text_of(min == kTiny ? 0 : min) + " … " + text_of(max);
    problems_.add({"", where_ + key, text_of(v), "is out of range", "finite, " + allowed});
  }
  void positive(const char* key, double v) { within(key, v, kTiny, kInfinity); }
  void not_negative(const char* key, double v) { within(key, v, 0, kInfinity); }

 private:
  std::string where_;
  Problems& problems_;
};

void check_drive(const actuator::ActuatorParams& p, Bounds& b) {
  b.positive("drive.inertia_kgm2", p.motor.inertia_kgm2);
  b.not_negative("drive.viscous_Nms_per_rad", p.motor.viscous_Nms_per_rad);
  b.not_negative("drive.torque_constant_Nm_per_A", p.motor.torque_constant_Nm_per_A);
  b.not_negative("drive.back_emf_Vs_per_rad", p.motor.back_emf_Vs_per_rad);
  b.positive("drive.resistance_Ohm", p.motor.resistance_Ohm);
  if (p.motor.inductance_H) b.positive("drive.inductance_H", *p.motor.inductance_H);
  b.positive("drive.gear_ratio", p.gearbox.ratio);
  b.not_negative("drive.friction_Nm", p.gearbox.friction.coulomb_Nm);
  b.not_negative("drive.presliding_rad", p.gearbox.friction.presliding_rad);
  b.not_negative("drive.load_loss", p.gearbox.load_loss);
  if (p.gearbox.back_loss) b.not_negative("drive.back_loss", *p.gearbox.back_loss);
  b.within("drive.supply_V", p.bridge.supply_V, 0, 1000);
  b.within("drive.dead_band", p.bridge.dead_band, 0, 0.99);
  b.within("drive.pwm_period_s", p.bridge.period_s, 0, 1);
  b.not_negative("drive.switch_Ohm", p.bridge.switch_Ohm);
  b.not_negative("drive.diode_V", p.bridge.diode_V);
  if (p.bridge.pin == drive::PwmPin::enable && p.bridge.period_s > 0)
    b.positive("drive.inductance_H", p.motor.inductance_H.value_or(0));
}

}  // namespace

void check_servo(const UnitConfig& c, std::string_view where, Problems& problems) {
  const actuator::ActuatorParams& p = c.actuator;
  control::validate(*c.servo, where, problems);
  const auto say = [&](const char* key, const std::string& value, const char* message, const char* allowed) {
    problems.add({"", std::string(where) + key, value, message, allowed});
  };
  if (p.bridge.pin != drive::PwmPin::input)
    say("drive.pwm_pin", "enable", "a servo's drive gives mean voltages, which a modulated enable pin doesn't", "input");
  if (p.bridge.dead_band != 0)
    say("drive.dead_band", text_of(p.bridge.dead_band), "a servo's drive gives the voltages that it is told", "0");
  if (!(p.motor.torque_constant_Nm_per_A > 0))
    say("drive.torque_constant_Nm_per_A", text_of(p.motor.torque_constant_Nm_per_A),
        "a servo needs a motor that turns current into torque", "above 0");
  if (p.transmission && c.is(control::ServoKind::torque_servo) && p.transmission->motor_count() != 1)
    say("control.kind", "torque_servo", "is of a law with one motor, a series elastic unit",
        "position_servo, motor_voltages, qbmove");
}

void check(const UnitConfig& c, std::string_view where, Problems& problems) {
  const actuator::ActuatorParams& p = c.actuator;
  if (!p.transmission) problems.add({"", std::string(where) + "elastic.law", "", "there is no transmission", "a law"});
  Bounds b(where, problems);
  check_drive(p, b);
  b.not_negative("shaft.friction_Nm", p.shaft_friction.coulomb_Nm);
  b.not_negative("shaft.presliding_rad", p.shaft_friction.presliding_rad);
  b.positive("shaft.inertia_kgm2", p.shaft_inertia_kgm2);
  b.within("tendon.friction", p.tendon.friction, 0, 0.99);
  b.not_negative("tendon.presliding_J", p.tendon.presliding_J);
  b.within("sensor.encoder_bits", p.encoder.bits, 1, 16);
  b.within("sensor.encoder_zero_rad", p.encoder.zero_rad, -1e3, 1e3);
  b.within("sensor.shaft_zero_rad", p.shaft_zero_rad, -1e3, 1e3);
  for (const std::uint8_t r : c.memory.resolution) b.within("firmware.resolution", r, 0, 8);
  b.within("limits.preset_max", c.preset_max, 0, 100);
  b.within("physics.substep_max_s", c.substep_max_s, 1e-6, 1e-3);
  if (c.servo) check_servo(c, where, problems);
  if (c.polarity != 1 && c.polarity != -1) {
    problems.add({"", std::string(where) + "drive.polarity", std::to_string(c.polarity), "is neither", "-1|1"});
  }
  if (p.tendon.friction > 0 && p.transmission && p.transmission->spring_count() == 0) {
    problems.add({"", std::string(where) + "tendon.friction", text_of(p.tendon.friction), "the law names no spring to load", "0"});
  }
  if (p.tendon.friction > 0 && p.tendon.presliding_J <= 0) {
    problems.add(
        {"", std::string(where) + "tendon.presliding_J", text_of(p.tendon.presliding_J), "tendon.friction needs one", "above 0"});
  }
}

bool alike(const UnitConfig& a, const UnitConfig& b) noexcept {
  if (!a.actuator.transmission || !b.actuator.transmission) return false;
  UnitConfig same_law = a;
  same_law.actuator.transmission = b.actuator.transmission;
  return same_law == b && a.actuator.transmission->equals(*b.actuator.transmission);
}

}  // namespace vsa::device
