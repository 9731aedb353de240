// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/ports/robot_ports.hpp"

#include "vsa/elastic/inverse.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/serial/ports.hpp"

namespace vsa::ports {
namespace {

/// "3, 7": what hangs on a bus.
std::string ids_on(const host::RobotConfig& config, std::size_t bus) {
  std::string ids;
  for (const auto& actuator : config.actuators)
    if (actuator.bus == bus) ids += (ids.empty() ? "" : ", ") + std::to_string(actuator.id);
  return ids;
}

/// "3": those for which equilibrium ± preset means nothing; "": none.
std::string others_on(const host::RobotConfig& config, std::size_t bus) {
  std::string ids;
  for (const auto& actuator : config.actuators) {
    if (actuator.bus != bus || elastic::antagonistic(*actuator.unit.actuator.transmission)) continue;
    ids += (ids.empty() ? "" : ", ") + std::to_string(actuator.id);
  }
  return ids;
}

}  // namespace

void RobotPorts::open(host::Robot& robot, const std::string& model, const Report& report) {
  Problems problems;
  for (std::size_t b = 0; b < robot.config().buses.size(); ++b) {
    device::PortLine* line = robot.serial_line(b);
    if (line == nullptr) continue;
    const host::BusConfig& bus = robot.config().buses[b];
    try {
      ports_.push_back(std::make_unique<serial::VirtualPort>(
          *line, serial::VirtualPortOptions{serial::port_path(bus.serial_port.value_or(bus.name))}));
      const std::string& path = ports_.back()->path();
      report("serial port " + path + ": bus " + bus.name + " of " + model + ", units " + ids_on(robot.config(), b) + "; vsa ping " +
             shell_word(path));
      if (const std::string others = others_on(robot.config(), b); !others.empty())
        report("serial port " + path + ": the references of unit " + others + " aren't equilibrium ± preset; use vsa set " +
               shell_word(path) + " inputs …");
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
  problems.throw_if_any();
}

}  // namespace vsa::ports
