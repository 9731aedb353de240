// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Setting a parameter. It goes to the stored set; dialect seven makes it current at once.
#include "vsa/bus/parameters.hpp"

#include "firmware/commands.hpp"
#include "vsa/bus/bytes.hpp"
#include "vsa/firmware/arithmetic.hpp"
#include "vsa/firmware/exchange.hpp"

namespace vsa::firmware {
namespace {

using bus::ParameterId;

Gains read_gains(bus::ByteReader& in) noexcept {
  Gains k;
  for (std::int32_t* v : {&k.p, &k.i, &k.d}) *v = truncate(in.f32() * 65536.0F);
  return k;
}

void read_limits(bus::ByteReader& in, Memory& m) noexcept {
  for (int i = 0; i < 2; ++i) {
    m.limit_low[i] = wrap_shl(in.i32(), m.resolution[i]);
    m.limit_high[i] = wrap_shl(in.i32(), m.resolution[i]);
  }
}

/// A step of the wrong sign is left out.
void read_max_steps(bus::ByteReader& in, Memory& m) noexcept {
  const std::int32_t negative = in.i32(), positive = in.i32();
  if (negative <= 0) m.max_step_negative = negative;
  if (positive >= 0) m.max_step_positive = positive;
}

void read_offsets(bus::ByteReader& in, Memory& m, ControllerState& loop) noexcept {
  std::array<Ticks, 3> offsets;
  for (Ticks& offset : offsets) offset = {in.i16()};
  set_offsets(m, loop, offsets);
}

bool known(const ProgramParams& p, ParameterId id) noexcept {
  if (id == ParameterId::rate_limiter) return p.model == Model::advanced || p.dialect == bus::Dialect::seven;
  if (id == ParameterId::serial_number) return p.dialect == bus::Dialect::seven;
  return id >= ParameterId::id && id <= ParameterId::current_limit;
}

/// The gains that parameters 2 and 3 mean depend on the mode in use, not on the one that was set last.
void write(const CommandContext& c, ParameterId id, bus::ByteReader& in) noexcept {
  Memory& m = c.state.memory.stored;
  const ControlMode mode{c.state.memory.current.control_mode};
  const bool twice = mode == ControlMode::position_current || mode == ControlMode::deflection_current;
  switch (id) {
    case ParameterId::id:
      m.id = in.u8();
      break;
    case ParameterId::position_pid:
      (twice ? m.double_position : m.position) = read_gains(in);
      break;
    case ParameterId::current_pid:
      (twice ? m.double_current : m.current) = read_gains(in);
      break;
    case ParameterId::startup_activation:
      m.startup_activation = in.u8();
      break;
    case ParameterId::input_mode:
      m.input_mode = in.u8();
      break;
    case ParameterId::control_mode:
      m.control_mode = in.u8();
      break;
    case ParameterId::resolutions:
      for (std::uint8_t& bits : m.resolution) bits = in.u8();
      break;
    case ParameterId::offsets:
      read_offsets(in, m, c.state.loop);
      break;
    case ParameterId::multipliers:
      for (float& v : m.multiplier) v = in.f32();
      break;
    case ParameterId::limits_on:
      m.limits_on = in.u8();
      break;
    case ParameterId::limits:
      read_limits(in, m);
      break;
    case ParameterId::max_steps:
      read_max_steps(in, m);
      break;
    case ParameterId::current_limit:
      m.current_limit_mA = in.i16();
      break;
    case ParameterId::rate_limiter:
      m.max_pwm_rate = in.u8();
      break;
    case ParameterId::serial_number:
      m.serial_number = in.u32();
      break;
  }
}

}  // namespace

bool set_parameter(const CommandContext& c, const bus::SetParameter& request) noexcept {
  const ParameterId id{request.index};
  if (!known(c.params, id)) return false;
  bus::ByteReader in{request.value};
  write(c, id, in);
  if (c.params.dialect == bus::Dialect::seven) c.state.memory.current = c.state.memory.stored;
  return true;
}

}  // namespace vsa::firmware
