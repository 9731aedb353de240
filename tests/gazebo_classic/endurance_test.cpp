// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Snake and module for a simulated minute, or ten of them with VSA_TEST_LONG.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "classic_world.hpp"
#include "gait_player.hpp"
#include "support/heap.hpp"

namespace vsa::test {
namespace {

constexpr int kStepsPerSecond = 1000;
constexpr int kSampleEvery = 50;

const std::string kGround = "<include><uri>model://terrain_flat</uri></include>";

std::string posed(const std::string& model) {
  std::string text = model_text(model);
  return text.insert(text.find('>') + 1, "<pose>0 0 0.0335 0 0 0</pose>");
}

/// Joint angles and the model's place, every 50 ms.
class Samples {
 public:
  explicit Samples(const gazebo::physics::ModelPtr& model) : model_(model) {
    for (const auto& joint : model_->GetJoints()) {
      if (joint->HasType(gazebo::physics::Base::HINGE_JOINT)) joints.push_back(joint);
    }
    end_ = gazebo::event::Events::ConnectWorldUpdateEnd([this] { sample(); });
  }
  void clear() {
    values.clear();
    steps_ = 0;
  }
  [[nodiscard]] ignition::math::Vector3d place() const { return model_->WorldPose().Pos(); }

  std::vector<double> values;
  std::vector<gazebo::physics::JointPtr> joints;
  bool finite = true;  ///< at every step

 private:
  void sample() {
    for (const auto& joint : joints) finite = finite && std::isfinite(joint->Position(0)) && std::isfinite(joint->GetVelocity(0));
    if (steps_++ % kSampleEvery != 0) return;
    for (const auto& joint : joints) values.push_back(joint->Position(0));
    const auto at = place();
    values.insert(values.end(), {at.X(), at.Y(), at.Z()});
  }

  gazebo::physics::ModelPtr model_;
  int steps_ = 0;
  gazebo::event::ConnectionPtr end_;
};

std::int64_t begin_ns(const gazebo::common::UpdateInfo& info) {  // the step that begins has been counted
  return info.simTime.sec * std::int64_t{1'000'000'000} + info.simTime.nsec - 1'000'000;
}

/// ODE keeps the joints' last impulses to begin the next step with, and no reset of the world clears them: it shall not.
template <class World>
class Colder : public World {
 public:
  template <class... Arguments>
  explicit Colder(Arguments&&... arguments) : World(std::forward<Arguments>(arguments)...) {
    const auto physics = this->world->Physics();
    if (physics->GetType() == "ode" && !physics->SetParam("warm_start_factor", 0.0))
      throw std::runtime_error("no warm_start_factor");
  }
};

/// A robot of models/ on flat ground, moved all the time: the snake sidewinds, the module turns its flange to and fro.
class Moving {
 public:
  Moving(const std::string& model, const std::string& engine, bool on_ground = true)
      : world_("moving_" + model, posed(model), engine, on_ground ? kGround : "", on_ground),
        samples(world_.world->ModelByName(model)) {
    if (model == "qbmove_snake") gait_.emplace(VSA_SOURCE_DIR "/models/gaits/sidewind.toml", world_.robot());
    begin_ = gazebo::event::Events::ConnectWorldUpdateBegin([this](const auto& info) { command(begin_ns(info)); });
  }

  void run(double seconds) { world_.run(static_cast<int>(seconds * kStepsPerSecond)); }
  void reset() {
    world_.reset();
    samples.clear();
  }

 private:
  void command(std::int64_t now_ns) {
    if (gait_) {
      gait_->play(now_ns);
    } else if (now_ns % 10'000'000 == 0) {
      const double t_s = static_cast<double>(now_ns) * 1e-9;
      (void)world_.robot().command(0, 0.6 * std::sin(3 * t_s), 0.4 + 0.3 * std::sin(0.7 * t_s));
    }
  }

  Colder<RobotWorld> world_;
  std::optional<GaitPlayer> gait_;
  gazebo::event::ConnectionPtr begin_;

 public:
  Samples samples;
};

/// The same model without its plug-in, its joints pushed to and fro: what of a difference is the host's own.
class Pushed {
 public:
  Pushed(const std::string& model, const std::string& engine)
      : world_(world_sdf("pushed_" + model, kGround + without(posed(model), "<plugin", "</plugin>")), engine),
        samples(world_.world->ModelByName(model)) {
    begin_ = gazebo::event::Events::ConnectWorldUpdateBegin([this](const auto& info) {
      const double t_s = static_cast<double>(begin_ns(info)) * 1e-9;
      for (std::size_t i = 0; i < samples.joints.size(); ++i)
        samples.joints[i]->SetForce(0, 0.3 * std::sin(3 * t_s + static_cast<double>(i)));
    });
  }

  void run(double seconds) { world_.run(static_cast<int>(seconds * kStepsPerSecond)); }

 private:
  Colder<ClassicWorld> world_;
  gazebo::event::ConnectionPtr begin_;

 public:
  Samples samples;
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size() || a.empty()) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

struct Case {
  std::string model, engine;
  [[nodiscard]] bool is_snake() const { return model == "qbmove_snake"; }
  /// Whether contacts come out alike each time. DART takes them in an order that addresses decide, and at times its first contact has
  /// no solution ("The solution of LCP includes NAN values"), with or without a plug-in: there runs are compared in the air.
  [[nodiscard]] bool has_same_contacts() const { return engine != "dart"; }
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.model << ", " << c.engine; }

class Endurance : public testing::TestWithParam<Case> {};

template <class Run, class... Where>
double two_fresh_runs(const Case& c, double seconds, Where... where) {
  std::vector<double> runs[2];
  for (auto& values : runs) {
    Run run(c.model, c.engine, where...);
    run.run(seconds);
    values = run.samples.values;
  }
  return largest_difference(runs[0], runs[1]);
}

double before_and_after_a_reset(const Case& c, double seconds, bool on_ground) {
  Moving run(c.model, c.engine, on_ground);
  run.run(seconds);
  const auto fresh = run.samples.values;
  run.reset();
  run.run(seconds);
  return largest_difference(fresh, run.samples.values);
}

TEST_P(Endurance, MovesForMinutesWithoutNaNOrGrowthOfMemory) {
  const int part_s = long_run() ? 50 : 5;
  Moving moving(GetParam().model, GetParam().engine);
  moving.samples.values.reserve(16 * 20 * 600);
  std::vector<long> kB;
  for (int i = 0; i < 12; ++i) {
    moving.run(part_s);
    kB.push_back(heap_in_use_kB());
  }
  EXPECT_TRUE(moving.samples.finite);
  const auto place = moving.samples.place();
  std::cout << GetParam() << ": " << testing::PrintToString(kB) << " kB after each " << part_s << " s, came to " << place << '\n';
  EXPECT_LT(usual_growth(kB), may_grow_kB(kStepsPerSecond * part_s)) << "kB in " << part_s << " s";
  EXPECT_LT(std::abs(place.Z()), 0.2) << "neither flies nor sinks";
}

TEST_P(Endurance, TwoFreshRunsGiveTheSameBits) {
  if (GetParam().has_same_contacts()) {
    EXPECT_EQ(two_fresh_runs<Pushed>(GetParam(), 5), 0.0) << "the host's own";
  }
  EXPECT_EQ(two_fresh_runs<Moving>(GetParam(), long_run() ? 60 : 5, GetParam().has_same_contacts()), 0.0);
}

TEST_P(Endurance, AfterAResetTheRunIsThatOfAFreshWorld) {
  const auto compare = [](double seconds, bool on_ground, double allowed) {
    const double ours = before_and_after_a_reset(GetParam(), seconds, on_ground);
    std::cout << GetParam() << ": after a reset differs by " << ours << " in " << seconds << " s\n";
    EXPECT_LE(ours, allowed) << (on_ground ? "on the ground" : "in the air");
  };
  const bool on_ground = GetParam().has_same_contacts();
  if (!GetParam().is_snake()) return compare(3, on_ground, 0.0);
  // A chain's reset turns its links by a rounding error, which contacts multiply by hundreds every 50 ms and 3 s in the air by some
  // thousands: mostly 0, once 3e-11. One encoder count that comes a tick later is 1e-4.
  compare(3, false, 1e-9);
  if (on_ground) compare(0.1, true, 1e-11);
}

INSTANTIATE_TEST_SUITE_P(Robots, Endurance,
                         testing::Values(Case{"qbmove", "ode"}, Case{"qbmove", "dart"}, Case{"qbmove_snake", "ode"},
                                         Case{"qbmove_snake", "dart"}),
                         [](const auto& c) { return c.param.model + "_" + c.param.engine; });

}  // namespace
}  // namespace vsa::test
