// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "record/log_messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "record/energy_columns.hpp"
#include "record/number_text.hpp"
#include "record/schema.hpp"

namespace vsa::record {
namespace {

using page::Json;
using schema::array_of;
using schema::object;
using schema::of_type;

using host::ActuatorReading;

struct Number {
  std::string_view name, description;
  double ActuatorReading::*value;
};

// One table makes the message and its schema.
constexpr std::array<Number, 9> kNumbers{{
    {"shaft_rad", "angle of the output shaft", &ActuatorReading::shaft_rad},
    {"shaft_speed_rad_per_s", "its speed", &ActuatorReading::shaft_speed_rad_per_s},
    {"equilibrium_command_rad", "commanded equilibrium", &ActuatorReading::equilibrium_command_rad},
    {"equilibrium_rad", "attained equilibrium, from the pulleys", &ActuatorReading::equilibrium_rad},
    {"preset_command", "commanded stiffness preset, in preset_unit", &ActuatorReading::preset_command},
    {"preset", "attained stiffness preset, in preset_unit", &ActuatorReading::preset},
    {"deflection_rad", "shaft less equilibrium", &ActuatorReading::deflection_rad},
    {"stiffness_Nm_per_rad", "stiffness at the shaft", &ActuatorReading::stiffness_Nm_per_rad},
    {"torque_Nm", "on the shaft by the actuator, at this time", &ActuatorReading::torque_Nm},
}};

struct MotorNumber {
  std::string_view name, description;
  std::array<double, 2> ActuatorReading::*value;
};

constexpr std::array<MotorNumber, 4> kMotorNumbers{{
    {"motor_rad", "angle of each motor's pulley", &ActuatorReading::motor_rad},
    {"motor_speed_rad_per_s", "speed of each motor's pulley", &ActuatorReading::motor_speed_rad_per_s},
    {"motor_torque_Nm", "spring load on each pulley, at this time", &ActuatorReading::motor_torque_Nm},
    {"current_A", "current of each motor", &ActuatorReading::current_A},
}};

constexpr std::string_view kTimeText = "simulated time; the message's log time in seconds";

void key(std::string& out, std::string_view name) {
  out += ",\"";
  out += name;
  out += "\":";
}

void member(std::string& out, std::string_view name, double value) {
  if (!std::isfinite(value)) return;
  key(out, name);
  put(out, value);
}

/// All or none: a list with a gap would name the wrong motor.
void member(std::string& out, std::string_view name, std::span<const double> values) {
  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) return;
  key(out, name);
  for (std::size_t i = 0; i < values.size(); ++i) {
    out += i == 0 ? '[' : ',';
    put(out, values[i]);
  }
  out += ']';
}

void begin(std::string& out, std::int64_t time_ns) {
  out = "{\"time_s\":";
  put(out, seconds_of(time_ns));
}

void actuator(std::string& out, const ActuatorInfo& info, const ActuatorReading& r) {
  out += "{\"name\":" + page::json_string(info.name);
  for (const Number& n : kNumbers) member(out, n.name, r.*n.value);
  key(out, "preset_unit");
  out += page::json_string(info.preset_unit);
  const auto motors = static_cast<std::size_t>(std::clamp(info.motors, 1, 2));
  for (const MotorNumber& n : kMotorNumbers) member(out, n.name, std::span(r.*n.value).first(motors));
  key(out, "measured_motor_ticks");
  for (std::size_t i = 0; i < motors; ++i) {
    out += i == 0 ? '[' : ',';
    put(out, r.measured[i].value);
  }
  out += ']';
  key(out, "measured_shaft_ticks");
  put(out, r.measured[2].value);
  out += '}';
}

std::string column_name(const EnergyColumn& c) { return std::string(c.name) + "_J"; }

}  // namespace

std::string actuators_schema() {
  Json fields{{"name", of_type("string", "the actuator's name")}};
  for (const Number& n : kNumbers) fields[std::string(n.name)] = of_type("number", n.description);
  fields["preset_unit"] = of_type("string", "of the preset, as the actuator's law or its servo has it; empty: none");
  for (const MotorNumber& n : kMotorNumbers) fields[std::string(n.name)] = array_of(of_type("number"), n.description);
  fields["measured_motor_ticks"] = array_of(of_type("integer"), "the unit's own reading of each motor, as its master last read it");
  fields["measured_shaft_ticks"] = of_type("integer", "the same of the shaft");
  return object("vsasim.ActuatorStates",
                {{"time_s", of_type("number", kTimeText)}, {"actuators", array_of(object("vsasim.ActuatorState", fields))}})
      .dump();
}

void actuators_message(std::string& out, std::int64_t time_ns, const RobotInfo& robot, std::span<const ActuatorReading> readings) {
  begin(out, time_ns);
  key(out, "actuators");
  out += '[';
  for (std::size_t i = 0; i < robot.actuators.size(); ++i) {
    if (i > 0) out += ',';
    actuator(out, robot.actuators[i], readings[i]);
  }
  out += "]}";
}

std::string energy_schema() {
  Json fields{{"time_s", of_type("number", kTimeText)}};
  for (const EnergyColumn& c : kEnergyColumns) fields[column_name(c)] = of_type("number");
  return object("vsasim.Energy", fields).dump();
}

void energy_message(std::string& out, const Sample& sample) {
  begin(out, sample.time_ns);
  for (const EnergyColumn& c : kEnergyColumns) member(out, column_name(c), c.value(sample));
  out += '}';
}

}  // namespace vsa::record
