// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A state as numbers: a flat array of doubles whose layout is published, and a copy of which is a snapshot.
//
//   kind      numbers   is
//   real      1         the double itself, bit for bit: −0 and every NaN, too
//   single    1         a float, exact; a NaN's payload is kept
//   whole     1         an integer of up to 32 bits, exact
//   wide      2         an integer of 64 bits: high·2³² + low; high carries the sign, low is 0 … 2³² − 1
//   flag      1         0 or 1
//   choice    1         one of an enumeration, from 0
//   bytes     1 per 6   bytes b₀ … b₅ as Σ b_k·256^k
//
// An array has as many times that. What has no fixed size stands with a count and room up to a bound; what the count leaves is
// zero. So equal states have equal numbers, and what restore() takes save() gives back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vsa {

/// What one number of the array is, or two: a double, a float, an integer of up to 32 or of 64 bits, a flag, one of an enumeration,
/// six bytes.
enum class StateKind : std::uint8_t { real, single, whole, wide, flag, choice, bytes };
[[nodiscard]] std::string_view name_of(StateKind kind) noexcept;  ///< "real", "single", …

/// One member's part of the array.
struct StateEntry {
  std::string name;                  ///< "robot[0]/elbow/unit.physics.motor[1].angle"
  std::string unit;                  ///< "rad"; empty: a number
  StateKind kind = StateKind::real;  ///< what it is
  std::size_t offset = 0,            ///< where in the array
      count = 0;                     ///< how many doubles
};

/// What each number of an array is, in order and without gaps.
class StateLayout {
 public:
  void add(std::string name, std::string unit, StateKind kind, std::size_t count);  ///< at the end, without a gap
  void append(std::string_view prefix, const StateLayout& other);  ///< its entries behind these, their names behind `prefix`

  [[nodiscard]] const std::vector<StateEntry>& entries() const noexcept { return entries_; }  ///< in order
  [[nodiscard]] std::vector<StateEntry>& entries() noexcept { return entries_; }              ///< to give them other names
  [[nodiscard]] std::size_t size() const noexcept { return size_; }                           ///< of the array
  [[nodiscard]] const StateEntry* find(std::string_view name) const noexcept;                 ///< none: there is no such name
  [[nodiscard]] std::string name_at(std::size_t offset) const;  ///< of a number, with its place in the entry
  /// Of names, units, kinds and counts: arrays with the same hash mean the same.
  [[nodiscard]] std::uint64_t hash() const noexcept;

 private:
  std::vector<StateEntry> entries_;
  std::size_t size_ = 0;
};

/// Of the numbers' bits.
[[nodiscard]] std::uint64_t state_hash(std::span<const double> numbers) noexcept;
/// The first number whose bits differ, or the shorter one's end; none: all are the same.
[[nodiscard]] std::optional<std::size_t> first_difference(std::span<const double> a, std::span<const double> b) noexcept;

/// Why numbers are no state, or a state has no numbers.
struct StateFault {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();  ///< no fault
  std::size_t offset = kNone;                                                    ///< of the number that is wrong
  double value = 0;                                                              ///< what it was
  const char* message = "";                                                      ///< what is wrong
  const char* allowed = "";                                                      ///< in words; empty: low … high
  double low = 0,  ///< least that is allowed, where `allowed` is empty
      high = 0;    ///< most

  [[nodiscard]] bool there() const noexcept { return offset != kNone; }  ///< whether there is one
};

/// Throws InputError with the number's name, where there is a fault.
void throw_if_any(const StateFault& fault, const StateLayout& layout);
/// Throws InputError where a span hasn't that many.
void check_state_size(std::size_t given, std::size_t wanted);

}  // namespace vsa
