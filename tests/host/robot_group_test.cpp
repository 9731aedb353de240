// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Robots on one kinematic tree: what one robot with all of the joints does, bit for bit.
#include "vsa/host/robot_group.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "support/one_joint.hpp"
#include "vsa/errors.hpp"

namespace {

using namespace vsa;
using host::JointIn, host::Robot, host::RobotGroup;

/// Units named by their numbers, each bus by its first one.
host::RobotConfig robot(const std::vector<std::vector<int>>& buses) {
  host::RobotConfig config;
  for (std::size_t b = 0; b < buses.size(); ++b) {
    config.buses.push_back({"bus" + std::to_string(buses[b].front()), 2e6, std::nullopt});
    int id = 0;
    for (const int number : buses[b]) {
      host::ActuatorConfig a;
      a.name = a.joint = "a" + std::to_string(number);
      a.unit = test::maker_pro();
      a.bus = b;
      a.id = ++id;
      a.initial_preset = 0.3 + 0.1 * number;
      config.actuators.push_back(a);
    }
  }
  return config;
}

/// Of light links one behind the other, so that each joint moves its neighbours; the last is on a tree of its own.
constexpr std::size_t kJoints = 4;
constexpr double kB[kJoints][kJoints] = {{3e3, -2e3, 4e2, 0}, {-2e3, 9e3, -3e3, 0}, {4e2, -3e3, 1.2e4, 0}, {0, 0, 0, 2e3}};

/// v' = v + dt·B·τ, q' = q + dt·v'
void move(std::array<JointIn, kJoints>& joints, const std::array<double, kJoints>& torques, double dt_s) {
  for (std::size_t i = 0; i < kJoints; ++i)
    for (std::size_t k = 0; k < kJoints; ++k) joints[i].speed_rad_per_s += dt_s * kB[i][k] * torques[k];
  for (JointIn& j : joints) j.angle_rad += dt_s * j.speed_rad_per_s;
}

/// Joints 0, 1 and 3 are of one robot, 2 of another.
struct Two {
  Two() {
    arm.join({{2}}, group.shared(0));
    hand.join({}, group.shared(1));
  }
  void step(std::int64_t t_ns, std::int64_t dt_ns, const std::array<JointIn, kJoints>& joints, std::array<double, kJoints>& out) {
    const std::array<JointIn, 3> of_arm{joints[0], joints[1], joints[3]};
    const std::array<JointIn, 1> of_hand{joints[2]};
    std::array<double, 3> arm_Nm{};
    std::array<double, 1> hand_Nm{};
    const std::array<double, 1> own{kB[3][3]};
    group.steps()[0] = {&arm, t_ns, of_arm, arm_Nm, own};
    group.steps()[1] = {&hand, t_ns, of_hand, hand_Nm, {}};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) group.mobility()[3 * i + k] = kB[i][k];
    group.advance(dt_ns);
    out = {arm_Nm[0], arm_Nm[1], hand_Nm[0], arm_Nm[2]};
  }
  RobotGroup group{2, {{{0, 0}, {0, 1}, {1, 0}}}};
  Robot arm{robot({{0, 1}, {3}})}, hand{robot({{2}})};
};

TEST(RobotGroup, MovesAsOneRobotWithAllOfTheJoints) {
  for (const std::int64_t dt_ns : {250'000, 1'000'000, 1'700'000, 4'000'000}) {
    Robot whole(robot({{0, 1}, {2}, {3}}));
    whole.join({{0, 1, 2}, {3}});
    Two two;
    std::array<JointIn, kJoints> joints{}, apart{};
    std::array<double, kJoints> torques{}, theirs{};
    std::vector<double> mobility;
    for (std::size_t i = 0; i < 3; ++i) mobility.insert(mobility.end(), &kB[i][0], &kB[i][3]);
    mobility.push_back(kB[3][3]);
    std::int64_t t_ns = 0;
    for (int n = 0; n < 1500; ++n, t_ns += dt_ns) {
      if (n == 40) {
        ASSERT_TRUE(whole.command(2, 0.5, 0.5));
        ASSERT_TRUE(two.hand.command(0, 0.5, 0.5));
      }
      if (n == 700) {  // another unit in the middle of it
        device::UnitConfig softer = test::maker_pro();
        softer.actuator.shaft_friction = {0.05, 0.02};
        whole.set_parameters(1, softer);
        two.arm.set_parameters(1, softer);
      }
      if (n == 900) {
        device::Faults off;
        off.powered = false;
        whole.set_faults(2, off);
        two.hand.set_faults(0, off);
      }
      whole.advance(t_ns, dt_ns, joints, torques, mobility);
      two.step(t_ns, dt_ns, apart, theirs);
      ASSERT_EQ(torques, theirs) << "step " << n << " of " << dt_ns << " ns";
      move(joints, torques, 1e-9 * static_cast<double>(dt_ns));
      move(apart, theirs, 1e-9 * static_cast<double>(dt_ns));
    }
    EXPECT_EQ(whole.read(2).motor_rad, two.hand.read(0).motor_rad);
    EXPECT_EQ(whole.ledger(1).coupling, two.arm.ledger(1).coupling);
    EXPECT_NE(whole.ledger(1).coupling, 0) << "nothing moved";
  }
}

/// One robot has joints on both trees, each tree two robots: all three step together.
TEST(RobotGroup, OfThreeRobotsOnTwoTreesMovesAsOneRobot) {
  Robot whole(robot({{0}, {1, 3}, {2}}));  // actuators 0, 1, 3, 2
  whole.join({{0, 1}, {2, 3}});
  RobotGroup group(3, {{{0, 0}, {1, 0}}, {{1, 1}, {2, 0}}});
  std::vector<Robot> three;
  for (const auto& buses : {std::vector<std::vector<int>>{{0}}, {{1, 3}}, {{2}}}) three.emplace_back(robot(buses));
  for (std::size_t r = 0; r < 3; ++r) three[r].join({}, group.shared(r));
  const std::array<double, 8> b{3e3, -2e3, -2e3, 9e3, 5e3, -1e3, -1e3, 2e3};
  std::array<JointIn, 4> joints{};
  for (std::int64_t n = 0; n < 800; ++n) {
    if (n == 40) {
      ASSERT_TRUE(whole.command(1, 0.4, 0.5));
      ASSERT_TRUE(three[1].command(0, 0.4, 0.5));
    }
    std::array<double, 4> torques{};
    std::array<std::array<double, 2>, 3> theirs{};
    whole.advance(n * 1'300'000, 1'300'000, joints, torques, b);
    const std::span<const JointIn> all(joints);
    const std::array<std::size_t, 3> first{0, 1, 3}, count{1, 2, 1};
    for (std::size_t r = 0; r < 3; ++r)
      group.steps()[r] = {&three[r], n * 1'300'000, all.subspan(first[r], count[r]), std::span(theirs[r]).first(count[r]), {}};
    std::copy(b.begin(), b.end(), group.mobility().begin());
    group.advance(1'300'000);
    ASSERT_EQ(torques, (std::array<double, 4>{theirs[0][0], theirs[1][0], theirs[1][1], theirs[2][0]})) << "step " << n;
    for (std::size_t tree = 0; tree < 4; tree += 2) {
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t k = 0; k < 2; ++k)
          joints[tree + i].speed_rad_per_s += 1.3e-3 * b[2 * tree + 2 * i + k] * torques[tree + k];
    }
    for (JointIn& j : joints) j.angle_rad += 1.3e-3 * j.speed_rad_per_s;
  }
  EXPECT_GT(std::abs(joints[1].angle_rad), 0.1) << "nothing moved";
}

TEST(RobotGroup, GoesOnFromSnapshotsAndWithCopiesOfItsRobots) {
  Two two;
  std::array<JointIn, kJoints> joints{};
  std::array<double, kJoints> torques{};
  const auto run = [&](Two& of, std::array<JointIn, kJoints> from, int first) {
    for (int n = 0; n < 200; ++n) {
      of.step((first + n) * 1'000'000, 1'000'000, from, torques);
      move(from, torques, 1e-3);
    }
    return from;
  };
  two.arm.command(0, 0.4, 0.2);
  joints = run(two, joints, 0);
  const auto arm = two.arm.snapshot(), hand = two.hand.snapshot();
  Two copy;
  copy.arm = two.arm.clone();
  copy.hand = two.hand.clone();
  const double after = run(two, joints, 200)[1].angle_rad;
  EXPECT_EQ(run(copy, joints, 200)[1].angle_rad, after);
  two.arm.restore(*arm);
  two.hand.restore(*hand);
  EXPECT_EQ(run(two, joints, 200)[1].angle_rad, after);
  EXPECT_NE(joints[1].angle_rad, after);
}

TEST(RobotGroup, WithoutAMatrixThatCanBeUsedEachJointIsByItself) {
  Two two;
  std::array<JointIn, kJoints> joints{};
  joints[1].angle_rad = 0.1;
  for (JointIn& j : joints) j.inverse_inertia = 1e3;
  Robot alone(robot({{2}}));
  const std::array<JointIn, 1> one{joints[2]};
  std::array<double, 1> torque{};
  alone.advance(0, 1'000'000, one, torque);
  const std::array<JointIn, 3> of_arm{joints[0], joints[1], joints[3]};
  std::array<double, 3> arm_Nm{};
  std::array<double, 1> hand_Nm{};
  two.group.steps()[0] = {&two.arm, 0, of_arm, arm_Nm, {}};
  two.group.steps()[1] = {&two.hand, 0, one, hand_Nm, {}};
  std::fill(two.group.mobility().begin(), two.group.mobility().end(), 0.0);
  two.group.advance(1'000'000);
  EXPECT_NEAR(hand_Nm[0], torque[0], 1e-9);
  EXPECT_LT(arm_Nm[1], -0.05) << "it was turned";
}

}  // namespace
