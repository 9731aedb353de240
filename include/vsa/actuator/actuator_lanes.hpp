// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// An actuator's segment, and what happens to it between segments, for one unit or several side by side (vsa/lanes.hpp).
#pragma once

#include <tuple>
#include <utility>

#include "vsa/actuator/actuator.hpp"
#include "vsa/actuator/shaft_lanes.hpp"
#include "vsa/actuator/step_constants.hpp"
#include "vsa/actuator/tendons_lanes.hpp"
#include "vsa/elastic/two_sinh_lanes.hpp"

namespace vsa::actuator {

namespace step {

// Each motor's correction takes its own curvature alone. Where a law ties the motors together (x0x1 ≠ 0), the iteration closes in by
// c₀c₁(x0x1)²/((1 + c₀κ₀)(1 + c₁κ₁)) a round, c a motor's give over the segment: a twentieth with rotors a hundred times lighter than the
// qbmove's, so that it costs no round (tests/actuator/laws_test.cpp).
/// ∂²H/∂x_i².
template <class T>
[[nodiscard]] T load_curvature(const elastic::HessianOf<T>& h, int i) noexcept {
  return i == 0 ? h.x0x0 : h.x1x1;
}

/// The mean, carried from the displacements it was evaluated at to nearby ones.
template <class T>
[[nodiscard]] elastic::SegmentMeanOf<T> carried(elastic::SegmentMeanOf<T> mean, T dq, const std::array<T, 2>& dx) noexcept {
  const elastic::HessianOf<T>& h = mean.slope;
  mean.torque -= h.qq * dq + h.qx[0] * dx[0] + h.qx[1] * dx[1];
  mean.load[0] -= h.qx[0] * dq + h.x0x0 * dx[0] + h.x0x1 * dx[1];
  mean.load[1] -= h.qx[1] * dq + h.x0x1 * dx[0] + h.x1x1 * dx[1];
  return mean;
}

/// `to` becomes `from` where `which`.
template <class Mask, class T>
void choose(Mask which, T& to, const T& from) noexcept {
  to = lanes::select(which, from, to);
}
/// Likewise of both.
template <class Mask, class T>
void choose(Mask which, std::array<T, 2>& to, const std::array<T, 2>& from) noexcept {
  for (std::size_t i = 0; i < 2; ++i) choose(which, to[i], from[i]);
}
/// to := from in these lanes.
template <class Trial, class Mask>
void take_over(Mask which, Trial& to, const Trial& from) noexcept {
  const auto tie = [](auto&... members) { return std::tie(members...); };
  const auto into = Trial::fields(to, tie);
  const auto out_of = Trial::fields(from, tie);
  [&]<std::size_t... I>(std::index_sequence<I...>) { (choose(which, std::get<I>(into), std::get<I>(out_of)), ...); }
  (std::make_index_sequence<std::tuple_size_v<decltype(into)>>{});
}

}  // namespace step

template <class T>
elastic::SegmentMeanOf<T> Actuator::mean_from(const elastic::OriginOf<T>& from, const elastic::PositionsOf<T>& to,
                                              T ahead) const noexcept {
  if constexpr (lanes::kScalar<T>) {
    if (two_sinh_ == nullptr) return params_.transmission->mean_from(from, to, ahead);
  }
  return two_sinh_->mean_lanes(from, to, ahead);
}

template <class T>
elastic::TangentOf<T> Actuator::tangent(const ActuatorStateOf<T>& s) const noexcept {
  if constexpr (lanes::kScalar<T>) {
    if (two_sinh_ == nullptr) return params_.transmission->tangent_of(s.origin);
  }
  return two_sinh_->tangent_lanes(s.origin);
}

template <class T>
T Actuator::energy_at(ActuatorStateOf<T>& s, T shaft) const noexcept {
  std::array<T, 2> w{};
  if constexpr (lanes::kScalar<T>) {
    if (two_sinh_ == nullptr) {
      s.origin = params_.transmission->moved(s.origin, positions(s, shaft));
      if (tendon_.coulomb_Nm <= 0) return params_.transmission->energy_of(s.origin);
      s.spring_w = params_.transmission->signed_energies_of(s.origin);
      return std::abs(s.spring_w[0]) + std::abs(s.spring_w[1]);
    }
  }
  s.origin = two_sinh_->moved_lanes(s.origin, positions(s, shaft));
  w = two_sinh_->signed_energies_lanes(s.origin);
  if (tendon_.coulomb_Nm > 0) s.spring_w = w;
  return lanes::abs(w[0]) + lanes::abs(w[1]);
}

template <class T>
void Actuator::book_motors(ActuatorStateOf<T>& s) const noexcept {
  LedgerOf<T>& l = s.ledger;
  l.kinetic = l.magnetic = l.bristle = 0.0;
  for (int i = 0; i < motors<T>(); ++i) {
    const Side& side = sides_[i];
    l.kinetic += 0.5 * side.motor.inertia_kgm2 * s.motor[i].speed * s.motor[i].speed;
    if (side.motor.inductance_H) l.magnetic += 0.5 * *side.motor.inductance_H * s.motor[i].current * s.motor[i].current;
    l.bristle += drive::bristle_energy(side.friction, s.motor[i].angle - s.motor_anchor[i]);
  }
}

template <class T>
void Actuator::begin(ActuatorStateOf<T>& s, SegmentOf<T>& seg, double h_s, const SegmentInputOf<T>& in) noexcept {
  seg.in = in;
  for (int i = 0; i < 2; ++i) {
    if (sides_[i].chopped && !(in.supply_V > 0)) seg.in.terminal[i] = drive::Terminal::open;
    seg.stepper[i] = &stepper(i, h_s, seg.in.terminal[i]);
    if constexpr (lanes::kScalar<T>) seg.pwm[i].cycle = nullptr;
  }
  seg.tried = false;
  if (tendon_.coulomb_Nm <= 0 || springs<T>() < 2) {  // else add_tendon_friction fills them before anybody reads them
    seg.found.rub = {};
    seg.found.straight_J = {step::kFar, step::kFar};
    seg.found.tension = {1.0, 1.0};
    seg.found.stick = {};
  }
  seg.damping = params_.tendon.damping_s / h_s;
  T own = in.lead.share + 3.0 * in.lead.spring;
  if (seg.sees_middle()) {
    seg.ramp = in.lead.motors * (1.0 - 2.0 * in.lead.before - in.lead.share);
    seg.spread = in.lead.motors * ((1.0 - in.lead.before) / in.lead.share - 1.0);
    for (int i = 0; i < 2; ++i) seg.lag[i] = -0.5 * in.lead.motors * in.lead.gone[i];
    own += seg.ramp;
  }
  seg.whole = own + 2.0 * in.lead.before;
  seg.per_share = 1.0 / in.lead.share;
  seg.per_own = own * seg.per_share;
  for (int i = 0; i < motors<T>(); ++i) {
    const Side& side = sides_[i];
    bool pwm = false;
    if constexpr (lanes::kScalar<T>) {
      pwm = side.chopped && seg.in.terminal[i] == drive::Terminal::driven;
      if (pwm) begin_pwm(seg, i, s.motor[i].speed, h_s);
    }
    if (!pwm) {
      seg.free[i] = seg.stepper[i]->free_displacement(s.motor[i], in.voltage[i]);
      seg.give[i] = seg.stepper[i]->compliance();
    }
    // The limit of the gears' friction follows the load of the last segment, by where that and the motor would go; its bristle's
    // stiffness doesn't, so that a limit that grows adds no energy and one that shrinks burns what it lets go.
    drive::FrictionOf<T>& gear = seg.gear[i];
    const auto back = (seg.free[i] + seg.give[i] * s.load[i]) * s.load[i] > 0.0;
    gear = drive::at_load<T>(side.friction, lanes::select(back, T(side.back_loss), T(side.load_loss)), s.load[i]);
    T& u = seg.gear_u[i];
    u = s.motor[i].angle - s.motor_anchor[i];
    if (!(gear.stiffness > 0)) continue;
    if (const auto over = lanes::abs(u) > gear.presliding_rad; lanes::any(over)) {
      const T kept = lanes::copysign(gear.presliding_rad, u);
      s.ledger.motor_friction += lanes::where<T>(over, drive::bristle_energy(gear, u) - drive::bristle_energy(gear, kept));
      s.motor_anchor[i] = lanes::select(over, s.motor[i].angle - kept, s.motor_anchor[i]);
      u = lanes::select(over, kept, u);
    }
  }
  if (tendon_.coulomb_Nm > 0) {
    seg.w = s.spring_w;
    for (int i = 0; i < 2; ++i) seg.w_u[i] = seg.w[i] - s.tendon_anchor[i];
  }
}

// With S the mean's slopes for the segment's end, f_i and F_i the tendons' part for x_i and for Δy, S' = S − f the springs':
//   −dload_i/d(Δy) = S'_qx,i R − F_i + S_xx,i dx_i/d(Δy),   R = share + 2·before + 3w: the end, the start, the shift
//   −dτ̄/d(Δy)     = S'_qq R + Σ F_i + Σ S_qx,i dx_i/d(Δy)
// Of a step's middle in every segment (Lead::motors), ramp is a part of R, and dx_i counts 1 + spread times in S'.
template <class T>
void Actuator::slopes(const SegmentOf<T>& seg, TrialOf<T>& t, const elastic::SegmentMeanOf<T>& mean,
                      const RubOf<T>& rub) const noexcept {
  t.slope = (mean.slope.qq - rub.dx[0] - rub.dx[1]) * seg.whole + rub.dy[0] + rub.dy[1];
  for (int i = 0; i < motors<T>(); ++i) {
    const T give = t.gain[i], qx = mean.slope.qx[i], spring = qx + rub.dx[i];
    t.gain[i] = -give * (spring * seg.per_own - rub.dx[i]);
    const T by_motor = seg.sees_middle() ? qx + seg.spread * spring : qx;
    t.slope -= give * by_motor * (spring * seg.whole - rub.dy[i]);
  }
}

template <class T>
SegmentResultOf<T> Actuator::foresee(const ActuatorStateOf<T>& s, SegmentOf<T>& seg) const noexcept {
  // The mean at dq = 0 looks ahead by this; slopes are those of a segment's end, half of the law's own.
  TrialOf<T>& t = seg.found;
  const T shift = 2.0 * seg.shift(0.0);
  SegmentResultOf<T> r{s.end.torque - s.end.slope.qq * shift, 0.0};
  for (int i = 0; i < motors<T>(); ++i) {
    const double c = seg.give[i];
    // load̄ ≈ end.load − qx·(dq + shift) − κ·dx, at dq = 0.
    const T qx = s.end.slope.qx[i];
    T curvature = step::load_curvature(s.end.slope, i), load = s.end.load[i] - qx * shift;
    if (seg.sees_middle()) {
      load -= 2.0 * curvature * seg.lag[i];
      r.torque -= 2.0 * qx * seg.lag[i];
      curvature *= 1.0 + seg.spread;
    }
    const T resist = 1.0 + c * lanes::max(curvature, 0.0);
    const T target = seg.free[i] + c * load;
    const auto found = drive::solve_yielding(seg.gear[i], seg.gear_u[i], target, c, resist);
    t.dx[i] = found.step.displacement;
    t.gain[i] = found.gain;
    r.torque -= qx * t.dx[i];
    if (seg.sees_middle()) r.torque -= seg.spread * qx * t.dx[i];
  }
  slopes(seg, t, s.end, s.end_rub);
  r.slope = t.slope;
  t.dq = 0.0;
  seg.tried = true;
  return r;
}

/// The springs' part of the mean, for motors that are so much further.
template <class T>
void Actuator::see_middle(TrialOf<T>& t, const std::array<T, 2>& further) noexcept {
  const elastic::HessianOf<T>& h = t.mean.slope;
  for (std::size_t i = 0; i < 2; ++i) {
    const T xx = spring_slope<T>(t, static_cast<int>(i));
    t.mean.torque -= 2.0 * (h.qx[i] + t.rub.dx[i]) * further[i];
    t.mean.load[i] -= 2.0 * (xx * further[i] + h.x0x1 * further[1 - i]);
  }
}

template <class T>
lanes::Truth<T> Actuator::correction(SegmentOf<T>& seg, TrialOf<T>& t, std::array<T, 2>& step) const noexcept {
  auto accepted = lanes::truth<T>(true);
  for (int i = 0; i < motors<T>(); ++i) {
    if constexpr (lanes::kScalar<T>) {
      if (seg.chopped(i)) follow(seg, i);
    }
    const double c = seg.give[i];
    // load(dx) ≈ load − κ·step; κ > −1/(2c) keeps the linear problem monotone where a law isn't convex.
    T curvature = step::load_curvature(t.mean.slope, i);
    if (seg.sees_middle()) curvature += seg.spread * spring_slope<T>(t, i);
    const T kappa = lanes::max(curvature, -0.5 / c);
    const T target = seg.free[i] + c * (t.mean.load[i] + kappa * t.dx[i]);
    const auto found = drive::solve_yielding(seg.gear[i], seg.gear_u[i], target, c, 1.0 + c * kappa);
    t.friction[i] = found.step;
    t.gain[i] = found.gain;
    step[i] = t.friction[i].displacement - t.dx[i];
    const T move = lanes::abs(step[i]);
    // Beyond an edge of a tendon's bristle the load may change by all that a tendon can hold.
    const bool whose = springs<T>() == motors<T>();
    const auto crosses = lanes::truth<T>(!whose) | (move * t.tension[i] > t.straight_J[i]);
    const T beyond = lanes::where<T>(crosses, whose ? t.stick[i] : t.stick[0] + t.stick[1]);
    const T load = lanes::abs(t.mean.load[i]);
    const auto near = (lanes::abs(kappa) + beyond) * move <= step::kRelativeTolerance * load + step::kAbsoluteTolerance_Nm;
    const auto straight = (move * lanes::abs(spring_slope<T>(t, i)) <= step::kStraight * load) & !crosses;
    accepted = accepted & (near | (straight & lanes::truth<T>(!seg.chopped(i))));
  }
  slopes(seg, t, t.mean, t.rub);
  return accepted;
}

template <class T>
SegmentResultOf<T> Actuator::attempt(const ActuatorStateOf<T>& s, SegmentOf<T>& seg, T dq, bool rough,
                                     lanes::Truth<T> which) const noexcept {
  if (!seg.tried) foresee(s, seg);
  // Those of several that don't try keep what they have; those that have found it find it again, as long as the others go on.
  TrialOf<T>* trial = &seg.found;
  if constexpr (!lanes::kScalar<T>) {
    if (!lanes::all(which)) *(trial = &seg.apart) = seg.found;
  }
  TrialOf<T>& t = *trial;
  for (int i = 0; i < motors<T>(); ++i) t.dx[i] += t.gain[i] * (dq - t.dq);
  t.dq = dq;
  const elastic::PositionsOf<T>& from = s.origin.at;
  const T ahead = seg.shift(dq);
  T last_residual = step::kFar;
  std::array<T, 2> last_dx = t.dx;
  SegmentResultOf<T> r;
  for (int iteration = 0; iteration < step::kMaxIterations; ++iteration) {
    const elastic::PositionsOf<T> to{from.q + dq, {from.x[0] + t.dx[0], from.x[1] + t.dx[1]}};
    t.mean = mean_from<T>(s.origin, to, ahead);
    if (tendon_.coulomb_Nm > 0) add_tendon_friction<T>(seg, t, to);
    if (seg.sees_middle()) see_middle<T>(t, {0.5 * seg.spread * t.dx[0] + seg.lag[0], 0.5 * seg.spread * t.dx[1] + seg.lag[1]});
    std::array<T, 2> step{};
    r.settled = correction<T>(seg, t, step);
    const T residual = lanes::max(lanes::abs(step[0]), lanes::abs(step[1]));
    const auto done = r.settled | (lanes::truth<T>(rough) & (residual < step::kRough_rad));
    if (lanes::all(done | !which) || iteration + 1 == step::kMaxIterations) {
      r.straight = straight<T>(t, step);
      for (int i = 0; i < 2; ++i) t.dx[i] += step[i];
      t.mean = step::carried(t.mean, T(0.0), step);
      if (seg.sees_middle()) see_middle<T>(t, {0.5 * seg.spread * step[0], 0.5 * seg.spread * step[1]});
      break;
    }
    // A hardening spring can throw Newton far out; halve until the correction shrinks.
    const auto worse = !(residual < last_residual);
    for (int i = 0; i < 2; ++i) {
      const T here = t.dx[i], next = lanes::select(worse, 0.5 * (here + last_dx[i]), here + step[i]);
      last_dx[i] = lanes::select(done | worse, last_dx[i], here);
      t.dx[i] = lanes::select(done, here, next);
    }
    last_residual = lanes::select(done | worse, last_residual, residual);
  }
  r.settled = r.settled | lanes::truth<T>(!rough);
  r.torque = t.mean.torque;
  r.slope = t.slope;
  if (trial != &seg.found) step::take_over(which, seg.found, t);
  return r;
}

template <class T>
void Actuator::drive_motors(ActuatorStateOf<T>& s, const SegmentOf<T>& seg) const noexcept {
  LedgerOf<T>& l = s.ledger;
  const TrialOf<T>& t = seg.found;
  for (int i = 0; i < motors<T>(); ++i) {
    const Side& side = sides_[i];
    drive::MotorStateOf<T>& m = s.motor[i];
    const T torque = t.mean.load[i] + t.friction[i].torque;
    const T voltage = seg.in.terminal[i] == drive::Terminal::driven ? seg.in.voltage[i] : T(0.0);
    const bool pwm = seg.chopped(i);
    if constexpr (lanes::kScalar<T>) {
      if (seg.in.terminal[i] == drive::Terminal::open && side.motor.inductance_H) {
        l.copper += 0.5 * *side.motor.inductance_H * m.current * m.current;  // an opened winding burns what it stored
        m.current = 0;
      }
    }
    const drive::MotorStepOf<T> step = [&] {
      if constexpr (lanes::kScalar<T>) {
        if (pwm) return pwm_step(l, side, seg.pwm[i], torque);
      }
      return seg.stepper[i]->step(m, voltage, torque);
    }();
    l.motor_friction += drive::friction_heat(seg.gear[i], seg.gear_u[i], t.friction[i]);
    if (!pwm) {
      l.supply += voltage * step.charge;
      l.supply_moved += lanes::abs(voltage * step.charge);
      l.copper += side.winding_Ohm * step.int_II;
      l.bridge += side.bridge.switch_Ohm * step.int_II;
    }
    l.conversion += (side.motor.back_emf_Vs_per_rad - side.motor.torque_constant_Nm_per_A) * step.int_Iw;
    l.viscous += side.motor.viscous_Nms_per_rad * step.int_ww;
    m.angle += step.displacement;
    m.speed = step.speed;
    m.current = side.motor.inductance_H ? step.current : T(0.0);
    s.motor_anchor[i] += t.friction[i].anchor_travel;
    s.load[i] = t.mean.load[i];
  }
  std::array<T, 2> to_end = t.dx;
  for (std::size_t i = 0; i < 2 && seg.sees_middle(); ++i) to_end[i] -= seg.spread * t.dx[i] + 2.0 * seg.lag[i];
  s.end = step::carried(t.mean, t.dq - 2.0 * seg.shift(t.dq), to_end);
  s.end_rub = t.rub;
  for (int i = 0; i < springs<T>(); ++i) {
    const T damped = 2.0 * t.rub.damping[i] * (t.dq - t.dx[i]);  // by the mean, and again by `carried`
    s.end.torque += damped;
    s.end.load[i] -= damped;
  }
}

template <class T>
void Actuator::finish(ActuatorStateOf<T>& s, const SegmentOf<T>& seg) const noexcept {
  const std::array<T, 2> before{s.motor[0].angle, s.motor[1].angle};
  const T before_J = s.ledger.elastic + s.ledger.tendon_bristle + s.ledger.tendon_friction;
  drive_motors(s, seg);
  s.shaft += seg.found.dq;
  const T elastic = energy_at(s, s.shaft);
  T work = seg.found.mean.torque * seg.found.dq;
  for (int i = 0; i < motors<T>(); ++i) work += seg.found.mean.load[i] * (s.motor[i].angle - before[i]);
  if (tendon_.coulomb_Nm > 0) move_tendons(s, seg);
  s.ledger.elastic = elastic;
  s.ledger.integrator -= (elastic + s.ledger.tendon_bristle + s.ledger.tendon_friction - before_J) + work;
  book_motors(s);
}

}  // namespace vsa::actuator
