// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Blocks of units: each is with its units (`states`), or its physics is in lanes, or its ticks are, too.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#include "device/lanes/table.hpp"
#include "device/plain_ticks.hpp"
#include "vsa/device/unit_batch.hpp"

namespace vsa::device {

constexpr std::size_t kAlignment = 64;  // of a block

struct FreeBlocks {
  void operator()(std::byte* memory) const noexcept { ::operator delete[](memory, std::align_val_t{kAlignment}); }
};

struct UnitBatch::Impl {
  Impl(const UnitConfig& config, std::size_t units, const LaneTable& lanes_)
      : unit(config), count(units), table(lanes_), width(static_cast<std::size_t>(table.width)) {
    const std::size_t blocks = (units + width - 1) / width, padded = blocks * width;
    states.assign(padded, unit.initial(0, 0, 0));
    in_lanes.assign(blocks, false);
    laned = unit.physics().has_lanes();
    loop_bytes = (table.loop_bytes + kAlignment - 1) / kAlignment * kAlignment;
    loops.reset(static_cast<std::byte*>(::operator new[](blocks* loop_bytes, std::align_val_t{kAlignment})));
    ticks_in_lanes.assign(blocks, false);
    memory.reset(static_cast<std::byte*>(::operator new[](blocks* table.block_bytes, std::align_val_t{kAlignment})));
    for (std::size_t b = 0; b < blocks; ++b) table.begin(block(b));
    plan.reset(static_cast<std::byte*>(::operator new[](table.plan_bytes, std::align_val_t{kAlignment})));
    table.begin_plan(plan.get());
    for (auto* column : {&angle, &speed, &inverse_inertia, &torque, &voltage[0], &voltage[1], &motor_angle[0], &motor_angle[1],
                         &motor_speed[0], &motor_speed[1]})
      column->assign(padded, 0.0);
  }

  [[nodiscard]] void* block(std::size_t b) noexcept { return memory.get() + b * table.block_bytes; }
  [[nodiscard]] std::size_t blocks() const noexcept { return in_lanes.size(); }

  [[nodiscard]] void* loop(std::size_t b) noexcept { return loops.get() + b * loop_bytes; }
  [[nodiscard]] const void* loop(std::size_t b) const noexcept { return loops.get() + b * loop_bytes; }

  bool tick(std::size_t b) noexcept;
  void take_loop(std::size_t i, UnitState& s) const noexcept;
  void ticks_to_lanes(std::size_t b) noexcept;
  void ticks_to_states(std::size_t b) noexcept;

  /// Their numbers go to the lanes, or come back.
  void to_lanes(std::size_t b) noexcept {
    if (in_lanes[b]) return;
    for (std::size_t i = 0; i < width; ++i) table.put(block(b), static_cast<int>(i), states[b * width + i]);
    in_lanes[b] = true;
  }
  void to_states(std::size_t b) noexcept {
    ticks_to_states(b);
    if (!in_lanes[b]) return;
    for (std::size_t i = 0; i < width; ++i) table.take(block(b), static_cast<int>(i), states[b * width + i]);
    in_lanes[b] = false;
  }

  void check(std::size_t unit) const;
  void step_block(std::size_t b, std::int64_t dt_ns) noexcept;
  void step_in_lanes(std::size_t b, std::int64_t dt_ns) noexcept;

  Unit unit;
  std::size_t count;
  const LaneTable& table;
  std::size_t width;
  bool laned = false;
  std::vector<UnitState> states;  // of blocks in lanes: all but the physics
  std::vector<char> in_lanes;
  std::unique_ptr<std::byte[], FreeBlocks> memory, plan;
  std::vector<char> ticks_in_lanes;  // only of blocks whose physics are
  std::size_t loop_bytes = 0;
  std::unique_ptr<std::byte[], FreeBlocks> loops;
  std::int64_t last_tick_ns = 0;
  std::vector<double> angle, speed, inverse_inertia, torque, voltage[2], motor_angle[2], motor_speed[2];
  std::int64_t now_ns = 0;
  std::size_t unsettled = 0;
};

}  // namespace vsa::device
