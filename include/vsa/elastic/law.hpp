// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A law that actuator types may name: src/elastic/laws/NAME.cpp has its equation, its parameters and what makes it, and nothing else
// has to know it: the build lists what is there. Documentation, files' checks and the property tests go over that list.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/elastic/transmission.hpp"

namespace vsa::elastic {

/// A number of the law's; a type's file has it as elastic.KEY.
struct LawParameter {
  std::string_view key,      ///< behind "elastic." in a file
      unit;                  ///< "rad", "N·m/rad"; empty for a plain number
  double min,                ///< least that is allowed
      max;                   ///< most that is allowed
  std::string_view meaning;  ///< one line for tables
};

/// A column of numbers in the file that a law is made of.
struct LawColumn {
  std::string_view name;     ///< as the file's first line has it, with its unit: "deflection_rad"
  double min,                ///< least that is allowed
      max;                   ///< most that is allowed
  bool needed;               ///< else 0 in every row of a file that hasn't the column
  std::string_view meaning;  ///< one line for tables
};

/// The file of a law that is made of one; a type's file names it as elastic.KEY.
struct LawFile {
  std::string_view key,                ///< behind "elastic." in a file
      meaning;                         ///< one line for tables
  std::span<const LawColumn> columns;  ///< that its first line must or may name
};

/// What is wrong between values that are fine one by one.
struct LawFault {
  std::string_view key;                           ///< which one to change
  std::string message,                            ///< what is wrong
      allowed;                                    ///< what would be right
  std::optional<std::size_t> row = std::nullopt;  ///< of the law's file
};

/// A law that actuator types may name: its parameters with their bounds, and what makes it. One const object a law; who uses it
/// keeps a pointer, so it lives as long as the process.
struct Law {
  std::string_view name;                     ///< as files write it
  std::string_view title;                    ///< for tables: "lever with a movable pivot"
  std::string_view equation;                 ///< in one line; H in J
  std::string_view source;                   ///< of the equation
  std::span<const LawParameter> parameters;  ///< each a key of the type's file
  /// Values in the order of the parameters, such as validate() has nothing against. After them the rows of the law's file, where it
  /// has one, each in the order of its columns.
  std::shared_ptr<const Transmission> (*make)(std::span<const double> values);
  /// Null: whatever is within the bounds goes together.
  std::optional<LawFault> (*fault)(std::span<const double> values) = nullptr;
  const LawFile* file = nullptr;  ///< null: the parameters are all that the law is made of
  /// What a user should know of the law that these values make, in a sentence; null: nothing.
  std::string (*remark)(std::span<const double> values) = nullptr;
};

/// Values as make() has them: their bounds, and what doesn't go together. What passes may be made.
void validate(const Law& law, std::span<const double> values, std::string_view where, Problems& problems);

/// All of the library, by name.
[[nodiscard]] std::span<const Law* const> laws() noexcept;

}  // namespace vsa::elastic
