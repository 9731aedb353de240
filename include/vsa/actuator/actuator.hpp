// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The physics of one unit: two motors with their gearboxes, the elastic transmission, the output shaft's friction.
//
// A segment is a piece of a host step with constant terminal voltages, along which the shaft moves straight from q₀ to q₁. Its
// unknowns are the pulleys' displacements:
//     Δx_i = free_i + c_i (load̄_i(Δq, Δx) + f̄_i(Δx_i))
// free_i and c_i come from the motor's exact step (drive/motor.hpp), load̄ from the law's segment mean, f̄ from the friction's closed
// form. Newton on the law, friction exact in each iteration; for a convex potential the solution is unique.
//
// TENDON FRICTION, proportional to each spring's tension T_i, in the coordinate of the spring's energy:
//     w_i = sign(δ_i) H_i,   ∂w_i/∂q = |T_i|
// There a loss μ|T| is a friction of constant level μ, so Hayward's and Armstrong's law (drive/friction.hpp) holds with "angle" w,
// "torque" μ and presliding w_max: shaft torque −μ s |T_i|, pulley load +μ s |T_i|, s = (w_i − z_i)/w_max within ±1. It is passive
// in every branch as that law is: presliding stores ½(μ/w_max)(w − z)², sliding burns μ|T| per rad. Range: 0 ≤ μ < 1.
// The bristle has a damper of the time constant T_d: s = (w − z + T_d ẇ)/w_max within ±1. That only ever burns more, by
// (μ/w_max)(clamp(u + T_d ẇ) − u)ẇ ≥ 0, and nothing where the motion is slow. Without it a bent bristle is a spring that rings.
//
// GEAR LOSS: the limit of the gearbox's friction grows by λ·|load_i| of the last segment, with another λ where motor and load
// together would turn the pulley the load's way (the load drives the motor back) than where the motor drives the load. Its
// bristle's stiffness stays, so a growing limit adds no energy, and one that shrinks burns what it lets go.
//
// States: pulley angle, speed, current (2 each), friction anchors (5), shaft position of the last segment's end, energy ledger.
#pragma once

#include <array>
#include <memory>

#include "vsa/actuator/ledger.hpp"
#include "vsa/drive/bridge.hpp"
#include "vsa/drive/droop_stepper.hpp"
#include "vsa/drive/motor.hpp"
#include "vsa/drive/pwm_cycle.hpp"
#include "vsa/elastic/transmission.hpp"
#include "vsa/sensor/sensors.hpp"

namespace vsa::actuator {

/// Friction proportional to the springs' tension, in the energy's own coordinate (see the top of this file).
struct TendonParams {
  double friction = 0;      ///< μ, loss torque a spring torque, [0, 1)
  double presliding_J = 0;  ///< w_max: how much a spring's energy changes before that friction slides, ≥ 0
  double damping_s = 0;     ///< T_d: the bristle's damper over its stiffness, ≥ 0
  bool operator==(const TendonParams&) const = default;
};

struct ActuatorParams {
  std::shared_ptr<const elastic::Transmission> transmission;
  drive::MotorParams motor;  ///< at the motor's shaft; both motors alike
  drive::GearboxParams gearbox;
  drive::BridgeParams bridge;
  drive::FrictionParams shaft_friction;
  TendonParams tendon;
  sensor::EncoderParams encoder;                ///< all three alike
  double shaft_zero_rad = 0;                    ///< and this added to the shaft's reading
  double shaft_inertia_kgm2 = drive::kMissing;  ///< used as 1/A where a host can't tell the inverse inertia
  bool operator==(const ActuatorParams&) const = default;
};

/// The output shaft's friction as the coupling needs it: with a bristle. A presliding of 0 is taken as kLeastPresliding_rad, a
/// hundredth of an encoder's count or less, so that what holds the shaft has a slope.
inline constexpr double kLeastPresliding_rad = 1e-5;
[[nodiscard]] drive::FrictionParams shaft_friction(const ActuatorParams& params) noexcept;

/// How the tendons' frictions on the shaft answer: −dτ/d(x_i) and −dτ/d(Δy) of each, N·m/rad, and the dampers' part of the first.
struct Rub {
  std::array<double, 2> dx{}, dy{}, damping{};
};

struct ActuatorState {
  std::array<drive::MotorState, 2> motor{};
  std::array<double, 2> motor_anchor{};
  double shaft = 0;  ///< y, end of the last segment's path
  double shaft_anchor = 0;
  std::array<double, 2> tendon_anchor{};  ///< z_w of each spring's friction, J
  std::array<double, 2> spring_w{};       ///< the springs' signed energies now, J; where there is tendon friction
  std::array<double, 2> load{};           ///< mean spring load on each pulley over the last segment
  elastic::Origin origin;                 ///< where the springs are: pulleys' angles and `shaft`
  elastic::SegmentMean end;  ///< torque and loads at the last segment's end if all stood still there, to first order; its slopes
  Rub end_rub;               ///< the part of those slopes that is the tendons' friction
  Ledger ledger;
};

/// Where a segment lies in its host step, and how far ahead its springs and frictions look (the blend of host/robot.hpp). The
/// default is a segment by itself, taken in its middle.
struct Lead {
  double before = 0, share = 1;    ///< parts of the step's displacement Δy: made before the segment, made in it
  double drift = 0;                ///< ½ dt v, rad
  double spring = 0;               ///< w of the springs, 0 … 1
  std::array<double, 2> tendon{};  ///< w of each tendon's friction, 0 … 1
};

/// w of a spring or friction that swings with x = ω·dt: 0 up to a quarter, where a step resolves it, then towards 1:
///   w = (x⁴ − 4⁻⁴)/(16 + x⁴)
[[nodiscard]] inline double lead_weight(double x_squared) noexcept {
  constexpr double kResolved = 1.0 / 256;
  const double x4 = x_squared * x_squared;
  return x4 > kResolved ? (x4 - kResolved) / (16.0 + x4) : 0.0;
}

struct SegmentInput {
  double dq = 0;  ///< shaft displacement along the path
  std::array<double, 2> voltage{};
  std::array<drive::Terminal, 2> terminal{drive::Terminal::driven, drive::Terminal::driven};
  Lead lead{};
  double supply_V = 0;  ///< counts where the bridge's enable pin is modulated, by a duty of voltage/supply; 0: no current
};

struct SegmentResult {
  double torque = 0;    ///< mean torque of the transmission on the shaft
  double slope = 0;     ///< −dτ̄/d(Δy) of the step's displacement, the motors' yielding included; ≥ 0 for a convex law
  bool settled = true;  ///< the motors' displacements are found; else they are one Newton round nearer
  /// Δy may be this far from here, rad, and the slope still tells the torque to 5e-6 of the springs' loads; 0: not known
  double straight = 0;
};

/// A segment while it is solved: begun once, tried for as many shaft displacements as its owner needs, finished once.
class Segment {
 private:
  friend class Actuator;
  /// A motor on a bridge whose enable pin is modulated: its current as a straight line about the speed `aim`.
  struct Pwm {
    const drive::PwmCycle* cycle = nullptr;  // none: terminals at a mean voltage, or open
    drive::DroopStepper stepper;
    double start = 0, aim = 0, current_at_rest = 0, h = 0;
  };
  std::array<const drive::MotorStepper*, 2> stepper{};
  std::array<Pwm, 2> pwm{};
  SegmentInput in;
  bool tried = false;
  // what the frictions see at the start
  std::array<drive::Friction, 2> gear{drive::FrictionParams{}, drive::FrictionParams{}};
  std::array<double, 2> gear_u{};
  std::array<double, 2> w{}, w_u{};  // the springs' signed energies, and their distance from the anchors
  std::array<double, 2> free{};      // the motors' displacements without load
  std::array<double, 2> give{};      // and what a torque adds to them, rad/(N·m)
  double damping = 0;                // T_d/h of the tendons' bristles
  double own = 1, whole = 1;         // how far the springs' end moves with the step's Δy: by the segment, and in all
  // what the last trial found
  std::array<double, 2> dx{};    // the pulleys' displacements
  std::array<double, 2> gain{};  // ∂dx/∂dq
  std::array<drive::FrictionStep, 2> friction{};
  elastic::SegmentMean mean;
  Rub rub;                           // of the tendons: their part of mean.slope, and what they give for the step's Δy
  std::array<double, 2> straight{};  // change of a spring's deflection until its tendon's bristle begins or ends to slide
  double slope = 0;

  /// w·(q' − middle of the path): by how much the springs look ahead.
  [[nodiscard]] double shift(double dq) const noexcept {
    return in.lead.spring > 0 ? in.lead.spring * (1.5 * dq / in.lead.share - in.lead.drift) : 0.0;
  }
};

/// Parameters at the pulley and the prepared motor steps. Immutable but for prepare(); a state belongs to whoever owns time.
class Actuator {
 public:
  explicit Actuator(ActuatorParams params);

  [[nodiscard]] const ActuatorParams& params() const noexcept { return params_; }
  [[nodiscard]] ActuatorState initial(const std::array<double, 2>& pulleys, double shaft) const noexcept;

  /// Puts the shaft somewhere without work, friction relaxed: before the first step only. The ledger begins here.
  void place(ActuatorState& state, double shaft) const noexcept;

  /// One segment of length h; advances motors, anchors and ledger, and moves state.shaft by dq. No allocation, no exception.
  SegmentResult segment(ActuatorState& state, double h_s, const SegmentInput& in) noexcept;

  /// The same in three parts. Until `finish` nothing else may be done
  /// with the state or begun on this actuator.
  void begin(ActuatorState& state, Segment& segment, double h_s, const SegmentInput& in) noexcept;
  /// The torque over the segment for dq = 0 and its slope, extrapolated from the last segment without a call of the law. The first
  /// attempt begins there.
  SegmentResult foresee(const ActuatorState& state, Segment& segment) const noexcept;
  /// `rough`: one round only, for an owner who will try another dq anyway.
  SegmentResult attempt(const ActuatorState& state, Segment& segment, double dq, bool rough = false) const noexcept;
  void finish(ActuatorState& state, const Segment& segment) const noexcept;

  /// Shaft friction over a whole host step along the predicted path; moves its anchor and books its heat. `lead` as of a segment
  /// that is the whole step, `weight` the friction's own w.
  drive::FrictionStep shaft_friction(ActuatorState& state, double displacement, double drift = 0, double weight = 0) const noexcept;

  /// The host moved the shaft to `actual` where the unit had predicted state.shaft. Books the difference:
  ///   coupling += (H + B)(predicted) − (H + B)(actual) − (τ_ret Δy_actual − τ_path Δy_path)
  /// and delivered += τ_ret Δy_actual. τ_ret is the torque that the host applied, τ_path Δy_path the work the segments booked.
  void settle(ActuatorState& state, double actual, double applied_torque, double actual_dy, double path_work) const noexcept;

  /// Somebody put the shaft elsewhere: the springs follow, and what is stored from now on is what the balance begins with.
  void relocate(ActuatorState& state, double shaft) const noexcept;

  [[nodiscard]] elastic::Response spring(const ActuatorState& state, double shaft) const noexcept;
  /// The springs' response with the torques of the frictions on the shaft's side: what acts if the shaft is there.
  [[nodiscard]] elastic::Response response(const ActuatorState& state, double shaft) const noexcept;
  [[nodiscard]] double motor_current(const ActuatorState& state, int i, double voltage, drive::Terminal terminal,
                                     double supply_V = 0) const noexcept;
  [[nodiscard]] int motors() const noexcept { return motors_; }

 private:
  struct Prepared {
    double h_s = 0;
    drive::MotorStepper driven, open;
  };
  const drive::MotorStepper& stepper(double h_s, drive::Terminal terminal) noexcept;
  const drive::PwmCycle& cycle(int i, const drive::PwmHold& hold) noexcept;
  [[nodiscard]] drive::PwmCycle new_cycle(const drive::PwmHold& hold) const noexcept;
  void begin_pwm(Segment& segment, int i, double speed, double h_s) noexcept;
  /// The line of a PWM motor's current about a mean speed, and what follows from it.
  void aim(Segment& segment, int i, double speed) const noexcept;
  /// The same where the last displacement found is that of another speed.
  void follow(Segment& segment, int i) const noexcept;
  drive::MotorStep pwm_step(Ledger& ledger, const Segment::Pwm& pwm, double torque) const noexcept;
  [[nodiscard]] double pwm_current(const drive::MotorState& motor, int i, drive::Terminal terminal,
                                   const drive::PwmHold& hold) const noexcept;
  void add_tendon_friction(Segment& segment, const elastic::Positions& to) const noexcept;
  void move_tendons(ActuatorState& state, const Segment& segment) const noexcept;
  /// One Newton correction of the pulleys from the mean at segment.dx; returns whether it was small enough to be the last.
  bool correction(Segment& segment, std::array<double, 2>& step) const noexcept;
  [[nodiscard]] double straight(const Segment& segment, int i) const noexcept;
  void drive_motors(ActuatorState& state, const Segment& segment) const noexcept;
  /// −dτ̄/d(Δy) and the pulleys' gains from a mean's slopes; seg.gain comes as each pulley's own give, ∂x_i/∂load_i.
  void slopes(Segment& segment, const elastic::SegmentMean& mean, const Rub& rub) const noexcept;
  [[nodiscard]] elastic::Positions positions(const ActuatorState& state, double shaft) const noexcept;
  void book_motors(ActuatorState& state) const noexcept;
  /// The springs and the frictions on the shaft's side where the shaft is; anchors that it left behind follow.
  void move_shaft(ActuatorState& state, double shaft) const noexcept;
  /// Moves the origin there and gives H; where there is tendon friction the springs' signed energies are kept too.
  [[nodiscard]] double energy_at(ActuatorState& state, double shaft) const noexcept;

  ActuatorParams params_;
  drive::MotorParams motor_;  // at the pulley
  drive::Friction friction_;  // at the pulley
  drive::Friction shaft_friction_;
  drive::Friction tendon_;  // in the energy's coordinate: "torque" μ, "angle" J
  int motors_, springs_;
  std::array<Prepared, 2> prepared_{};  // the two step lengths used last
  bool chopped_;                        // the bridge's enable pin is modulated
  double back_loss_;
  double winding_Ohm_, winding_H_;  // motor_ has the switches' resistance, too, and no inductance where chopped
  std::array<std::array<drive::PwmCycle, 2>, 2> cycles_{};  // of each motor, the two used last
};

}  // namespace vsa::actuator
