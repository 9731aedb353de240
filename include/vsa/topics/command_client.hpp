// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The other side: finds running robots, sends commands and sees their states. Messages can be lost while two processes find each
// other, so a client repeats a command until the state's own `commands` show it.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vsa/host/topics.hpp"

namespace vsa::topics {

/// A client of running robots, for one of them at a time.
class CommandClient {
 public:
  CommandClient();
  ~CommandClient();
  CommandClient(const CommandClient&) = delete;
  CommandClient& operator=(const CommandClient&) = delete;

  /// Scoped names ("a/b") of the robots whose joint_state is advertised now, sorted. Waits for the transport's first discovery.
  [[nodiscard]] std::vector<std::string> models() const;

  /// Follows one robot from now on. Throws InputError if the name can't be a topic.
  void watch(const std::string& model);
  /// The next state that arrives, none after `limit`. Without watch(): none.
  [[nodiscard]] std::optional<host::JointStates> wait_for_state(std::chrono::milliseconds limit);
  /// To the robot that is watched. What is lost is lost: see above.
  void send(const host::Trajectory& trajectory);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsa::topics
