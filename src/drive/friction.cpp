// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/drive/friction.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::drive {
namespace {

double sign(double v) noexcept { return v > 0 ? 1.0 : (v < 0 ? -1.0 : 0.0); }

/// z_max = 0: hold still if at most τ_c does it, else slide at τ_c.
FrictionStep solve_coulomb(double coulomb, double free, double compliance) noexcept {
  const double slide = std::abs(free) - compliance * coulomb;
  FrictionStep step;
  if (slide <= 0) {
    step.torque = compliance > 0 ? -free / compliance : 0.0;
    return step;
  }
  step.torque = -sign(free) * coulomb;
  step.displacement = sign(free) * slide;
  step.anchor_travel = step.displacement;
  return step;
}

}  // namespace

Friction at_load(const Friction& p, double ratio, double load_Nm) noexcept {
  Friction loaded = p;
  loaded.coulomb_Nm += ratio * std::abs(load_Nm);
  loaded.presliding_rad = p.stiffness > 0 ? loaded.coulomb_Nm / p.stiffness : 0.0;
  return loaded;
}

FrictionStep follow_friction(const Friction& p, double u, double displacement) noexcept {
  FrictionStep step;
  step.displacement = displacement;
  if (p.coulomb_Nm <= 0) {
    step.anchor_travel = displacement;
    return step;
  }
  if (p.presliding_rad <= 0) {
    step.torque = -sign(displacement) * p.coulomb_Nm;
    step.anchor_travel = displacement;
    return step;
  }
  const double reached = u + displacement;
  const double end = std::clamp(reached, -p.presliding_rad, p.presliding_rad);
  step.torque = -0.5 * p.stiffness * (u + end);
  step.anchor_travel = reached - end;
  return step;
}

FrictionStep solve_friction(const Friction& p, double u, double free, double compliance) noexcept {
  if (p.coulomb_Nm <= 0) return follow_friction(p, u, free);
  if (p.presliding_rad <= 0) return solve_coulomb(p.coulomb_Nm, free, compliance);
  const double stick = (free - compliance * p.stiffness * u) / (1.0 + 0.5 * compliance * p.stiffness);
  if (std::abs(u + stick) <= p.presliding_rad) return follow_friction(p, u, stick);
  // The bristle ends fully bent. τ̄ falls monotonically with Δx, so the root lies on the side that `stick` overshot.
  FrictionStep step;
  const double end = std::copysign(p.presliding_rad, u + stick);
  step.torque = -0.5 * p.stiffness * (u + end);
  step.displacement = free + compliance * step.torque;
  step.anchor_travel = u + step.displacement - end;
  return step;
}

double bristle_energy(const Friction& p, double u) noexcept { return 0.5 * p.stiffness * u * u; }

double friction_heat(const Friction& p, double u, const FrictionStep& step) noexcept {
  if (p.coulomb_Nm <= 0) return 0.0;
  if (p.presliding_rad <= 0) return -step.torque * step.displacement;
  const double end = u + step.displacement - step.anchor_travel;
  return 0.5 * p.stiffness * (u + end) * step.anchor_travel;
}

}  // namespace vsa::drive
