// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The tendons' friction over a segment: its torque and slopes while the segment is solved, and what it burnt.
#pragma once

#include "vsa/actuator/actuator.hpp"
#include "vsa/actuator/step_constants.hpp"

namespace vsa::actuator {

namespace step {

/// How far one tendon's bristle is bent over a segment, J, with the weights of its start, its end and the look ahead; and how much
/// of that answers: to the pulley (`per_dx`), to the step's Δy (`per_dy`), to the damper (`free`). `straight`: how far w may be from
/// here with the same answers.
template <class T>
struct BendOf {
  T bend = 0,        ///< mean over the segment, J
      per_dx = 0,    ///< part of it that answers to the pulley
      per_dy = 0,    ///< … to the step's Δy
      free = 0,      ///< … to the damper
      straight = 0;  ///< how far w may be from here, J
};

/// From u, w changes by dw; `damper` is what ẇ adds to the bend, `ahead` what w changes from the end to where the engine goes.
template <class T>
[[nodiscard]] BendOf<T> bend_over(T u, T dw, T damper, T ahead, double z, T weight, const LeadOf<T>& lead) noexcept {
  const double ends = lead.before + lead.share;
  const T held = 0.5 * (1.0 - weight), reached = u + dw, most = z;
  const T begin = u + damper, middle = lanes::clamp(reached, -most, most) + damper;
  const auto to_edge = [&](T bend) { return lanes::abs(lanes::abs(bend) - most); };
  const auto bends = [&](T bend) { return lanes::abs(bend) <= most; };
  BendOf<T> b{held * (lanes::clamp(begin, -most, most) + lanes::clamp(middle, -most, most))};
  b.straight = to_edge(reached);
  if (const auto damped = damper != 0.0; lanes::any(damped))
    b.straight = lanes::select(damped, lanes::min(lanes::min(b.straight, to_edge(begin)), to_edge(middle)), b.straight);
  const lanes::Truth<T> from = bends(begin), to = bends(middle), both = to & bends(reached);
  b.free = lanes::where<T>(from, held) + lanes::where<T>(to, held);
  b.per_dx = lanes::where<T>(both, held);
  b.per_dy = lanes::where<T>(from, held * lead.before) + lanes::where<T>(both, held * ends);
  if (const auto leads = weight > 0.0; lanes::any(leads)) {
    const T leading = reached + ahead + damper;
    const auto bent = leads & bends(leading);
    const T edge = to_edge(leading) * (lead.share / (1.0 + lead.share));
    b.straight = lanes::select(leads, lanes::min(b.straight, edge), b.straight);
    b.bend += lanes::where<T>(leads, weight * lanes::clamp(leading, -most, most));
    b.free += lanes::where<T>(bent, weight);
    b.per_dx += lanes::where<T>(bent, weight);
    b.per_dy += lanes::where<T>(bent, weight * (ends + 1.0));
  }
  return b;
}

}  // namespace step

template <class T>
void Actuator::add_tendon_friction(const SegmentOf<T>& seg, TrialOf<T>& t, const elastic::PositionsOf<T>& to) const noexcept {
  elastic::SegmentMeanOf<T>& mean = t.mean;
  const LeadOf<T>& lead = seg.in.lead;
  const T shift = seg.shift(t.dq), ahead_rad = t.dq * seg.per_share - lead.drift;  // q' − y' of the step
  for (int i = 0; i < springs<T>(); ++i) {
    T& xx = i == 0 ? mean.slope.x0x0 : mean.slope.x1x1;
    const T deflection = t.dq - t.dx[i];
    // The mean tension times the deflection's change is the energy's change: w at the end costs no call of the law.
    const T signed_tension = mean.load[i] - 2.0 * xx * shift;
    const T energy = lanes::max(lanes::abs(seg.w[i]) + signed_tension * deflection, 0.0);
    const T w = lanes::copysign(energy, to.q - to.x[i]), dw = w - seg.w[i];
    // Mean |tension| over the segment, Δw/Δδ; by the elastic mean where the spring doesn't pass through zero.
    const auto same_side = lanes::same(w < 0.0, seg.w[i] < 0.0);
    T tension = lanes::abs(signed_tension);
    if (!lanes::all(same_side)) tension = lanes::select(same_side, tension, lanes::abs(dw / deflection));
    const T tension_slope = lanes::select(w < 0.0, -xx, xx), end_tension = tension + deflection * tension_slope;
    const auto b =
        step::bend_over<T>(seg.w_u[i], dw, seg.damping * dw, end_tension * ahead_rad, tendon_.presliding_rad, lead.tendon[i], lead);
    t.straight_J[i] = b.straight;
    t.tension[i] = lanes::max(lanes::abs(end_tension), step::kNothing);
    const T level = -tendon_.stiffness * b.bend, stick = tendon_.stiffness * end_tension * tension;
    t.stick[i] = stick * (1.0 + seg.damping);
    const T turn = level * -tension_slope, damping = t.rub.damping[i] = stick * seg.damping * b.free;
    const T dx = t.rub.dx[i] = turn + stick * b.per_dx + damping;
    t.rub.dy[i] = turn * (2.0 * lead.before + lead.share) + stick * b.per_dy + damping * lead.share;
    const T torque = level * tension;
    mean.torque += torque;
    mean.load[i] -= torque;
    mean.slope.qq += dx;
    mean.slope.qx[i] -= dx;
    xx += dx;
  }
}

template <class T>
T Actuator::spring_slope(const TrialOf<T>& t, int i) noexcept {
  return (i == 0 ? t.mean.slope.x0x0 : t.mean.slope.x1x1) - t.rub.dx[i];
}

/// How far the springs' deflections may be corrected by the slopes alone: min(a/b, c/d) of each by one division. Nothing where it isn't
/// known which motor pulls at which spring.
template <class T>
T Actuator::straight(const TrialOf<T>& t, const std::array<T, 2>& step) const noexcept {
  if (springs<T>() != motors<T>()) return 0.0;
  T least = step::kFar;
  for (int i = 0; i < springs<T>(); ++i) {
    const T load = step::kStraight * lanes::abs(t.mean.load[i]);
    const T slope = lanes::max(lanes::abs(spring_slope<T>(t, i)), step::kNothing);
    const auto edge = t.straight_J[i] * slope < load * t.tension[i];
    const T far = lanes::select(edge, t.straight_J[i], load) / lanes::select(edge, t.tension[i], slope);
    least = lanes::min(least, far - lanes::abs(step[i]));
  }
  return least;
}

template <class T>
void Actuator::move_tendons(ActuatorStateOf<T>& s, const SegmentOf<T>& seg) const noexcept {
  const std::array<T, 2>& w = s.spring_w;
  s.ledger.tendon_bristle = 0.0;
  for (int i = 0; i < springs<T>(); ++i) {
    const T u = seg.w_u[i], dw = w[i] - seg.w[i], damper = seg.damping * dw, z = tendon_.presliding_rad;
    const drive::FrictionStepOf<T> step = drive::follow_friction(tendon_, u, dw);
    const T end = u + dw - step.anchor_travel;
    const T bent_more = lanes::clamp(u + damper, -z, z) - u + lanes::clamp(end + damper, -z, z) - end;
    s.ledger.tendon_friction += drive::friction_heat(tendon_, u, step) + 0.5 * tendon_.stiffness * bent_more * dw;
    s.tendon_anchor[i] += step.anchor_travel;
    s.ledger.tendon_bristle += drive::bristle_energy(tendon_, w[i] - s.tendon_anchor[i]);
  }
}

}  // namespace vsa::actuator
