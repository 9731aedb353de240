// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// How a block is stepped, and where its numbers are meanwhile.
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "device/unit_batch_impl.hpp"

namespace vsa::device {
namespace {

constexpr auto kNotTold = [] {
  std::array<double, kBlock> none{};
  none.fill(std::numeric_limits<double>::quiet_NaN());
  return none;
}();

}  // namespace

void UnitBatch::Impl::ticks_to_lanes(std::size_t b) noexcept {
  for (std::size_t i = 0; i < width; ++i) table.put_loop(loop(b), static_cast<int>(i), states[b * width + i]);
  for (std::size_t i = b * width; i < (b + 1) * width; ++i)
    for (std::size_t m = 0; m < 2; ++m) voltage[m][i] = states[i].held.voltage[m];
  ticks_in_lanes[b] = true;
}

void UnitBatch::Impl::take_loop(std::size_t i, UnitState& s) const noexcept {
  table.take_loop(loop(i / width), static_cast<int>(i % width), s);
  s.program.watchdog.run_to(last_tick_ns);
  for (std::size_t m = 0; m < 2; ++m) s.held.voltage[m] = voltage[m][i];
}

void UnitBatch::Impl::ticks_to_states(std::size_t b) noexcept {
  if (ticks_in_lanes[b] == 0) return;
  for (std::size_t i = b * width; i < (b + 1) * width; ++i) take_loop(i, states[i]);
  ticks_in_lanes[b] = false;
}

/// The ticks of a block at its step's begin. False: they are for the units one by one.
bool UnitBatch::Impl::tick(std::size_t b) noexcept {
  if (in_lanes[b] == 0) return false;
  if (ticks_in_lanes[b] == 0) {
    for (std::size_t i = b * width; i < (b + 1) * width; ++i)
      if (!unit.plain_ticks().plain(states[i], now_ns)) return false;
    ticks_to_lanes(b);
  }
  TickStep io = unit.plain_ticks().common();
  const std::size_t first = b * width;
  io.angle = &angle[first];
  for (std::size_t m = 0; m < 2; ++m) {
    io.motor_angle[m] = &motor_angle[m][first];
    io.motor_speed[m] = &motor_speed[m][first];
    io.voltage[m] = &voltage[m][first];
  }
  table.tick(loop(b), io);
  return true;
}

void UnitBatch::Impl::step_in_lanes(std::size_t b, std::int64_t dt_ns) noexcept {
  const std::size_t first = b * width;
  for (std::size_t i = first; i < first + width && ticks_in_lanes[b] == 0; ++i)
    for (std::size_t m = 0; m < 2; ++m) voltage[m][i] = states[i].held.voltage[m];
  to_lanes(b);
  BlockStep io;
  io.dt_s = static_cast<double>(dt_ns) * 1e-9;
  io.angle = &angle[first];
  io.speed = &speed[first];
  io.inverse_inertia = &inverse_inertia[first];
  io.free_acceleration = kNotTold.data();
  io.torque = &torque[first];
  for (std::size_t m = 0; m < 2; ++m) {
    io.voltage[m] = &voltage[m][first];
    io.motor_angle[m] = &motor_angle[m][first];
    io.motor_speed[m] = &motor_speed[m][first];
  }
  unsettled += static_cast<std::size_t>(std::popcount(table.step(unit, block(b), plan.get(), io)));
}

void UnitBatch::Impl::step_block(std::size_t b, std::int64_t dt_ns) noexcept {
  const std::size_t first = b * width;
  const auto in = [&](std::size_t i) { return ShaftIn{angle[i], speed[i], inverse_inertia[i]}; };
  const auto alone = [&](std::size_t i, auto&& step) {
    torque[i] = step(states[i]);
    unsettled += unit.settled() ? 0 : 1;
  };
  if (!laned || !unit.whole(now_ns, dt_ns)) {
    to_states(b);
    for (std::size_t i = first; i < first + width; ++i) alone(i, [&](UnitState& s) { return unit.step(s, now_ns, dt_ns, in(i)); });
    return;
  }
  const bool ticks = now_ns % firmware::kTickNs == 0;
  if (ticks ? tick(b) : ticks_in_lanes[b] != 0) return step_in_lanes(b, dt_ns);
  bool regular = true;
  for (std::size_t i = first; i < first + width; ++i) {
    UnitState& s = states[i];
    if (ticks) {
      for (std::size_t m = 0; m < 2 && in_lanes[b] != 0; ++m) {
        s.actuator.motor[m].angle = motor_angle[m][i];
        s.actuator.motor[m].speed = motor_speed[m][i];
      }
      unit.tick(s, now_ns, angle[i]);
    }
    regular =
        regular && s.started && s.held.terminal[0] == drive::Terminal::driven && s.held.terminal[1] == drive::Terminal::driven;
  }
  if (regular) return step_in_lanes(b, dt_ns);
  to_states(b);
  for (std::size_t i = first; i < first + width; ++i)
    alone(i, [&](UnitState& s) { return unit.step_held(s, now_ns, dt_ns, in(i)); });
}

}  // namespace vsa::device
