// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The virtual serial ports of the buses that have one (<serial_port> in the plug-in's XML).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vsa/engine/world.hpp"
#include "vsa/record/page.hpp"
#include "vsa/serial/virtual_port.hpp"

namespace vsa::app {

class RobotPorts {
 public:
  /// Opens them all, or throws InputError with every one that can't be had. `report` gets a line a port. The world must outlive it.
  RobotPorts(engine::World& world, const std::function<void(const std::string&)>& report);

  [[nodiscard]] bool empty() const noexcept { return ports_.empty(); }
  /// What each did, for the run's summary.
  [[nodiscard]] std::vector<record::Statistic> statistics() const;

 private:
  std::vector<std::unique_ptr<serial::VirtualPort>> ports_;
};

}  // namespace vsa::app
