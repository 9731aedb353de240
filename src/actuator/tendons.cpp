// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The tendons' friction over a segment: its torque and slopes while the segment is solved, and what it burnt.
#include <algorithm>
#include <cmath>
#include <limits>

#include "vsa/actuator/actuator.hpp"

namespace vsa::actuator {

namespace {

// Where no bristle begins or ends to slide, a correction that moves a spring's load by this fraction leaves half of its square.
constexpr double kStraight = 3e-3;
constexpr double kNothing = std::numeric_limits<double>::min();

/// How far one tendon's bristle is bent over a segment, J, with the weights of its start, its end and the look ahead; and how much
/// of that answers: to the pulley (`per_dx`), to the step's Δy (`per_dy`), to the damper (`free`). `straight`: how far w may be from
/// here with the same answers.
struct Bend {
  double bend = 0, per_dx = 0, per_dy = 0, free = 0, straight = 0;
};

/// From u, w changes by dw; `damper` is what ẇ adds to the bend, `ahead` what w changes from the end to where the engine goes.
Bend bend_over(double u, double dw, double damper, double ahead, double z, double weight, const Lead& lead) noexcept {
  const double held = 0.5 * (1.0 - weight), ends = lead.before + lead.share, reached = u + dw;
  const double begin = u + damper, middle = std::clamp(reached, -z, z) + damper;
  const auto to_edge = [z](double bend) { return std::abs(std::abs(bend) - z); };
  Bend b{held * (std::clamp(begin, -z, z) + std::clamp(middle, -z, z))};
  b.straight = to_edge(reached);
  if (damper != 0) b.straight = std::min({b.straight, to_edge(begin), to_edge(middle)});
  if (std::abs(begin) <= z) b.free = held, b.per_dy = held * lead.before;
  if (std::abs(middle) <= z) {
    b.free += held;
    if (std::abs(reached) <= z) b.per_dx = held, b.per_dy += held * ends;
  }
  if (weight > 0) {
    const double leading = reached + ahead + damper;
    b.straight = std::min(b.straight, to_edge(leading) / (1.0 + 1.0 / lead.share));
    b.bend += weight * std::clamp(leading, -z, z);
    if (std::abs(leading) <= z) b.free += weight, b.per_dx += weight, b.per_dy += weight * (ends + 1.0);
  }
  return b;
}

}  // namespace

void Actuator::add_tendon_friction(Segment& seg, const elastic::Positions& to) const noexcept {
  elastic::SegmentMean& mean = seg.mean;
  const Lead& lead = seg.in.lead;
  const double shift = seg.shift(seg.in.dq), ahead_rad = seg.in.dq / lead.share - lead.drift;  // q' − y' of the step
  for (int i = 0; i < springs_; ++i) {
    double& xx = i == 0 ? mean.slope.x0x0 : mean.slope.x1x1;
    const double deflection = seg.in.dq - seg.dx[i];
    // The mean tension times the deflection's change is the energy's change: w at the end costs no call of the law.
    const double signed_tension = mean.load[i] - 2.0 * xx * shift;
    const double energy = std::max(std::abs(seg.w[i]) + signed_tension * deflection, 0.0);
    const double w = std::copysign(energy, to.q - to.x[i]), dw = w - seg.w[i];
    // Mean |tension| over the segment, Δw/Δδ; by the elastic mean where the spring doesn't pass through zero.
    const bool same_side = (w < 0) == (seg.w[i] < 0);
    const double tension = same_side ? std::abs(signed_tension) : std::abs(dw / deflection);
    const double tension_slope = w < 0 ? -xx : xx, end_tension = tension + deflection * tension_slope;
    const Bend b =
        bend_over(seg.w_u[i], dw, seg.damping * dw, end_tension * ahead_rad, tendon_.presliding_rad, lead.tendon[i], lead);
    seg.straight[i] = b.straight / std::max(std::abs(end_tension), kNothing);
    const double level = -tendon_.stiffness * b.bend, stick = tendon_.stiffness * end_tension * tension;
    const double turn = level * -tension_slope, damping = seg.rub.damping[i] = stick * seg.damping * b.free;
    const double dx = seg.rub.dx[i] = turn + stick * b.per_dx + damping;
    seg.rub.dy[i] = turn * (2.0 * lead.before + lead.share) + stick * b.per_dy + damping * lead.share;
    const double torque = level * tension;
    mean.torque += torque;
    mean.load[i] -= torque;
    mean.slope.qq += dx;
    mean.slope.qx[i] -= dx;
    xx += dx;
  }
}

/// How far spring i's deflection may be corrected by the slopes alone. Nothing where it isn't known which motor pulls at which
/// spring.
double Actuator::straight(const Segment& seg, int i) const noexcept {
  if (springs_ != motors_) return 0;
  const double slope = (i == 0 ? seg.mean.slope.x0x0 : seg.mean.slope.x1x1) - seg.rub.dx[i];
  return std::min(seg.straight[i], kStraight * std::abs(seg.mean.load[i]) / std::max(std::abs(slope), kNothing));
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
