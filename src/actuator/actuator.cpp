// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/actuator/actuator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vsa::actuator {
namespace {

constexpr int kMaxIterations = 60;
// Newton converges quadratically: a last correction that moves a load by this fraction leaves about its square. What it leaves is
// not lost but booked as integrator error.
constexpr double kRelativeTolerance = 1e-4;
constexpr double kAbsoluteTolerance_Nm = 1e-6;
constexpr double kRough_rad = 0.02;  // a correction that is larger isn't trusted unseen

// Each motor's correction takes its own curvature alone: where a law ties the motors together (x0x1 ≠ 0), the iteration converges
// linearly instead of quadratically.
double load_curvature(const elastic::Hessian& h, int i) noexcept { return i == 0 ? h.x0x0 : h.x1x1; }

/// The mean, carried from the displacements it was evaluated at to nearby ones.
elastic::SegmentMean carried(elastic::SegmentMean mean, double dq, const std::array<double, 2>& dx) noexcept {
  const elastic::Hessian& h = mean.slope;
  mean.torque -= h.qq * dq + h.qx[0] * dx[0] + h.qx[1] * dx[1];
  mean.load[0] -= h.qx[0] * dq + h.x0x0 * dx[0] + h.x0x1 * dx[1];
  mean.load[1] -= h.qx[1] * dq + h.x0x1 * dx[0] + h.x1x1 * dx[1];
  return mean;
}

}  // namespace

drive::FrictionParams shaft_friction(const ActuatorParams& params) noexcept {
  drive::FrictionParams p = params.shaft_friction;
  if (p.coulomb_Nm > 0) p.presliding_rad = std::max(p.presliding_rad, kLeastPresliding_rad);
  return p;
}

Actuator::Actuator(ActuatorParams params)
    : params_(std::move(params)),
      motor_(drive::at_pulley(params_.motor, params_.gearbox.ratio)),
      friction_(drive::at_pulley(params_.gearbox.friction, params_.gearbox.ratio)),
      shaft_friction_(actuator::shaft_friction(params_)),
      tendon_(drive::FrictionParams{params_.tendon.friction, params_.tendon.presliding_J}),
      motors_(params_.transmission->motor_count()),
      springs_(params_.transmission->spring_count()),
      chopped_(params_.bridge.pin == drive::PwmPin::enable),
      back_loss_(params_.gearbox.back_loss.value_or(params_.gearbox.load_loss)),
      winding_Ohm_(motor_.resistance_Ohm),
      winding_H_(motor_.inductance_H.value_or(0.0)) {
  if (chopped_) {
    motor_.inductance_H.reset();  // it shapes the current within a period, whose mean follows the speed at once
  } else {
    motor_.resistance_Ohm += params_.bridge.switch_Ohm;
  }
}

elastic::Positions Actuator::positions(const ActuatorState& s, double shaft) const noexcept {
  return {shaft, {s.motor[0].angle, s.motor[1].angle}};
}

ActuatorState Actuator::initial(const std::array<double, 2>& pulleys, double shaft) const noexcept {
  ActuatorState s;
  for (int i = 0; i < 2; ++i) s.motor[i].angle = s.motor_anchor[i] = pulleys[i];
  place(s, shaft);
  return s;
}

void Actuator::place(ActuatorState& s, double shaft) const noexcept {
  s.shaft = s.shaft_anchor = shaft;
  const elastic::Response r = params_.transmission->evaluate(positions(s, shaft));
  s.load = r.load;
  s.end = {r.torque, r.load, {}};
  s.end_rub = {};
  s.origin = params_.transmission->origin(positions(s, shaft));
  s.tendon_anchor = s.spring_w = params_.transmission->signed_energies_of(s.origin);
  s.ledger = {};
  s.ledger.elastic = r.energy;
  book_motors(s);
  s.ledger.stored_at_start = s.ledger.stored();
}

double Actuator::energy_at(ActuatorState& s, double shaft) const noexcept {
  s.origin = params_.transmission->moved(s.origin, positions(s, shaft));
  if (tendon_.coulomb_Nm <= 0) return params_.transmission->energy_of(s.origin);
  s.spring_w = params_.transmission->signed_energies_of(s.origin);
  return std::abs(s.spring_w[0]) + std::abs(s.spring_w[1]);
}

void Actuator::book_motors(ActuatorState& s) const noexcept {
  Ledger& l = s.ledger;
  l.kinetic = l.magnetic = l.bristle = 0;
  for (int i = 0; i < motors_; ++i) {
    l.kinetic += 0.5 * motor_.inertia_kgm2 * s.motor[i].speed * s.motor[i].speed;
    if (motor_.inductance_H) l.magnetic += 0.5 * *motor_.inductance_H * s.motor[i].current * s.motor[i].current;
    l.bristle += drive::bristle_energy(friction_, s.motor[i].angle - s.motor_anchor[i]);
  }
}

const drive::MotorStepper& Actuator::stepper(double h_s, drive::Terminal terminal) noexcept {
  if (prepared_[0].h_s != h_s) {
    std::swap(prepared_[0], prepared_[1]);
    if (prepared_[0].h_s != h_s) {
      prepared_[0] = {h_s, {motor_, drive::Terminal::driven, h_s}, {motor_, drive::Terminal::open, h_s}};
    }
  }
  return terminal == drive::Terminal::driven ? prepared_[0].driven : prepared_[0].open;
}

void Actuator::begin(ActuatorState& s, Segment& seg, double h_s, const SegmentInput& in) noexcept {
  seg.in = in;
  for (int i = 0; i < 2; ++i) {
    if (chopped_ && !(in.supply_V > 0)) seg.in.terminal[i] = drive::Terminal::open;
    seg.stepper[i] = &stepper(h_s, seg.in.terminal[i]);
    seg.pwm[i].cycle = nullptr;
  }
  seg.tried = false;
  seg.rub = {};
  seg.straight.fill(std::numeric_limits<double>::infinity());
  seg.damping = params_.tendon.damping_s / h_s;
  seg.own = in.lead.share + 3.0 * in.lead.spring;
  seg.whole = seg.own + 2.0 * in.lead.before;
  for (int i = 0; i < motors_; ++i) {
    if (chopped_ && seg.in.terminal[i] == drive::Terminal::driven) {
      begin_pwm(seg, i, s.motor[i].speed, h_s);
    } else {
      seg.free[i] = seg.stepper[i]->free_displacement(s.motor[i], in.voltage[i]);
      seg.give[i] = seg.stepper[i]->compliance();
    }
    // The limit of the gears' friction follows the load of the last segment, by where that and the motor would go; its bristle's
    // stiffness doesn't, so that a limit that grows adds no energy and one that shrinks burns what it lets go.
    drive::Friction& gear = seg.gear[i];
    const bool back = (seg.free[i] + seg.give[i] * s.load[i]) * s.load[i] > 0;
    gear = drive::at_load(friction_, back ? back_loss_ : params_.gearbox.load_loss, s.load[i]);
    double& u = seg.gear_u[i];
    u = s.motor[i].angle - s.motor_anchor[i];
    if (gear.stiffness > 0 && std::abs(u) > gear.presliding_rad) {
      const double kept = std::copysign(gear.presliding_rad, u);
      s.ledger.motor_friction += drive::bristle_energy(gear, u) - drive::bristle_energy(gear, kept);
      s.motor_anchor[i] = s.motor[i].angle - kept;
      u = kept;
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
void Actuator::slopes(Segment& seg, const elastic::SegmentMean& mean, const Rub& rub) const noexcept {
  const double per_own = seg.own / seg.in.lead.share;
  seg.slope = (mean.slope.qq - rub.dx[0] - rub.dx[1]) * seg.whole + rub.dy[0] + rub.dy[1];
  for (int i = 0; i < motors_; ++i) {
    const double give = seg.gain[i], qx = mean.slope.qx[i], spring = qx + rub.dx[i];
    seg.gain[i] = -give * (spring * per_own - rub.dx[i]);
    seg.slope -= give * qx * (spring * seg.whole - rub.dy[i]);
  }
}

SegmentResult Actuator::foresee(const ActuatorState& s, Segment& seg) const noexcept {
  // The mean at dq = 0 looks ahead by this; slopes are those of a segment's end, half of the law's own.
  const double shift = 2.0 * seg.shift(0);
  SegmentResult r{s.end.torque - s.end.slope.qq * shift, 0};
  for (int i = 0; i < motors_; ++i) {
    const double c = seg.give[i];
    // load̄ ≈ end.load − qx·(dq + shift) − κ·dx, at dq = 0.
    const double qx = s.end.slope.qx[i];
    const double yield = 1.0 / (1.0 + c * std::max(load_curvature(s.end.slope, i), 0.0));
    const double target = (seg.free[i] + c * (s.end.load[i] - qx * shift)) * yield;
    const auto found = drive::solve_friction(seg.gear[i], seg.gear_u[i], target, c * yield);
    const double bristle = found.anchor_travel != 0.0 ? 0.0 : 0.5 * seg.gear[i].stiffness;
    seg.dx[i] = found.displacement;
    seg.gain[i] = c * yield / (1.0 + c * yield * bristle);
    r.torque -= qx * seg.dx[i];
  }
  slopes(seg, s.end, s.end_rub);
  r.slope = seg.slope;
  seg.in.dq = 0;
  seg.tried = true;
  return r;
}

bool Actuator::correction(Segment& seg, std::array<double, 2>& step) const noexcept {
  bool accepted = true;
  for (int i = 0; i < motors_; ++i) {
    if (seg.pwm[i].cycle != nullptr) follow(seg, i);
    const double c = seg.give[i];
    // load(dx) ≈ load − κ·step; κ > −1/(2c) keeps the linear problem monotone where a law isn't convex.
    const double kappa = std::max(load_curvature(seg.mean.slope, i), -0.5 / c);
    const double yield = 1.0 / (1.0 + c * kappa);
    const double target = (seg.free[i] + c * (seg.mean.load[i] + kappa * seg.dx[i])) * yield;
    seg.friction[i] = drive::solve_friction(seg.gear[i], seg.gear_u[i], target, c * yield);
    step[i] = seg.friction[i].displacement - seg.dx[i];
    const bool near = std::abs(kappa * step[i]) <= kRelativeTolerance * std::abs(seg.mean.load[i]) + kAbsoluteTolerance_Nm;
    accepted = accepted && (near || (seg.pwm[i].cycle == nullptr && std::abs(step[i]) <= straight(seg, i)));
    const double bristle = seg.friction[i].anchor_travel != 0.0 ? 0.0 : 0.5 * seg.gear[i].stiffness;
    seg.gain[i] = c * yield / (1.0 + c * yield * bristle);
  }
  slopes(seg, seg.mean, seg.rub);
  return accepted;
}

SegmentResult Actuator::attempt(const ActuatorState& s, Segment& seg, double dq, bool rough) const noexcept {
  if (!seg.tried) foresee(s, seg);
  for (int i = 0; i < motors_; ++i) seg.dx[i] += seg.gain[i] * (dq - seg.in.dq);
  seg.in.dq = dq;
  const elastic::Positions& from = s.origin.at;
  double last_residual = std::numeric_limits<double>::infinity();
  std::array<double, 2> last_dx = seg.dx;
  bool settled = false;
  double straight_rad = springs_ == motors_ ? std::numeric_limits<double>::infinity() : 0.0;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const elastic::Positions to{from.q + dq, {from.x[0] + seg.dx[0], from.x[1] + seg.dx[1]}};
    seg.mean = params_.transmission->mean_from(s.origin, to, seg.shift(dq));
    if (tendon_.coulomb_Nm > 0) add_tendon_friction(seg, to);
    std::array<double, 2> step{};
    settled = correction(seg, step);
    const double residual = std::max(std::abs(step[0]), std::abs(step[1]));
    if (settled || (rough && residual < kRough_rad) || iteration + 1 == kMaxIterations) {
      for (int i = 0; i < springs_; ++i) straight_rad = std::min(straight_rad, straight(seg, i) - std::abs(step[i]));
      for (int i = 0; i < 2; ++i) seg.dx[i] += step[i];
      seg.mean = carried(seg.mean, 0.0, step);
      break;
    }
    // A hardening spring can throw Newton far out; halve until the correction shrinks.
    const bool worse = !(residual < last_residual);
    for (int i = 0; i < 2; ++i) {
      const double next = worse ? 0.5 * (seg.dx[i] + last_dx[i]) : seg.dx[i] + step[i];
      if (!worse) last_dx[i] = seg.dx[i];
      seg.dx[i] = next;
    }
    if (!worse) last_residual = residual;
  }
  return {seg.mean.torque, seg.slope, settled || !rough, straight_rad};
}

void Actuator::drive_motors(ActuatorState& s, const Segment& seg) const noexcept {
  Ledger& l = s.ledger;
  for (int i = 0; i < motors_; ++i) {
    drive::MotorState& m = s.motor[i];
    const double torque = seg.mean.load[i] + seg.friction[i].torque;
    const double voltage = seg.in.terminal[i] == drive::Terminal::driven ? seg.in.voltage[i] : 0.0;
    if (seg.in.terminal[i] == drive::Terminal::open && motor_.inductance_H) {
      l.copper += 0.5 * *motor_.inductance_H * m.current * m.current;  // an opened winding burns what it stored
      m.current = 0;
    }
    const bool pwm = seg.pwm[i].cycle != nullptr;
    const drive::MotorStep step = pwm ? pwm_step(l, seg.pwm[i], torque) : seg.stepper[i]->step(m, voltage, torque);
    l.motor_friction += drive::friction_heat(seg.gear[i], seg.gear_u[i], seg.friction[i]);
    if (!pwm) {
      l.supply += voltage * step.charge;
      l.supply_moved += std::abs(voltage * step.charge);
      l.copper += winding_Ohm_ * step.int_II;
      l.bridge += params_.bridge.switch_Ohm * step.int_II;
    }
    l.conversion += (motor_.back_emf_Vs_per_rad - motor_.torque_constant_Nm_per_A) * step.int_Iw;
    l.viscous += motor_.viscous_Nms_per_rad * step.int_ww;
    m.angle += step.displacement;
    m.speed = step.speed;
    m.current = motor_.inductance_H ? step.current : 0.0;
    s.motor_anchor[i] += seg.friction[i].anchor_travel;
    s.load[i] = seg.mean.load[i];
  }
  s.end = carried(seg.mean, seg.in.dq - 2.0 * seg.shift(seg.in.dq), seg.dx);
  s.end_rub = seg.rub;
  for (int i = 0; i < springs_; ++i) {
    const double damped = 2.0 * seg.rub.damping[i] * (seg.in.dq - seg.dx[i]);  // by the mean, and again by `carried`
    s.end.torque += damped;
    s.end.load[i] -= damped;
  }
}

void Actuator::finish(ActuatorState& s, const Segment& seg) const noexcept {
  const std::array<double, 2> before{s.motor[0].angle, s.motor[1].angle};
  const double before_J = s.ledger.elastic + s.ledger.tendon_bristle + s.ledger.tendon_friction;
  drive_motors(s, seg);
  s.shaft += seg.in.dq;
  const double elastic = energy_at(s, s.shaft);
  double work = seg.mean.torque * seg.in.dq;
  for (int i = 0; i < motors_; ++i) work += seg.mean.load[i] * (s.motor[i].angle - before[i]);
  if (tendon_.coulomb_Nm > 0) move_tendons(s, seg);
  s.ledger.elastic = elastic;
  s.ledger.integrator -= (elastic + s.ledger.tendon_bristle + s.ledger.tendon_friction - before_J) + work;
  book_motors(s);
}

SegmentResult Actuator::segment(ActuatorState& s, double h_s, const SegmentInput& in) noexcept {
  Segment seg;
  begin(s, seg, h_s, in);
  const SegmentResult result = attempt(s, seg, in.dq);
  finish(s, seg);
  return result;
}

}  // namespace vsa::actuator
