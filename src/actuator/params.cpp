// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/actuator/params.hpp"

#include <algorithm>

#include "vsa/checks.hpp"

namespace vsa::actuator {
namespace {

const char* number_of(std::size_t side) noexcept { return side == 0 ? "" : "_2"; }

bool told(const Problems& before, const Problem& p) {
  const auto same = [&](const Problem& b) { return b.key == p.key && b.value == p.value && b.message == p.message; };
  return std::any_of(before.list().begin(), before.list().end(), same);
}

/// What is wrong with the second side and the shaft's encoder in the same way as with the first is told once.
void check_sides(const ActuatorParams& p, std::string_view where, Problems& problems) {
  Problems first;
  validate(p.side[0], where, "", first);
  for (const Problem& problem : first.list()) problems.add(problem);
  if (p.sides() > 1) {
    Problems second, as_first;
    validate(p.side[1], where, number_of(1), second);
    validate(p.side[1], where, "", as_first);
    for (std::size_t i = 0; i < second.list().size(); ++i)
      if (!told(first, as_first.list()[i])) problems.add(second.list()[i]);
  }
  Problems shaft;
  sensor::validate(p.shaft_encoder, std::string(where) + "sensor.", shaft);
  for (const Problem& problem : shaft.list())
    if (!told(first, problem)) problems.add(problem);
}

void check_law(const ActuatorParams& p, std::string_view where, Problems& problems) {
  Checks check(where, problems);
  const elastic::Transmission& law = *p.transmission;
  law.validate(std::string(where) + "elastic.", problems);
  for (std::size_t i = 0; i < p.sides(); ++i) {
    if (law.input_unit(i) == "rad") continue;
    check.refuse("drive" + std::string(number_of(i)) + ".lead_m_per_rad", "",
                 "is missing: input " + std::to_string(i + 1) + " of the law is a travel", "travel a pulley's radian, above 0");
  }
  if (p.tendon.friction > 0 && law.spring_count() == 0)
    check.refuse("tendon.friction", Checks::text(p.tendon.friction), "the law names no spring that a tension could load", "0");
}

}  // namespace

void validate(const TendonParams& p, std::string_view where, Problems& problems) {
  Checks check(where, problems);
  check.within("friction", p.friction, 0, 0.99);
  check.not_negative("presliding_J", p.presliding_J);
  check.not_negative("damping_s", p.damping_s);
  if (p.friction > 0 && p.presliding_J == 0) check.refuse("presliding_J", "0", "tendon.friction needs a presliding", "above 0");
}

void validate(const SideParams& p, std::string_view where, std::string_view number, Problems& problems) {
  const std::string drive = std::string(where) + "drive" + std::string(number) + '.';
  Checks check(drive, problems);
  drive::validate(p.motor, drive, problems);
  drive::validate(p.gearbox, drive, problems);
  drive::validate(p.bridge, drive, problems);
  if (p.bridge.pin == drive::PwmPin::enable && p.bridge.period_s > 0 && !p.motor.inductance_H) {
    check.refuse("inductance_H", "", "a modulated enable pin with a period needs the winding's inductance",
                 "above 0, or drive.pwm_period_s = 0");
  }
  if (p.polarity != 1 && p.polarity != -1) check.refuse("polarity", std::to_string(p.polarity), "is neither", "-1|1");
  sensor::validate(p.encoder, std::string(where) + "sensor" + std::string(number) + '.', problems);
}

void validate(const ActuatorParams& p, std::string_view where, Problems& problems) {
  Checks check(where, problems);
  if (p.transmission) {
    check_law(p, where, problems);
  } else {
    check.refuse("elastic.law", "", "there is no transmission", "a law");
  }
  check_sides(p, where, problems);
  check.within("drive.supply_V", p.supply_V, 0, 1000);
  drive::validate(p.shaft_friction, std::string(where) + "shaft.", problems);
  check.positive(p.linear() ? "shaft.mass_kg" : "shaft.inertia_kgm2", p.shaft_inertia_kgm2);
  check.positive("sensor.shaft_scale", p.shaft_scale);
  validate(p.tendon, std::string(where) + "tendon.", problems);
  check.within("sensor.shaft_zero_rad", p.shaft_zero_rad, -1e3, 1e3);
}

drive::FrictionParams shaft_friction(const ActuatorParams& params) noexcept {
  drive::FrictionParams p = params.shaft_friction;
  if (p.coulomb_Nm > 0) p.presliding_rad = std::max(p.presliding_rad, kLeastPresliding_rad);
  return p;
}

}  // namespace vsa::actuator
