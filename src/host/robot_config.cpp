// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/host/robot_config.hpp"

#include <cmath>

#include "vsa/checks.hpp"

namespace vsa::host {
namespace {

void check_actuator(const RobotConfig& config, std::size_t i, std::string_view where, Problems& problems) {
  const ActuatorConfig& a = config.actuators[i];
  Checks check(where, problems);
  device::validate(a.unit, std::string(where) + a.name + ": ", problems);
  if (a.id < 1 || a.id > 254) check.refuse(a.name, std::to_string(a.id), "id is out of range", "1 … 254");
  if (!std::isfinite(a.initial_equilibrium_rad) || !std::isfinite(a.initial_preset))
    check.refuse(a.name, "", "initial command isn't finite", "finite numbers");
  if (a.bus >= config.buses.size()) check.refuse(a.name, std::to_string(a.bus), "no such bus", "an index into buses");
  if (a.unit.servo && a.bus < config.buses.size() && config.buses[a.bus].serial_port)
    check.refuse(a.name, std::string(control::name_of(a.unit.servo->kind)),
                 "has no line: its bus " + config.buses[a.bus].name + " can't have a serial port",
                 "a bus without a port, or an actuator type with control.kind = qbmove");
  for (std::size_t j = 0; j < i; ++j) {
    const ActuatorConfig& b = config.actuators[j];
    if (a.name == b.name) check.refuse(a.name, "", "two actuators have this name", "unique names");
    if (a.joint == b.joint) check.refuse(a.name, a.joint, "joint is driven by " + b.name + " already", "one actuator a joint");
    if (a.bus == b.bus && a.id == b.id)
      check.refuse(a.name, std::to_string(a.id), "id is used by " + b.name + " on the same bus", "unique ids on a bus");
  }
}

}  // namespace

void validate(const RobotConfig& config, std::string_view where, Problems& problems) {
  Checks check(where, problems);
  for (std::size_t i = 0; i < config.actuators.size(); ++i) check_actuator(config, i, where, problems);
  for (const BusConfig& b : config.buses) {
    if (!(b.baud_Hz >= 1 && b.baud_Hz <= 1e9)) check.refuse(b.name, Checks::text(b.baud_Hz), "no such baud rate", "1 … 1e9");
    if (b.cycle_s && !(*b.cycle_s >= 1e-6 && *b.cycle_s <= 1e6))
      check.refuse(b.name, Checks::text(*b.cycle_s), "cycle is out of range", "1e-6 … 1e6 s");
  }
  const auto rate = [&](const char* key, double rate_Hz) {
    if (!(rate_Hz > 0 && rate_Hz <= 1e9)) check.refuse(key, Checks::text(rate_Hz), "is out of range", "above 0, up to 1e9");
  };
  rate("state_rate_Hz", config.state_rate_Hz);
  if (config.record) rate("record.rate_Hz", config.record->rate_Hz);
  if (const int n = config.substeps.value_or(1); n < 1 || n > kMostSubsteps)
    check.refuse("substeps", std::to_string(n), "is out of range", "1 … " + std::to_string(kMostSubsteps));
}

}  // namespace vsa::host
