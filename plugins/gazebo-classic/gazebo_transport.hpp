// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// host::TopicTransport on Gazebo Classic's own transport, so that `gz topic`, which every installation has, commands and shows a robot:
// single numbers that come in as gazebo.msgs.Any of type DOUBLE under the same names; all numbers that go out as one
// gazebo.msgs.Param_V, /model/M/vsa/readings, its parameters "time" and "joint_0/stiffness", …: a publisher each would slow the
// world's steps. Trajectories, arrays and joint states have no stock message there: they are on ignition-transport only.
#pragma once

#include <memory>
#include <string>

#include "vsa/host/topics.hpp"

namespace vsa::plugins {

class GazeboTransport final : public host::TopicTransport {
 public:
  GazeboTransport(const std::string& world, const std::string& model);  ///< model: scoped name
  ~GazeboTransport() override;                                          ///< no handler runs any more
  GazeboTransport(const GazeboTransport&) = delete;
  GazeboTransport& operator=(const GazeboTransport&) = delete;

  host::Outcome on_double(const std::string& topic, std::function<void(double)> handler) override;
  host::Outcome on_trajectory(const std::string&, std::function<void(const host::Trajectory&)>) override {
    return host::Outcome::unsupported;
  }
  host::Outcome on_actuators(const std::string&, std::function<void(const host::ActuatorsCmd&)>) override {
    return host::Outcome::unsupported;
  }
  host::Outcome serve_text(const std::string&, Answer) override { return host::Outcome::unsupported; }
  std::unique_ptr<host::Publisher<double>> advertise_double(const std::string& topic) override;
  std::unique_ptr<host::Publisher<host::JointStates>> advertise_states(const std::string&) override { return nullptr; }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsa::plugins
