// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Sends a gait over the topics in real time, as a program on a desk would to the robot:
//
//   vsa run models/worlds/snake_flat.sdf --realtime &
//   snake_gait_topics models/gaits/sidewind.toml 30
//
// Every 20 ms one JointTrajectory with one point: the joint's name is its equilibrium, the name with "_preset" its preset. What
// arrives when is up to the machine, so two such runs differ; a gait that must be repeatable is played by `vsa run --gait`.
#include <ignition/msgs/joint_trajectory.pb.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <ignition/transport/Node.hh>
#include <iostream>
#include <thread>

#include "vsa/motion/gait.hpp"

namespace {

volatile std::sig_atomic_t stop = 0;

ignition::msgs::JointTrajectory message_at(const vsa::motion::Gait& gait, double t_s) {
  ignition::msgs::JointTrajectory message;
  auto* point = message.add_points();
  for (const auto& group : gait.params().groups) {
    for (std::size_t k = 0; k < group.actuators.size(); ++k) {
      message.add_joint_names(group.actuators[k]);
      point->add_positions(gait.equilibrium(group, k, t_s));
      message.add_joint_names(group.actuators[k] + "_preset");
      point->add_positions(group.preset_rad);
    }
  }
  return message;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: snake_gait_topics GAIT.toml SECONDS [MODEL]\n";
    return 2;
  }
  const std::string topic = std::string("/model/") + (argc > 3 ? argv[3] : "qbmove_snake") + "/vsa/cmd";
  setenv("IGN_IP", "127.0.0.1", 0);  // as vsa does: talk on this machine only unless told otherwise
  std::signal(SIGINT, [](int) { stop = 1; });
  try {
    const auto gait = vsa::motion::Gait::load(argv[1]);
    if (gait.params().steering) std::cerr << "note: over the topics this gait runs without its steering\n";
    const double duration_s = std::stod(argv[2]);
    ignition::transport::Node node;
    auto publisher = node.Advertise<ignition::msgs::JointTrajectory>(topic);
    for (int i = 0; i < 250 && !publisher.HasConnections(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (!publisher.HasConnections()) {
      std::cerr << "nobody listens on " << topic << "\n";
      return 1;
    }
    const auto began = std::chrono::steady_clock::now();
    for (auto next = began; stop == 0; next += std::chrono::milliseconds(20)) {
      std::this_thread::sleep_until(next);
      const double t_s = std::chrono::duration<double>(next - began).count();
      if (t_s > duration_s) break;
      publisher.Publish(message_at(gait, t_s));
    }
  } catch (const vsa::InputError& error) {
    std::cerr << error.what() << "\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "snake_gait_topics: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
