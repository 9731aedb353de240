// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A Gazebo that calls its plug-ins one by one: those of one model step as one.
#include "model_robots.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <utility>

#include "seat/arm_of_three.hpp"

namespace vsa::seat::testing {
namespace {

using host::TreeBody;
using plugins::LinkTrees, plugins::ModelRobot, plugins::ModelRobots;

/// Of the links that the joints asked for hang on.
struct ArmTrees final : LinkTrees {
  ArmTrees() = default;
  ArmTrees(std::vector<TreeBody> bodies, std::vector<std::size_t> driven) {
    tree_ = DrivenTree(std::move(bodies), std::move(driven));
  }
  void look() override { ++looks; }
  void feel() override {}
  [[nodiscard]] bool are_there() const override { return number_ >= gone; }
  static inline int looks = 0, made = 0, gone = 0;  ///< gone: so many of those made have lost links

 private:
  int number_ = made++;
};

double damping = 0;  ///< at each joint of the trees

enum class Is { tree, loop_of_trees, no_tree };

/// A plug-in as a Gazebo calls it, with joints from `first` on.
class Plugin final : public ModelRobot {
 public:
  Plugin(Arm& arm, std::size_t first, std::size_t count, Is model) : arm_(arm), first_(first), model_(model) {
    Options options;
    options.report = [this](const std::string& line) { said += line + "\n"; };
    seat_.emplace(part(first, count), options);
    for (std::size_t i = first; i < first + count; ++i) driven_.push_back(100 + i);
  }
  [[nodiscard]] Seat* seat() noexcept override { return &*seat_; }
  [[nodiscard]] const Joints& driven() const noexcept override { return driven_; }
  /// Joint i hangs on joint i − 1, wherever they are: the arm's B doesn't change either.
  [[nodiscard]] std::unique_ptr<LinkTrees> link_trees(Links links, const Joints& driven) override {
    const bool is_tree = links == Links::of_outermost_model ? model_ == Is::tree : model_ != Is::no_tree;
    if (!is_tree) return std::make_unique<ArmTrees>();
    const std::size_t from = links == Links::of_outermost_model ? 0 : first_;
    std::vector<TreeBody> bodies;
    for (std::size_t i = from; i < 3; ++i) {
      const double x = 0.1 * static_cast<double>(i);
      bodies.push_back({i == from ? TreeBody::kGround : bodies.size() - 1,
                        TreeBody::Joint::revolute,
                        {0, 0, 1},
                        {x, 0, 0},
                        0.05,
                        {x + 0.05, 0, 0},
                        {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4}});
      bodies.back().damping = damping;
    }
    std::vector<std::size_t> at;
    for (const std::uint64_t joint : driven) at.push_back(joint - 100 - from);
    return std::make_unique<ArmTrees>(std::move(bodies), std::move(at));
  }
  void tell(std::int64_t time_ns) override {
    times.push_back(time_ns);
    arm_.tell(*seat_, first_);
  }
  void apply() override {
    for (std::size_t i = 0; i < driven_.size(); ++i) arm_.torque[first_ + i] = seat_->torques()[i];
  }

  std::vector<std::int64_t> times;
  std::string said;

 private:
  Arm& arm_;
  std::size_t first_;
  Is model_;
  std::optional<Seat> seat_;
  Joints driven_;
};

/// Models of a Gazebo, each known by its number.
std::shared_ptr<ModelRobots> robots_of(std::uint64_t model) {
  static const int kWorld = 0;
  return ModelRobots::of({&kWorld, model});
}

/// A model with these plug-ins: each as the number of its joints.
struct Host {
  explicit Host(const std::vector<std::size_t>& counts, Is model = Is::tree, std::uint64_t number = 1) : robots(robots_of(number)) {
    std::size_t first = 0;
    for (const std::size_t count : counts) {
      plugins.push_back(std::make_unique<Plugin>(arm, first, count, model));
      robots->add(*plugins.back());
      first += count;
    }
  }
  ~Host() {
    for (const auto& p : plugins) robots->remove(*p);
  }
  std::array<double, 3> step(bool backwards = false) {
    now_ns += kStep_ns;
    for (std::size_t k = 0; k < plugins.size(); ++k)
      robots->step(*plugins[backwards ? plugins.size() - 1 - k : k], now_ns, kStep_ns);
    arm.move();
    return arm.angle;
  }

  Arm arm;
  std::shared_ptr<ModelRobots> robots;
  std::vector<std::unique_ptr<Plugin>> plugins;
  std::int64_t now_ns = 0;
};

TEST(ModelRobots, OfAnArmAndItsHandMoveAsOneInWhateverOrderTheyAreCalled) {
  Host whole({3});
  Host two({2, 1}, Is::tree, 2), three({1, 1, 1}, Is::tree, 3);
  for (int n = 0; n < 400; ++n) {
    const auto angles = whole.step();
    ASSERT_EQ(two.step(n % 3 == 0), angles) << "step " << n;
    ASSERT_EQ(three.step(n % 2 == 0), angles) << "step " << n;
  }
  for (const Host* host : {&two, &three}) {
    for (const auto& plugin : host->plugins) {
      ASSERT_EQ(plugin->times.size(), 400U) << "each once a step";
      EXPECT_EQ(plugin->times.back(), host->now_ns);
      EXPECT_EQ(plugin->said, "");
    }
  }
}

struct ModelRobotsWithDampers : ::testing::Test {
  ModelRobotsWithDampers() { damping = 0.01; }
  ~ModelRobotsWithDampers() override { damping = 0; }
};

TEST_F(ModelRobotsWithDampers, OfOneTreeAreToldTheSame) {
  Host whole({3});
  Host two({2, 1}, Is::tree, 2);
  for (int n = 0; n < 400; ++n) {
    const auto angles = whole.step();
    ASSERT_EQ(two.step(n % 3 == 0), angles) << "step " << n;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto told = whole.plugins[0]->seat()->in()[i].free_acceleration_rad_per_s2;
      ASSERT_EQ(told.has_value(), n > 0) << "step " << n;
      ASSERT_EQ(two.plugins[i / 2]->seat()->in()[i % 2].free_acceleration_rad_per_s2, told) << "step " << n;
    }
  }
}

TEST_F(ModelRobotsWithDampers, AreToldNothingWhereThereIsNoStepBeforeNoTreeOrNoDamper) {
  const auto told = [](Host& host) { return host.plugins[0]->seat()->in()[0].free_acceleration_rad_per_s2.has_value(); };
  Host host({2, 1}, Is::loop_of_trees);
  for (const bool known : {false, true, true}) {
    host.step();
    EXPECT_EQ(told(host), known);
  }
  host.plugins[0]->seat()->in()[0].placed = true;
  host.step();
  EXPECT_FALSE(told(host));
  host.step();
  EXPECT_TRUE(told(host));
  host.robots->forget();
  host.step();
  EXPECT_FALSE(told(host));
  Host none({3}, Is::no_tree, 2);
  for (int n = 0; n < 3; ++n) none.step();
  EXPECT_FALSE(told(none));
  damping = 0;
  Host free({3}, Is::tree, 3);
  for (int n = 0; n < 3; ++n) free.step();
  EXPECT_FALSE(told(free));
}

TEST(ModelRobots, OneThatGoesLeavesTheOthersMoving) {
  Host host({1, 1, 1});
  for (int n = 0; n < 50; ++n) host.step();
  host.robots->remove(*host.plugins[1]);
  host.plugins.erase(host.plugins.begin() + 1);
  host.arm.torque = {};
  for (int n = 0; n < 50; ++n) host.step();
  EXPECT_EQ(host.plugins[0]->times.size(), 100U);
  EXPECT_EQ(host.plugins[1]->times.size(), 100U);
  EXPECT_NE(host.arm.torque[2], 0);
  EXPECT_EQ(host.arm.torque[1], 0) << "nobody's";
}

TEST(ModelRobots, OneThatComesLaterJoinsTheOthers) {
  Host host({2});
  for (int n = 0; n < 50; ++n) host.step();
  host.plugins.push_back(std::make_unique<Plugin>(host.arm, 2, 1, Is::tree));
  host.robots->add(*host.plugins.back());
  for (int n = 0; n < 50; ++n) host.step();
  EXPECT_EQ(host.plugins[0]->times.size(), 100U);
  EXPECT_EQ(host.plugins[1]->times.size(), 50U);
}

TEST(ModelRobots, FindTheTreesAnewWhereLinksOfThemAreGone) {
  Host undisturbed({2, 1}), host({2, 1}, Is::tree, 2);
  std::vector<std::array<double, 3>> angles;
  for (int n = 0; n < 200; ++n) angles.push_back(undisturbed.step());
  for (std::size_t n = 0; n < angles.size(); ++n) {
    if (n == 100) ArmTrees::gone = ArmTrees::made;
    const int before = ArmTrees::made;
    ASSERT_EQ(host.step(), angles[n]) << "step " << n;
    EXPECT_EQ(ArmTrees::made - before, n == 0 || n == 100 ? 1 : 0) << "step " << n;
  }
  for (const auto& plugin : host.plugins) EXPECT_EQ(plugin->said, "");
}

TEST(ModelRobots, WhereTheWholeModelIsNoTreeEachHasItsOwnModel) {
  Host host({2, 1}, Is::loop_of_trees);
  ArmTrees::looks = 0;
  host.step();
  EXPECT_EQ(ArmTrees::looks, 2) << "two trees, each looked at once";
  for (const auto& plugin : host.plugins) EXPECT_EQ(plugin->said, "");
}

TEST(ModelRobots, WhereThereIsNoTreeEachSaysSoOnce) {
  Host host({2, 1}, Is::no_tree);
  for (int n = 0; n < 5; ++n) host.step();
  for (const auto& plugin : host.plugins) {
    const auto at = plugin->said.find("no tree of hinges");
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(plugin->said.find("no tree of hinges", at + 1), std::string::npos);
  }
  EXPECT_NE(host.arm.torque[0], 0);
}

TEST(ModelRobots, OfAModelAreTheSameAsLongAsAnyoneHasThem) {
  auto a = robots_of(7);
  EXPECT_EQ(robots_of(7), a);
  EXPECT_NE(robots_of(8), a);
  const std::weak_ptr<ModelRobots> once = a;
  a.reset();
  EXPECT_TRUE(once.expired());
}

}  // namespace
}  // namespace vsa::seat::testing
