// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// An actuator type's variables and where each stands.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "vsa/fmu/unit_model.hpp"

namespace vsa::fmu {

inline constexpr std::string_view kLoadInertia = "load_inertia_kg_m2";

struct UnitPlaces {
  struct Motor {
    Reference angle = 0, speed = 0, current = 0;
  };
  Reference angle = 0, speed = 0, acceleration = 0;
  std::optional<Reference> equilibrium, preset;
  std::array<std::optional<Reference>, 2> direct;  ///< past the law: motor voltages, or a servo's torque
  Reference torque = 0, mean_torque = 0, stiffness = 0, deflection = 0, equilibrium_attained = 0;
  std::optional<Reference> preset_attained;
  std::array<Motor, 2> motor;
  std::size_t motors = 0;
  Reference energy_supply = 0, energy_delivered = 0, energy_stored = 0, energy_lost = 0;
  Reference coupling = 0, load_inertia = 0;
  std::vector<Reference> keys;  ///< of the type's parameters
};

[[nodiscard]] std::vector<Variable> unit_variables(const config::ActuatorType& type, Names names, UnitPlaces& places);

}  // namespace vsa::fmu
