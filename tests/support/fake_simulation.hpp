// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A world without a simulator: one robot of one actuator whose link rises by a metre a second. It tells no energy of bodies, has no
// hands and no contacts.
#pragma once

#include <utility>

#include "support/one_joint.hpp"
#include "vsa/host/simulation.hpp"

namespace vsa::test {

inline host::RobotConfig one_actuator() {
  host::RobotConfig config;
  config.buses.emplace_back().name = "bus";
  host::ActuatorConfig actuator;
  actuator.name = actuator.joint = "elbow";
  actuator.type = "made_up";
  actuator.unit = maker_pro();
  config.actuators.push_back(std::move(actuator));
  return config;
}

class FakeSimulation final : public host::Simulation {
 public:
  FakeSimulation() {
    links_.push_back({"arm::base", "arm", 1, true, {}});
    links_.push_back({"arm::link", "arm", 1, false, {{}}});
  }
  void step() {
    std::array<double, 1> torque{};
    const std::array<host::JointIn, 1> joint{};
    robot_.advance(time_ns_, kStep_ns, joint, torque);
    time_ns_ += kStep_ns;
  }

  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] double step_s() const override { return 1e-9 * kStep_ns; }
  [[nodiscard]] std::int64_t time_ns() const override { return time_ns_; }
  [[nodiscard]] const std::vector<std::string>& warnings() const override { return warnings_; }
  [[nodiscard]] std::size_t robot_count() const override { return 1; }
  [[nodiscard]] host::Robot& robot(std::size_t) override { return robot_; }
  [[nodiscard]] const host::Robot& robot(std::size_t) const override { return robot_; }
  [[nodiscard]] const std::string& robot_model(std::size_t) const override { return model_; }
  [[nodiscard]] const std::vector<scene::LinkInfo>& links() const override { return links_; }
  void poses(std::span<scene::Pose> out) const override { out[1].position[2] = time_s(); }

 private:
  static constexpr std::int64_t kStep_ns = 1'000'000;
  std::string name_ = "nowhere", model_ = "arm";
  std::vector<std::string> warnings_;
  std::vector<scene::LinkInfo> links_;
  host::Robot robot_{one_actuator()};
  std::int64_t time_ns_ = 0;
};

}  // namespace vsa::test
