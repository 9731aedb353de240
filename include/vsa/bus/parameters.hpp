// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The unit's parameters as command 12 carries them: the list packet and the values of a set.
//
// The list's body (after the header): [0] command, [1] number of slots, then slots of 50 bytes from 2: type, count, values
// (big-endian), text, 0, and for flags with a menu the menu's number behind the text's zero; then menus of 150 bytes; CHK last.
//   dialect six    13 slots, menus at 652, 802, 952, 1201 bytes in all, LEN = 1201 mod 256 = 177; CHK covers bytes 0…175 only
//   dialect seven  15 slots (14 rate limiter, 15 serial number), menus behind them at 752, 902, 1052; zeros up to a multiple of 32:
//                  1216 bytes, LEN = 38. The client reads slots 1 to 14 at the same offsets; where its menus lie isn't public.
//
// Values are as on the wire: offsets and limits in ticks (raw >> resolution), gains as plain numbers.
//
// Source: NMMI/qbmove-maker-pro 6.1, get_param_list; qbdevice-api 7.2.8, Device::Params and readPackage.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "vsa/bus/messages.hpp"

namespace vsa::bus {

/// The parameters, as both dialects number them.
enum class ParameterId : std::uint16_t {
  id = 1,
  position_pid = 2,
  current_pid = 3,
  startup_activation = 4,
  input_mode = 5,
  control_mode = 6,
  resolutions = 7,
  offsets = 8,
  multipliers = 9,
  limits_on = 10,
  limits = 11,
  max_steps = 12,
  current_limit = 13,
  rate_limiter = 14,   ///< dialect seven
  serial_number = 15,  ///< dialect seven
};

/// How a value stands on the wire, big-endian.
enum class ParameterType : std::uint8_t {
  flag = 0,
  int8 = 1,
  uint8 = 2,
  int16 = 3,
  uint16 = 4,
  int32 = 5,
  uint32 = 6,
  float32 = 7,
  float64 = 8,
  text = 9,
};

/// One parameter of a dialect.
struct ParameterInfo {
  ParameterId id = ParameterId::id;           ///< its number
  ParameterType type = ParameterType::uint8;  ///< of each value
  std::uint8_t count = 1;                     ///< of its values
  std::string_view text;                      ///< as in the list, without the words for a flag's value
  std::uint8_t menu = 0;                      ///< 1 input mode, 2 control mode, 3 yes or no; 0 none
};

/// All parameters of a dialect, by number.
[[nodiscard]] std::span<const ParameterInfo> parameter_table(Dialect dialect) noexcept;
/// Null: no such parameter in this dialect.
[[nodiscard]] const ParameterInfo* find_parameter(Dialect dialect, std::uint16_t index) noexcept;
[[nodiscard]] std::size_t value_bytes(ParameterType type) noexcept;  ///< of one value of that type

/// All values, as the list carries them.
struct ParameterValues {
  std::uint8_t id = 1;                        ///< of the unit, 1 … 254
  std::array<float, 3> position_pid{};        ///< P, I, D, as plain numbers
  std::array<float, 3> current_pid{};         ///< P, I, D of the current loop
  std::uint8_t startup_activation = 0;        ///< written to the enable pins at a power-up: 3 on
  std::uint8_t input_mode = 0;                ///< 0: references come over the bus, 1: the third encoder is one
  std::uint8_t control_mode = 0;              ///< firmware::ControlMode
  std::array<std::uint8_t, 3> resolutions{};  ///< of motor 1, motor 2 and shaft: raw >> this is a tick
  std::array<std::int16_t, 3> offsets{};      ///< of motor 1, motor 2 and shaft, ticks
  std::array<float, 3> multipliers{};         ///< of motor 1, motor 2 and shaft
  std::uint8_t limits_on = 0;                 ///< 0: references aren't limited
  std::array<std::int32_t, 4> limits{};       ///< inf 1, sup 1, inf 2, sup 2
  std::array<std::int32_t, 2> max_steps{};    ///< negative, positive
  std::int16_t current_limit = 0;             ///< mA
  std::uint8_t rate_limiter = 0;              ///< dialect seven, and the advanced unit
  std::uint32_t serial_number = 0;            ///< dialect seven
  bool advanced = false;                      ///< the list has the advanced unit's fourteenth slot in dialect six; not a value
  bool operator==(const ParameterValues&) const = default;
};

// ------------------------------------------------------------------------------------------------------------------------- list

inline constexpr std::size_t kListBytesSix = kHeaderBytes + 1201;    ///< in dialect six
inline constexpr std::size_t kListBytesSeven = kHeaderBytes + 1216;  ///< in dialect seven
inline constexpr std::size_t kMaxListBytes = kListBytesSeven;        ///< of either dialect
inline constexpr std::uint8_t kSlotsOfAdvanced = 14;                 ///< of the advanced unit in dialect six
inline constexpr std::size_t kSlotBytes = 50;                        ///< one parameter
inline constexpr std::size_t kMenuBytes = 150;                       ///< one menu
inline constexpr std::size_t kMaxMenus = 3;                          ///< that the list has

/// Header included. Returns the bytes written (1205 or 1220), 0 if `out` is too small.
std::size_t encode_parameter_list(Wire wire, std::uint8_t id, const ParameterValues& values, std::span<std::uint8_t> out) noexcept;

/// From a whole list, header included. None: too short, not a list, wrong checksum, a slot with another type or count.
[[nodiscard]] std::optional<ParameterValues> decode_parameter_list(Wire wire, std::span<const std::uint8_t> bytes) noexcept;

/// One slot of a list, as sent: for programs that print what a unit says of itself.
struct ParameterSlot {
  ParameterType type = ParameterType::uint8;  ///< of each value
  std::uint8_t count = 0;                     ///< of its values
  std::span<const std::uint8_t> values;       ///< on the wire, `count` of them
  std::string_view text;                      ///< without its zero
  std::uint8_t menu = 0;                      ///< 0: none; behind the text's zero
};
/// None: no such slot, or the list ends within it.
[[nodiscard]] std::optional<ParameterSlot> read_slot(std::span<const std::uint8_t> list, std::uint16_t index) noexcept;

// -------------------------------------------------------------------------------------------------------------------------- set

/// A value of any parameter's type.
using ParameterValue =
    std::variant<std::uint8_t, std::int16_t, std::uint32_t, std::array<std::uint8_t, 3>, std::array<std::int16_t, 3>,
                 std::array<float, 3>, std::array<std::int32_t, 2>, std::array<std::int32_t, 4>>;

/// None: the value isn't of the parameter's type.
[[nodiscard]] std::optional<SetParameter> encode_value(ParameterId id, const ParameterValue& value) noexcept;
/// Reads as the unit does, stale bytes included. None: no such parameter in this dialect.
[[nodiscard]] std::optional<ParameterValue> decode_value(Dialect dialect, const SetParameter& set) noexcept;
[[nodiscard]] ParameterValue get(const ParameterValues& values, ParameterId id) noexcept;  ///< its own type
/// False: the value isn't of the parameter's type.
bool put(ParameterValues& values, ParameterId id, const ParameterValue& value) noexcept;

}  // namespace vsa::bus
