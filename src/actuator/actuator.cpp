// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/actuator/actuator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vsa/actuator/actuator_lanes.hpp"

namespace vsa::actuator {

drive::FrictionParams shaft_friction(const ActuatorParams& params) noexcept {
  drive::FrictionParams p = params.shaft_friction;
  if (p.coulomb_Nm > 0) p.presliding_rad = std::max(p.presliding_rad, kLeastPresliding_rad);
  return p;
}

Actuator::Actuator(ActuatorParams params)
    : params_(std::move(params)),
      two_sinh_(dynamic_cast<const elastic::TwoSinh*>(params_.transmission.get())),
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

const drive::MotorStepper& Actuator::stepper(double h_s, drive::Terminal terminal) noexcept {
  if (prepared_[0].h_s != h_s) {
    std::swap(prepared_[0], prepared_[1]);
    if (prepared_[0].h_s != h_s) {
      prepared_[0] = {h_s, {motor_, drive::Terminal::driven, h_s}, {motor_, drive::Terminal::open, h_s}};
    }
  }
  return terminal == drive::Terminal::driven ? prepared_[0].driven : prepared_[0].open;
}

bool Actuator::has_lanes() const noexcept {
  const bool gears = friction_.stiffness > 0 || (friction_.coulomb_Nm <= 0 && params_.gearbox.load_loss == 0 && back_loss_ == 0);
  return two_sinh_ != nullptr && gears && !chopped_ && !motor_.inductance_H;
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

}  // namespace vsa::actuator
