// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The unit's parameters by name: how each is written, read, and what it may be.
#include "vsa/config/unit_parameters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vsa::config {
namespace {

using bus::ParameterId;

struct Name {
  ParameterId id;
  const char* name;
};
constexpr std::array<Name, 15> kNames{{{ParameterId::id, "id"},
                                       {ParameterId::position_pid, "position_pid"},
                                       {ParameterId::current_pid, "current_pid"},
                                       {ParameterId::startup_activation, "startup_activation"},
                                       {ParameterId::input_mode, "input_mode"},
                                       {ParameterId::control_mode, "control_mode"},
                                       {ParameterId::resolutions, "resolutions"},
                                       {ParameterId::offsets, "offsets"},
                                       {ParameterId::multipliers, "multipliers"},
                                       {ParameterId::limits_on, "limits_on"},
                                       {ParameterId::limits, "limits"},
                                       {ParameterId::max_steps, "max_steps"},
                                       {ParameterId::current_limit, "current_limit"},
                                       {ParameterId::rate_limiter, "rate_limiter"},
                                       {ParameterId::serial_number, "serial_number"}}};

constexpr std::uint8_t kMotorsOn = 3;
constexpr double kMostGain = 32767;             // 16.16 fixed point
constexpr std::int32_t kMostRaw = 127 * 65536;  // the unit counts turns in eight bits
constexpr int kMostResolution = 8;
constexpr double kMostMultiplier = 1e6;

constexpr std::array<std::string_view, 2> kOnOff{"off", "on"};
constexpr std::array<std::string_view, 2> kInputModes{"bus", "third_encoder"};
constexpr std::array<std::string_view, 6> kControlModes{"position",         "pwm",        "current",
                                                        "position_current", "deflection", "deflection_current"};

std::string word_text(std::span<const std::string_view> words, std::uint8_t value) {
  return value < words.size() ? std::string(words[value]) : fmt::format("{} (unknown)", value);
}

template <class T, std::size_t N>
std::vector<std::int32_t> widened(const std::array<T, N>& values) {
  return {values.begin(), values.end()};
}

std::string gains_text(const std::array<float, 3>& k) { return fmt::format("P {:.6g}, I {:.6g}, D {:.6g}", k[0], k[1], k[2]); }

std::string limits_text(const bus::ParameterValues& v) {
  return fmt::format("motor 1 {} … {}, motor 2 {} … {}", angle_text(v.limits[0], v.resolutions[0]),
                     angle_text(v.limits[1], v.resolutions[0]), angle_text(v.limits[2], v.resolutions[1]),
                     angle_text(v.limits[3], v.resolutions[1]));
}

std::array<float, 3> read_floats(ValueReader& reader, double most, const char* example) {
  std::array<float, 3> values{};
  if (!reader.expect(3, example)) return values;
  for (std::size_t i = 0; i < 3; ++i) values[i] = static_cast<float>(reader.number(i, -most, most, ""));
  return values;
}

std::uint8_t read_word(ValueReader& reader, std::span<const std::string_view> words) {
  return reader.expect(1, "one of its words") ? static_cast<std::uint8_t>(reader.word(0, words)) : std::uint8_t{0};
}

std::uint8_t read_byte(ValueReader& reader, int low, int high) {
  return reader.expect(1, "a number") ? static_cast<std::uint8_t>(reader.whole(0, low, high, "")) : std::uint8_t{0};
}

bus::ParameterValue read_resolutions(ValueReader& reader) {
  std::array<std::uint8_t, 3> values{};
  if (!reader.expect(3, "1 1 1")) return values;
  for (std::size_t i = 0; i < 3; ++i) values[i] = static_cast<std::uint8_t>(reader.whole(i, 0, kMostResolution, " bits"));
  return values;
}

bus::ParameterValue read_offsets(ValueReader& reader, const Resolutions& resolutions) {
  std::array<std::int16_t, 3> values{};
  if (!reader.expect(3, "0 0 0")) return values;
  for (std::size_t i = 0; i < 3; ++i)
    values[i] = static_cast<std::int16_t>(
        reader.ticks(i, resolutions[i], std::numeric_limits<std::int16_t>::min(), std::numeric_limits<std::int16_t>::max()));
  return values;
}

template <std::size_t N>
bus::ParameterValue read_ticks(ValueReader& reader, const char* example, const std::array<std::uint8_t, N>& resolutions) {
  std::array<std::int32_t, N> values{};
  if (!reader.expect(N, example)) return values;
  for (std::size_t i = 0; i < N; ++i) {
    const std::int32_t most = kMostRaw >> std::min<int>(resolutions[i], 31);  // the unit takes any byte for one
    values[i] = reader.ticks(i, resolutions[i], -most, most);
  }
  return values;
}

bus::ParameterValue read_limits(ValueReader& reader, const Resolutions& r) {
  const auto value = read_ticks<4>(reader, "-160 160 -160 160", {r[0], r[0], r[1], r[1]});
  const auto& limits = std::get<std::array<std::int32_t, 4>>(value);
  for (std::size_t i = 0; i < 4; i += 2)
    if (limits[i] > limits[i + 1]) reader.refuse(i, "above the upper limit", "lower and upper of motor 1, then of motor 2");
  return value;
}

/// The unit leaves out one of the wrong sign, and stores the other.
bus::ParameterValue read_max_steps(ValueReader& reader, const Resolutions& r) {
  const auto value = read_ticks<2>(reader, "-10 10", {r[0], r[0]});
  const auto& steps = std::get<std::array<std::int32_t, 2>>(value);
  constexpr const char* kAllowed = "-10 10: lowest ≤ 0, highest ≥ 0";
  if (steps[0] > 0) reader.refuse(0, "above 0", kAllowed);
  if (steps[1] < 0) reader.refuse(1, "below 0", kAllowed);
  return value;
}

}  // namespace

std::vector<std::string> unit_parameter_names(bus::Dialect dialect) {
  std::vector<std::string> names;
  for (const Name& n : kNames)
    if (bus::find_parameter(dialect, static_cast<std::uint16_t>(n.id)) != nullptr) names.emplace_back(n.name);
  return names;
}

std::optional<ParameterId> unit_parameter_named(bus::Dialect dialect, std::string_view name) {
  const auto at = std::find_if(kNames.begin(), kNames.end(), [name](const Name& n) { return n.name == name; });
  if (at == kNames.end() || bus::find_parameter(dialect, static_cast<std::uint16_t>(at->id)) == nullptr) return std::nullopt;
  return at->id;
}

ParameterId need_unit_parameter(bus::Dialect dialect, const std::string& name, std::span<const std::string_view> things) {
  if (const auto id = unit_parameter_named(dialect, name)) return *id;
  throw InputError({"", "WHAT", name, "is nothing that this unit has",
                    fmt::format("{}, {}", fmt::join(things, ", "), fmt::join(unit_parameter_names(dialect), ", "))});
}

void check_unit_word(const std::string& name, std::span<const std::string_view> things) {
  if (std::find(things.begin(), things.end(), name) == things.end())
    static_cast<void>(need_unit_parameter(bus::Dialect::seven, name, things));
}

bool same_unit_value(const bus::ParameterValue& a, const bus::ParameterValue& b) {
  const auto* x = std::get_if<std::array<float, 3>>(&a);
  const auto* y = std::get_if<std::array<float, 3>>(&b);
  if (x == nullptr || y == nullptr) return a == b;
  return std::equal(x->begin(), x->end(), y->begin(),
                    [](double u, double v) { return std::abs(u - v) <= 1 / 65536.0 + 1e-6 * std::abs(v); });
}

std::string unit_parameter_text(const bus::ParameterValues& v, ParameterId id) {
  switch (id) {
    case ParameterId::id:
      return std::to_string(v.id);
    case ParameterId::position_pid:
      return gains_text(v.position_pid);
    case ParameterId::current_pid:
      return gains_text(v.current_pid);
    case ParameterId::startup_activation:
      return v.startup_activation == kMotorsOn ? "on" : fmt::format("off ({})", v.startup_activation);
    case ParameterId::input_mode:
      return word_text(kInputModes, v.input_mode);
    case ParameterId::control_mode:
      return word_text(kControlModes, v.control_mode);
    case ParameterId::resolutions:
      return fmt::format("{} {} {} bits", v.resolutions[0], v.resolutions[1], v.resolutions[2]);
    case ParameterId::offsets:
      return angles_text(widened(v.offsets), v.resolutions);
    case ParameterId::multipliers:
      return fmt::format("{:.6g} {:.6g} {:.6g}", v.multipliers[0], v.multipliers[1], v.multipliers[2]);
    case ParameterId::limits_on:
      return v.limits_on == 0 ? "off" : "on";
    case ParameterId::limits:
      return limits_text(v);
    case ParameterId::max_steps:
      return fmt::format("{} … {} (the unit doesn't use them)", angle_text(v.max_steps[0], v.resolutions[0]),
                         angle_text(v.max_steps[1], v.resolutions[0]));
    case ParameterId::current_limit:
      return fmt::format("{} mA", v.current_limit);
    case ParameterId::rate_limiter:
      return std::to_string(v.rate_limiter);
    case ParameterId::serial_number:
      return std::to_string(v.serial_number);
  }
  return "";
}

bus::ParameterValue read_unit_parameter(ValueReader& reader, ParameterId id, const Resolutions& resolutions) {
  constexpr int kMost_mA = std::numeric_limits<std::int16_t>::max();
  switch (id) {
    case ParameterId::id:
      return read_byte(reader, 1, 254);
    case ParameterId::position_pid:
    case ParameterId::current_pid:
      return read_floats(reader, kMostGain, "0.1 0 0.8");
    case ParameterId::startup_activation:
      return static_cast<std::uint8_t>(kMotorsOn * read_word(reader, kOnOff));
    case ParameterId::input_mode:
      return read_word(reader, kInputModes);
    case ParameterId::control_mode:
      return read_word(reader, kControlModes);
    case ParameterId::resolutions:
      return read_resolutions(reader);
    case ParameterId::offsets:
      return read_offsets(reader, resolutions);
    case ParameterId::multipliers:
      return read_floats(reader, kMostMultiplier, "1 1 1");
    case ParameterId::limits_on:
      return read_word(reader, kOnOff);
    case ParameterId::limits:
      return read_limits(reader, resolutions);
    case ParameterId::max_steps:
      return read_max_steps(reader, resolutions);
    case ParameterId::current_limit:
      return static_cast<std::int16_t>(reader.expect(1, "1500") ? reader.whole(0, 0, kMost_mA, " mA") : 0);
    case ParameterId::rate_limiter:
      return read_byte(reader, 0, 255);
    case ParameterId::serial_number:
      return static_cast<std::uint32_t>(reader.expect(1, "a number") ? reader.whole(0, 0, 0xFFFFFFFF, "") : 0);
  }
  return std::uint8_t{0};
}

}  // namespace vsa::config
