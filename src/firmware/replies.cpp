// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The long answers, and the way out.
#include <algorithm>

#include "firmware/commands.hpp"
#include "vsa/bus/codec.hpp"
#include "vsa/bus/parameters.hpp"
#include "vsa/firmware/arithmetic.hpp"
#include "vsa/firmware/info.hpp"

namespace vsa::firmware {
namespace {

constexpr std::int64_t kBitsPerByte = 10;
constexpr std::int64_t kDividedClockHz = 6'000'000;  // 48 MHz, eight samples a bit

std::int64_t wire_ns(std::size_t bytes, std::uint8_t divider) noexcept {
  return static_cast<std::int64_t>(bytes) * kBitsPerByte * divider * 1'000'000'000 / kDividedClockHz;
}

std::array<float, 3> numbers(const Gains& k) noexcept {
  const auto number = [](std::int32_t v) { return static_cast<float>(v) / 65536.0F; };
  return {number(k.p), number(k.i), number(k.d)};
}

bus::ParameterValues listed(const Memory& m, Model model) noexcept {
  const ControlMode mode{m.control_mode};
  const bool twice = mode == ControlMode::position_current || mode == ControlMode::deflection_current;
  bus::ParameterValues v;
  v.id = m.id;
  v.position_pid = numbers(twice ? m.double_position : m.position);
  v.current_pid = numbers(twice ? m.double_current : m.current);
  v.startup_activation = m.startup_activation;
  v.input_mode = m.input_mode;
  v.control_mode = m.control_mode;
  v.resolutions = m.resolution;
  for (int i = 0; i < 3; ++i) {
    const std::int32_t ticks = shift_right(m.offset[i], m.resolution[i]);
    v.offsets[i] = cut_16(model == Model::advanced && i != 2 ? wrap_sub(0, ticks) : ticks);
  }
  v.multipliers = m.multiplier;
  v.limits_on = m.limits_on;
  for (std::size_t i = 0; i < 2; ++i) {
    v.limits[2 * i] = shift_right(m.limit_low[i], m.resolution[i]);
    v.limits[2 * i + 1] = shift_right(m.limit_high[i], m.resolution[i]);
  }
  v.max_steps = {m.max_step_negative, m.max_step_positive};
  v.current_limit = m.current_limit_mA;
  v.rate_limiter = m.max_pwm_rate;
  v.serial_number = m.serial_number;
  return v;
}

constexpr std::size_t slot_at(std::size_t index) noexcept { return 2 + (index - 1) * bus::kSlotBytes; }

/// The advanced unit of dialect six has a fourteenth slot, and the menus move on by one slot.
void add_rate_slot(std::span<std::uint8_t> body, std::uint8_t rate) noexcept {
  constexpr std::string_view text = "14 - Max PWM rate:";
  constexpr std::size_t slot = slot_at(bus::kSlotsOfAdvanced), menus = bus::kMaxMenus * bus::kMenuBytes;
  std::copy_backward(body.begin() + slot, body.begin() + slot + menus, body.begin() + slot + menus + bus::kSlotBytes);
  std::fill_n(body.begin() + slot, bus::kSlotBytes, std::uint8_t{0});
  body[1] = bus::kSlotsOfAdvanced;
  body[slot] = static_cast<std::uint8_t>(bus::ParameterType::uint8);
  body[slot + 1] = 1;
  body[slot + 2] = rate;
  std::copy(text.begin(), text.end(), body.begin() + slot + 3);
}

/// "6 - Control mode: Deflection and current" has two bytes more than its array: the last letter and the zero fall on the text of
/// parameter 7, which the linker put behind it (the map of the advanced unit's build; UNKNOWN for the maker pro).
void overrun_mode_text(std::span<std::uint8_t> body) noexcept {
  constexpr std::size_t text = slot_at(7) + 2 + 3;
  body[text] = 't';
  body[text + 1] = 0;
}

/// What the list of firmware 6 has beyond the bus's; the whole list, header included.
void finish_list(const CommandContext& c, std::span<std::uint8_t> list) noexcept {
  const Memory& m = c.state.memory.current;
  const auto body = list.subspan(bus::kHeaderBytes);
  if (c.params.model == Model::advanced) add_rate_slot(body, m.max_pwm_rate);
  const bool overruns = ControlMode{m.control_mode} == ControlMode::deflection_current && !c.params.repairs.list_mode_5;
  if (overruns) overrun_mode_text(body);
  const std::size_t content = body.size() - 1;
  body[content] = bus::checksum(body.first(c.wire.repair_list_checksum ? content : content % 256));
}

}  // namespace

void send(const CommandContext& c, std::size_t size) noexcept {
  ProgramState& s = c.state;
  const std::int64_t start = std::max(s.busy_until_ns, c.now_ns);
  c.out.commit(size, start - c.now_ns);
  s.busy_until_ns = start + wire_ns(size, s.baud_divider);
}

void send(const CommandContext& c, const bus::FrameBytes& frame) noexcept {
  const auto room = c.out.room();
  if (room.size() < frame.size) return;
  std::copy_n(frame.bytes.begin(), frame.size, room.begin());
  send(c, frame.size);
}

void send_info(const CommandContext& c) noexcept {
  std::array<char, kInfoBytes> buffer;
  const ProgramState& s = c.state;
  const LoopMemory memory{s.memory.stored, s.memory.current};
  const auto text = info_text({c.params.model, c.params.repairs, memory, s.loop, c.params.loop_time_us}, buffer);
  send(c, bus::encode_info(c.wire, s.memory.stored.id, text, c.out.room()));
}

void send_parameter_list(const CommandContext& c) noexcept {
  const MemoryState& m = c.state.memory;
  const auto room = c.out.room();
  const std::size_t size = bus::encode_parameter_list(c.wire, m.stored.id, listed(m.current, c.params.model), room);
  if (size != 0 && c.params.dialect == bus::Dialect::six) finish_list(c, room.first(size));
  send(c, size);
}

}  // namespace vsa::firmware
