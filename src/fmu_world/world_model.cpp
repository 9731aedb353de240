// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/fmu_world/world_model.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "vsa/config/text.hpp"
#include "vsa/elastic/transmission.hpp"
#include "vsa/errors.hpp"
#include "vsa/units.hpp"

namespace vsa::fmu {
namespace {

/// As FMI's structured names have it: anything but an identifier stands in quotes.
std::string quoted(const std::string& name) {
  const auto plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  const bool identifier =
      !name.empty() && std::isdigit(static_cast<unsigned char>(name.front())) == 0 && std::all_of(name.begin(), name.end(), plain);
  return identifier ? name : "'" + name + "'";
}

Variable variable(const std::string& name, const std::string& unit, const std::string& description, Causality causality) {
  Variable v;
  v.name = name;
  v.unit = unit_name(unit);
  v.description = description;
  v.causality = causality;
  if (causality == Causality::input) {
    v.min = -kFarthest;
    v.max = kFarthest;
  }
  return v;
}

Variable output(const std::string& name, const std::string& unit, const std::string& description) {
  return variable(name, unit, description, Causality::output);
}

std::string name_of(const engine::World& world, const engine::ActuatorRef& ref) { return quoted(world.name_of(ref)); }

}  // namespace

WorldModel::WorldModel(engine::World world) : world_(std::move(world)) { add_variables(make_variables()); }

std::vector<Variable> WorldModel::make_variables() {
  std::vector<Variable> out;
  Variable time = variable("time", "s", "simulation time", Causality::independent);
  out.push_back(std::move(time));
  for (const engine::ActuatorRef& ref : world_.actuators()) add_actuator(out, ref, name_of(world_, ref) + ".");
  first_joint_ = static_cast<Reference>(out.size());
  for (const engine::JointInfo& j : world_.joints()) {
    const bool turns = j.type == engine::JointInfo::Type::revolute;
    if (j.actuator || !j.one_axis()) continue;
    joints_.push_back(world_.joint(j.name));
    out.push_back(output(quoted(j.name) + ".position", turns ? "rad" : "m", "of a joint without an actuator"));
    out.push_back(output(quoted(j.name) + ".speed", turns ? "rad/s" : "m/s", "of a joint without an actuator"));
  }
  first_model_ = static_cast<Reference>(out.size());
  for (std::size_t r = 0; r < world_.robot_count(); ++r) {
    const std::string model = world_.robot_model(r).substr(0, world_.robot_model(r).find("::"));
    if (std::find(models_.begin(), models_.end(), model) != models_.end()) continue;
    models_.push_back(model);
    for (const char* axis : {"x", "y", "z"})
      out.push_back(output(quoted(model) + ".center_of_mass_" + axis, "m", "of the whole model, in the world"));
  }
  first_energy_ = static_cast<Reference>(out.size());
  out.push_back(output("energy_supply", "J", "drawn from the supplies since the start"));
  out.push_back(output("energy_delivered", "J", "given to the joints since the start"));
  out.push_back(output("energy_lost", "J", "turned to heat in the actuators since the start"));
  out.push_back(output("energy_bodies", "J", "kinetic, gravitational and joint springs' energy of all bodies"));
  return out;
}

void WorldModel::add_actuator(std::vector<Variable>& out, const engine::ActuatorRef& ref, const std::string& prefix) {
  const host::ActuatorConfig& config = world_.robot(ref.robot).config().actuators[ref.index];
  // Of the shaft, whose numbers are m and N where it slides.
  const auto shaft = [slides = config.unit.actuator.linear()](std::string_view unit) {
    return slides ? sliding(unit) : std::string(unit);
  };
  Actuator a;
  a.ref = ref;
  a.voltages = config.unit.is(control::ServoKind::motor_voltages);
  a.has_preset = !a.voltages && !config.unit.preset_unit().empty();
  a.motors = static_cast<std::size_t>(config.unit.actuator.transmission->motor_count());
  a.equilibrium = static_cast<Reference>(out.size());
  if (a.voltages) {
    for (std::size_t m = 0; m < a.motors; ++m)
      out.push_back(variable(prefix + "motor_" + std::to_string(m + 1) + "_voltage", "V", "within the supply", Causality::input));
  } else {
    out.push_back(variable(prefix + "equilibrium", shaft("rad"), "commanded equilibrium position", Causality::input));
    out.back().start = config.initial_equilibrium_rad;
    if (a.has_preset) {
      out.push_back(
          variable(prefix + "preset", std::string(config.unit.preset_unit()), "commanded stiffness preset", Causality::input));
      out.back().start = config.initial_preset;
    }
  }
  a.preset = a.equilibrium + 1;
  a.first_output = static_cast<Reference>(out.size());
  out.push_back(output(prefix + "shaft_angle", shaft("rad"), "of the joint"));
  out.push_back(output(prefix + "shaft_speed", shaft("rad/s"), "of the joint"));
  out.push_back(output(prefix + "torque", shaft("N·m"), "on the joint by springs and frictions"));
  out.push_back(output(prefix + "mean_torque", shaft("N·m"), "the same, mean over the world's last step"));
  out.push_back(output(prefix + "stiffness", shaft("N·m/rad"), "of the springs about the shaft, pulleys held"));
  out.push_back(output(prefix + "deflection", shaft("rad"), "shaft less attained equilibrium"));
  out.push_back(output(prefix + "equilibrium_attained", shaft("rad"), "where the pulleys put the equilibrium"));
  const std::string preset(config.unit.actuator.transmission->preset_unit());
  out.push_back(output(prefix + "preset_attained", preset.empty() ? "1" : preset, "where the pulleys put the preset"));
  for (std::size_t m = 0; m < a.motors; ++m) {
    const std::string motor = prefix + "motor_" + std::to_string(m + 1);
    out.push_back(output(motor + "_angle", "rad", "at the pulley"));
    out.push_back(output(motor + "_current", "A", "of the motor"));
  }
  actuators_.push_back(std::move(a));
}

void WorldModel::begin_own() {
  world_.reset();
  for (Actuator& a : actuators_) {
    a.sent = {variables()[a.equilibrium].start, a.has_preset ? variables()[a.preset].start : 0.0};
    if (a.voltages) a.sent = {};
  }
  warned_ = false;
  send_commands();
}

void WorldModel::send_commands() {
  for (Actuator& a : actuators_) {
    const bool second = a.has_preset || (a.voltages && a.motors > 1);
    const std::array<double, 2> now{value(a.equilibrium), second ? value(a.preset) : 0.0};
    if (now == a.sent) continue;
    if (a.voltages) {
      world_.robot(a.ref.robot).command_direct(a.ref.index, now);
    } else {
      static_cast<void>(world_.command(a.ref, now[0], now[1]));
    }
    a.sent = now;
  }
}

void WorldModel::step_own(std::int64_t dt_ns) {
  const std::int64_t step_ns = std::llround(world_.step_s() * 1e9), until = time_ns() + dt_ns;
  if (until % step_ns != 0 && !warned_) {
    warned_ = true;
    tell("a communication point at " + config::number_text(static_cast<double>(until) * 1e-9) +
         " s lies between two steps of the world, which are " + config::number_text(world_.step_s()) +
         " s: outputs there are those of the step before");
  }
  send_commands();
  while (world_.time_ns() + step_ns <= until) world_.step();
  for (std::size_t r = 0; r < world_.robot_count(); ++r)
    for (const host::Notice& notice : world_.robot(r).take_notices()) tell(notice.text);
}

void WorldModel::evaluate(std::span<double> values) {
  for (const Actuator& a : actuators_) {
    const host::ActuatorReading now = world_.read(a.ref);
    Reference at = a.first_output;
    for (const double v : {now.shaft_rad, now.shaft_speed_rad_per_s, now.torque_Nm, now.mean_torque_Nm, now.stiffness_Nm_per_rad,
                           now.deflection_rad, now.equilibrium_rad, now.preset})
      values[at++] = v;
    for (std::size_t m = 0; m < a.motors; ++m) {
      values[at++] = now.motor_rad[m];
      values[at++] = now.current_A[m];
    }
  }
  Reference at = first_joint_;
  for (const engine::JointHandle joint : joints_) {
    values[at++] = world_.joint_angle(joint);
    values[at++] = world_.joint_speed(joint);
  }
  for (const std::string& model : models_)
    for (const double v : world_.center_of_mass(model)) values[at++] = v;
  const actuator::Ledger l = world_.ledger();
  const auto bodies = world_.energy();
  values[at++] = l.supply;
  values[at++] = l.delivered + l.pending;
  values[at++] = l.copper + l.bridge + l.conversion + l.viscous + l.motor_friction + l.shaft_friction + l.tendon_friction;
  values[at++] = bodies.kinetic + bodies.gravitational + bodies.springs;
}

std::size_t WorldModel::own_size() const { return world_.state_size() + 2 * actuators_.size() + 1; }

void WorldModel::save_own(std::span<double> out) const {
  std::size_t at = 0;
  out[at++] = warned_ ? 1 : 0;
  for (const Actuator& a : actuators_)
    for (const double v : a.sent) out[at++] = v;
  world_.save(out.subspan(at));
}

void WorldModel::restore_own(std::span<const double> in) {
  const std::size_t head = 1 + 2 * actuators_.size();
  world_.restore(in.subspan(head));
  warned_ = in[0] != 0;
  std::size_t at = 1;
  for (Actuator& a : actuators_)
    for (double& v : a.sent) v = in[at++];
}

}  // namespace vsa::fmu
