// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/bus/parameters.hpp"

#include <algorithm>
#include <type_traits>

#include "bus/parameter_bytes.hpp"
#include "vsa/bus/bytes.hpp"

namespace vsa::bus {
namespace {

using Id = ParameterId;
using Type = ParameterType;

constexpr std::array<ParameterInfo, 15> kTable{{
    {Id::id, Type::uint8, 1, "1 - Device ID:", 0},
    {Id::position_pid, Type::float32, 3, "2 - Position PID [P, I, D]:", 0},
    {Id::current_pid, Type::float32, 3, "3 - Current PID [P, I, D]:", 0},
    {Id::startup_activation, Type::flag, 1, "4 - Startup Activation:", 3},
    {Id::input_mode, Type::flag, 1, "5 - Input mode:", 1},
    {Id::control_mode, Type::flag, 1, "6 - Control mode:", 2},
    {Id::resolutions, Type::uint8, 3, "7 - Resolutions:", 0},
    {Id::offsets, Type::int16, 3, "8 - Measurement Offsets:", 0},
    {Id::multipliers, Type::float32, 3, "9 - Multipliers:", 0},
    {Id::limits_on, Type::flag, 1, "10 - Pos. limit active:", 3},
    {Id::limits, Type::int32, 4, "11 - Pos. limits [inf, sup]:", 0},
    {Id::max_steps, Type::int32, 2, "12 - Max steps [neg, pos]:", 0},
    {Id::current_limit, Type::int16, 1, "13 - Current limit:", 0},
    // The texts of dialect seven's own two aren't public: ours.
    {Id::rate_limiter, Type::uint8, 1, "14 - Rate limiter:", 0},
    {Id::serial_number, Type::uint32, 1, "15 - Serial number:", 0},
}};
constexpr std::size_t kParametersSix = 13;

/// Values one after another, of any of ParameterValue's types.
void write(ByteWriter& out, std::uint8_t v) noexcept { out.u8(v); }
void write(ByteWriter& out, std::int16_t v) noexcept { out.i16(v); }
void write(ByteWriter& out, std::int32_t v) noexcept { out.i32(v); }
void write(ByteWriter& out, std::uint32_t v) noexcept { out.u32(v); }
void write(ByteWriter& out, float v) noexcept { out.f32(v); }
template <class T, std::size_t N>
void write(ByteWriter& out, const std::array<T, N>& values) noexcept {
  for (const T v : values) write(out, v);
}

void read(ByteReader& in, std::uint8_t& v) noexcept { v = in.u8(); }
void read(ByteReader& in, std::int16_t& v) noexcept { v = in.i16(); }
void read(ByteReader& in, std::int32_t& v) noexcept { v = in.i32(); }
void read(ByteReader& in, std::uint32_t& v) noexcept { v = in.u32(); }
void read(ByteReader& in, float& v) noexcept { v = in.f32(); }
template <class T, std::size_t N>
void read(ByteReader& in, std::array<T, N>& values) noexcept {
  for (T& v : values) read(in, v);
}

/// Calls `f` with the member that `id` names. The one place where numbers and members meet.
template <class Values, class F>
bool with_member(Values& v, ParameterId id, F&& f) noexcept {
  switch (id) {
    case Id::id:
      return f(v.id), true;
    case Id::position_pid:
      return f(v.position_pid), true;
    case Id::current_pid:
      return f(v.current_pid), true;
    case Id::startup_activation:
      return f(v.startup_activation), true;
    case Id::input_mode:
      return f(v.input_mode), true;
    case Id::control_mode:
      return f(v.control_mode), true;
    case Id::resolutions:
      return f(v.resolutions), true;
    case Id::offsets:
      return f(v.offsets), true;
    case Id::multipliers:
      return f(v.multipliers), true;
    case Id::limits_on:
      return f(v.limits_on), true;
    case Id::limits:
      return f(v.limits), true;
    case Id::max_steps:
      return f(v.max_steps), true;
    case Id::current_limit:
      return f(v.current_limit), true;
    case Id::rate_limiter:
      return f(v.rate_limiter), true;
    case Id::serial_number:
      return f(v.serial_number), true;
  }
  return false;
}

}  // namespace

std::span<const ParameterInfo> parameter_table(Dialect dialect) noexcept {
  return std::span{kTable}.first(dialect == Dialect::six ? kParametersSix : kTable.size());
}

const ParameterInfo* find_parameter(Dialect dialect, std::uint16_t index) noexcept {
  const auto table = parameter_table(dialect);
  return index >= 1 && index <= table.size() ? &table[index - 1U] : nullptr;
}

std::size_t value_bytes(ParameterType type) noexcept {
  switch (type) {
    case Type::flag:
    case Type::int8:
    case Type::uint8:
    case Type::text:
      return 1;
    case Type::int16:
    case Type::uint16:
      return 2;
    case Type::int32:
    case Type::uint32:
    case Type::float32:
      return 4;
    case Type::float64:
      return 8;
  }
  return 0;
}

ParameterValue get(const ParameterValues& values, ParameterId id) noexcept {
  ParameterValue value;
  with_member(values, id, [&value](const auto& member) { value = member; });
  return value;
}

bool put(ParameterValues& values, ParameterId id, const ParameterValue& value) noexcept {
  bool ok = false;
  with_member(values, id, [&](auto& member) {
    if (const auto* v = std::get_if<std::decay_t<decltype(member)>>(&value)) {
      member = *v;
      ok = true;
    }
  });
  return ok;
}

std::optional<SetParameter> encode_value(ParameterId id, const ParameterValue& value) noexcept {
  ParameterValues typed;
  if (!put(typed, id, value)) return std::nullopt;
  SetParameter set;
  set.index = static_cast<std::uint16_t>(id);
  ByteWriter out{set.value};
  with_member(typed, id, [&out](const auto& member) { write(out, member); });
  set.value_bytes = static_cast<std::uint8_t>(out.size());
  return set;
}

std::optional<ParameterValue> decode_value(Dialect dialect, const SetParameter& set) noexcept {
  if (find_parameter(dialect, set.index) == nullptr) return std::nullopt;
  ParameterValues typed;
  const auto id = static_cast<ParameterId>(set.index);
  ByteReader in{set.value};
  with_member(typed, id, [&in](auto& member) { read(in, member); });
  return get(typed, id);
}

void write_value(ByteWriter& out, const ParameterValues& values, ParameterId id) noexcept {
  with_member(values, id, [&out](const auto& member) { write(out, member); });
}

void read_value(ByteReader& in, ParameterValues& values, ParameterId id) noexcept {
  with_member(values, id, [&in](auto& member) { read(in, member); });
}

}  // namespace vsa::bus
