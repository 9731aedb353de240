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
template <class T, class Side>
[[nodiscard]] typename Side::Number load_curvature(const elastic::HessianOf<T>& h, const Side& side) noexcept {
  return side(h.xx);
}

/// What a side picks of its motor: ∫ω so far.
inline constexpr auto kAngle = [](auto& motor) -> auto& { return motor.angle; };
/// What a side picks of its motor: ω.
inline constexpr auto kSpeed = [](auto& motor) -> auto& { return motor.speed; };

/// What a side picks of its motor: I where that is a state.
inline constexpr auto kCurrent = [](auto& motor) -> auto& { return motor.current; };

/// `to` := the mean's torque and loads, carried from the displacements it was evaluated at to nearby ones.
template <class T>
void carry(const elastic::SegmentMeanOf<T>& mean, T dq, const std::array<T, 2>& dx, elastic::SegmentMeanOf<T>& to) noexcept {
  const elastic::HessianOf<T>& h = mean.slope;
  to.torque = mean.torque - (h.qq * dq + h.qx[0] * dx[0] + h.qx[1] * dx[1]);
  lanes::each_side<T>([&](auto side) {
    side.put(to.load, side(mean.load) - (side(h.qx) * dq + side(h.xx[0], h.x0x1) * dx[0] + side(h.x0x1, h.xx[1]) * dx[1]));
  });
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

template <class Of>
drive::FrictionOf<typename Of::Number> Actuator::gear(const Of& side) const noexcept {
  return {side(sides_, [](const Side& of) { return of.friction.coulomb_Nm; }),
          side(sides_, [](const Side& of) { return of.friction.presliding_rad; }),
          side(sides_, [](const Side& of) { return of.friction.stiffness; })};
}
template <class T, class Of>
drive::FrictionOf<typename Of::Number> Actuator::gear(const SegmentOf<T>& seg, const Of& side) const noexcept {
  return {side(seg.gear_Nm), side(seg.gear_rad), side(sides_, [](const Side& of) { return of.friction.stiffness; })};
}

template <class T>
void Actuator::mean_from(const elastic::OriginOf<T>& from, const elastic::PositionsOf<T>& to, T ahead,
                         elastic::SegmentMeanOf<T>& mean) const noexcept {
  if constexpr (lanes::kScalar<T>) {
    if (two_sinh_ == nullptr) {
      mean = params_.transmission->mean_from(from, to, ahead);
      return;
    }
  }
  two_sinh_->mean_lanes(from, to, ahead, mean);
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
  two_sinh_->move_lanes(s.origin, positions(s, shaft));
  w = two_sinh_->signed_energies_lanes(s.origin);
  if (tendon_.coulomb_Nm > 0) s.spring_w = w;
  return lanes::abs(w[0]) + lanes::abs(w[1]);
}

template <class T>
void Actuator::book_motors(ActuatorStateOf<T>& s) const noexcept {
  LedgerOf<T>& l = s.ledger;
  l.kinetic = l.magnetic = l.bristle = 0.0;
  lanes::each_side<T>(alike_, motors_, [&](auto side) {
    using N = typename decltype(side)::Number;
    const N speed = side(s.motor, step::kSpeed);
    side.add(l.kinetic, 0.5 * side(sides_, [](const Side& of) { return of.motor.inertia_kgm2; }) * speed * speed);
    if constexpr (lanes::kScalar<N>) {
      if (const auto& henry = sides_[side.i].motor.inductance_H) {
        const N current = s.motor[side.i].current;
        l.magnetic += 0.5 * *henry * current * current;
      }
    }
    side.add(l.bristle, drive::bristle_energy(gear(side), side(s.motor, step::kAngle) - side(s.motor_anchor)));
  });
}

template <class T>
void Actuator::begin(ActuatorStateOf<T>& s, SegmentOf<T>& seg, double h_s, const SegmentInputOf<T>& in) noexcept {
  seg.in.dq = in.dq;
  seg.in.lead = in.lead;
  seg.in.supply_V = in.supply_V;
  for (int i = 0; i < 2; ++i) {
    seg.in.voltage[i] = in.voltage[i];
    seg.in.terminal[i] = in.terminal[i];
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
  each_motor<T>(seg, [&](auto side) {
    using N = typename decltype(side)::Number;
    N free = 0.0;
    lanes::Constant<N> give = 0.0;
    if constexpr (decltype(side)::kBoth) {
      free = side(seg.stepper[0]->free_displacement(s.motor[0], in.voltage[0]),
                  seg.stepper[1]->free_displacement(s.motor[1], in.voltage[1]));
      give = side(seg.stepper[0]->compliance(), seg.stepper[1]->compliance());
      side.put(seg.free, free);
      side.put(seg.give, give);
    } else {
      const std::size_t i = side.i;
      bool pwm = false;
      if constexpr (lanes::kScalar<T>) {
        pwm = sides_[i].chopped && seg.in.terminal[i] == drive::Terminal::driven;
        if (pwm) begin_pwm(seg, static_cast<int>(i), s.motor[i].speed, h_s);
      }
      if (!pwm) {
        seg.free[i] = seg.stepper[i]->free_displacement(s.motor[i], in.voltage[i]);
        seg.give[i] = seg.stepper[i]->compliance();
      }
      free = seg.free[i];
      give = seg.give[i];
    }
    // The limit of the gears' friction follows the load of the last segment, by where that and the motor would go; its bristle's
    // stiffness doesn't, so that a limit that grows adds no energy and one that shrinks burns what it lets go.
    const N load = side(s.load);
    const auto back = (free + give * load) * load > 0.0;
    const N loss = lanes::select(back, N(side(sides_, [](const Side& of) { return of.back_loss; })),
                                 N(side(sides_, [](const Side& of) { return of.load_loss; })));
    const drive::FrictionOf<N> gear = drive::at_load<N>(this->gear(side), loss, load);
    N u = side(s.motor, step::kAngle) - side(s.motor_anchor);
    if (drive::bristled(gear)) {
      if (const auto over = lanes::abs(u) > gear.presliding_rad; lanes::any(over)) {
        const N kept = lanes::copysign(gear.presliding_rad, u);
        side.add(s.ledger.motor_friction,
                 lanes::where<N>(over, drive::bristle_energy(gear, u) - drive::bristle_energy(gear, kept)));
        side.put(s.motor_anchor, lanes::select(over, side(s.motor, step::kAngle) - kept, N(side(s.motor_anchor))));
        u = lanes::select(over, kept, u);
      }
    }
    side.put(seg.gear_Nm, gear.coulomb_Nm);
    side.put(seg.gear_rad, gear.presliding_rad);
    side.put(seg.gear_u, u);
  });
  if (tendon_.coulomb_Nm > 0) {
    lanes::each_side<T>([&](auto side) {
      side.put(seg.w, side(s.spring_w));
      side.put(seg.w_u, side(s.spring_w) - side(s.tendon_anchor));
    });
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
  each_motor<T>(seg, [&](auto side) {
    using N = typename decltype(side)::Number;
    const N give = side(t.gain), qx = side(mean.slope.qx), rub_dx = side(rub.dx), spring = qx + rub_dx;
    side.put(t.gain, -give * (spring * seg.per_own - rub_dx));
    N by_motor = qx;
    if constexpr (!decltype(side)::kBoth) by_motor = seg.sees_middle() ? qx + seg.spread * spring : qx;
    side.add(t.slope, -(give * by_motor * (spring * seg.whole - side(rub.dy))));
  });
}

template <class T>
SegmentResultOf<T> Actuator::foresee(const ActuatorStateOf<T>& s, SegmentOf<T>& seg) const noexcept {
  // The mean at dq = 0 looks ahead by this; slopes are those of a segment's end, half of the law's own.
  TrialOf<T>& t = seg.found;
  const T shift = 2.0 * seg.shift(0.0);
  SegmentResultOf<T> r{s.end.torque - s.end.slope.qq * shift, 0.0};
  each_motor<T>(seg, [&](auto side) {
    using N = typename decltype(side)::Number;
    const auto c = side(seg.give);
    // load̄ ≈ end.load − qx·(dq + shift) − κ·dx, at dq = 0.
    const N qx = side(s.end.slope.qx);
    N curvature = step::load_curvature(s.end.slope, side), load = side(s.end.load) - qx * shift;
    if constexpr (!decltype(side)::kBoth) {
      if (seg.sees_middle()) {
        load -= 2.0 * curvature * seg.lag[side.i];
        r.torque -= 2.0 * qx * seg.lag[side.i];
        curvature *= 1.0 + seg.spread;
      }
    }
    const N resist = 1.0 + c * lanes::max(curvature, 0.0);
    const N target = side(seg.free) + c * load;
    const auto found = drive::solve_yielding<N>(gear(seg, side), side(seg.gear_u), target, c, resist);
    const N dx = found.step.displacement;
    side.put(t.dx, dx);
    side.put(t.gain, found.gain);
    side.add(r.torque, -(qx * dx));
    if constexpr (!decltype(side)::kBoth) {
      if (seg.sees_middle()) r.torque -= seg.spread * qx * dx;
    }
  });
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
    const T xx = spring_slope<T>(t, lanes::OneSide<T>{i});
    t.mean.torque -= 2.0 * (h.qx[i] + t.rub.dx[i]) * further[i];
    t.mean.load[i] -= 2.0 * (xx * further[i] + h.x0x1 * further[1 - i]);
  }
}

template <class T>
lanes::Truth<T> Actuator::correction(SegmentOf<T>& seg, TrialOf<T>& t, std::array<T, 2>& step) const noexcept {
  auto accepted = lanes::truth<T>(true);
  const bool whose = springs<T>() == motors<T>();
  each_motor<T>(seg, [&](auto side) {
    using N = typename decltype(side)::Number;
    if constexpr (lanes::kScalar<T>) {
      if constexpr (!decltype(side)::kBoth) {
        if (seg.chopped(static_cast<int>(side.i))) follow(seg, static_cast<int>(side.i));
      }
    }
    const auto c = side(seg.give);
    const N dx = side(t.dx), load = side(t.mean.load), slope = spring_slope<T>(t, side);
    // load(dx) ≈ load − κ·step; κ > −1/(2c) keeps the linear problem monotone where a law isn't convex.
    N curvature = step::load_curvature(t.mean.slope, side);
    if constexpr (!decltype(side)::kBoth) {
      if (seg.sees_middle()) curvature += seg.spread * slope;
    }
    const N kappa = lanes::max(curvature, -0.5 / c);
    const N target = side(seg.free) + c * (load + kappa * dx);
    const auto found = drive::solve_yielding<N>(gear(seg, side), side(seg.gear_u), target, c, 1.0 + c * kappa);
    side.put(
        t.friction, found.step.displacement, [](auto& f) -> auto& { return f.displacement; });
    side.put(
        t.friction, found.step.torque, [](auto& f) -> auto& { return f.torque; });
    side.put(
        t.friction, found.step.anchor_travel, [](auto& f) -> auto& { return f.anchor_travel; });
    side.put(t.gain, found.gain);
    side.put(step, found.step.displacement - dx);
    const N move = lanes::abs(found.step.displacement - dx);
    // Beyond an edge of a tendon's bristle the load may change by all that a tendon can hold.
    const auto crosses = lanes::truth<N>(!whose) | (move * side(t.tension) > side(t.straight_J));
    const N beyond = lanes::where<N>(crosses, whose ? N(side(t.stick)) : N(t.stick[0] + t.stick[1]));
    const N size = lanes::abs(load);
    const auto near = (lanes::abs(kappa) + beyond) * move <= step::kRelativeTolerance * size + step::kAbsoluteTolerance_Nm;
    const auto straight = (move * lanes::abs(slope) <= step::kStraight * size) & !crosses;
    if constexpr (decltype(side)::kBoth) {
      accepted = lanes::all(near | straight);
    } else {
      accepted = accepted & (near | (straight & lanes::truth<T>(!seg.chopped(static_cast<int>(side.i)))));
    }
  });
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
  each_motor<T>(seg, [&](auto side) { side.put(t.dx, side(t.dx) + side(t.gain) * (dq - t.dq)); });
  t.dq = dq;
  const elastic::PositionsOf<T>& from = s.origin.at;
  const T ahead = seg.shift(dq);
  T last_residual = step::kFar;
  std::array<T, 2> last_dx = t.dx;
  SegmentResultOf<T> r;
  for (int iteration = 0; iteration < step::kMaxIterations; ++iteration) {
    const elastic::PositionsOf<T> to{from.q + dq, {from.x[0] + t.dx[0], from.x[1] + t.dx[1]}};
    mean_from<T>(s.origin, to, ahead, t.mean);
    if (tendon_.coulomb_Nm > 0) add_tendon_friction<T>(seg, t, to);
    if (seg.sees_middle()) see_middle<T>(t, {0.5 * seg.spread * t.dx[0] + seg.lag[0], 0.5 * seg.spread * t.dx[1] + seg.lag[1]});
    std::array<T, 2> step{};
    r.settled = correction<T>(seg, t, step);
    const T residual = lanes::max(lanes::abs(step[0]), lanes::abs(step[1]));
    const auto done = r.settled | (lanes::truth<T>(rough) & (residual < step::kRough_rad));
    if (lanes::all(done | !which) || iteration + 1 == step::kMaxIterations) {
      r.straight = straight<T>(t, step);
      lanes::each_side<T>([&](auto side) { side.put(t.dx, side(t.dx) + side(step)); });
      step::carry(t.mean, T(0.0), step, t.mean);
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
  each_motor<T>(seg, [&](auto side) {
    using N = typename decltype(side)::Number;
    const N friction = side(t.friction, [](const auto& f) { return f.torque; });
    const N travel = side(t.friction, [](const auto& f) { return f.anchor_travel; });
    const N load = side(t.mean.load), torque = load + friction;
    const auto voltage_of = [&](std::size_t i) {
      return seg.in.terminal[i] == drive::Terminal::driven ? seg.in.voltage[i] : T(0.0);
    };
    N voltage;
    drive::MotorStepOf<N> step;
    bool pwm = false;
    if constexpr (decltype(side)::kBoth) {
      voltage = side(voltage_of(0), voltage_of(1));
      step = drive::MotorStepper::both(*seg.stepper[0], *seg.stepper[1], side(s.motor, step::kSpeed), voltage, torque);
    } else {
      const std::size_t i = side.i;
      drive::MotorStateOf<T>& m = s.motor[i];
      voltage = voltage_of(i);
      pwm = seg.chopped(static_cast<int>(i));
      if constexpr (lanes::kScalar<T>) {
        if (seg.in.terminal[i] == drive::Terminal::open && sides_[i].motor.inductance_H) {
          l.copper += 0.5 * *sides_[i].motor.inductance_H * m.current * m.current;  // an opened winding burns what it stored
          m.current = 0;
        }
        if (pwm) step = pwm_step(l, sides_[i], seg.pwm[i], torque);
      }
      if (!pwm) step = seg.stepper[i]->step(m, voltage, torque);
    }
    const drive::FrictionStepOf<N> rubbed{side(t.friction, [](const auto& f) { return f.displacement; }), friction, travel};
    side.add(l.motor_friction, drive::friction_heat(gear(seg, side), N(side(seg.gear_u)), rubbed));
    if (!pwm) {
      side.add(l.supply, voltage * step.charge);
      side.add(l.supply_moved, lanes::abs(voltage * step.charge));
      side.add(l.copper, side(sides_, [](const Side& of) { return of.winding_Ohm; }) * step.int_II);
      side.add(l.bridge, side(sides_, [](const Side& of) { return of.bridge.switch_Ohm; }) * step.int_II);
    }
    const auto unlike =
        side(sides_, [](const Side& of) { return of.motor.back_emf_Vs_per_rad - of.motor.torque_constant_Nm_per_A; });
    side.add(l.conversion, unlike * step.int_Iw);
    side.add(l.viscous, side(sides_, [](const Side& of) { return of.motor.viscous_Nms_per_rad; }) * step.int_ww);
    side.put(s.motor, side(s.motor, step::kAngle) + step.displacement, step::kAngle);
    side.put(s.motor, step.speed, step::kSpeed);
    if constexpr (decltype(side)::kBoth) {
      side.put(s.motor, N(0.0), step::kCurrent);
    } else {
      s.motor[side.i].current = sides_[side.i].motor.inductance_H ? step.current : T(0.0);
    }
    side.put(s.motor_anchor, side(s.motor_anchor) + travel);
    side.put(s.load, load);
  });
  std::array<T, 2> to_end = t.dx;
  for (std::size_t i = 0; i < 2 && seg.sees_middle(); ++i) to_end[i] -= seg.spread * t.dx[i] + 2.0 * seg.lag[i];
  step::carry(t.mean, t.dq - 2.0 * seg.shift(t.dq), to_end, s.end);
  s.end.slope = t.mean.slope;
  s.end_rub = t.rub;
  for (int i = 0; i < springs<T>(); ++i) {
    const T damped = 2.0 * t.rub.damping[i] * (t.dq - t.dx[i]);  // by the mean, and again by carry()
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
