// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "peer.hpp"

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <iostream>
#include <stdexcept>

#include "classic_world.hpp"
#include "processor_time.hpp"
#include "vsa/errors.hpp"

namespace vsa::test {
namespace {

using std::chrono::steady_clock;

constexpr int kLoadSteps = 100;  // Gazebo loads a world's plug-ins within its first steps

bool receive(int line, void* to, std::size_t size) { return recv(line, to, size, MSG_WAITALL) == static_cast<ssize_t>(size); }

bool send_all(int line, const void* from, std::size_t size) {
  return send(line, from, size, MSG_NOSIGNAL) == static_cast<ssize_t>(size);
}

/// A world that has blown up tells nothing about a cost.
bool finite(const gazebo::physics::WorldPtr& world) {
  for (const auto& model : world->Models()) {
    for (const auto& joint : model->GetJoints()) {
      if (!std::isfinite(joint->Position(0)) || !std::isfinite(joint->GetVelocity(0))) return false;
    }
  }
  return true;
}

double us(steady_clock::duration time, int steps) { return std::chrono::duration<double, std::micro>(time).count() / steps; }

}  // namespace

Peer::Peer(const std::string& world_file, const std::string& engine) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) throw std::runtime_error("no socket for " + world_file);
  line_ = ends[0];
  process_ = fork();
  if (process_ == 0) {
    dup2(ends[1], STDIN_FILENO);
    execl("/proc/self/exe", "gazebo_classic_overhead", "peer", world_file.c_str(), engine.c_str(), nullptr);
    _exit(1);
  }
  close(ends[1]);
  try {
    (void)run(1);
  } catch (const std::runtime_error&) {
    throw InputError(
        {world_file, "", "", "can't be timed, its process said why", "a world whose models' plug-ins listen to a step's begin"});
  }
}

Peer::~Peer() {
  close(line_);
  if (process_ > 0) waitpid(process_, nullptr, 0);
}

PeerCost Peer::run(int steps) {
  PeerCost cost;
  if (!send_all(line_, &steps, sizeof steps) || !receive(line_, &cost, sizeof cost))
    throw std::runtime_error("the other world's process ended");
  return cost;
}

namespace {

void serve(const std::string& world_file, const std::string& engine) {
  start_server();
  std::chrono::nanoseconds begin{}, in_call{};
  using gazebo::event::Events;
  const auto before = Events::ConnectWorldUpdateBegin([&](const auto&) { begin = processor_time(); });
  ClassicWorld world(read_file(world_file), engine);
  world.world->Physics()->SetRealTimeUpdateRate(0);
  const unsigned alone =
      Events::worldUpdateBegin.ConnectionCount();  // ours and Gazebo's own; models load theirs in the first steps
  world.run(kLoadSteps);
  if (Events::worldUpdateBegin.ConnectionCount() == alone)
    throw std::runtime_error("no model's plug-in listens to the begin of a step");
  const auto after = Events::ConnectWorldUpdateBegin([&](const auto&) { in_call += processor_time() - begin; });
  int steps = 0;
  while (receive(STDIN_FILENO, &steps, sizeof steps)) {
    in_call = {};
    const auto start = steady_clock::now();
    world.run(steps);
    const PeerCost cost{us(steady_clock::now() - start, steps), us(in_call, steps)};
    if (!finite(world.world)) throw std::runtime_error("a joint is no longer at a finite angle");
    if (!send_all(STDIN_FILENO, &cost, sizeof cost)) return;
  }
}

}  // namespace

void serve_peer(const std::string& world_file, const std::string& engine) {
  // The other plug-ins, and Gazebo where it didn't load, may not know how to end.
  try {
    serve(world_file, engine);
    _exit(0);
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    _exit(2);
  }
}

}  // namespace vsa::test
