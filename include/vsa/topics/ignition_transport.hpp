// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// host::TopicTransport on ignition-transport 11 with stock messages: Double, JointTrajectory, Actuators, Model and StringMsg,
// simulated stamps.
#pragma once

#include <memory>
#include <string>

#include "vsa/host/topics.hpp"

namespace vsa::topics {

/// host::TopicTransport on ignition-transport 11. What is published is packed and sent by a thread of its own, within about a
/// millisecond of wall time and in order; it also asks the transport who listens, 50 times a second: until then nobody is taken to
/// listen. A publisher is for one thread at a time. Once the transport is destroyed, with all sent, no handler runs any more;
/// publishers that outlive it say that nobody listens.
class IgnitionTransport final : public host::TopicTransport {
 public:
  IgnitionTransport();
  ~IgnitionTransport() override;
  IgnitionTransport(const IgnitionTransport&) = delete;
  IgnitionTransport& operator=(const IgnitionTransport&) = delete;

  host::Outcome on_double(const std::string& topic, std::function<void(double)> handler) override;  ///< as ignition::msgs::Double
  /// As ignition::msgs::JointTrajectory.
  host::Outcome on_trajectory(const std::string& topic, std::function<void(const host::Trajectory&)> handler) override;
  /// As ignition::msgs::Actuators.
  host::Outcome on_actuators(const std::string& topic, std::function<void(const host::ActuatorsCmd&)> handler) override;
  host::Outcome serve_text(const std::string& service, Answer answer) override;  ///< StringMsg to StringMsg
  std::unique_ptr<host::Publisher<double>> advertise_double(const std::string& topic) override;
  /// As ignition::msgs::Model.
  std::unique_ptr<host::Publisher<host::JointStates>> advertise_states(const std::string& topic) override;

  /// Messages and requests that came, taken or refused. From any thread.
  [[nodiscard]] std::uint64_t heard() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsa::topics
