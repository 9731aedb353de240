// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "vsa/page/json.hpp"
#include "vsa/units.hpp"

namespace vsa::page {

/// Results of a linear actuator: all keys of its shaft in m and N, those of motors and pulleys as they are.
[[nodiscard]] inline Json sliding_keys(const Json& from) {
  if (!from.is_array() && !from.is_object()) return from;
  Json out = from.is_array() ? Json::array() : Json::object();
  for (const auto& [key, value] : from.items()) {
    if (from.is_array()) {
      out.push_back(sliding_keys(value));
    } else {
      out[key.rfind("pulley_", 0) == 0 || key.rfind("motor_", 0) == 0 ? key : sliding(key)] = sliding_keys(value);
    }
  }
  return out;
}

}  // namespace vsa::page
