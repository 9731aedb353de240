// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A unit's values as people read and write them. Angles in degrees, or in the unit's ticks with the word behind the number: "10",
// "10deg", "910ticks". A turn is 65536 raw, a tick is raw >> resolution of that encoder.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/bus/parameters.hpp"
#include "vsa/errors.hpp"

namespace vsa::config {

using Resolutions = std::array<std::uint8_t, 3>;  ///< motor 1, motor 2, shaft

[[nodiscard]] double degrees_of(double ticks, std::uint8_t resolution);  ///< of an encoder
/// "10.00° (910 ticks)"
[[nodiscard]] std::string angle_text(std::int32_t ticks, std::uint8_t resolution);
/// "motor 1 10.00° (910 ticks), motor 2 …, shaft …", as many as there are.
[[nodiscard]] std::string angles_text(const std::vector<std::int32_t>& ticks, const Resolutions& resolutions);

/// Reads values one by one and collects what is wrong with them.
class ValueReader {
 public:
  /// `what` leads every problem's key.
  ValueReader(std::string what, std::vector<std::string> values) : what_(std::move(what)), values_(std::move(values)) {}

  /// False, and a problem, unless there are so many.
  bool expect(std::size_t count, const std::string& example);
  /// Ends included; else a problem, and 0. `index` below size(): expect() sees to it.
  [[nodiscard]] double number(std::size_t index, double low, double high, const std::string& unit);
  /// Likewise, without a fraction.
  [[nodiscard]] std::int64_t whole(std::size_t index, std::int64_t low, std::int64_t high, const std::string& unit);
  /// An angle of that encoder; in degrees, or with the word "ticks".
  [[nodiscard]] std::int32_t ticks(std::size_t index, std::uint8_t resolution, std::int32_t low, std::int32_t high);
  /// One of the words, by its place, or that place as a number.
  [[nodiscard]] std::size_t word(std::size_t index, std::span<const std::string_view> words);
  [[nodiscard]] std::size_t size() const noexcept { return values_.size(); }  ///< how many there are
  void throw_if_any() const { problems_.throw_if_any(); }                     ///< InputError with all problems

  void refuse(std::size_t index, const std::string& why, const std::string& allowed);  ///< adds a problem of that value

 private:
  std::string what_;
  std::vector<std::string> values_;
  Problems problems_;
};

/// Names of parameters: "position_pid", "control_mode"…; in order of their numbers.
[[nodiscard]] std::vector<std::string> unit_parameter_names(bus::Dialect dialect);
/// None: no such name in this dialect.
[[nodiscard]] std::optional<bus::ParameterId> unit_parameter_named(bus::Dialect dialect, std::string_view name);
/// As above; throws InputError, which also names the other `things` that could be meant.
[[nodiscard]] bus::ParameterId need_unit_parameter(bus::Dialect dialect, const std::string& name,
                                                   std::span<const std::string_view> things);
/// Throws InputError: neither one of the things nor a parameter of any dialect.
void check_unit_word(const std::string& name, std::span<const std::string_view> things);
/// Its value with unit, for people.
[[nodiscard]] std::string unit_parameter_text(const bus::ParameterValues& values, bus::ParameterId id);
/// Problems are the reader's; then the value means nothing.
[[nodiscard]] bus::ParameterValue read_unit_parameter(ValueReader& reader, bus::ParameterId id, const Resolutions& resolutions);
/// Equal, but for the unit's own rounding of gains to 16.16 fixed point.
[[nodiscard]] bool same_unit_value(const bus::ParameterValue& a, const bus::ParameterValue& b);

}  // namespace vsa::config
