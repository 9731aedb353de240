// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Between a unit and its host: where the shaft is put, and what acts where it is.
#include <algorithm>
#include <cmath>

#include "vsa/actuator/actuator_lanes.hpp"

namespace vsa::actuator {

ActuatorState Actuator::initial(const std::array<double, 2>& pulleys, double shaft,
                                const std::array<double, 2>& pulley_speeds) const noexcept {
  ActuatorState s;
  for (int i = 0; i < 2; ++i) s.motor[i].angle = s.motor_anchor[i] = pulleys[i];
  for (int i = 0; i < motors(); ++i) s.motor[i].speed = pulley_speeds[i];
  place(s, shaft);
  return s;
}

void Actuator::place(ActuatorState& s, double shaft) const noexcept {
  s.shaft = s.shaft_anchor = shaft;
  const elastic::Response r = params_.transmission->evaluate(positions(s, shaft));
  s.load = r.load;
  s.end = {r.torque, r.load, {}};
  s.end_rub = {};
  s.origin = params_.transmission->origin(positions(s, shaft));
  s.tendon_anchor = s.spring_w = params_.transmission->signed_energies_of(s.origin);
  s.ledger = {};
  s.ledger.elastic = r.energy;
  book_motors(s);
  s.ledger.stored_at_start = s.ledger.stored();
}

void Actuator::relocate(ActuatorState& s, double shaft) const noexcept {
  Ledger& l = s.ledger;
  const double before = l.stored();
  move_shaft(s, shaft);
  const elastic::Response r = spring(s, shaft);
  s.end = {r.torque, r.load, {}};
  s.end_rub = {};
  l.delivered += l.pending;  // the step under way ends as it was foreseen
  l.pending = 0;
  l.stored_at_start += l.stored() - before;
}

elastic::Response Actuator::spring(const ActuatorState& s, double shaft) const noexcept {
  return params_.transmission->evaluate(positions(s, shaft));
}

elastic::Response Actuator::response(const ActuatorState& s, double shaft) const noexcept {
  elastic::Response r = spring(s, shaft);
  const double z = shaft_friction_.presliding_rad;
  r.torque -= shaft_friction_.stiffness * std::clamp(shaft - s.shaft_anchor, -z, z);
  if (tendon_.coulomb_Nm <= 0) return r;
  const std::array<double, 2> w = params_.transmission->signed_energies(positions(s, shaft));
  for (int i = 0; i < springs_; ++i) {
    const double u = std::clamp(w[i] - s.tendon_anchor[i], -tendon_.presliding_rad, tendon_.presliding_rad);
    const double torque = -tendon_.stiffness * u * std::abs(r.load[i]);
    r.torque += torque;
    r.load[i] -= torque;
  }
  return r;
}

double Actuator::motor_current(const ActuatorState& s, int i, double voltage, drive::Terminal terminal,
                               double supply_V) const noexcept {
  return sides_[i].chopped ? pwm_current(s.motor[i], i, terminal, {voltage / supply_V, supply_V})
                           : drive::current(sides_[i].motor, terminal, s.motor[i], voltage);
}

}  // namespace vsa::actuator
