// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a segment is told, what it finds, and what it is while it is solved (actuator.hpp), for one unit or several side by side.
#pragma once

#include <algorithm>
#include <array>
#include <type_traits>

#include "vsa/drive/droop_stepper.hpp"
#include "vsa/drive/motor.hpp"
#include "vsa/drive/pwm_cycle.hpp"
#include "vsa/elastic/transmission.hpp"

namespace vsa::actuator {

class Actuator;

/// How the tendons' frictions on the shaft answer: −dτ/d(x_i) and −dτ/d(Δy) of each, N·m/rad, and the dampers' part of the first.
template <class T>
struct RubOf {
  std::array<T, 2> dx{},  ///< by x_i, N·m/rad
      dy{},               ///< by the step's Δy, N·m/rad
      damping{};          ///< the dampers' part of `dx`, N·m/rad
  static auto fields(auto& s, auto&& visit) {
    return visit("dx", "N·m/rad", s.dx, "dy", "N·m/rad", s.dy, "damping", "N·m/rad", s.damping);
  }
};

using Rub = RubOf<double>;  ///< of one unit

/// Where a segment lies in its host step, and how far ahead its springs and frictions look (the blend of host/robot.hpp). The
/// default is a segment by itself, taken in its middle.
template <class T>
struct LeadOf {
  double before = 0,          ///< part of the step's displacement Δy that was made before the segment
      share = 1;              ///< part that is made in it
  T drift = 0;                ///< ½ dt v, rad
  T spring = 0;               ///< w of the springs, 0 … 1
  std::array<T, 2> tendon{};  ///< w of each tendon's friction, 0 … 1
  // Where a step is several segments and resolves neither the shaft's swing nor the motors':
  double motors = 0;             ///< w of the motors: how far springs see the step's middle in every segment, 0 … 1
  std::array<double, 2> gone{};  ///< of each motor, since the step began, rad

  LeadOf() = default;
  LeadOf(const LeadOf& o) noexcept { *this = o; }  ///< number by number
  /// Number by number: a copy of the whole would wait for numbers that were stored one by one just before.
  LeadOf& operator=(const LeadOf& o) noexcept {
    before = o.before;
    share = o.share;
    drift = o.drift;
    spring = o.spring;
    for (std::size_t i = 0; i < 2; ++i) tendon[i] = o.tendon[i];
    motors = o.motors;
    for (std::size_t i = 0; i < 2; ++i) gone[i] = o.gone[i];
    return *this;
  }
};
using Lead = LeadOf<double>;  ///< of one unit

/// w of a spring or friction that swings with x = ω·dt: 0 up to a quarter, where a step resolves it, then towards 1:
///   w = (x⁴ − 4⁻⁴)/(16 + x⁴)
template <class T>
[[nodiscard]] T lead_weight(T x_squared) noexcept {
  constexpr double kResolved = 1.0 / 256;
  const T x4 = x_squared * x_squared;
  const lanes::Truth<T> leads = x4 > kResolved;
  return lanes::any(leads) ? lanes::where<T>(leads, (x4 - kResolved) / (16.0 + x4)) : T(0.0);
}

/// w of a motor that swings with θ = ω·dt on its spring, its shaft held, in a step of several segments: 0 up to 2, 1 from 3 on. From π on
/// a motor that went its way from segment to segment would lead a light shaft astray, which is one step behind it.
[[nodiscard]] inline double motor_weight(double theta_squared) noexcept {
  return std::clamp((theta_squared - 4.0) / 5.0, 0.0, 1.0);
}

/// What acts in a segment: the shaft's way and the motors' terminals, whose voltages are constant in it.
template <class T>
struct SegmentInputOf {
  T dq = 0;                    ///< shaft displacement along the path
  std::array<T, 2> voltage{};  ///< of each motor, V: its mean over the PWM
  std::array<drive::Terminal, 2> terminal{drive::Terminal::driven, drive::Terminal::driven};  ///< of each motor
  LeadOf<T> lead{};     ///< where it lies in its step, and how far ahead it looks
  double supply_V = 0;  ///< counts where the bridge's enable pin is modulated, by a duty of voltage/supply; 0: no current
};
using SegmentInput = SegmentInputOf<double>;  ///< of one unit

/// What a trial finds for its dq: the transmission's mean torque on the shaft, and how it changes with the step's Δy.
template <class T>
struct SegmentResultOf {
  T torque = 0;  ///< mean torque of the transmission on the shaft
  T slope = 0;   ///< −dτ̄/d(Δy) of the step's displacement, the motors' yielding included; ≥ 0 for a convex law
  lanes::Truth<T> settled = lanes::truth<T>(true);  ///< the motors' displacements are found; else they are one Newton round nearer
  /// Δy may be this far from here, rad, and the slope still tells the torque to 5e-6 of the springs' loads; 0: not known
  T straight = 0;
};
using SegmentResult = SegmentResultOf<double>;  ///< of one unit

/// A motor on a bridge whose enable pin is modulated: its current as a straight line about the speed `aim`.
struct PwmInSegment {
  const drive::PwmCycle* cycle = nullptr;  ///< none: terminals at a mean voltage, or open
  drive::DroopStepper stepper;             ///< at that line
  double start = 0,                        ///< speed at the segment's start, rad/s
      aim = 0,                             ///< where the line touches, rad/s
      current_at_rest = 0,                 ///< of the line, A
      h = 0;                               ///< length of the segment, s
};
/// Instead of it in lanes, which have no such motors.
struct NoPwm {};
/// What one unit has no need of.
struct Nothing {};

/// A segment while it is solved: begun once, tried for as many shaft displacements as its owner needs, finished once.
template <class T>
class SegmentOf {
 private:
  friend class Actuator;
  /// What a trial finds.
  struct Trial {
    T dq = 0;                 // for this displacement of the shaft
    std::array<T, 2> dx{};    // the pulleys' displacements
    std::array<T, 2> gain{};  // ∂dx/∂dq
    std::array<drive::FrictionStepOf<T>, 2> friction{};
    elastic::SegmentMeanOf<T> mean;
    RubOf<T> rub;                   // of the tendons: their part of mean.slope, and what they give for the step's Δy
    std::array<T, 2> straight_J{};  // change of a spring's energy until its tendon's bristle begins or ends to slide
    std::array<T, 2> tension{};     // at the end, > 0
    std::array<T, 2> stick{};       // what a tendon that holds adds to its spring's slope, at most
    T slope = 0;
    static auto fields(auto& s, auto&& visit) {
      return visit(s.dq, s.dx, s.gain, s.friction[0].displacement, s.friction[0].torque, s.friction[0].anchor_travel,
                   s.friction[1].displacement, s.friction[1].torque, s.friction[1].anchor_travel, s.mean.torque, s.mean.load,
                   s.mean.slope.qq, s.mean.slope.qx, s.mean.slope.xx, s.mean.slope.x0x1, s.rub.dx, s.rub.dy, s.rub.damping,
                   s.straight_J, s.tension, s.stick, s.slope);
    }
  };
  std::array<const drive::MotorStepper*, 2> stepper{};
  std::array<std::conditional_t<lanes::kScalar<T>, PwmInSegment, NoPwm>, 2> pwm{};
  SegmentInputOf<T> in;
  bool tried = false;
  // what the frictions see at the start
  std::array<T, 2> gear_Nm{}, gear_rad{};  // the gears' friction under the load
  std::array<T, 2> gear_u{};
  std::array<T, 2> w{}, w_u{};   // the springs' signed energies, and their distance from the anchors
  std::array<T, 2> free{};       // the motors' displacements without load
  std::array<double, 2> give{};  // and what a torque adds to them, rad/(N·m)
  double damping = 0;            // T_d/h of the tendons' bristles
  T whole = 1, per_own = 1;      // how far the springs' end moves with the step's Δy, and by the segment, of its share
  double per_share = 1;
  // Lead::motors: the middle that the springs see is so much further: of the shaft by ramp/2 of Δy, of a motor by spread/2 of its own
  // displacement and lag.
  double ramp = 0, spread = 0;
  std::array<double, 2> lag{};
  Trial found;                                                                        // by the last trial
  [[no_unique_address]] std::conditional_t<lanes::kScalar<T>, Nothing, Trial> apart;  // by one of some lanes

  /// w·(q' − middle of the path): by how much the springs look ahead.
  [[nodiscard]] T shift(T dq) const noexcept {
    if constexpr (lanes::kScalar<T>) {
      if (sees_middle()) return in.lead.spring * (1.5 * dq * per_share - in.lead.drift) + 0.5 * ramp * dq * per_share;
    }
    const lanes::Truth<T> leads = in.lead.spring > 0.0;
    if (!lanes::any(leads)) return 0.0;
    return lanes::where<T>(leads, in.lead.spring * (1.5 * dq * per_share - in.lead.drift));
  }
  [[nodiscard]] bool sees_middle() const noexcept { return in.lead.motors > 0; }
  [[nodiscard]] bool chopped(int i) const noexcept {
    if constexpr (lanes::kScalar<T>) return pwm[i].cycle != nullptr;
    return false;
  }
};
using Segment = SegmentOf<double>;  ///< of one unit

}  // namespace vsa::actuator
