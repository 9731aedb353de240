// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/firmware/program.hpp"

#include <algorithm>

#include "firmware/commands.hpp"
#include "vsa/firmware/arithmetic.hpp"

namespace vsa::firmware {
namespace {

constexpr std::uint8_t kBothMotors = 3;

}  // namespace

Program::Program(const ProgramParams& params) noexcept
    : params_(params),
      controller_{params.model, params.supply_table.value_or(params.model == Model::maker_pro), params.repairs, params.generation},
      wire_{params.dialect, params.repairs.layout_134, params.repairs.list_checksum} {}

ProgramState Program::fresh(std::int64_t now_ns) const noexcept {
  ProgramState s;
  power_up(s, now_ns);
  s.busy_until_ns = now_ns;
  return s;
}

ProgramState Program::fresh(std::int64_t now_ns, const Memory& shipped) const noexcept {
  ProgramState s;
  s.memory.user = s.memory.factory = shipped;
  s.memory.user.valid = s.memory.factory.valid = true;
  power_up(s, now_ns);
  return s;
}

void Program::power_up(ProgramState& s, std::int64_t now_ns) const noexcept {
  const MemoryState memory = s.memory;
  s = {};
  s.memory = memory;
  s.busy_until_ns = now_ns;
  begin_store(params_, s, recall(s.memory, params_.model), now_ns);
  s.loop.orders.onoff = s.memory.current.startup_activation;
  if (params_.repairs.startup_activation_reported) s.loop.orders_new.onoff = s.loop.orders.onoff;
  s.enable = s.loop.orders.onoff & kBothMotors;
  s.watchdog.power_up(now_ns, s.memory.stored.watchdog_period != 0);
}

void Program::receive(ProgramState& s, std::uint8_t byte, std::int64_t now_ns, Output& out) const noexcept {
  if (s.in_bootloader) return;
  s.buffer.push(byte);
  s.bytes_waiting = true;
  poll(s, now_ns, out);
}

void Program::receive_frame(ProgramState& s, std::span<const std::uint8_t> frame, std::int64_t now_ns, Output& out) const noexcept {
  if (s.in_bootloader) return;
  s.buffer.pass(frame.size());
  s.watchdog.run_to(now_ns);
  s.watchdog.heard_byte();
  if (s.receiver.push_frame(frame, s.memory.current.id) == bus::ReceiverEvent::frame)
    execute_frame({params_, controller_, wire_, now_ns, s, out});
}

void Program::let_pass(ProgramState& s, std::size_t bytes, std::uint8_t id, std::uint8_t length, std::int64_t now_ns) noexcept {
  if (s.in_bootloader) return;
  s.buffer.pass(bytes);
  s.watchdog.run_to(now_ns);
  s.watchdog.heard_byte();
  s.receiver.pass(id, length);
}

void Program::shift_time(ProgramState& s, std::int64_t by_ns) noexcept {
  s.busy_until_ns += by_ns;
  s.watchdog.next_clock_ns += by_ns;
}

std::optional<std::int64_t> Program::wake_ns(const ProgramState& s) const noexcept {
  if (!s.bytes_waiting || s.receiver_off || s.in_bootloader) return std::nullopt;
  return s.busy_until_ns;
}

void Program::poll(ProgramState& s, std::int64_t now_ns, Output& out) const noexcept {
  if (!s.bytes_waiting || s.receiver_off || s.in_bootloader || now_ns < s.busy_until_ns) return;
  s.bytes_waiting = false;
  s.watchdog.run_to(now_ns);
  s.watchdog.heard_byte();
  drain(s, now_ns, out);
}

/// After six frames the rest waits for the next byte; a program that became busy looks again when it is done. Not inlined: all
/// commands hang on it, and in most ticks no byte has come.
[[gnu::noinline]] void Program::drain(ProgramState& s, std::int64_t now_ns, Output& out) const noexcept {
  int frames = 0;
  while (!s.buffer.empty() && frames < bus::kFramesPerPoll && !s.in_bootloader) {
    const bus::ReceiverEvent event = s.receiver.push(s.buffer.pop(), s.memory.current.id);
    if (bus::counts_toward_poll(event)) ++frames;
    const CommandContext context{params_, controller_, wire_, now_ns, s, out};
    if (event == bus::ReceiverEvent::frame) execute_frame(context);
    if (event == bus::ReceiverEvent::info_request) send_info(context);
  }
}

bool Program::skips(const ProgramState& s, std::int64_t now_ns) const noexcept { return s.busy_until_ns - now_ns >= kTickNs; }

void Program::begin_tick(ProgramState& s, const TickInputs& in, std::int64_t now_ns, Output& out) const noexcept {
  poll(s, now_ns, out);
  // Two seconds pass between the answer and the other program; until then bridges and PWM stay as they are.
  if (s.in_bootloader && now_ns >= s.busy_until_ns) s.enable = 0, s.loop.duty = {};
  if (skips(s, now_ns) || s.in_bootloader) return;
  const LoopMemory m{s.memory.stored, s.memory.current};
  for (int i = 0; i < 3; ++i) controller_.read_encoder(m, s.loop, in, i);
  controller_.drive_motors(m, s.loop);
}

void Program::end_tick(ProgramState& s, const TickInputs& in, std::int64_t now_ns, Output& out) const noexcept {
  s.watchdog.run_to(now_ns);
  if (skips(s, now_ns) || s.in_bootloader) return;
  controller_.read_analog(s.loop, in);
  calibrate(s, now_ns);
  Controller::end_tick(s.loop);
  if (s.activation_waits) s.enable = s.loop.orders.onoff & kBothMotors;
  s.activation_waits = false;
  poll(s, now_ns, out);
  if (s.watchdog.expired) {
    s.watchdog.reload = true;
    s.loop.orders_new.onoff = 0;
    if (params_.repairs.watchdog_stops_motors) s.enable = 0;
  }
  if (s.buffer.overflow) s.buffer.clear();
}

/// In one piece where a room's sources are compiled together (VSA_UNITY): a fiftieth of a unit's step.
[[gnu::flatten]] void Program::tick(ProgramState& s, const TickInputs& in, std::int64_t now_ns, Output& out) const noexcept {
  begin_tick(s, in, now_ns, out);
  end_tick(s, in, now_ns, out);
}

Drive Program::drive(const ProgramState& s) const noexcept {
  Drive d;
  d.duty_pct = s.loop.duty;
  for (int i = 0; i < 2; ++i) d.enabled[i] = ((s.enable >> i) & 1) != 0;
  return d;
}

void settle(const Program& program, ProgramState& s, const TickInputs& in) noexcept {
  ControllerState& c = s.loop;
  const LoopMemory m{s.memory.stored, s.memory.current};
  c.ref = c.ref_old = c.ref_new;
  for (int i = 0; i < 3; ++i) program.controller().read_encoder(m, c, in, i);
  for (int i = 0; i < 2; ++i) {
    constexpr std::int32_t kTurn = 65536, kHalf = kTurn / 2;
    c.turns[i] = static_cast<std::int8_t>((wrap_sub(c.ref[i], c.meas[i]) + kHalf) >> 16);
    c.meas[i] = wrap_add(c.meas[i], c.turns[i] * kTurn);
  }
  c.meas_old = c.meas;
  c.meas_driven = {c.meas[0], c.meas[1]};
  c.first_tick = true;
  program.controller().read_analog(c, in);
  c.orders.onoff = c.orders_old.onoff = c.orders_new.onoff = s.enable = kBothMotors;
}

void begin_store(const ProgramParams& p, ProgramState& s, int rows, std::int64_t now_ns) noexcept {
  if (rows == 0) return;
  s.loop.duty = {};
  s.busy_until_ns = std::max(s.busy_until_ns, now_ns) + rows * p.row_write_ns;
}

}  // namespace vsa::firmware
