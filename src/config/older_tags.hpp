// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The tags of the 2021 toolbox, one by one, and what each comes to here.
#pragma once

#include <string_view>

namespace vsa::config {

enum class Meaning {
  same,                     ///< the parameter `key`, in the same unit
  of_both_motors,           ///< the same, given for each motor
  friction_of_both_motors,  ///< the same, and the displacement before it slides with it
  mode,                     ///< operation_mode: 6 is how a unit is commanded here
  angle_limit,              ///< another meaning; the answer has the value converted from rad to raw
  another,                  ///< not the same: answered with `instead` and `why`
};

struct OlderTag {
  std::string_view name;
  Meaning meaning;
  std::string_view key;  ///< of the parameter
  std::string_view why, instead;
};

/// Null: no tag of an older plug-in.
[[nodiscard]] const OlderTag* find_older_tag(std::string_view name) noexcept;

}  // namespace vsa::config
