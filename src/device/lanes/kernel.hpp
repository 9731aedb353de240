// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What is compiled anew for each instruction set: the physics of a block of units, one in each lane. A source that includes this
// is compiled with that set's options and keeps to types that carry its name (vsa/lanes.hpp), so that nothing in it can be taken for
// the same function of another set: no containers here, memory comes from the caller.
#pragma once

#include <new>

#include "device/lanes/algebra.hpp"
#include "device/lanes/loop.hpp"
#include "device/lanes/table.hpp"
#include "device/unit_lanes.hpp"

namespace vsa::device::lane_kernel {

template <class T>
struct ShaftInOf {
  T angle, speed, inverse_inertia, free_acceleration;
};

/// Of UnitState what the physics has, in lanes.
template <class T>
struct Block {
  actuator::ActuatorStateOf<T> actuator;
  T start_y = 0.0, applied_torque = 0.0, path_work = 0.0, last_speed = 0.0, last_dt = 1.0, unresolved = 0.0;
  struct {
    T angle = 0.0, speed = 0.0;
  } reached;
};

/// Of StepPlan what a step of one segment needs, in lanes.
template <class T>
struct Plan {
  ShaftInOf<T> in;
  T y = 0.0, free = 0.0, last_torque = 0.0, dy = 0.0, shaft_weight = 0.0;
  actuator::LeadOf<T> lead;
  actuator::SegmentOf<T> last;
  actuator::SegmentResultOf<T> path;
  drive::FrictionTorqueOf<T> rub;
};

template <class T>
void set_out(Unit& unit, const UnitPhysics<T>& physics, Block<T>& s, Plan<T>& plan, double dt,
             const std::array<T, 2>& voltage) noexcept {
  physics.begin(s, plan, dt);
  actuator::SegmentInputOf<T> in;
  in.lead = physics.look_ahead(s, plan, dt);
  in.voltage = voltage;
  unit.physics().begin(s.actuator, plan.last, dt, in);
}

template <class T>
[[gnu::flatten]] unsigned step(Unit& unit, void* memory, void* scratch, const BlockStep& io) noexcept {
  Block<T>& s = *std::launder(static_cast<Block<T>*>(memory));
  Plan<T>& plan = *std::launder(static_cast<Plan<T>*>(scratch));
  const UnitPhysics<T> physics = unit.template steps<T>();
  const double dt = io.dt_s;
  plan.in = {load<T>(io.angle), load<T>(io.speed), load<T>(io.inverse_inertia), load<T>(io.free_acceleration)};
  set_out<T>(unit, physics, s, plan, dt, {load<T>(io.voltage[0]), load<T>(io.voltage[1])});
  T torque;
  const auto settled = solve_whole<T>(physics, s, plan, dt, torque);
  store(torque, io.torque);
  for (int i = 0; i < 2; ++i)
    store(s.actuator.motor[i].angle, io.motor_angle[i]), store(s.actuator.motor[i].speed, io.motor_speed[i]);
  return ~settled.bits() & ((1U << T::kWidth) - 1);
}

/// A block and its step while somebody else solves it.
template <class T>
struct Trials {
  Block<T> s;
  Plan<T> plan;
};

template <class T>
void begin_trials_plan(void* memory) noexcept {
  new (&static_cast<Trials<T>*>(memory)->plan) Plan<T>();
}
template <class T>
[[gnu::flatten]] void begin_trials(Unit& unit, void* memory, const BlockTrials& io) noexcept {
  Trials<T>& t = *std::launder(static_cast<Trials<T>*>(memory));
  const UnitPhysics<T> physics = unit.template steps<T>();
  t.plan.in = {load<T>(io.angle), load<T>(io.speed), load<T>(io.inverse_inertia), load<T>(io.free_acceleration)};
  set_out<T>(unit, physics, t.s, t.plan, io.dt_s, {load<T>(io.voltage[0]), load<T>(io.voltage[1])});
  const ShaftTorqueOf<T> r = physics.foresee(t.s, t.plan, lanes::clamp(t.plan.free, -T(io.reach), io.reach));
  store(t.plan.free, io.free);
  store(t.plan.last_torque, io.last_torque);
  store(r.torque, io.torque);
  store(r.slope, io.slope);
}

template <class T>
[[gnu::flatten]] void attempt(Unit& unit, void* memory, const double* dy, bool rough, unsigned which, double* torque,
                              double* slope) noexcept {
  Trials<T>& t = *std::launder(static_cast<Trials<T>*>(memory));
  T tries;
  for (int i = 0; i < T::kWidth; ++i) tries.set_lane(i, static_cast<double>(which >> i & 1U));
  const ShaftTorqueOf<T> r = unit.template steps<T>().attempt(t.s, t.plan, load<T>(dy), rough, tries != 0.0);
  store(r.torque, torque);
  store(r.slope, slope);
}

template <class T>
[[gnu::flatten]] unsigned carry(const Unit& unit, const void* memory, const double* move, double dt_s, double* torque,
                                double* slope) noexcept {
  const Trials<T>& t = *std::launder(static_cast<const Trials<T>*>(memory));
  const ShaftTorqueOf<T> r = unit.template steps<T>().carried(t.s, t.plan, load<T>(move), dt_s);
  store(r.torque, torque);
  store(r.slope, slope);
  return r.settled.bits();
}

template <class T>
[[gnu::flatten]] void finish(const Unit& unit, void* memory, const double* move, const double* torque, double dt_s) noexcept {
  Trials<T>& t = *std::launder(static_cast<Trials<T>*>(memory));
  unit.template steps<T>().finish(t.s, t.plan, load<T>(move), load<T>(torque), dt_s);
}

template <class T>
void motors(const void* memory, double* const angle[2], double* const speed[2]) noexcept {
  const Block<T>& s = *std::launder(static_cast<const Block<T>*>(memory));
  for (int i = 0; i < 2; ++i) store(s.actuator.motor[i].angle, angle[i]), store(s.actuator.motor[i].speed, speed[i]);
}
template <class T>
void observe(void* memory, int lane, double angle, double speed) noexcept {
  Block<T>& s = *std::launder(static_cast<Block<T>*>(memory));
  s.reached.angle.set_lane(lane, angle);
  s.reached.speed.set_lane(lane, speed);
}

// Between a block's lane and a unit's state, number by number. A block lies at its trials' begin.

template <class T, class F>
void pair(T& lanes, double& one, F&& f) noexcept {
  f(lanes, one);
}
template <class T, class F>
void pair(T& lanes, int& one, F&& f) noexcept {
  double value = one;
  f(lanes, value);
  one = static_cast<int>(value);
}
template <class A, class B, std::size_t N, class F>
void pair(std::array<A, N>& lanes, std::array<B, N>& one, F&& f) noexcept {
  for (std::size_t i = 0; i < N; ++i) pair(lanes[i], one[i], f);
}
template <class A, class B, class F>
requires requires(A& a) {
  A::fields(a, [](auto&&...) {});
}
void pair(A& lanes, B& one, F&& f) noexcept {
  const auto tie = [](auto&&... members) { return std::tie(members...); };
  auto into = A::fields(lanes, tie);
  auto out_of = B::fields(one, tie);
  [&]<std::size_t... I>(std::index_sequence<I...>) { (pair(std::get<3 * I + 2>(into), std::get<3 * I + 2>(out_of), f), ...); }
  (std::make_index_sequence<std::tuple_size_v<decltype(into)> / 3>{});
}
template <class T, class F>
void each(Block<T>& b, UnitState& s, F&& f) noexcept {
  pair(b.actuator, s.actuator, f);
  pair(b.start_y, s.start_y, f);
  pair(b.applied_torque, s.applied_torque, f);
  pair(b.path_work, s.path_work, f);
  pair(b.last_speed, s.last_speed, f);
  pair(b.last_dt, s.last_dt, f);
  pair(b.unresolved, s.unresolved, f);
  pair(b.reached.angle, s.reached.angle, f);
  pair(b.reached.speed, s.reached.speed, f);
}

template <class T>
void put(void* memory, int lane, UnitState& from) noexcept {
  each(*std::launder(static_cast<Block<T>*>(memory)), from, [lane](T& lanes, double& one) { lanes.set_lane(lane, one); });
}
template <class T>
void take(void* memory, int lane, UnitState& to) noexcept {
  each(*std::launder(static_cast<Block<T>*>(memory)), to, [lane](T& lanes, double& one) { one = lanes.lane(lane); });
}
template <class T>
void begin(void* memory) noexcept {
  new (memory) Block<T>();
}
template <class T>
void begin_plan(void* memory) noexcept {
  new (memory) Plan<T>();
}

template <class T>
[[nodiscard]] LaneTable table(const char* name) noexcept {
  constexpr int kWidth = T::kWidth;
  using Isa = typename T::Isa;
  return {name,
          kWidth,
          sizeof(Block<T>),
          begin<T>,
          put<T>,
          take<T>,
          sizeof(Plan<T>),
          begin_plan<T>,
          step<T>,
          sizeof(Trials<T>),
          begin_trials_plan<T>,
          begin_trials<T>,
          attempt<T>,
          carry<T>,
          finish<T>,
          motors<T>,
          observe<T>,
          sizeof(Loop<kWidth, Isa>),
          put_loop<kWidth, Isa>,
          take_loop<kWidth, Isa>,
          tick<kWidth, Isa>,
          refer<kWidth, Isa>,
          add_product<T>,
          substitute<T>};
}

}  // namespace vsa::device::lane_kernel
