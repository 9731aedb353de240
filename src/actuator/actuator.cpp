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

double load_curvature(const elastic::Hessian& h, int i) noexcept { return i == 0 ? h.x0x0 : h.x1x1; }

/// The mean, carried from the displacements it was evaluated at to nearby ones.
void correct(elastic::SegmentMean& mean, const std::array<double, 2>& step) noexcept {
  mean.torque -= mean.slope.qx[0] * step[0] + mean.slope.qx[1] * step[1];
  mean.load[0] -= mean.slope.x0x0 * step[0] + mean.slope.x0x1 * step[1];
  mean.load[1] -= mean.slope.x0x1 * step[0] + mean.slope.x1x1 * step[1];
}

}  // namespace

Actuator::Actuator(ActuatorParams params)
    : params_(std::move(params)),
      motor_(drive::at_pulley(params_.motor, params_.gearbox.ratio)),
      friction_(drive::at_pulley(params_.gearbox.friction, params_.gearbox.ratio)),
      shaft_friction_(params_.shaft_friction),
      tendon_(drive::FrictionParams{params_.tendon.friction, params_.tendon.presliding_J}),
      motors_(params_.transmission->motor_count()) {}

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
  s.tendon_anchor = s.spring_w = params_.transmission->signed_energies(positions(s, shaft));
  s.ledger = {};
  s.ledger.elastic = r.energy;
  book_motors(s);
  s.ledger.stored_at_start = s.ledger.stored();
}

double Actuator::energy_at(ActuatorState& s, double shaft) const noexcept {
  if (tendon_.coulomb_Nm <= 0) return params_.transmission->energy(positions(s, shaft));
  s.spring_w = params_.transmission->signed_energies(positions(s, shaft));
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

Actuator::Start Actuator::start_of(ActuatorState& s) const noexcept {
  Start start;
  for (int i = 0; i < motors_; ++i) {
    // The limit of the gears' friction follows the load of the last segment; its bristle's stiffness doesn't, so that a limit that
    // grows adds no energy and one that shrinks burns what it lets go.
    drive::Friction& gear = start.gear[i];
    gear = drive::at_load(friction_, params_.gearbox.load_loss, s.load[i]);
    double& u = start.gear_u[i];
    u = s.motor[i].angle - s.motor_anchor[i];
    if (gear.stiffness > 0 && std::abs(u) > gear.presliding_rad) {
      const double kept = std::copysign(gear.presliding_rad, u);
      s.ledger.motor_friction += drive::bristle_energy(gear, u) - drive::bristle_energy(gear, kept);
      s.motor_anchor[i] = s.motor[i].angle - kept;
      u = kept;
    }
  }
  if (tendon_.coulomb_Nm > 0) {
    start.w = s.spring_w;
    for (int i = 0; i < 2; ++i) start.w_u[i] = start.w[i] - s.tendon_anchor[i];
  }
  return start;
}

void Actuator::add_tendon_friction(const Start& start, const elastic::Positions& to, const std::array<double, 2>& deflection,
                                   elastic::SegmentMean& mean) const noexcept {
  const std::array<double, 2> w = params_.transmission->signed_energies(to);
  for (int i = 0; i < params_.transmission->spring_count(); ++i) {
    const drive::FrictionStep step = drive::follow_friction(tendon_, start.w_u[i], w[i] - start.w[i]);
    // Mean tension over the segment, Δw/Δδ; by the elastic mean where the spring doesn't pass through zero.
    const bool same_side = (w[i] < 0) == (start.w[i] < 0);
    const double tension = same_side ? std::abs(mean.load[i]) : std::abs((w[i] - start.w[i]) / deflection[i]);
    double& xx = i == 0 ? mean.slope.x0x0 : mean.slope.x1x1;
    const double tension_slope = w[i] < 0 ? -xx : xx;
    const double end_tension = tension + deflection[i] * tension_slope;
    const bool sliding = std::abs(start.w_u[i] + (w[i] - start.w[i])) > tendon_.presliding_rad;
    const double torque = step.torque * tension;
    const double slope = (sliding ? 0.0 : 0.5 * tendon_.stiffness * end_tension * tension) - step.torque * tension_slope;
    mean.torque += torque;
    mean.load[i] -= torque;
    mean.slope.qq += slope;
    mean.slope.qx[i] -= slope;
    xx += slope;
  }
}

void Actuator::move_tendons(ActuatorState& s, const Start& start) const noexcept {
  const std::array<double, 2>& w = s.spring_w;
  s.ledger.tendon_bristle = 0;
  for (int i = 0; i < params_.transmission->spring_count(); ++i) {
    const drive::FrictionStep step = drive::follow_friction(tendon_, start.w_u[i], w[i] - start.w[i]);
    s.ledger.tendon_friction += drive::friction_heat(tendon_, start.w_u[i], step);
    s.tendon_anchor[i] += step.anchor_travel;
    s.ledger.tendon_bristle += drive::bristle_energy(tendon_, w[i] - s.tendon_anchor[i]);
  }
}

Actuator::Pulleys Actuator::solve(const ActuatorState& s, const Start& start, const drive::MotorStepper& stepper,
                                  const SegmentInput& in) const noexcept {
  const double c = stepper.compliance();
  const elastic::Positions from = positions(s, s.shaft);
  std::array<double, 2> free{};
  const std::array<double, 2>& u = start.gear_u;
  Pulleys p;
  for (int i = 0; i < motors_; ++i) {
    free[i] = stepper.free_displacement(s.motor[i], in.voltage[i]);
    p.dx[i] = drive::solve_friction(start.gear[i], u[i], free[i] + c * s.load[i], c).displacement;
  }
  double last_residual = std::numeric_limits<double>::infinity();
  std::array<double, 2> last_dx = p.dx;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const elastic::Positions to{from.q + in.dq, {from.x[0] + p.dx[0], from.x[1] + p.dx[1]}};
    p.mean = params_.transmission->mean_over(from, to);
    if (tendon_.coulomb_Nm > 0) add_tendon_friction(start, to, {in.dq - p.dx[0], in.dq - p.dx[1]}, p.mean);
    p.slope = p.mean.slope.qq;
    std::array<double, 2> step{};
    double residual = 0;
    bool accepted = true;
    for (int i = 0; i < motors_; ++i) {
      // load(dx) ≈ load − κ·step; κ > −1/(2c) keeps the linear problem monotone where a law isn't convex.
      const double kappa = std::max(load_curvature(p.mean.slope, i), -0.5 / c);
      const double yield = 1.0 / (1.0 + c * kappa);
      const double target = (free[i] + c * (p.mean.load[i] + kappa * p.dx[i])) * yield;
      p.friction[i] = drive::solve_friction(start.gear[i], u[i], target, c * yield);
      step[i] = p.friction[i].displacement - p.dx[i];
      residual = std::max(residual, std::abs(step[i]));
      accepted = accepted && std::abs(kappa * step[i]) <= kRelativeTolerance * std::abs(p.mean.load[i]) + kAbsoluteTolerance_Nm;
      const double bristle = p.friction[i].anchor_travel != 0.0 ? 0.0 : 0.5 * start.gear[i].stiffness;
      p.slope -= p.mean.slope.qx[i] * p.mean.slope.qx[i] * c * yield / (1.0 + c * yield * bristle);
    }
    if (accepted || iteration + 1 == kMaxIterations) {
      for (int i = 0; i < 2; ++i) p.dx[i] += step[i];
      correct(p.mean, step);
      return p;
    }
    // A hardening spring can throw Newton far out; halve until the correction shrinks.
    const bool worse = !(residual < last_residual);
    for (int i = 0; i < 2; ++i) {
      const double next = worse ? 0.5 * (p.dx[i] + last_dx[i]) : p.dx[i] + step[i];
      if (!worse) last_dx[i] = p.dx[i];
      p.dx[i] = next;
    }
    if (!worse) last_residual = residual;
  }
  return p;
}

void Actuator::drive_motors(ActuatorState& s, const Start& start, const drive::MotorStepper& stepper, const SegmentInput& in,
                            const Pulleys& p) const noexcept {
  Ledger& l = s.ledger;
  for (int i = 0; i < motors_; ++i) {
    drive::MotorState& m = s.motor[i];
    const double voltage = in.terminal == drive::Terminal::driven ? in.voltage[i] : 0.0;
    if (in.terminal == drive::Terminal::open && motor_.inductance_H) {
      l.copper += 0.5 * *motor_.inductance_H * m.current * m.current;  // an opened winding burns what it stored
      m.current = 0;
    }
    const drive::MotorStep step = stepper.step(m, voltage, p.mean.load[i] + p.friction[i].torque);
    l.motor_friction += drive::friction_heat(start.gear[i], start.gear_u[i], p.friction[i]);
    l.supply += voltage * step.charge;
    l.supply_moved += std::abs(voltage * step.charge);
    l.copper += motor_.resistance_Ohm * step.int_II;
    l.conversion += (motor_.back_emf_Vs_per_rad - motor_.torque_constant_Nm_per_A) * step.int_Iw;
    l.viscous += motor_.viscous_Nms_per_rad * step.int_ww;
    m.angle += step.displacement;
    m.speed = step.speed;
    m.current = motor_.inductance_H ? step.current : 0.0;
    s.motor_anchor[i] += p.friction[i].anchor_travel;
    s.load[i] = p.mean.load[i];
  }
}

SegmentResult Actuator::segment(ActuatorState& s, double h_s, const SegmentInput& in) noexcept {
  const drive::MotorStepper& prepared = stepper(h_s, in.terminal);
  const Start start = start_of(s);
  const Pulleys p = solve(s, start, prepared, in);
  const std::array<double, 2> before{s.motor[0].angle, s.motor[1].angle};
  const double before_J = s.ledger.elastic + s.ledger.tendon_bristle + s.ledger.tendon_friction;
  drive_motors(s, start, prepared, in, p);
  s.shaft += in.dq;
  const double elastic = energy_at(s, s.shaft);
  double work = p.mean.torque * in.dq;
  for (int i = 0; i < motors_; ++i) work += p.mean.load[i] * (s.motor[i].angle - before[i]);
  if (tendon_.coulomb_Nm > 0) move_tendons(s, start);
  s.ledger.elastic = elastic;
  s.ledger.integrator -= (elastic + s.ledger.tendon_bristle + s.ledger.tendon_friction - before_J) + work;
  book_motors(s);
  return {p.mean.torque, p.slope};
}

drive::FrictionStep Actuator::shaft_friction(ActuatorState& s, double displacement) const noexcept {
  // The segments have moved state.shaft already: the friction's own start is behind it.
  const double u = s.shaft - displacement - s.shaft_anchor;
  const drive::FrictionStep step = drive::follow_friction(shaft_friction_, u, displacement);
  s.ledger.shaft_friction += drive::friction_heat(shaft_friction_, u, step);
  s.shaft_anchor += step.anchor_travel;
  s.ledger.shaft_bristle = drive::bristle_energy(shaft_friction_, s.shaft - s.shaft_anchor);
  return step;
}

void Actuator::settle(ActuatorState& s, double actual, double applied_torque, double actual_dy, double path_work) const noexcept {
  Ledger& l = s.ledger;
  const double predicted = l.elastic + l.shaft_bristle + l.tendon_bristle;
  s.shaft = actual;
  if (params_.shaft_friction.presliding_rad > 0) {
    const double z = params_.shaft_friction.presliding_rad;
    s.shaft_anchor = actual - std::clamp(actual - s.shaft_anchor, -z, z);
  } else {
    s.shaft_anchor = actual;
  }
  l.elastic = energy_at(s, actual);
  l.shaft_bristle = drive::bristle_energy(shaft_friction_, s.shaft - s.shaft_anchor);
  if (tendon_.coulomb_Nm > 0) {
    const std::array<double, 2>& w = s.spring_w;
    l.tendon_bristle = 0;
    for (int i = 0; i < params_.transmission->spring_count(); ++i) {
      const double u = std::clamp(w[i] - s.tendon_anchor[i], -tendon_.presliding_rad, tendon_.presliding_rad);
      s.tendon_anchor[i] = w[i] - u;
      l.tendon_bristle += drive::bristle_energy(tendon_, u);
    }
  }
  const double work = applied_torque * actual_dy;
  l.coupling += (predicted - (l.elastic + l.shaft_bristle + l.tendon_bristle)) - (work - path_work);
  l.delivered += work;
  l.pending = 0;
  l.delivered_moved += std::abs(work);
}

elastic::Response Actuator::spring(const ActuatorState& s, double shaft) const noexcept {
  return params_.transmission->evaluate(positions(s, shaft));
}

double Actuator::motor_current(const ActuatorState& s, int i, double voltage, drive::Terminal terminal) const noexcept {
  return drive::current(motor_, terminal, s.motor[i], voltage);
}

}  // namespace vsa::actuator
