// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "fmu/unit_variables.hpp"

#include <string>
#include <utility>

#include "vsa/elastic/transmission.hpp"
#include "vsa/units.hpp"

namespace vsa::fmu {
namespace {

class List {
 public:
  explicit List(Names names) : gazebo_(names == Names::gazebo_fmi) {}

  Reference add(Variable v) {
    variables_.push_back(std::move(v));
    return static_cast<Reference>(variables_.size() - 1);
  }
  /// `gazebo`: what the actuator plug-in of robotology/gazebo-fmi calls it.
  Reference input(const std::string& name, const char* gazebo, const std::string& unit, const std::string& description) {
    return add(named(name, gazebo, unit, description, Causality::input));
  }
  Reference output(const std::string& name, const std::string& unit, const std::string& description,
                   std::vector<Reference> depends_on = {}, const char* gazebo = nullptr) {
    Variable v = named(name, gazebo, unit, description, Causality::output);
    v.depends_on = std::move(depends_on);
    return add(std::move(v));
  }
  [[nodiscard]] std::vector<Variable> take() { return std::move(variables_); }

 private:
  [[nodiscard]] Variable named(const std::string& name, const char* gazebo, const std::string& unit, const std::string& description,
                               Causality causality) const {
    Variable v;
    v.name = gazebo_ && gazebo != nullptr ? gazebo : name;
    v.unit = unit_name(unit);
    v.description = description;
    v.causality = causality;
    if (causality == Causality::input) {
      v.min = -kFarthest;
      v.max = kFarthest;
    }
    return v;
  }

  bool gazebo_;
  std::vector<Variable> variables_;
};

/// A unit of the shaft's, as the actuator has it.
std::string shaft(const config::ActuatorType& type, std::string_view unit) {
  return type.unit.actuator.linear() ? sliding(unit) : std::string(unit);
}

void add_commands(const config::ActuatorType& type, List& list, UnitPlaces& p) {
  const device::UnitConfig& unit = type.unit;
  if (unit.is(control::ServoKind::motor_voltages)) {
    for (std::size_t m = 0; m < p.motors; ++m)
      p.direct[m] = list.input("motor_" + std::to_string(m + 1) + "_voltage", m == 0 ? "actuatorInput" : nullptr, "V",
                               "voltage of motor " + std::to_string(m + 1) + ", within the supply");
    return;
  }
  p.equilibrium = list.input("equilibrium", "actuatorInput", shaft(type, "rad"), "commanded equilibrium position of the shaft");
  if (!unit.preset_unit().empty())
    p.preset = list.input("preset", nullptr, std::string(unit.preset_unit()), "commanded stiffness preset");
  if (unit.is(control::ServoKind::torque_servo))
    p.direct[0] = list.input("feedforward_torque", nullptr, shaft(type, "N·m"),
                             "torque on the shaft beside what the commanded stiffness gives");
}

void add_outputs(const config::ActuatorType& type, List& list, UnitPlaces& p) {
  p.torque =
      list.output("torque", shaft(type, "N·m"), "on the shaft by springs and frictions, at the communication point", {p.angle});
  p.mean_torque =
      list.output("mean_torque", shaft(type, "N·m"), "the same, mean over the last communication step", {}, "jointTorque");
  p.stiffness = list.output("stiffness", shaft(type, "N·m/rad"), "of the springs about the shaft, pulleys held", {p.angle});
  p.deflection = list.output("deflection", shaft(type, "rad"), "shaft less attained equilibrium", {p.angle});
  p.equilibrium_attained = list.output("equilibrium_attained", shaft(type, "rad"), "where the pulleys put the equilibrium");
  if (const std::string unit(type.unit.actuator.transmission->preset_unit()); !unit.empty())
    p.preset_attained = list.output("preset_attained", unit, "where the pulleys put the preset");
  for (std::size_t m = 0; m < p.motors; ++m) {
    const std::string motor = "motor_" + std::to_string(m + 1), of = " of motor " + std::to_string(m + 1);
    p.motor[m] = {list.output(motor + "_angle", "rad", "angle at the pulley" + of),
                  list.output(motor + "_speed", "rad/s", "speed at the pulley" + of),
                  list.output(motor + "_current", "A", "current" + of)};
  }
  p.energy_supply = list.output("energy_supply", "J", "drawn from the supply since the start");
  p.energy_delivered = list.output("energy_delivered", "J", "given to the shaft since the start");
  p.energy_stored = list.output("energy_stored", "J", "in springs, motors and presliding, less that of the start");
  p.energy_lost = list.output("energy_lost", "J", "turned to heat since the start");
}

void add_coupling(const config::ActuatorType& type, List& list, UnitPlaces& p) {
  Variable coupling;
  coupling.name = "coupling";
  coupling.description =
      "prescribed: the importer moves the shaft; implicit: it steps this unit first and applies mean_torque over the same step";
  coupling.kind = Kind::enumeration;
  coupling.causality = Causality::parameter;
  coupling.variability = Variability::fixed;
  coupling.words = {"prescribed", "implicit"};
  coupling.start = 1;
  coupling.min = 1;
  coupling.max = 2;
  p.coupling = list.add(std::move(coupling));
  Variable inertia;
  inertia.name = std::string(kLoadInertia);
  inertia.unit = unit_name(shaft(type, "kg·m²"));
  inertia.description =
      "behind the shaft; 0: unknown, and no warning of steps that are too long. In the bare unit: shaft.inertia_kgm2, or of a "
      "linear "
      "actuator the mass shaft.mass_kg";
  inertia.causality = Causality::parameter;
  inertia.variability = Variability::tunable;
  inertia.min = 0;
  inertia.max = kFarthest;
  p.load_inertia = list.add(std::move(inertia));
  for (const config::Entry& entry : type.entries) {
    if (std::optional<Variable> v = variable_of(entry)) p.keys.push_back(list.add(std::move(*v)));
  }
}

}  // namespace

std::vector<Variable> unit_variables(const config::ActuatorType& type, Names names, UnitPlaces& p) {
  List list(names);
  p = {};
  p.motors = static_cast<std::size_t>(type.unit.actuator.transmission->motor_count());
  Variable time;
  time.name = "time";
  time.unit = "s";
  time.description = "simulation time";
  time.causality = Causality::independent;
  list.add(std::move(time));
  p.angle = list.input("shaft_angle", "jointPosition", shaft(type, "rad"), "of the shaft at the communication point");
  p.speed = list.input("shaft_speed", "jointVelocity", shaft(type, "rad/s"), "of the shaft at the communication point");
  p.acceleration = list.input("shaft_acceleration", "jointAcceleration", shaft(type, "rad/s²"),
                              "until the next communication point; 0: the speed stays. Of no effect where coupling is implicit");
  add_commands(type, list, p);
  add_outputs(type, list, p);
  add_coupling(type, list, p);
  return list.take();
}

}  // namespace vsa::fmu
