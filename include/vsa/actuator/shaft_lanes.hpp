// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Between a unit and its host: the output shaft's friction, and what happens where the shaft went elsewhere than foreseen.
#pragma once

#include "vsa/actuator/actuator.hpp"

namespace vsa::actuator {

template <class T>
drive::FrictionStepOf<T> Actuator::shaft_friction(ActuatorStateOf<T>& s, T displacement, T drift, T weight) const noexcept {
  // The segments have moved state.shaft already: the friction's own start is behind it.
  const T u = s.shaft - displacement - s.shaft_anchor;
  drive::FrictionStepOf<T> step = drive::follow_friction(shaft_friction_, u, displacement);
  const T heat = drive::friction_heat(shaft_friction_, u, step);
  const T torque = drive::leading_friction(shaft_friction_, u, displacement, drift, weight).torque;
  s.ledger.integrator -= (torque - step.torque) * displacement;
  s.ledger.shaft_friction += heat;
  s.shaft_anchor += step.anchor_travel;
  s.ledger.shaft_bristle = drive::bristle_energy(shaft_friction_, s.shaft - s.shaft_anchor);
  step.torque = torque;
  return step;
}

template <class T>
void Actuator::move_shaft(ActuatorStateOf<T>& s, T shaft) const noexcept {
  LedgerOf<T>& l = s.ledger;
  const T z = shaft_friction_.presliding_rad, most = tendon_.presliding_rad;
  s.shaft = shaft;
  s.shaft_anchor = shaft - lanes::clamp(shaft - s.shaft_anchor, -z, z);
  l.elastic = energy_at(s, shaft);
  l.shaft_bristle = drive::bristle_energy(shaft_friction_, s.shaft - s.shaft_anchor);
  if (tendon_.coulomb_Nm <= 0) return;
  l.tendon_bristle = 0.0;
  for (int i = 0; i < springs<T>(); ++i) {
    const T u = lanes::clamp(s.spring_w[i] - s.tendon_anchor[i], -most, most);
    s.tendon_anchor[i] = s.spring_w[i] - u;
    l.tendon_bristle += drive::bristle_energy(tendon_, u);
  }
}

template <class T>
void Actuator::settle(ActuatorStateOf<T>& s, T actual, T applied_torque, T actual_dy, T path_work) const noexcept {
  LedgerOf<T>& l = s.ledger;
  const T predicted = l.elastic + l.shaft_bristle + l.tendon_bristle;
  move_shaft(s, actual);
  const T work = applied_torque * actual_dy;
  l.coupling += (predicted - (l.elastic + l.shaft_bristle + l.tendon_bristle)) - (work - path_work);
  l.delivered += work;
  l.pending = 0.0;
  l.delivered_moved += lanes::abs(work);
}

}  // namespace vsa::actuator
