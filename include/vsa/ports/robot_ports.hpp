// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The virtual serial ports of a robot's buses that have one (<serial_port> in the plug-in's XML).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vsa/host/robot.hpp"
#include "vsa/serial/virtual_port.hpp"

namespace vsa::ports {

using Report = std::function<void(const std::string&)>;  ///< gets one readable line

/// The open serial ports of a robot's buses; they close with the object.
class RobotPorts {
 public:
  /// Opens the robot's ports; `report` gets a line a port. Throws InputError with every one that can't be had. The robot must
  /// outlive this.
  void open(host::Robot& robot, const std::string& model, const Report& report);

  /// In the order of its buses.
  [[nodiscard]] const std::vector<std::unique_ptr<serial::VirtualPort>>& all() const noexcept { return ports_; }

 private:
  std::vector<std::unique_ptr<serial::VirtualPort>> ports_;
};

}  // namespace vsa::ports
