// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/actuator/ledger.hpp"

namespace vsa::actuator {

template <>
Ledger& Ledger::operator+=(const Ledger& o) noexcept {
  supply += o.supply;
  copper += o.copper;
  bridge += o.bridge;
  conversion += o.conversion;
  viscous += o.viscous;
  motor_friction += o.motor_friction;
  shaft_friction += o.shaft_friction;
  tendon_friction += o.tendon_friction;
  delivered += o.delivered;
  integrator += o.integrator;
  pending += o.pending;
  coupling += o.coupling;
  kinetic += o.kinetic;
  magnetic += o.magnetic;
  elastic += o.elastic;
  bristle += o.bristle;
  shaft_bristle += o.shaft_bristle;
  tendon_bristle += o.tendon_bristle;
  stored_at_start += o.stored_at_start;
  supply_moved += o.supply_moved;
  delivered_moved += o.delivered_moved;
  return *this;
}

}  // namespace vsa::actuator
