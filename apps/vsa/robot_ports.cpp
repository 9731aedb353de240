// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "robot_ports.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "vsa/errors.hpp"
#include "vsa/serial/ports.hpp"

namespace vsa::app {
namespace {

/// "3, 7": what hangs on a bus.
std::string ids_on(const host::RobotConfig& config, std::size_t bus) {
  std::vector<int> ids;
  for (const auto& actuator : config.actuators)
    if (actuator.bus == bus) ids.push_back(actuator.id);
  return fmt::format("{}", fmt::join(ids, ", "));
}

}  // namespace

RobotPorts::RobotPorts(engine::World& world, const std::function<void(const std::string&)>& report) {
  Problems problems;
  for (std::size_t r = 0; r < world.robot_count(); ++r) {
    host::Robot& robot = world.robot(r);
    for (std::size_t b = 0; b < robot.config().buses.size(); ++b) {
      device::PortLine* line = robot.serial_line(b);
      if (line == nullptr) continue;
      const host::BusConfig& bus = robot.config().buses[b];
      try {
        ports_.push_back(std::make_unique<serial::VirtualPort>(
            *line, serial::VirtualPortOptions{serial::port_path(bus.serial_port.value_or(bus.name))}));
        report(fmt::format("serial port {}: bus {} of {}, units {}; vsa ping {}", ports_.back()->path(), bus.name,
                           world.robot_model(r), ids_on(robot.config(), b), ports_.back()->path()));
      } catch (const InputError& error) {
        problems.add_all(error);
      }
    }
  }
  problems.throw_if_any();
}

std::vector<record::Statistic> RobotPorts::statistics() const {
  std::vector<record::Statistic> out;
  for (const auto& port : ports_) {
    const serial::PortCounters n = port->counters();
    out.push_back({"serial port", fmt::format("{}: {} exchanges, {} bytes in, {} out, {} dropped; longest service {:.3f} ms",
                                              port->path(), n.exchanges, n.bytes_in, n.bytes_out, n.bytes_dropped,
                                              static_cast<double>(n.longest_service_ns) * 1e-6)});
  }
  return out;
}

}  // namespace vsa::app
