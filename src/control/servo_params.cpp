// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a servo's parameters and its state may be.
#include <cmath>
#include <string>

#include "vsa/checks.hpp"
#include "vsa/control/servo.hpp"

namespace vsa::control {
std::string_view name_of(ServoKind kind) noexcept {
  switch (kind) {
    case ServoKind::position_servo:
      return "position_servo";
    case ServoKind::torque_servo:
      return "torque_servo";
    case ServoKind::motor_voltages:
      return "motor_voltages";
  }
  return "";
}

void validate(const ServoParams& p, std::string_view where, Problems& problems) {
  if (p.kind == ServoKind::motor_voltages) return;
  Checks b(std::string(where) + "control.", problems);
  constexpr double kLeast = 1e-9;  // above 0
  b.within("current_max_A", p.current_max_A, kLeast, 1e4);
  b.within("speed_filter_s", p.speed_filter_s, 0, 0.1);
  if (p.kind == ServoKind::position_servo) {
    b.within("reference_max_rad", p.reference_max_rad, kLeast, 1000);
    b.within("position_gain_per_s", p.position.gain_per_s, kLeast, 1000);
    b.within("speed_max_rad_per_s", p.position.speed_max_rad_per_s, kLeast, 1e4);
    b.within("speed_gain_Nms_per_rad", p.position.speed_gain_Nms_per_rad, kLeast, 1e5);
    b.within("speed_integral_Nm_per_rad", p.position.integral_Nm_per_rad, 0, 1e6);
  } else {
    b.within("torque_gain", p.torque.gain, 0, 1000);
    b.within("torque_integral_per_s", p.torque.integral_per_s, 0, 1e5);
    b.within("torque_dead_zone_Nm", p.torque.dead_zone_Nm, 0, 1000);
    b.within("motor_damping_Nms_per_rad", p.torque.motor_damping_Nms_per_rad, 0, 1e4);
    b.within("stiffness_Nm_per_rad", p.torque.stiffness_Nm_per_rad, 0, 1e6);
    b.within("damping_Nms_per_rad", p.torque.damping_Nms_per_rad, 0, 1e4);
  }
}

const char* ServoState::impossible() const noexcept {
  for (const std::int64_t r : raw)
    if (std::abs(static_cast<double>(r)) > kFarthest_rad * 65536.0) return "counts that a turning motor could reach";
  return nullptr;
}

}  // namespace vsa::control
