// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The tendons' friction over a segment: its torque and slopes while the segment is solved, and what it burnt.
#include <algorithm>
#include <cmath>

#include "vsa/actuator/actuator.hpp"

namespace vsa::actuator {

void Actuator::add_tendon_friction(Segment& seg, const elastic::Positions& to) const noexcept {
  elastic::SegmentMean& mean = seg.mean;
  const Lead& lead = seg.in.lead;
  const double shift = seg.shift(seg.in.dq), ahead_rad = seg.in.dq / lead.share - lead.drift;  // q' − y' of the step
  for (int i = 0; i < springs_; ++i) {
    double& xx = i == 0 ? mean.slope.x0x0 : mean.slope.x1x1;
    const double deflection = seg.in.dq - seg.dx[i];
    const double end = to.q - to.x[i];
    // The mean tension times the deflection's change is the energy's change: w at the end costs no call of the law.
    const double signed_tension = mean.load[i] - 2.0 * xx * shift;
    const double energy = std::max(std::abs(seg.w[i]) + signed_tension * deflection, 0.0);
    const double w = std::copysign(energy, end);
    // Mean |tension| over the segment, Δw/Δδ; by the elastic mean where the spring doesn't pass through zero.
    const bool same_side = (w < 0) == (seg.w[i] < 0);
    const double tension = same_side ? std::abs(signed_tension) : std::abs((w - seg.w[i]) / deflection);
    const double tension_slope = w < 0 ? -xx : xx;
    const double end_tension = tension + deflection * tension_slope;
    const double z = tendon_.presliding_rad, reached = seg.w_u[i] + (w - seg.w[i]), leading = reached + end_tension * ahead_rad;
    // The damper adds T_d ẇ to the bend, ẇ the mean over the segment.
    const double per_dw = seg.damping, damper = per_dw * (w - seg.w[i]);
    const double held = 0.5 * (1.0 - lead.tendon[i]);
    const double begin = seg.w_u[i] + damper, middle = std::clamp(reached, -z, z) + damper, ahead = leading + damper;
    const double level = -tendon_.stiffness * (held * (std::clamp(begin, -z, z) + std::clamp(middle, -z, z)) +
                                               lead.tendon[i] * std::clamp(ahead, -z, z));
    // Slopes of what isn't at its limit: for the pulley, and for the step's Δy, which moves the start of the segment too.
    const double stick = tendon_.stiffness * end_tension * tension, ends = lead.before + lead.share;
    const bool bends = std::abs(reached) <= z;
    double dx = level * -tension_slope, dy = dx * (lead.before + ends);
    const auto add = [&](double weight, double for_dx, double for_dy) {
      dx += weight * stick * (for_dx + per_dw);
      dy += weight * stick * (for_dy + per_dw * lead.share);
    };
    if (std::abs(begin) <= z) add(held, 0.0, lead.before);
    if (std::abs(middle) <= z) add(held, bends ? 1.0 : 0.0, bends ? ends : 0.0);
    if (std::abs(ahead) <= z) add(lead.tendon[i], 1.0, ends + 1.0);
    seg.rub.dx[i] = dx;
    seg.rub.dy[i] = dy;
    const double torque = level * tension;
    mean.torque += torque;
    mean.load[i] -= torque;
    mean.slope.qq += dx;
    mean.slope.qx[i] -= dx;
    xx += dx;
  }
}

void Actuator::move_tendons(ActuatorState& s, const Segment& seg) const noexcept {
  const std::array<double, 2>& w = s.spring_w;
  s.ledger.tendon_bristle = 0;
  for (int i = 0; i < springs_; ++i) {
    const double u = seg.w_u[i], dw = w[i] - seg.w[i], damper = seg.damping * dw, z = tendon_.presliding_rad;
    const drive::FrictionStep step = drive::follow_friction(tendon_, u, dw);
    const double end = u + dw - step.anchor_travel;
    const double bent_more = std::clamp(u + damper, -z, z) - u + std::clamp(end + damper, -z, z) - end;
    s.ledger.tendon_friction += drive::friction_heat(tendon_, u, step) + 0.5 * tendon_.stiffness * bent_more * dw;
    s.tendon_anchor[i] += step.anchor_travel;
    s.ledger.tendon_bristle += drive::bristle_energy(tendon_, w[i] - s.tendon_anchor[i]);
  }
}

}  // namespace vsa::actuator
