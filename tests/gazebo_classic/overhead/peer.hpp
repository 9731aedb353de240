// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Another plug-in's world, timed beside ours. It has a process of its own: Gazebo's update event reaches every plug-in of a
// process, and not each asks whose world it is for.
#pragma once

#include <sys/types.h>

#include <string>

namespace vsa::test {

struct PeerCost {
  double step_us = 0;  ///< a whole step
  double call_us = 0;  ///< what listens to the begin of a step, all together
};

class Peer {
 public:
  /// Starts this program again, with the world of this file. Models and libraries are found by GAZEBO_MODEL_PATH and
  /// GAZEBO_PLUGIN_PATH. InputError where that world doesn't load or nothing listens there; its own process has said why. Before
  /// this process has threads.
  Peer(const std::string& world_file, const std::string& engine);
  ~Peer();
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  /// The mean over so many steps. Throws where the process is gone.
  [[nodiscard]] PeerCost run(int steps);

 private:
  pid_t process_ = -1;
  int line_ = -1;
};

/// The other process: answers on standard input, which is a socket, until that ends.
[[noreturn]] void serve_peer(const std::string& world_file, const std::string& engine);

}  // namespace vsa::test
