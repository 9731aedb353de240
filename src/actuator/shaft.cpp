// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Between a unit and its host: the output shaft's friction, and what happens where the shaft went elsewhere than foreseen.
#include <algorithm>
#include <cmath>

#include "vsa/actuator/actuator.hpp"

namespace vsa::actuator {

drive::FrictionStep Actuator::shaft_friction(ActuatorState& s, double displacement, double drift, double weight) const noexcept {
  // The segments have moved state.shaft already: the friction's own start is behind it.
  const double u = s.shaft - displacement - s.shaft_anchor;
  drive::FrictionStep step = drive::follow_friction(shaft_friction_, u, displacement);
  const double heat = drive::friction_heat(shaft_friction_, u, step);
  const double torque = drive::leading_friction(shaft_friction_, u, displacement, drift, weight).torque;
  s.ledger.integrator -= (torque - step.torque) * displacement;
  s.ledger.shaft_friction += heat;
  s.shaft_anchor += step.anchor_travel;
  s.ledger.shaft_bristle = drive::bristle_energy(shaft_friction_, s.shaft - s.shaft_anchor);
  step.torque = torque;
  return step;
}

void Actuator::move_shaft(ActuatorState& s, double shaft) const noexcept {
  Ledger& l = s.ledger;
  const double z = shaft_friction_.presliding_rad;
  s.shaft = shaft;
  s.shaft_anchor = shaft - std::clamp(shaft - s.shaft_anchor, -z, z);
  l.elastic = energy_at(s, shaft);
  l.shaft_bristle = drive::bristle_energy(shaft_friction_, s.shaft - s.shaft_anchor);
  if (tendon_.coulomb_Nm <= 0) return;
  l.tendon_bristle = 0;
  for (int i = 0; i < springs_; ++i) {
    const double u = std::clamp(s.spring_w[i] - s.tendon_anchor[i], -tendon_.presliding_rad, tendon_.presliding_rad);
    s.tendon_anchor[i] = s.spring_w[i] - u;
    l.tendon_bristle += drive::bristle_energy(tendon_, u);
  }
}

void Actuator::settle(ActuatorState& s, double actual, double applied_torque, double actual_dy, double path_work) const noexcept {
  Ledger& l = s.ledger;
  const double predicted = l.elastic + l.shaft_bristle + l.tendon_bristle;
  move_shaft(s, actual);
  const double work = applied_torque * actual_dy;
  l.coupling += (predicted - (l.elastic + l.shaft_bristle + l.tendon_bristle)) - (work - path_work);
  l.delivered += work;
  l.pending = 0;
  l.delivered_moved += std::abs(work);
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
  return chopped_ ? pwm_current(s.motor[i], i, terminal, {voltage / supply_V, supply_V})
                  : drive::current(motor_, terminal, s.motor[i], voltage);
}

}  // namespace vsa::actuator
