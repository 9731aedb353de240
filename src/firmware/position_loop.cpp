// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/firmware/position_loop.hpp"

#include "vsa/firmware/arithmetic.hpp"
#include "vsa/firmware/exchange.hpp"

namespace vsa::firmware {
namespace {

const Memory kInitial = initial_memory(Model::maker_pro);

}  // namespace

Memory memory_of(const LoopParams& p) noexcept {
  Memory m = kInitial;
  m.position = {p.kp, p.ki, p.kd};
  m.limits_on = p.limits_on ? 1 : 0;
  for (std::size_t i = 0; i < 2; ++i) {
    m.limit_low[i] = p.limits_raw[2 * i];
    m.limit_high[i] = p.limits_raw[2 * i + 1];
  }
  for (int i = 0; i < 3; ++i) m.resolution[i] = static_cast<std::uint8_t>(p.resolution[i]);
  return m;
}

void set_inputs(const LoopParams& p, LoopState& s, std::array<Ticks, 2> inputs) noexcept {
  const Memory m = memory_of(p);
  set_inputs(Model::maker_pro, {m, m}, s, inputs);
}

std::array<Ticks, 3> measurements(const LoopParams& p, const LoopState& s) noexcept {
  return positions(Model::maker_pro, memory_of(p), s);
}

void tick(const LoopParams& p, LoopState& s, const TickInputs& in) noexcept {
  const Memory memory = memory_of(p);
  const LoopMemory m{memory, memory};
  const Controller controller{Model::maker_pro, p.supply_limit, {}};
  const bool first = s.first_tick;
  for (int i = 0; i < 3; ++i) controller.read_encoder(m, s, in, i);
  if (first) s.meas_old = s.meas;
  for (int i = 0; i < 2; ++i) controller.drive_motor(m, s, i);
  controller.read_analog(s, in);
  Controller::end_tick(s);
}

}  // namespace vsa::firmware
