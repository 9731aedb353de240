// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Motors on a bridge whose enable pin is modulated: the current falls with the speed in branches. A segment takes the branch's
// straight line at its mean speed (found by the same Newton rounds as the springs) and its motor's step is exact for that line.
//
// What the ledger gets is the circuit's heat at the mean speed, plus K_b g ∫(ω − ω̄)² in the winding for the swing about it. The
// supply gives heat and K_b∫Iω: passive whatever the line, and the circuit's own supply power to second order in what the line
// misses.
#include <algorithm>
#include <cmath>

#include "vsa/actuator/actuator.hpp"

namespace vsa::actuator {
namespace {

constexpr double kSameSpeed_rad_per_s = 1e-4;  // a line about a speed as near as this isn't drawn anew

}  // namespace

drive::PwmCycle Actuator::new_cycle(int i, const drive::PwmHold& hold) const noexcept {
  return {sides_[i].bridge, hold.supply_V, sides_[i].winding_Ohm, sides_[i].winding_H, hold.duty};
}

const drive::PwmCycle& Actuator::cycle(int i, const drive::PwmHold& hold) noexcept {
  auto& [first, second] = cycles_[i];
  const auto same = [&](const drive::PwmCycle& c) { return c.duty() == hold.duty && c.supply_V() == hold.supply_V; };
  if (!same(first)) {
    std::swap(first, second);
    if (!same(first)) first = new_cycle(i, hold);
  }
  return first;
}

void Actuator::begin_pwm(Segment& seg, int i, double speed, double h_s) noexcept {
  PwmInSegment& pwm = seg.pwm[i];
  pwm.cycle = &cycle(i, {seg.in.voltage[i] / seg.in.supply_V, seg.in.supply_V});
  pwm.start = speed;
  pwm.h = h_s;
  aim(seg, i, speed);
}

void Actuator::aim(Segment& seg, int i, double speed) const noexcept {
  PwmInSegment& pwm = seg.pwm[i];
  const drive::MotorParams& motor = sides_[i].motor;
  const drive::PwmMean mean = pwm.cycle->mean(motor.back_emf_Vs_per_rad * speed);
  const double droop = mean.conductance * motor.back_emf_Vs_per_rad;
  pwm.aim = speed;
  pwm.current_at_rest = mean.current + droop * speed;
  if (droop != pwm.stepper.droop_As_per_rad() || pwm.stepper.h_s() != pwm.h) pwm.stepper = {motor, droop, pwm.h};
  seg.free[i] = pwm.stepper.free_displacement(pwm.start, pwm.current_at_rest);
  seg.give[i] = pwm.stepper.compliance();
}

void Actuator::follow(Segment& seg, int i) const noexcept {
  const double speed = seg.found.dx[i] / seg.pwm[i].h;
  if (std::abs(speed - seg.pwm[i].aim) > kSameSpeed_rad_per_s) aim(seg, i, speed);
}

drive::MotorStep Actuator::pwm_step(Ledger& l, const Side& side, const PwmInSegment& pwm, double torque) const noexcept {
  const double emf_per_speed = side.motor.back_emf_Vs_per_rad;
  const drive::MotorStep step = pwm.stepper.step(pwm.start, pwm.current_at_rest, torque);
  const drive::PwmPower power = pwm.cycle->power(emf_per_speed * step.displacement / pwm.h);
  const double apart = pwm.stepper.spread(pwm.start, pwm.current_at_rest, torque);
  const double copper = pwm.h * power.winding + emf_per_speed * pwm.stepper.droop_As_per_rad() * apart;
  const double bridge = pwm.h * power.bridge, supply = copper + bridge + emf_per_speed * step.int_Iw;
  l.copper += copper;
  l.bridge += bridge;
  l.supply += supply;
  l.supply_moved += std::abs(supply);
  return step;
}

double Actuator::pwm_current(const drive::MotorState& motor, int i, drive::Terminal terminal,
                             const drive::PwmHold& hold) const noexcept {
  if (terminal == drive::Terminal::open || !(hold.supply_V > 0)) return 0.0;
  const double emf = sides_[i].motor.back_emf_Vs_per_rad * motor.speed;
  for (const drive::PwmCycle& known : cycles_[i])
    if (known.duty() == hold.duty && known.supply_V() == hold.supply_V) return known.mean(emf).current;
  return new_cycle(i, hold).mean(emf).current;
}

}  // namespace vsa::actuator
