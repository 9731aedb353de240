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

#include "vsa/actuator/ledger.hpp"
#include "vsa/actuator/params.hpp"
#include "vsa/actuator/segment.hpp"
#include "vsa/drive/droop_stepper.hpp"
#include "vsa/drive/pwm_cycle.hpp"
#include "vsa/elastic/two_sinh.hpp"

namespace vsa::actuator {

/// All that changes of an actuator. Copyable; a state belongs to whoever owns time, and goes on with actuators of equal parameters
/// only.
template <class T>
struct ActuatorStateOf {
  std::array<drive::MotorStateOf<T>, 2> motor{};  ///< the pulleys
  std::array<T, 2> motor_anchor{};                ///< z of each gearbox's friction, rad
  T shaft = 0;                                    ///< y, end of the last segment's path
  T shaft_anchor = 0;                             ///< z of the shaft's friction, rad
  std::array<T, 2> tendon_anchor{};               ///< z_w of each spring's friction, J
  std::array<T, 2> spring_w{};                    ///< the springs' signed energies now, J; where there is tendon friction
  std::array<T, 2> load{};                        ///< mean spring load on each pulley over the last segment
  elastic::OriginOf<T> origin;                    ///< where the springs are: pulleys' angles and `shaft`
  elastic::SegmentMeanOf<T>
      end;             ///< torque and loads at the last segment's end if all stood still there, to first order; its slopes
  RubOf<T> end_rub;    ///< the part of those slopes that is the tendons' friction
  LedgerOf<T> ledger;  ///< since the start
  static auto fields(auto& s, auto&& visit) {
    return visit("motor", "", s.motor, "motor_anchor", "rad", s.motor_anchor, "shaft", "rad", s.shaft, "shaft_anchor", "rad",
                 s.shaft_anchor, "tendon_anchor", "J", s.tendon_anchor, "spring_energy", "J", s.spring_w, "load", "N·m", s.load,
                 "origin", "", s.origin, "end", "", s.end, "end_rub", "", s.end_rub, "ledger", "", s.ledger);
  }
};
using ActuatorState = ActuatorStateOf<double>;  ///< of one unit

/// The physics of one unit: motors, gearboxes, springs and frictions, advanced a segment at a time. Holds parameters at the pulley,
/// and what was prepared for the step lengths and duties used last; that is all that changes in it, so it isn't for two threads at
/// once. A state belongs to whoever owns time.
class Actuator {
 public:
  explicit Actuator(ActuatorParams params);  ///< parameters that validate() passes; no check here

  [[nodiscard]] const ActuatorParams& params() const noexcept { return params_; }  ///< as given
  /// Pulleys (rad, rad/s) and shaft (rad) there, frictions relaxed; the ledger begins.
  [[nodiscard]] ActuatorState initial(const std::array<double, 2>& pulleys, double shaft,
                                      const std::array<double, 2>& pulley_speeds = {}) const noexcept;

  /// Puts the shaft somewhere without work, friction relaxed: before the first step only. The ledger begins here.
  void place(ActuatorState& state, double shaft) const noexcept;

  /// One segment of length h; advances motors, anchors and ledger, and moves state.shaft by dq. No allocation, no exception.
  SegmentResult segment(ActuatorState& state, double h_s, const SegmentInput& in) noexcept;

  /// Whether several units of these parameters may go side by side (vsa/lanes.hpp). They do while all their motors are driven.
  [[nodiscard]] bool has_lanes() const noexcept;

  /// Prepares a segment of length h: what motors and frictions see at its start. segment() in three parts, begin, attempt and finish,
  /// for one unit or several side by side. Until `finish` nothing else may be done with the state or begun on this actuator.
  template <class T>
  void begin(ActuatorStateOf<T>& state, SegmentOf<T>& segment, double h_s, const SegmentInputOf<T>& in) noexcept;
  /// The torque over the segment for dq = 0 and its slope, extrapolated from the last segment without a call of the law. The first
  /// attempt begins there.
  template <class T>
  SegmentResultOf<T> foresee(const ActuatorStateOf<T>& state, SegmentOf<T>& segment) const noexcept;
  /// `rough`: one round only, for an owner who will try another dq anyway. `which`: of several lanes, those that try; the others keep
  /// what they found.
  template <class T>
  SegmentResultOf<T> attempt(const ActuatorStateOf<T>& state, SegmentOf<T>& segment, T dq, bool rough = false,
                             lanes::Truth<T> which = lanes::truth<T>(true)) const noexcept;
  /// Ends the segment at its last attempt: moves motors, anchors, springs and state.shaft, and books the energies.
  template <class T>
  void finish(ActuatorStateOf<T>& state, const SegmentOf<T>& segment) const noexcept;

  /// Shaft friction over a whole host step along the predicted path; moves its anchor and books its heat. `lead` as of a segment
  /// that is the whole step, `weight` the friction's own w.
  template <class T>
  drive::FrictionStepOf<T> shaft_friction(ActuatorStateOf<T>& state, T displacement, T drift = 0.0, T weight = 0.0) const noexcept;

  /// The host moved the shaft to `actual` where the unit had predicted state.shaft. Books the difference:
  ///   coupling += (H + B)(predicted) − (H + B)(actual) − (τ_ret Δy_actual − τ_path Δy_path)
  /// and delivered += τ_ret Δy_actual. τ_ret is the torque that the host applied, τ_path Δy_path the work the segments booked.
  template <class T>
  void settle(ActuatorStateOf<T>& state, T actual, T applied_torque, T actual_dy, T path_work) const noexcept;

  /// The springs' own slope and tensions where they are.
  template <class T>
  [[nodiscard]] elastic::TangentOf<T> tangent(const ActuatorStateOf<T>& state) const noexcept;
  /// θ² = dt²·∂²H/∂x_i²/J_i of the faster motor: how it swings on its spring, the shaft held.
  [[nodiscard]] double swing_squared(const ActuatorState& state, double dt_s) const noexcept;

  /// Somebody put the shaft elsewhere: the springs follow, and what is stored from now on is what the balance begins with.
  void relocate(ActuatorState& state, double shaft) const noexcept;

  /// What the springs alone say with the shaft there, the pulleys where they are.
  [[nodiscard]] elastic::Response spring(const ActuatorState& state, double shaft) const noexcept;
  /// The springs' response with the torques of the frictions on the shaft's side: what acts if the shaft is there.
  [[nodiscard]] elastic::Response response(const ActuatorState& state, double shaft) const noexcept;
  /// Of motor i now, A, at that terminal voltage; `supply_V` as of a segment, where the enable pin is modulated.
  [[nodiscard]] double motor_current(const ActuatorState& state, int i, double voltage, drive::Terminal terminal,
                                     double supply_V = 0) const noexcept;
  [[nodiscard]] int motors() const noexcept { return motors_; }  ///< 1 or 2, of the law

 private:
  struct Prepared {
    double h_s = 0;
    drive::MotorStepper driven, open;
  };
  /// A motor at its pulley.
  struct Side {
    explicit Side(const SideParams& params) noexcept;
    drive::MotorParams motor;  // with the switches' resistance, too, and no inductance where chopped
    drive::Friction friction;
    double load_loss, back_loss;
    drive::BridgeParams bridge;
    double winding_Ohm, winding_H;
    bool chopped;  // the bridge's enable pin is modulated
  };
  /// A bristle in its gearbox, and a current that follows voltage and speed at once.
  [[nodiscard]] static bool plain(const Side& side) noexcept;
  const drive::MotorStepper& stepper(std::size_t i, double h_s, drive::Terminal terminal) noexcept {
    const std::size_t of = steppers_of_[i];
    const Prepared& last = prepared_[of][0];
    if (last.h_s != h_s) prepare(of, h_s);
    return terminal == drive::Terminal::driven ? last.driven : last.open;
  }
  void prepare(std::size_t of, double h_s) noexcept;  ///< this step length becomes the one used last
  const drive::PwmCycle& cycle(int i, const drive::PwmHold& hold) noexcept;
  [[nodiscard]] drive::PwmCycle new_cycle(int i, const drive::PwmHold& hold) const noexcept;
  void begin_pwm(Segment& segment, int i, double speed, double h_s) noexcept;
  /// The line of a PWM motor's current about a mean speed, and what follows from it.
  void aim(Segment& segment, int i, double speed) const noexcept;
  /// The same where the last displacement found is that of another speed.
  void follow(Segment& segment, int i) const noexcept;
  drive::MotorStep pwm_step(Ledger& ledger, const Side& side, const PwmInSegment& pwm, double torque) const noexcept;
  [[nodiscard]] double pwm_current(const drive::MotorState& motor, int i, drive::Terminal terminal,
                                   const drive::PwmHold& hold) const noexcept;

  /// Of a unit in lanes they are known, so that what goes for each is no loop and stays in registers.
  template <class T>
  [[nodiscard]] int motors() const noexcept {
    return lanes::kScalar<T> ? motors_ : 2;
  }
  template <class T>
  [[nodiscard]] int springs() const noexcept {
    return lanes::kScalar<T> ? springs_ : 2;
  }

  /// The friction in the gears without load; and as a segment has it.
  template <class Of>
  [[nodiscard]] drive::FrictionOf<typename Of::Number> gear(const Of& side) const noexcept;
  template <class T, class Of>
  [[nodiscard]] drive::FrictionOf<typename Of::Number> gear(const SegmentOf<T>& segment, const Of& side) const noexcept;
  template <class T, class F>
  void each_spring(F&& f) const noexcept {
    lanes::each_side<T>(springs_ == 2, springs_, f);
  }
  /// Of one unit both motors at once where a segment takes them alike.
  template <class T, class F>
  void each_motor(const SegmentOf<T>& segment, F&& f) const noexcept {
    lanes::each_side<T>(alike_ && !segment.sees_middle(), motors_, f);
  }

  // Of a step, for one unit or several: vsa/actuator/actuator_lanes.hpp.
  template <class T>
  using TrialOf = typename SegmentOf<T>::Trial;
  template <class T>
  void add_tendon_friction(const SegmentOf<T>& segment, TrialOf<T>& trial, const elastic::PositionsOf<T>& to) const noexcept;
  template <class T>
  void move_tendons(ActuatorStateOf<T>& state, const SegmentOf<T>& segment) const noexcept;
  /// One Newton correction of the pulleys from the mean at trial.dx; returns where it was small enough to be the last.
  template <class T>
  lanes::Truth<T> correction(SegmentOf<T>& segment, TrialOf<T>& trial, std::array<T, 2>& step) const noexcept;
  template <class T>
  static void see_middle(TrialOf<T>& trial, const std::array<T, 2>& further) noexcept;
  template <class T, class Of>
  [[nodiscard]] static typename Of::Number spring_slope(const TrialOf<T>& trial, const Of& side) noexcept;
  template <class T>
  [[nodiscard]] T straight(const TrialOf<T>& trial, const std::array<T, 2>& step) const noexcept;
  template <class T>
  void drive_motors(ActuatorStateOf<T>& state, const SegmentOf<T>& segment) const noexcept;
  /// −dτ̄/d(Δy) and the pulleys' gains from a mean's slopes; trial.gain comes as each pulley's own give, ∂x_i/∂load_i.
  template <class T>
  void slopes(const SegmentOf<T>& segment, TrialOf<T>& trial, const elastic::SegmentMeanOf<T>& mean,
              const RubOf<T>& rub) const noexcept;
  template <class T>
  void book_motors(ActuatorStateOf<T>& state) const noexcept;
  /// The springs and the frictions on the shaft's side where the shaft is; anchors that it left behind follow.
  template <class T>
  void move_shaft(ActuatorStateOf<T>& state, T shaft) const noexcept;
  /// Moves the origin there and gives H; where there is tendon friction the springs' signed energies are kept too.
  template <class T>
  [[nodiscard]] T energy_at(ActuatorStateOf<T>& state, T shaft) const noexcept;
  template <class T>
  void mean_from(const elastic::OriginOf<T>& from, const elastic::PositionsOf<T>& to, T ahead_rad,
                 elastic::SegmentMeanOf<T>& mean) const noexcept;
  template <class T>
  [[nodiscard]] static elastic::PositionsOf<T> positions(const ActuatorStateOf<T>& state, T shaft) noexcept {
    return {shaft, {state.motor[0].angle, state.motor[1].angle}};
  }

  ActuatorParams params_;
  const elastic::TwoSinh* two_sinh_;  // params_.transmission, if it is one: known by name it is inlined
  std::array<Side, 2> sides_;
  drive::Friction shaft_friction_;
  drive::Friction tendon_;  // in the energy's coordinate: "torque" μ, "angle" J
  int motors_, springs_;
  bool alike_;  // two motors of one kind, both with a bristle: what is done for one is done for the other
  std::array<std::size_t, 2> steppers_of_;                  // where in prepared_ a motor's are; motors that are alike share them
  std::array<std::array<Prepared, 2>, 2> prepared_{};       // the two step lengths used last
  std::array<std::array<drive::PwmCycle, 2>, 2> cycles_{};  // of each motor, the two used last
};

}  // namespace vsa::actuator
