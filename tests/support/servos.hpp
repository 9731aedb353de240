// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Units whose controller is a servo: one motor behind a linear spring, or two behind the maker pro's.
#pragma once

#include "support/one_joint.hpp"
#include "vsa/elastic/series_spring.hpp"

namespace vsa::test {

inline control::ServoParams position_servo() {
  control::ServoParams p;
  p.kind = control::ServoKind::position_servo;
  p.current_max_A = 5;
  p.speed_filter_s = 0.001;
  p.reference_max_rad = 50;
  p.position = {25, 10, 0.5, 2};
  return p;
}

inline control::ServoParams torque_servo() {
  control::ServoParams p;
  p.kind = control::ServoKind::torque_servo;
  p.current_max_A = 5;
  p.torque = {0.5, 20, 0.0, 0.5, 20, 0.2};
  return p;
}

inline control::ServoParams motor_voltages() {
  control::ServoParams p;
  p.kind = control::ServoKind::motor_voltages;
  return p;
}

/// One motor, a spring of that stiffness, frictions as given.
inline device::UnitConfig series(control::ServoParams servo, double stiffness_Nm_per_rad, double friction_Nm = 0.0) {
  device::UnitConfig c = maker_pro();
  c.actuator.transmission = std::make_shared<elastic::SeriesSpring>(stiffness_Nm_per_rad);
  c.actuator.set_both({.motor = {0.001, 0.01, 1.0, 1.0, 2.3, std::nullopt},
                       .gearbox = {1.0, {friction_Nm, 0.01}},
                       .bridge = {.dead_band = 0},
                       .encoder = {.bits = 16}});
  c.actuator.shaft_friction = {0.0, 0.0};
  c.actuator.shaft_encoder.bits = 16;
  c.preset_max = servo.kind == control::ServoKind::torque_servo ? 30.0 : 0.0;
  c.servo = servo;
  return c;
}

/// Two motors behind the maker pro's springs.
inline device::UnitConfig antagonist(control::ServoParams servo) {
  device::UnitConfig c = maker_pro();
  for (auto& side : c.actuator.side) side.bridge.dead_band = 0;
  c.servo = servo;
  return c;
}

}  // namespace vsa::test
