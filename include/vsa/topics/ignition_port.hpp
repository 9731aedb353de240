// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// host::TopicPort on ignition-transport 11 with stock messages: Double, JointTrajectory, Actuators and Model, simulated stamps.
#pragma once

#include <memory>
#include <string>

#include "vsa/host/topics.hpp"

namespace vsa::topics {

/// Once the port is destroyed no handler runs any more; publishers that outlive it say that nobody listens.
class IgnitionPort final : public host::TopicPort {
 public:
  IgnitionPort();
  ~IgnitionPort() override;
  IgnitionPort(const IgnitionPort&) = delete;
  IgnitionPort& operator=(const IgnitionPort&) = delete;

  host::Outcome on_double(const std::string& topic, std::function<void(double)> handler) override;
  host::Outcome on_trajectory(const std::string& topic, std::function<void(const host::Trajectory&)> handler) override;
  host::Outcome on_actuators(const std::string& topic, std::function<void(const host::ActuatorsCmd&)> handler) override;
  std::unique_ptr<host::Publisher<double>> advertise_double(const std::string& topic) override;
  std::unique_ptr<host::Publisher<host::JointStates>> advertise_states(const std::string& topic) override;

  /// Asks the transport who listens, for all publishers. That takes its lock for each, so do it a few times a wall second, not at
  /// the state rate; until the first call nobody is taken to listen.
  void refresh_listeners();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsa::topics
