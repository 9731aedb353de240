// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/checks.hpp"
#include "vsa/drive/bridge.hpp"
#include "vsa/drive/motor.hpp"

namespace vsa::drive {

void validate(const FrictionParams& p, std::string_view where, Problems& problems) {
  Checks check(where, problems);
  check.not_negative("friction_Nm", p.coulomb_Nm);
  check.not_negative("presliding_rad", p.presliding_rad);
}

void validate(const MotorParams& p, std::string_view where, Problems& problems) {
  Checks check(where, problems);
  check.positive("inertia_kgm2", p.inertia_kgm2);
  check.not_negative("viscous_Nms_per_rad", p.viscous_Nms_per_rad);
  check.not_negative("torque_constant_Nm_per_A", p.torque_constant_Nm_per_A);
  check.not_negative("back_emf_Vs_per_rad", p.back_emf_Vs_per_rad);
  check.positive("resistance_Ohm", p.resistance_Ohm);
  if (p.inductance_H) check.positive("inductance_H", *p.inductance_H);
}

void validate(const GearboxParams& p, std::string_view where, Problems& problems) {
  Checks check(where, problems);
  check.positive("gear_ratio", p.ratio);
  validate(p.friction, where, problems);
  check.not_negative("load_loss", p.load_loss);
  if (p.back_loss) check.not_negative("back_loss", *p.back_loss);
}

void validate(const BridgeParams& p, std::string_view where, Problems& problems) {
  Checks check(where, problems);
  check.within("dead_band", p.dead_band, 0, 0.99);
  check.within("pwm_period_s", p.period_s, 0, 1);
  check.not_negative("switch_Ohm", p.switch_Ohm);
  check.not_negative("diode_V", p.diode_V);
}

}  // namespace vsa::drive
