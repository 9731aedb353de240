// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Commands to a world's actuators, and what they are doing.
#include <cmath>
#include <cstddef>
#include <cstring>

#include "arrays.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "world.hpp"

namespace vsa::python {
namespace {

using host::ActuatorReading;
using Maybe = std::optional<double>;

py::dtype reading_dtype() {
#define FIELD(name) \
  { #name, offsetof(ActuatorReading, name) }
  return record_dtype({FIELD(equilibrium_command_rad),
                       FIELD(preset_command),
                       FIELD(equilibrium_rad),
                       FIELD(preset),
                       FIELD(shaft_rad),
                       FIELD(shaft_speed_rad_per_s),
                       FIELD(deflection_rad),
                       FIELD(stiffness_Nm_per_rad),
                       FIELD(torque_Nm),
                       FIELD(mean_torque_Nm),
                       {"motor_rad", offsetof(ActuatorReading, motor_rad), 2},
                       {"motor_speed_rad_per_s", offsetof(ActuatorReading, motor_speed_rad_per_s), 2},
                       {"motor_torque_Nm", offsetof(ActuatorReading, motor_torque_Nm), 2},
                       {"current_A", offsetof(ActuatorReading, current_A), 2},
                       {"measured_ticks", offsetof(ActuatorReading, measured), 3, "i2"}},
                      sizeof(ActuatorReading));
#undef FIELD
}

/// With zeros where the struct has padding, so that equal readings are equal bytes.
void put(void* to, const ActuatorReading& reading) {
  constexpr std::size_t kTold = offsetof(ActuatorReading, measured) + sizeof(ActuatorReading::measured);
  static_assert(sizeof(ActuatorReading) - kTold < alignof(ActuatorReading), "measured is its last member");
  std::memset(to, 0, sizeof reading);
  std::memcpy(to, &reading, kTold);
}

py::object read(PyWorld& w, const py::object& actuator, const py::object& out) {
  const auto& all = w.any_thread().actuators();
  if (!actuator.is_none()) {
    py::array one = into(out, reading_dtype(), {});
    const engine::ActuatorRef& which = w.actuator(actuator);
    put(one.mutable_data(), w.get().read(which));
    return out.is_none() ? py::object(one[py::tuple()]) : py::object(one);
  }
  py::array many = into(out, reading_dtype(), {static_cast<py::ssize_t>(all.size())});
  const engine::World& world = w.get();
  auto* to = static_cast<ActuatorReading*>(many.mutable_data());
  for (std::size_t i = 0; i < all.size(); ++i) put(to + i, world.read(all[i]));
  return many;
}

void check_finite(Problems& problems, const std::string& name, const char* key, const Maybe& value) {
  if (value && !std::isfinite(*value)) problems.add({name, key, config::number_text(*value), "isn't finite", "finite numbers"});
}

/// Taken at the next step's start; nothing of it where one isn't a number.
void command(PyWorld& w, const py::object& which, const Maybe& equilibrium, const Maybe& preset) {
  const engine::ActuatorRef& a = w.actuator(which);
  Problems problems;
  check_finite(problems, a.name, "equilibrium_rad", equilibrium);
  check_finite(problems, a.name, "preset", preset);
  problems.throw_if_any();
  w.any_thread().robot(a.robot).command(a.index, equilibrium, preset);
}

void command_all(PyWorld& w, const py::object& equilibrium, const py::object& preset) {
  engine::World& world = w.any_thread();
  const auto& all = world.actuators();
  std::vector<double> e, p;
  if (!equilibrium.is_none()) e = numbers(equilibrium, all.size(), "equilibrium_rad", true);
  if (!preset.is_none()) p = numbers(preset, all.size(), "preset", true);
  std::vector<std::vector<host::Robot::Command>> commands(world.robot_count());
  for (std::size_t i = 0; i < all.size(); ++i)
    commands[all[i].robot].push_back({all[i].index, e.empty() ? Maybe() : e[i], p.empty() ? Maybe() : p[i]});
  for (std::size_t r = 0; r < commands.size(); ++r) world.robot(r).command(commands[r]);
}

void place(PyWorld& w, const py::object& which, double angle, double preset, double speed, const Maybe& equilibrium) {
  const engine::ActuatorRef& a = w.actuator(which);
  w.get().place(a, {angle, preset, speed, equilibrium});
}

void command_direct(PyWorld& w, const py::object& which, double first, double second) {
  const engine::ActuatorRef& a = w.actuator(which);
  w.get().robot(a.robot).command_direct(a.index, {first, second});
}

py::list actuator_info(PyWorld& w) {
  py::list out;
  const engine::World& world = w.any_thread();
  for (std::size_t i = 0; i < world.actuators().size(); ++i) {
    const engine::ActuatorRef& a = world.actuators()[i];
    const host::ActuatorConfig& config = world.robot(a.robot).config().actuators[a.index];
    const elastic::Transmission& law = *config.unit.actuator.transmission;
    py::dict one;
    one["name"] = w.actuator_names()[i];
    one["model"] = a.model;
    one["joint"] = world.joints()[world.joint(a).index()].name;
    one["type"] = config.type;
    one["motors"] = law.motor_count();
    one["preset_unit"] = std::string(config.unit.preset_unit());
    one["preset_max"] = config.unit.preset_max;
    out.append(one);
  }
  return out;
}

std::vector<std::string> take_notices(PyWorld& w) {
  std::vector<std::string> out;
  engine::World& world = w.get();
  for (std::size_t r = 0; r < world.robot_count(); ++r)
    for (const host::Notice& n : world.robot(r).take_notices()) out.push_back(n.text);
  return out;
}

py::dict ledger(PyWorld& w, const py::object& which) {
  if (which.is_none()) return ledger_dict(w.get().ledger());
  const engine::ActuatorRef& a = w.actuator(which);
  return ledger_dict(w.get().robot(a.robot).ledger(a.index));
}

constexpr const char* kRead =
    "What the actuators are doing at the end of the last step: a structured ndarray (n,) in the order of `actuators`, or one "
    "record\n"
    "of one actuator. Its dtype is World.reading_dtype: float64 with units in the names, two for each motor's; measured_ticks is\n"
    "int16 (3,), as the bus master last read them. out: an array of that dtype and shape () or (n,), which is filled and "
    "returned;\n"
    "else a new one. A copy either way.";
constexpr const char* kCommandAll =
    "Commands all actuators in the order of `actuators`: equilibria in rad and presets in their law's unit, each (n,) or one "
    "number\n"
    "for all; None keeps them. From any thread. NaN, infinity or another shape: InputError, and nothing is commanded; no numbers:\n"
    "TypeError. What is out of range is clamped as the device does; take_notices() tells.";
constexpr const char* kPlace =
    "Puts an actuator and its joint somewhere as if it had been there for long, without a kick: shaft at angle_rad with a speed "
    "in\n"
    "rad/s, pulleys, frictions and program to match. equilibrium_rad: commanded; default: where the springs give no torque.\n"
    "Its kinematic loops go along, other actuators of theirs only where the loops leave no other way; joints that were put\n"
    "since the last step stay. InputError: beyond the joint's limits or the program's, where its loops don't get there, and\n"
    "where they would take another joint beyond its limits.";

}  // namespace

void bind_world_actuators(WorldClass& c) {
  c.def_property_readonly(
       "actuators", &PyWorld::actuator_names,
       "Names of the actuators, \"model/name\" where several models have one: list of str. All methods take a name\n"
       "or an index into this list.")
      .def("actuator_info", &actuator_info,
           "What is known of each actuator: list of dicts of name, model, joint, type, motors, preset_unit, preset_max.")
      .def("command", &command, py::arg("actuator"), py::arg("equilibrium_rad") = py::none(), py::arg("preset") = py::none(),
           "Commands one actuator from the next step on: equilibrium in rad, preset in the law's unit; None keeps it. From any "
           "thread.\n"
           "InputError: no such actuator, NaN or infinity. What is out of range is clamped as the device does; take_notices() "
           "tells.")
      .def("command_all", &command_all, py::arg("equilibrium_rad") = py::none(), py::arg("preset") = py::none(), kCommandAll)
      .def("read", &read, py::arg("actuator") = py::none(), py::arg("out") = py::none(), kRead)
      .def("place", &place, py::arg("actuator"), py::arg("angle_rad"), py::arg("preset"), py::arg("speed_rad_per_s") = 0.0,
           py::arg("equilibrium_rad") = py::none(), kPlace)
      .def(
          "command_direct", &command_direct, py::arg("actuator"), py::arg("first"), py::arg("second") = 0.0,
          "Past the law, from the next tick on: control.kind motor_voltages takes V for each motor, torque_servo N·m on the shaft.")
      .def("ledger", &ledger, py::arg("actuator") = py::none(),
           "Where the energy went since the start or the last reset, J: dict, of one actuator or summed over all.")
      .def("take_notices", &take_notices, "What was clamped or couldn't be resolved since the last call: list of str.");
  def_static_property(
      c, "reading_dtype", [](const py::object&) { return reading_dtype(); },
      "The dtype of read(): numpy.dtype, whose names carry the units. What each is, read() tells.");
}

}  // namespace vsa::python
