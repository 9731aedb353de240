// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a servo's parameters and its state may be.
#include <sstream>
#include <string>

#include "vsa/control/servo.hpp"

namespace vsa::control {
namespace {

std::string text_of(double v) {
  std::ostringstream out;
  out << v;
  return out.str();
}

class Bounds {
 public:
  Bounds(std::string_view where, Problems& problems) : where_(where), problems_(problems) {}

  void above_0(const char* key, double v, double max) {
    if (!(v > 0 && v <= max)) say(key, v, "above 0, up to " + text_of(max));
  }
  void from_0(const char* key, double v, double max) {
    if (!(v >= 0 && v <= max)) say(key, v, "0 … " + text_of(max));
  }

 private:
  void say(const char* key, double v, std::string allowed) {
    problems_.add({"", std::string(where_) + "control." + key, text_of(v), "is out of range", std::move(allowed)});
  }

  std::string_view where_;
  Problems& problems_;
};

}  // namespace

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
  Bounds b(where, problems);
  b.above_0("current_max_A", p.current_max_A, 1e4);
  b.from_0("speed_filter_s", p.speed_filter_s, 0.1);
  if (p.kind == ServoKind::position_servo) {
    b.above_0("reference_max_rad", p.reference_max_rad, 1000);
    b.above_0("position_gain_per_s", p.position.gain_per_s, 1000);
    b.above_0("speed_max_rad_per_s", p.position.speed_max_rad_per_s, 1e4);
    b.above_0("speed_gain_Nms_per_rad", p.position.speed_gain_Nms_per_rad, 1e5);
    b.from_0("speed_integral_Nm_per_rad", p.position.integral_Nm_per_rad, 1e6);
  } else {
    b.from_0("torque_gain", p.torque.gain, 1000);
    b.from_0("torque_integral_per_s", p.torque.integral_per_s, 1e5);
    b.from_0("torque_dead_zone_Nm", p.torque.dead_zone_Nm, 1000);
    b.from_0("motor_damping_Nms_per_rad", p.torque.motor_damping_Nms_per_rad, 1e4);
    b.from_0("stiffness_Nm_per_rad", p.torque.stiffness_Nm_per_rad, 1e6);
    b.from_0("damping_Nms_per_rad", p.torque.damping_Nms_per_rad, 1e4);
  }
}

const char* ServoState::impossible() const noexcept {
  for (const std::int64_t r : raw)
    if (std::abs(static_cast<double>(r)) > kFarthest_rad * 65536.0) return "counts that a turning motor could reach";
  return nullptr;
}

}  // namespace vsa::control
