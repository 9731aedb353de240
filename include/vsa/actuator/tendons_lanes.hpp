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
template <class T, class Lead>
[[nodiscard]] BendOf<T> bend_over(T u, T dw, T damper, T ahead, double z, T weight, const Lead& lead) noexcept {
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
  each_spring<T>([&](auto side) {
    using N = typename decltype(side)::Number;
    const N xx = side(mean.slope.xx), deflection = t.dq - side(t.dx), before = side(seg.w), load = side(mean.load);
    // The mean tension times the deflection's change is the energy's change: w at the end costs no call of the law.
    const N signed_tension = load - 2.0 * xx * shift;
    const N energy = lanes::max(lanes::abs(before) + signed_tension * deflection, 0.0);
    const N w = lanes::copysign(energy, to.q - side(to.x)), dw = w - before;
    // Mean |tension| over the segment, Δw/Δδ; by the elastic mean where the spring doesn't pass through zero.
    const auto same_side = lanes::same(w < 0.0, before < 0.0);
    N tension = lanes::abs(signed_tension);
    if (!lanes::all(same_side)) tension = lanes::select(same_side, tension, lanes::abs(dw / deflection));
    const N tension_slope = lanes::select(w < 0.0, -xx, xx), end_tension = tension + deflection * tension_slope;
    const auto b = step::bend_over<N>(side(seg.w_u), dw, seg.damping * dw, end_tension * ahead_rad, tendon_.presliding_rad,
                                      side(lead.tendon), lead);
    side.put(t.straight_J, b.straight);
    side.put(t.tension, lanes::max(lanes::abs(end_tension), step::kNothing));
    const N level = -tendon_.stiffness * b.bend, stick = tendon_.stiffness * end_tension * tension;
    side.put(t.stick, stick * (1.0 + seg.damping));
    const N turn = level * -tension_slope, damping = stick * seg.damping * b.free;
    const N dx = turn + stick * b.per_dx + damping, torque = level * tension;
    side.put(t.rub.damping, damping);
    side.put(t.rub.dx, dx);
    side.put(t.rub.dy, turn * (2.0 * lead.before + lead.share) + stick * b.per_dy + damping * lead.share);
    side.put(mean.load, load - torque);
    side.put(mean.slope.qx, side(mean.slope.qx) - dx);
    side.add(mean.torque, torque);
    side.add(mean.slope.qq, dx);
    side.put(mean.slope.xx, xx + dx);
  });
}

template <class T, class Of>
typename Of::Number Actuator::spring_slope(const TrialOf<T>& t, const Of& side) noexcept {
  return side(t.mean.slope.xx) - side(t.rub.dx);
}

/// How far the springs' deflections may be corrected by the slopes alone: min(a/b, c/d) of each by one division. Nothing where it isn't
/// known which motor pulls at which spring.
template <class T>
T Actuator::straight(const TrialOf<T>& t, const std::array<T, 2>& step) const noexcept {
  if (springs<T>() != motors<T>()) return 0.0;
  std::array<T, 2> far;
  each_spring<T>([&](auto side) {
    using N = typename decltype(side)::Number;
    const N load = step::kStraight * lanes::abs(side(t.mean.load)), tension = side(t.tension), bent = side(t.straight_J);
    const N slope = lanes::max(lanes::abs(spring_slope<T>(t, side)), step::kNothing);
    const auto edge = bent * slope < load * tension;
    side.put(far, lanes::select(edge, bent, load) / lanes::select(edge, tension, slope) - lanes::abs(side(step)));
  });
  T least = step::kFar;
  for (int i = 0; i < springs<T>(); ++i) least = lanes::min(least, far[i]);
  return least;
}

template <class T>
void Actuator::move_tendons(ActuatorStateOf<T>& s, const SegmentOf<T>& seg) const noexcept {
  s.ledger.tendon_bristle = 0.0;
  each_spring<T>([&](auto side) {
    using N = typename decltype(side)::Number;
    const N w = side(s.spring_w), u = side(seg.w_u), dw = w - side(seg.w), damper = seg.damping * dw, z = tendon_.presliding_rad;
    const drive::FrictionStepOf<N> step = drive::follow_friction(tendon_, u, dw);
    const N end = u + dw - step.anchor_travel;
    const N bent_more = lanes::clamp(u + damper, -z, z) - u + lanes::clamp(end + damper, -z, z) - end;
    side.add(s.ledger.tendon_friction, drive::friction_heat(tendon_, u, step) + 0.5 * tendon_.stiffness * bent_more * dw);
    const N anchor = side(s.tendon_anchor) + step.anchor_travel;
    side.put(s.tendon_anchor, anchor);
    side.add(s.ledger.tendon_bristle, drive::bristle_energy(tendon_, w - anchor));
  });
}

}  // namespace vsa::actuator
