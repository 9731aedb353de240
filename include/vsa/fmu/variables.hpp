// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What an FMU's importer sees of a model: a list of variables. A variable's value reference is its place in the list, whatever its
// type. Every value is kept as a double; whole numbers, switches and words (by their place, from 1 as FMI counts enumerations) are
// exact in it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/config/actuator_type.hpp"

namespace vsa::fmu {

using Reference = std::uint32_t;  ///< a variable's place in the list

/// A variable's kind of value.
enum class Kind { real, integer, boolean, enumeration };
/// What a variable is to its model; independent: time.
enum class Causality { independent, parameter, input, output };
/// fixed: until the end of the initialisation; tunable: at communication points, too.
enum class Variability { fixed, tunable, continuous };

/// One variable, as modelDescription.xml lists it.
struct Variable {
  std::string name;                                   ///< unique in the model
  std::string unit;                                   ///< "N.m/rad", as unit_name() has it; empty: a number without one
  std::string description;                            ///< one line
  Kind kind = Kind::real;                             ///< of its values
  Causality causality = Causality::output;            ///< to the model
  Variability variability = Variability::continuous;  ///< when it may change
  double start = 0;                                   ///< of parameters and inputs
  std::optional<double> min{},                        ///< end included; none: no bound
      max{};                                          ///< end included; none: no bound
  std::vector<std::string> words{};                   ///< of an enumeration
  /// Of an output: the inputs that it follows at once, without a step.
  std::vector<Reference> depends_on{};
};

/// The words for the actuator's joint: "shaft_angle", "torque" …, or those that robotology/gazebo-fmi's actuator plug-in looks for.
enum class Names { vsasim, gazebo_fmi };

/// A type's parameter as a variable; none: it names a file, which isn't the importer's to choose.
[[nodiscard]] std::optional<Variable> variable_of(const config::Entry& entry);
/// A parameter's value as a type's file would have it.
[[nodiscard]] std::string value_text(const Variable& variable, double value);

/// "N·m·s/rad" → "N.m.s/rad", "kg·m²" → "kg.m2", "Ω" → "Ohm": ASCII, as Modelica writes units. "1" → "".
[[nodiscard]] std::string unit_name(std::string_view unit);

/// Exponents of a unit in the SI's base, in FMI's words: {"kg", 1}, {"m", 2}, {"s", -2}, {"rad", -1}. `unit` as unit_name() has it.
/// None: it has a part that the SI doesn't know (ticks, %), so nothing converts it.
[[nodiscard]] std::optional<std::map<std::string, int>> base_units(std::string_view unit);

}  // namespace vsa::fmu
