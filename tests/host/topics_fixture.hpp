// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A transport that is a few maps, and a robot of two qbmoves and a series elastic actuator on it.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/one_joint.hpp"
#include "vsa/elastic/series_spring.hpp"
#include "vsa/host/topics.hpp"

namespace vsa::test {

/// Publishers may outlive the transport, so what they write to is shared.
struct Wire {
  std::map<std::string, std::vector<std::pair<std::int64_t, double>>> numbers;
  std::vector<host::JointStates> states;
  std::set<std::string> listened;  // topics that somebody listens to
  bool all_listened = true;
};

template <class Message>
class FakePublisher final : public host::Publisher<Message> {
 public:
  FakePublisher(std::shared_ptr<Wire> wire, std::string topic) : wire_(std::move(wire)), topic_(std::move(topic)) {}
  [[nodiscard]] bool wanted() const noexcept override { return wire_->all_listened || wire_->listened.count(topic_) > 0; }
  void publish(std::int64_t time_ns, const Message& message) override {
    if constexpr (std::is_same_v<Message, double>) {
      wire_->numbers[topic_].emplace_back(time_ns, message);
    } else {
      wire_->states.push_back(message);
    }
  }

 private:
  std::shared_ptr<Wire> wire_;
  std::string topic_;
};

class FakeTransport final : public host::TopicTransport {
 public:
  using Outcome = host::Outcome;
  Outcome on_double(const std::string& topic, std::function<void(double)> handler) override {
    doubles[topic] = std::move(handler);
    return outcome;
  }
  Outcome on_trajectory(const std::string& topic, std::function<void(const host::Trajectory&)> handler) override {
    if (!knows_trajectories) return Outcome::unsupported;
    trajectories[topic] = std::move(handler);
    return outcome;
  }
  Outcome on_actuators(const std::string& topic, std::function<void(const host::ActuatorsCmd&)> handler) override {
    actuators[topic] = std::move(handler);
    return outcome;
  }
  Outcome serve_text(const std::string& service, Answer answer) override {
    services[service] = std::move(answer);
    return of_services;
  }
  std::unique_ptr<host::Publisher<double>> advertise_double(const std::string& topic) override {
    advertised.insert(topic);
    return std::make_unique<FakePublisher<double>>(wire, topic);
  }
  std::unique_ptr<host::Publisher<host::JointStates>> advertise_states(const std::string& topic) override {
    advertised.insert(topic);
    return std::make_unique<FakePublisher<host::JointStates>>(wire, topic);
  }

  std::map<std::string, std::function<void(double)>> doubles;
  std::map<std::string, std::function<void(const host::Trajectory&)>> trajectories;
  std::map<std::string, std::function<void(const host::ActuatorsCmd&)>> actuators;
  std::map<std::string, Answer> services;
  std::set<std::string> advertised;
  std::shared_ptr<Wire> wire = std::make_shared<Wire>();
  Outcome outcome = Outcome::ok, of_services = Outcome::ok;
  bool knows_trajectories = true;
};

inline host::RobotConfig three_actuators() {
  host::RobotConfig config;
  config.buses.push_back({"arm", 2'000'000, std::nullopt});
  config.actuators.push_back({"shoulder", "module_1::shaft", "maker_pro", maker_pro(), 0, 1, 0.0, 0.2});
  config.actuators.push_back({"arm::elbow", "module_2::shaft", "maker_pro", maker_pro(), 0, 2, 0.1, 0.3});
  device::UnitConfig series = maker_pro();
  series.actuator.transmission = std::make_shared<elastic::SeriesSpring>(20.0);
  config.actuators.push_back({"wrist", "module_3::shaft", "series", series, 0, 3, 0.0, 0.0});
  return config;
}

/// The robot's shafts are held still: what is tested is what commands mean, not how the arm moves.
struct TopicsFixture {
  explicit TopicsFixture(host::RobotConfig config = three_actuators()) : robot(std::move(config)) {}

  void connect() {
    topics = std::make_unique<host::RobotTopics>(robot, "lab::arm", transport,
                                                 [this](const std::string& line) { lines.push_back(line); });
  }

  void step(int count = 1) {
    const std::vector<host::JointIn> still(robot.size());
    std::vector<double> torques(robot.size());
    for (int k = 0; k < count; ++k) {
      robot.advance(time_ns, kStep_ns, still, torques);
      time_ns += kStep_ns;
      if (topics) topics->update(time_ns);
    }
  }

  [[nodiscard]] std::array<double, 2> commanded(std::size_t actuator) const {
    const auto now = robot.read(actuator);
    return {now.equilibrium_command_rad, now.preset_command};
  }

  static constexpr std::int64_t kStep_ns = 1'000'000;
  host::Robot robot;
  FakeTransport transport;
  std::vector<std::string> lines;
  std::int64_t time_ns = 0;
  std::unique_ptr<host::RobotTopics> topics;
};

}  // namespace vsa::test
