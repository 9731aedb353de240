// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Snake and module for a simulated minute, or ten of them with VSA_TEST_LONG.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <optional>

#include "classic_world.hpp"
#include "gait_player.hpp"

namespace vsa::test {
namespace {

constexpr int kStepsPerSecond = 1000;
constexpr int kSampleEvery = 50;

/// A robot of models/ on flat ground, moved all the time: the snake sidewinds, the module turns its flange to and fro.
class Moving {
 public:
  Moving(const std::string& model, const std::string& engine)
      : model_(model),
        world_("moving_" + model, posed(model), engine, "<include><uri>model://terrain_flat</uri></include>"),
        model_of_world_(world_.world->ModelByName(model)) {
    if (model == "qbmove_snake") gait_.emplace(VSA_SOURCE_DIR "/models/gaits/sidewind.toml", world_.robot());
    for (const auto& joint : model_of_world_->GetJoints()) {
      if (joint->HasType(gazebo::physics::Base::HINGE_JOINT)) joints_.push_back(joint);
    }
    begin_ = gazebo::event::Events::ConnectWorldUpdateBegin([this](const auto& info) { command(info.simTime); });
    end_ = gazebo::event::Events::ConnectWorldUpdateEnd([this] { sample(); });
  }

  void run(double seconds) { world_.run(static_cast<int>(seconds * kStepsPerSecond)); }
  void reset() {
    world_.reset();
    samples.clear();
    steps_ = 0;
  }
  [[nodiscard]] ignition::math::Vector3d place() const { return model_of_world_->WorldPose().Pos(); }

  std::vector<double> samples;  ///< joint angles and the model's place, every 50 ms
  bool finite = true;           ///< at every step

 private:
  static std::string posed(const std::string& model) {
    std::string text = model_text(model);
    return text.insert(text.find('>') + 1, "<pose>0 0 0.0335 0 0 0</pose>");
  }

  void command(const gazebo::common::Time& time) {
    // The step that begins has been counted.
    const std::int64_t now_ns = time.sec * std::int64_t{1'000'000'000} + time.nsec - 1'000'000;
    if (gait_) {
      gait_->play(now_ns);
    } else if (now_ns % 10'000'000 == 0) {
      const double t_s = static_cast<double>(now_ns) * 1e-9;
      (void)world_.robot().command(0, 0.6 * std::sin(3 * t_s), 0.4 + 0.3 * std::sin(0.7 * t_s));
    }
  }

  void sample() {
    for (const auto& joint : joints_) finite = finite && std::isfinite(joint->Position(0)) && std::isfinite(joint->GetVelocity(0));
    if (steps_++ % kSampleEvery != 0) return;
    for (const auto& joint : joints_) samples.push_back(joint->Position(0));
    const auto at = place();
    samples.insert(samples.end(), {at.X(), at.Y(), at.Z()});
  }

  std::string model_;
  RobotWorld world_;
  gazebo::physics::ModelPtr model_of_world_;
  std::vector<gazebo::physics::JointPtr> joints_;
  std::optional<GaitPlayer> gait_;
  int steps_ = 0;
  gazebo::event::ConnectionPtr begin_, end_;
};

struct Case {
  const char* model;
  const char* engine;
};

class Endurance : public testing::TestWithParam<Case> {};

TEST_P(Endurance, MovesForMinutesWithoutNaNOrGrowthOfMemory) {
  const double duration_s = long_run() ? 600 : 60;
  Moving moving(GetParam().model, GetParam().engine);
  moving.samples.reserve(16 * 20 * 600);
  moving.run(0.2 * duration_s);
  const long early_kB = resident_kB();
  moving.run(0.8 * duration_s);
  const long grown_kB = resident_kB() - early_kB;
  EXPECT_TRUE(moving.finite);
  EXPECT_LT(grown_kB, 2'000) << "in " << 0.8 * duration_s << " s";
  const auto place = moving.place();
  std::cout << GetParam().model << ", " << GetParam().engine << ": grew by " << grown_kB << " kB, came to " << place << '\n';
  EXPECT_LT(std::abs(place.Z()), 0.2) << "neither flies nor sinks";
}

TEST_P(Endurance, TwoFreshRunsGiveTheSameBits) {
  std::vector<double> runs[2];
  for (auto& samples : runs) {
    Moving moving(GetParam().model, GetParam().engine);
    moving.run(long_run() ? 60 : 5);
    samples = moving.samples;
  }
  EXPECT_EQ(runs[0], runs[1]);
}

TEST_P(Endurance, AfterAResetTheRunIsThatOfAFreshWorld) {
  Moving moving(GetParam().model, GetParam().engine);
  moving.run(3);
  const auto fresh = moving.samples;
  moving.reset();
  moving.run(3);
  ASSERT_EQ(fresh.size(), moving.samples.size());
  double largest = 0;
  for (std::size_t i = 0; i < fresh.size(); ++i) largest = std::max(largest, std::abs(fresh[i] - moving.samples[i]));
  std::cout << GetParam().model << ", " << GetParam().engine << ": after a reset differs by " << largest << '\n';
  EXPECT_EQ(largest, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Robots, Endurance,
                         testing::Values(Case{"qbmove", "ode"}, Case{"qbmove", "dart"}, Case{"qbmove_snake", "ode"},
                                         Case{"qbmove_snake", "dart"}),
                         [](const auto& c) { return std::string(c.param.model) + "_" + c.param.engine; });

}  // namespace
}  // namespace vsa::test
