// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/actuator/actuator.hpp"

#include <utility>

#include "vsa/actuator/actuator_lanes.hpp"

namespace vsa::actuator {

Actuator::Side::Side(const SideParams& p) noexcept
    : motor(drive::at_pulley(p.motor, p.gearbox.ratio)),
      friction(drive::at_pulley(p.gearbox.friction, p.gearbox.ratio)),
      load_loss(p.gearbox.load_loss),
      back_loss(p.gearbox.back_loss.value_or(p.gearbox.load_loss)),
      bridge(p.bridge),
      winding_Ohm(motor.resistance_Ohm),
      winding_H(motor.inductance_H.value_or(0.0)),
      chopped(p.bridge.pin == drive::PwmPin::enable) {
  if (chopped) {
    motor.inductance_H.reset();  // it shapes the current within a period, whose mean follows the speed at once
  } else {
    motor.resistance_Ohm += bridge.switch_Ohm;
  }
}

Actuator::Actuator(ActuatorParams params)
    : params_(std::move(params)),
      two_sinh_(dynamic_cast<const elastic::TwoSinh*>(params_.transmission.get())),
      sides_{Side(params_.side[0]), Side(params_.side[params_.sides() - 1])},
      shaft_friction_(actuator::shaft_friction(params_)),
      tendon_(drive::FrictionParams{params_.tendon.friction, params_.tendon.presliding_J}),
      motors_(params_.transmission->motor_count()),
      springs_(params_.transmission->spring_count()),
      alike_(motors_ == 2 && plain(sides_[0]) && plain(sides_[1])),
      steppers_of_{0, sides_[0].motor == sides_[1].motor ? std::size_t{0} : std::size_t{1}} {}

void Actuator::prepare(std::size_t of, double h_s) noexcept {
  auto& [first, second] = prepared_[of];
  std::swap(first, second);
  if (first.h_s == h_s) return;
  const drive::MotorParams& motor = sides_[of].motor;
  first = {h_s, {motor, drive::Terminal::driven, h_s}, {motor, drive::Terminal::open, h_s}};
}

bool Actuator::plain(const Side& s) noexcept { return s.friction.stiffness > 0 && !s.chopped && !s.motor.inductance_H; }

bool Actuator::has_lanes() const noexcept {
  const auto side = [](const Side& s) {
    const bool smooth = s.friction.coulomb_Nm <= 0 && s.load_loss == 0 && s.back_loss == 0;
    return plain(s) || (smooth && !s.chopped && !s.motor.inductance_H);
  };
  return two_sinh_ != nullptr && side(sides_[0]) && side(sides_[1]);
}

SegmentResult Actuator::segment(ActuatorState& s, double h_s, const SegmentInput& in) noexcept {
  Segment seg;
  begin(s, seg, h_s, in);
  const SegmentResult result = attempt(s, seg, in.dq);
  finish(s, seg);
  return result;
}

template void Actuator::begin(ActuatorState&, Segment&, double, const SegmentInput&) noexcept;
template SegmentResult Actuator::foresee(const ActuatorState&, Segment&) const noexcept;
template SegmentResult Actuator::attempt(const ActuatorState&, Segment&, double, bool, bool) const noexcept;
template void Actuator::finish(ActuatorState&, const Segment&) const noexcept;
template drive::FrictionStep Actuator::shaft_friction(ActuatorState&, double, double, double) const noexcept;
template void Actuator::settle(ActuatorState&, double, double, double, double) const noexcept;
template elastic::Tangent Actuator::tangent(const ActuatorState&) const noexcept;

double Actuator::swing_squared(const ActuatorState& s, double dt_s) const noexcept {
  elastic::SegmentMean mean;
  mean_from<double>(s.origin, s.origin.at, 0.0, mean);
  const elastic::Hessian& half = mean.slope;  // slopes are for a segment's end
  double most = 0;
  for (int i = 0; i < motors<double>(); ++i) most = std::max(most, 2.0 * half.xx[i] * dt_s * dt_s / sides_[i].motor.inertia_kgm2);
  return most;
}

}  // namespace vsa::actuator
