// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// robot_topics WORLD.sdf…: every topic that the robots of these worlds subscribe to or publish, one line each: world, model, way,
// message, topic. It asks host::RobotTopics itself, with a transport that only listens to the names.
#include <cstdio>
#include <exception>
#include <filesystem>

#include "vsa/engine/world.hpp"
#include "vsa/host/topics.hpp"

namespace {

class NamesOnly final : public vsa::host::TopicTransport {
 public:
  NamesOnly(std::string world, std::string model) : world_(std::move(world)), model_(std::move(model)) {}

  vsa::host::Outcome on_double(const std::string& topic, std::function<void(double)>) override {
    return tell("to_gz", "gz.msgs.Double", topic);
  }
  vsa::host::Outcome on_trajectory(const std::string& topic, std::function<void(const vsa::host::Trajectory&)>) override {
    return tell("to_gz", "gz.msgs.JointTrajectory", topic);
  }
  vsa::host::Outcome on_actuators(const std::string& topic, std::function<void(const vsa::host::ActuatorsCmd&)>) override {
    return tell("to_gz", "gz.msgs.Actuators", topic);
  }
  vsa::host::Outcome serve_text(const std::string&, Answer) override {
    return vsa::host::Outcome::unsupported;
  }  // no bridge has it
  std::unique_ptr<vsa::host::Publisher<double>> advertise_double(const std::string& topic) override {
    tell("to_ros", "gz.msgs.Double", topic);
    return nullptr;
  }
  std::unique_ptr<vsa::host::Publisher<vsa::host::JointStates>> advertise_states(const std::string& topic) override {
    tell("to_ros", "gz.msgs.Model", topic);
    return nullptr;
  }

 private:
  vsa::host::Outcome tell(const char* way, const char* message, const std::string& topic) {
    std::printf("%s %s %s %s %s\n", world_.c_str(), model_.c_str(), way, message, topic.c_str());
    return vsa::host::Outcome::ok;
  }
  std::string world_, model_;
};

}  // namespace

int main(int argc, char** argv) {
  try {
    for (int i = 1; i < argc; ++i) {
      auto world = vsa::engine::World::load(argv[i]);
      for (std::size_t r = 0; r < world.robot_count(); ++r) {
        NamesOnly port(std::filesystem::path(argv[i]).stem().string(), world.robot_model(r));
        const vsa::host::RobotTopics topics(world.robot(r), world.robot_model(r), port, {});
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "robot_topics: %s\n", error.what());
    return 1;
  }
  return 0;
}
