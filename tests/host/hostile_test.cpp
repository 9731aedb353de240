// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Every public function of vsa::host with wrong sizes, numbers that are none, other robots' objects and robots that were moved
// from: an error in words or a line and an abort, and nothing else. Worth most under the sanitizers (preset asan).
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "host/free_flanges.hpp"
#include "host/topics_fixture.hpp"
#include "support/servos.hpp"
#include "vsa/elastic/series_spring.hpp"
#include "vsa/errors.hpp"
#include "vsa/host/mobility_watch.hpp"
#include "vsa/host/resolution.hpp"
#include "vsa/host/robot_group.hpp"
#include "vsa/host/topics.hpp"
#include "vsa/host/tree_foresight.hpp"
#include "vsa/host/tree_inertia.hpp"
#include "vsa/host/unit_kind.hpp"
#include "vsa/state_io.hpp"

namespace {

using vsa::InputError;
using vsa::host::JointIn;
using vsa::host::Robot;
using vsa::test::chain;
using Bench = vsa::test::Flanges;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

TEST(HostileRobot, AWrongStepEndsTheProgramInWords) {
  Bench bench(chain(2));
  std::vector<JointIn> in(2), short_in(1), long_in(3);
  std::vector<double> out(2), short_out(1);
  EXPECT_DEATH(bench.robot.advance(0, 1'000'000, short_in, out), "Robot::advance: in and torques_out need one entry an actuator");
  EXPECT_DEATH(bench.robot.advance(0, 1'000'000, long_in, out), "one entry an actuator");
  EXPECT_DEATH(bench.robot.advance(0, 1'000'000, in, short_out), "one entry an actuator");
  EXPECT_DEATH(bench.robot.advance(0, 1'000'000, {}, {}), "one entry an actuator");
  for (const std::int64_t dt : {std::int64_t{0}, std::int64_t{-1}, std::int64_t{16'000'001}, std::int64_t{40'000'000}})
    EXPECT_DEATH(bench.robot.advance(0, dt, in, out), "a step has 1 ns … 16 ms");
  EXPECT_DEATH(bench.robot.advance(-1, 1'000'000, in, out), "t is outside");
  EXPECT_DEATH(bench.robot.advance(std::numeric_limits<std::int64_t>::max(), 1'000'000, in, out), "t is outside");
  const Robot taken = std::move(bench.robot);
  EXPECT_DEATH(bench.robot.advance(0, 1'000'000, in, out), "moved from");
}

TEST(HostileGroup, WrongTreesAndRobotsAreRefusedInWords) {
  using vsa::host::RobotGroup;
  EXPECT_THROW(RobotGroup(2, {{{0, 0}, {2, 0}}}), InputError);
  EXPECT_THROW(RobotGroup(2, {{{0, 0}, {1, 0}}, {{1, 0}}}), InputError);
  EXPECT_THROW(RobotGroup(1, {{{kNowhere, 0}}}), InputError);
  RobotGroup group(2, {{{0, 0}, {1, 1}}, {}});
  EXPECT_THROW((void)group.shared(2), InputError);
  EXPECT_EQ(group.another().shared(1), group.shared(1));
  Bench a(chain(2)), b(chain(2));
  EXPECT_THROW(a.robot.join({{0, 1}}, {1}), InputError);
  EXPECT_THROW(a.robot.join({}, {2}), InputError);
  std::vector<double> out_a(2), out_b(2);
  EXPECT_DEATH(group.advance(1'000'000), "a robot is missing");
  group.steps()[0] = {&a.robot, 0, a.in, out_a, {}};
  group.steps()[1] = {&b.robot, 0, b.in, out_b, {}};
  EXPECT_DEATH(group.advance(1'000'000), "wasn't joined with its shared");
  a.robot.join({}, group.shared(0));
  b.robot.join({}, group.shared(1));
  EXPECT_DEATH(a.robot.advance(0, 1'000'000, a.in, out_a), "steps in its RobotGroup");
  EXPECT_DEATH(group.advance(0), "a step has 1 ns … 16 ms");
  group.steps()[1].torques_out = std::span(out_b).first(1);
  EXPECT_DEATH(group.advance(1'000'000), "one entry an actuator");
  group.steps()[1].torques_out = out_b;
  for (double& v : group.mobility()) v = kNan;
  group.advance(1'000'000);
  EXPECT_TRUE(std::isfinite(out_a[0]) && std::isfinite(out_b[1]));
  b.in[0].speed_rad_per_s = kNan;
  group.advance(1'000'000);
  EXPECT_TRUE(std::isnan(out_a[0]) && std::isnan(out_b[0]));
  RobotGroup none(0, {});
  none.advance(1'000'000);
}

TEST(HostileRobot, TheLongestAndTheShortestStepWork) {
  for (const std::int64_t dt : {std::int64_t{1}, std::int64_t{16'000'000}}) {
    Bench bench(chain(2), dt);
    bench.t_ns = 999'999;
    bench.run(3);
    EXPECT_TRUE(std::isfinite(bench.out[0]));
  }
}

TEST(HostileRobot, AJointThatIsNoNumberGivesNoneAndChangesNothing) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (int field = 0; field < 3; ++field) {
      Bench bench(chain(2));
      bench.run(5);
      const auto before = bench.robot.read(0);
      std::vector<JointIn> in = bench.in;
      (field == 0 ? in[1].angle_rad : field == 1 ? in[1].speed_rad_per_s : in[1].inverse_inertia.emplace()) = bad;
      bench.robot.advance(bench.t_ns, bench.dt_ns, in, bench.out);
      EXPECT_TRUE(std::isnan(bench.out[0]) && std::isnan(bench.out[1]));
      EXPECT_EQ(bench.robot.read(0).motor_rad, before.motor_rad);
      Bench untouched(chain(2));
      untouched.run(5);
      bench.run(10);
      untouched.run(10);
      EXPECT_EQ(bench.in[1].angle_rad, untouched.in[1].angle_rad);
    }
  }
}

TEST(HostileRobot, WhatNoShaftCouldHaveLeavesItAsItWas) {
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e13, 1e300}) {
    for (const bool acceleration : {false, true}) {
      Bench bench(chain(2)), untouched(chain(2));
      for (Bench* b : {&bench, &untouched}) b->run(5);
      std::vector<JointIn> in = bench.in;
      (acceleration ? in[1].free_acceleration_rad_per_s2 : in[1].inverse_inertia) = bad;
      bench.robot.advance(bench.t_ns, bench.dt_ns, in, bench.out);
      EXPECT_TRUE(std::isnan(bench.out[0]) && std::isnan(bench.out[1])) << bad;
      for (Bench* b : {&bench, &untouched}) b->run(10);
      EXPECT_EQ(bench.in[1].angle_rad, untouched.in[1].angle_rad) << bad;
    }
  }
  // 5 rad in one step; this law has no numbers beyond some tens.
  for (const double most : {1e7, -1e7}) {
    Bench bench(chain(1));
    bench.run(5);
    bench.in[0].free_acceleration_rad_per_s2 = most;
    bench.step();
    bench.in[0] = {0, 0, 1e3};
    bench.run(50);
    EXPECT_TRUE(std::isfinite(bench.in[0].angle_rad) && std::isfinite(bench.out[0])) << most << " for a step";
  }
}

TEST(HostileRobot, HugeNumbersEndInNumbersOrNone) {
  for (const double huge : {1e6, 1e20, 1e300}) {
    Bench bench(chain(1));
    std::vector<JointIn> in{{huge, -huge, 1e3}};
    std::vector<double> out(1);
    for (int n = 0; n < 3; ++n) bench.robot.advance(n * 1'000'000, 1'000'000, in, out);
    static_cast<void>(bench.robot.read(0));
    EXPECT_TRUE(bench.robot.command(0, huge, huge));
    EXPECT_TRUE(bench.robot.follow(0, Robot::Channel::equilibrium, {{0.5, huge}}));
    bench.robot.advance(3'000'000, 1'000'000, in, out);
    static_cast<void>(bench.robot.take_notices());
  }
}

TEST(HostileRobot, AnActuatorThatIsNotThereIsAnError) {
  Bench bench(chain(2));
  Robot& r = bench.robot;
  for (const std::size_t i : {std::size_t{2}, std::size_t{9}, kNowhere}) {
    EXPECT_THROW((void)r.read(i), InputError);
    EXPECT_THROW((void)r.received_inputs(i), InputError);
    EXPECT_THROW((void)r.ledger(i), InputError);
    EXPECT_THROW((void)r.faults(i), InputError);
    EXPECT_THROW(r.set_faults(i, {}), InputError);
    EXPECT_THROW(r.check_faults(i, {}), InputError);
    EXPECT_THROW(r.place(i, {}), InputError);
    EXPECT_THROW(r.relocate(i, 0.1), InputError);
    EXPECT_THROW(r.set_parameters(i, vsa::test::maker_pro()), InputError);
    EXPECT_FALSE(r.command(i, 0.1, 0.1));
    EXPECT_FALSE(r.follow(i, Robot::Channel::preset, {{0.0, 0.1}}));
    EXPECT_EQ(r.serial_line(i), nullptr);
  }
  EXPECT_FALSE(r.find("nobody"));
  EXPECT_FALSE(r.find({}));
}

TEST(HostileRobot, NumbersThatAreNoneAreRefused) {
  Bench bench(chain(1));
  Robot& r = bench.robot;
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    EXPECT_FALSE(r.command(0, bad, std::nullopt));
    EXPECT_FALSE(r.command(0, std::nullopt, bad));
    EXPECT_FALSE(r.follow(0, Robot::Channel::preset, {{0.0, bad}}));
    EXPECT_FALSE(r.follow(0, Robot::Channel::preset, {{bad, 0.0}}));
    vsa::device::Faults faults;
    faults.lost_byte = bad;
    EXPECT_THROW(r.set_faults(0, faults), InputError);
    faults = {};
    faults.encoder[2].noise_rad = bad;
    EXPECT_THROW(r.set_faults(0, faults), InputError);
    faults = {};
    faults.supply_V = bad;
    EXPECT_THROW(r.set_faults(0, faults), InputError);
  }
  EXPECT_FALSE(r.follow(0, Robot::Channel::preset, {}));
  EXPECT_FALSE(r.follow(0, static_cast<Robot::Channel>(7), {{0.0, 0.1}}));
  EXPECT_FALSE(r.follow({{0, Robot::Channel::preset, {{0.0, 0.1}}}, {0, static_cast<Robot::Channel>(-1), {{0.0, 0.1}}}}));
  EXPECT_FALSE(r.follow(0, Robot::Channel::preset, {{-1.0, 0.0}}));
  EXPECT_FALSE(r.follow(0, Robot::Channel::preset, {{1e10, 0.0}}));
  EXPECT_TRUE(r.command(std::span<const Robot::Command>{}));
  bench.step();
  EXPECT_EQ(r.read(0).equilibrium_command_rad, 0.0);
}

TEST(HostileRobot, ParametersOfAnotherRobotOrOfNoneAreRefusedAndNothingChanged) {
  Bench bench(chain(2)), untouched(chain(2));
  Robot& r = bench.robot;
  for (Bench* b : {&bench, &untouched}) b->run(3);
  using Parameters = std::shared_ptr<const vsa::host::RobotConfig>;
  const auto spoiled = [&](auto&& spoil) -> Parameters {
    auto config = *r.parameters();
    spoil(config);
    return std::make_shared<const vsa::host::RobotConfig>(config);
  };
  using Spoiled = vsa::host::RobotConfig;
  const std::vector<Parameters> of_others{
      nullptr,
      Robot(chain(1)).parameters(),
      Robot(chain(3)).parameters(),
      Robot({}).parameters(),
      spoiled([](Spoiled& c) { c.actuators[1].name = "else"; }),
      spoiled([](Spoiled& c) { c.actuators[1].unit.actuator.transmission = nullptr; }),
      spoiled([](Spoiled& c) { c.actuators[1].unit.program.model = vsa::firmware::Model::advanced; }),
      spoiled([](Spoiled& c) { c.actuators[1].unit.actuator.transmission = std::make_shared<vsa::elastic::SeriesSpring>(2.0); }),
      spoiled([](Spoiled& c) { c.actuators[1].unit.servo.emplace(); })};
  for (const Parameters& theirs : of_others) {
    EXPECT_THROW(r.check(theirs), InputError);
    EXPECT_THROW(r.set_parameters(theirs), InputError);
    EXPECT_THROW(r.use(theirs), InputError);
    if (!theirs) continue;
    EXPECT_THROW((void)r.parameters_with(*theirs, {}, 1'000'000), InputError);
  }
  const Parameters broken = spoiled([](Spoiled& c) { c.actuators[1].unit.actuator.shaft_inertia_kgm2 = kNan; });
  EXPECT_THROW(r.set_parameters(broken), InputError);
  EXPECT_THROW(r.use(broken), InputError);
  const Parameters now = r.parameters();
  std::vector<std::pair<std::size_t, vsa::host::ActuatorConfig>> change{{1, broken->actuators[1]}};
  EXPECT_THROW((void)r.parameters_with(*now, change, 1'000'000), InputError);
  change[0] = {2, now->actuators[1]};
  EXPECT_THROW((void)r.parameters_with(*now, change, 1'000'000), InputError);
  change[0].first = kNowhere;
  EXPECT_THROW((void)r.parameters_with(*now, change, 1'000'000), InputError);
  for (const std::int64_t dt :
       {std::int64_t{0}, std::int64_t{-1}, std::int64_t{16'000'001}, std::numeric_limits<std::int64_t>::max()})
    EXPECT_THROW((void)r.parameters_with(*now, {}, dt), InputError) << dt;
  EXPECT_EQ(r.parameters(), now);
  EXPECT_TRUE(r.has_own_memories());
  r.renew_memories();
  for (Bench* b : {&bench, &untouched}) b->run(5);
  EXPECT_EQ(r.state_hash(), untouched.robot.state_hash());
}

TEST(HostileRobot, NumbersThatAreNoStateOfItsOwnAreRefusedAndNothingChanged) {
  Bench bench(chain(2));
  Robot& r = bench.robot;
  bench.run(3);
  const std::uint64_t hash = r.state_hash();
  const std::size_t n = r.state_size();
  ASSERT_EQ(n, r.state_layout().size());
  std::vector<double> numbers(n + 1, kNan);
  for (const std::size_t wrong : {std::size_t{0}, n - 1, n + 1}) {
    EXPECT_THROW(r.save(std::span(numbers).first(wrong)), InputError);
    EXPECT_THROW(r.restore(std::span<const double>(numbers).first(wrong)), InputError);
    EXPECT_THROW(r.check(std::span<const double>(numbers).first(wrong)), InputError);
  }
  EXPECT_THROW(r.restore(std::span<const double>(numbers).first(n)), InputError);
  EXPECT_THROW((void)r.restore_tight({}), InputError);
  EXPECT_THROW((void)r.restore_tight(numbers), InputError);
  vsa::state::Rewriter small(3, n - 1), right(3, n);
  EXPECT_THROW(r.save_tight(small), InputError);
  r.save_tight(right);
  EXPECT_THROW(r.save_tight(right), InputError) << "behind the one that stands there, without begin()";
  const std::vector<double> tight(right.numbers().begin() + 3, right.numbers().end());
  for (std::size_t k = 0; k < tight.size(); ++k)
    EXPECT_THROW((void)r.restore_tight(std::span(tight).first(k)), InputError) << k << " of " << tight.size();
  vsa::state::Rewriter taken = std::move(right);
  EXPECT_THROW(r.save_tight(right), InputError);  // NOLINT(bugprone-use-after-move): that is what is tested
  EXPECT_EQ(r.state_hash(), hash);
  EXPECT_EQ(r.restore_tight(tight), tight.size());
  EXPECT_EQ(r.state_hash(), hash);
}

TEST(HostileRobot, GoesBackToTheFirstSampleWhereNothingWasKept) {
  Bench bench(chain(2));
  const std::uint64_t first = bench.robot.state_hash();
  bench.run(3);
  bench.robot.go_back();
  EXPECT_EQ(bench.robot.state_hash(), first);
}

TEST(HostileRobot, DirectCommandsAreForWhoTakesThem) {
  Robot r(chain(1));
  EXPECT_THROW(r.command_direct(0, {1, 1}), InputError) << "a qbmove's program takes no voltages";
  auto config = chain(1);
  config.actuators[0].unit = vsa::test::series(vsa::test::motor_voltages(), 10);
  Robot direct(config);
  for (const std::size_t i : {std::size_t{1}, kNowhere}) EXPECT_THROW(direct.command_direct(i, {1, 1}), InputError);
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    EXPECT_THROW(direct.command_direct(0, {bad, 0}), InputError);
    EXPECT_THROW(direct.command_direct(0, {0, bad}), InputError);
  }
}

TEST(HostileRobot, AConfigThatNoRobotCouldHaveIsRefused) {
  const auto refused = [](auto&& spoil) {
    auto config = chain(2);
    spoil(config);
    EXPECT_THROW(Robot{config}, InputError);
  };
  refused([](auto& c) { c.actuators[0].bus = 7; });
  refused([](auto& c) { c.actuators[0].id = 0; });
  refused([](auto& c) { c.actuators[0].id = 255; });
  refused([](auto& c) { c.actuators[1].initial_equilibrium_rad = kNan; });
  refused([](auto& c) { c.actuators[1].initial_preset = kInfinity; });
  refused([](auto& c) { c.buses[0].baud_Hz = kNan; });
  refused([](auto& c) { c.buses[0].baud_Hz = 0; });
  refused([](auto& c) { c.buses[0].cycle_s = -1; });
  refused([](auto& c) { c.buses[0].cycle_s = kNan; });
  refused([](auto& c) { c.state_rate_Hz = kNan; });
  refused([](auto& c) { c.state_rate_Hz = 0; });
  refused([](auto& c) { c.record = {"out", kNan}; });
  refused([](auto& c) { c.buses.clear(); });
  refused([](auto& c) { c.actuators[1].unit.actuator.transmission = nullptr; });
  refused([](auto& c) { c.actuators[1].unit.substep_max_s = kNan; });
  vsa::Problems problems;
  auto config = chain(2);
  config.actuators[1].unit.actuator.transmission = nullptr;
  vsa::host::validate(config, "there: ", problems);
  EXPECT_FALSE(problems.list().empty());
  Robot none{{}};
  none.advance(0, 1'000'000, {}, {});
  none.reset();
}

TEST(HostileRobot, OneThatWasMovedFromSaysSo) {
  Bench bench(chain(1));
  const auto snapshot = bench.robot.snapshot();
  const auto parameters = bench.robot.parameters();
  std::vector<double> numbers(bench.robot.state_size());
  Robot taken = std::move(bench.robot);
  Robot& r = bench.robot;
  EXPECT_THROW((void)r.config(), std::logic_error);
  EXPECT_THROW((void)r.size(), std::logic_error);
  EXPECT_THROW((void)r.find("a1"), std::logic_error);
  EXPECT_THROW((void)r.command(0, 0.1, 0.1), std::logic_error);
  EXPECT_THROW((void)r.command(std::span<const Robot::Command>{}), std::logic_error);
  EXPECT_THROW((void)r.follow(0, Robot::Channel::preset, {{0.0, 0.1}}), std::logic_error);
  EXPECT_THROW((void)r.read(0), std::logic_error);
  EXPECT_THROW((void)r.received_inputs(0), std::logic_error);
  EXPECT_THROW((void)r.ledger(0), std::logic_error);
  EXPECT_THROW((void)r.ledger(), std::logic_error);
  EXPECT_THROW((void)r.take_notices(), std::logic_error);
  EXPECT_THROW((void)r.is_stiff(), std::logic_error);
  EXPECT_THROW(r.set_supply(true), std::logic_error);
  EXPECT_THROW(r.set_faults(0, {}), std::logic_error);
  EXPECT_THROW((void)r.faults(0), std::logic_error);
  EXPECT_THROW((void)r.serial_line(0), std::logic_error);
  EXPECT_THROW(r.place(0, {}), std::logic_error);
  EXPECT_THROW(r.relocate(0, 0.1), std::logic_error);
  EXPECT_THROW(r.set_parameters(0, vsa::test::maker_pro()), std::logic_error);
  EXPECT_THROW((void)r.clone(), std::logic_error);
  EXPECT_THROW((void)r.snapshot(), std::logic_error);
  EXPECT_THROW(r.restore(*snapshot), std::logic_error);
  EXPECT_THROW(r.check(*snapshot), std::logic_error);
  EXPECT_THROW(r.reset(), std::logic_error);
  EXPECT_THROW(r.join({}), std::logic_error);
  EXPECT_THROW((void)r.mobility_size(), std::logic_error);
  EXPECT_THROW(r.command_direct(0, {}), std::logic_error);
  EXPECT_THROW((void)r.follow(std::vector<Robot::Path>{}), std::logic_error);
  EXPECT_THROW((void)r.parameters(), std::logic_error);
  EXPECT_THROW((void)r.parameters_with(*parameters, {}, 1'000'000), std::logic_error);
  EXPECT_THROW(r.set_parameters(parameters), std::logic_error);
  EXPECT_THROW(r.use(parameters), std::logic_error);
  EXPECT_THROW(r.check(parameters), std::logic_error);
  EXPECT_THROW(r.renew_memories(), std::logic_error);
  EXPECT_THROW((void)r.has_own_memories(), std::logic_error);
  EXPECT_THROW((void)r.state_layout(), std::logic_error);
  EXPECT_THROW((void)r.state_size(), std::logic_error);
  EXPECT_THROW(r.save(numbers), std::logic_error);
  EXPECT_THROW(r.restore(std::span<const double>(numbers)), std::logic_error);
  EXPECT_THROW(r.check(std::span<const double>(numbers)), std::logic_error);
  vsa::state::Rewriter tight(0, numbers.size());
  EXPECT_THROW(r.save_tight(tight), std::logic_error);
  EXPECT_THROW((void)r.restore_tight(numbers), std::logic_error);
  EXPECT_THROW((void)r.state_hash(), std::logic_error);
  EXPECT_THROW(r.keep(), std::logic_error);
  EXPECT_THROW(r.go_back(), std::logic_error);
  r = std::move(taken);
  EXPECT_EQ(r.size(), 1U) << "and works again once it is given a robot";
}

TEST(HostileTopics, NamesAndObjectsThatWereMovedFrom) {
  EXPECT_THROW((void)vsa::host::topic_scope("", "model"), InputError);
  EXPECT_THROW((void)vsa::host::topic_scope("a::", "model"), InputError);
  EXPECT_THROW((void)vsa::host::topic_scope("a b", "model"), InputError);
  EXPECT_THROW((void)vsa::host::model_topic("", ""), InputError);
  EXPECT_THROW((void)vsa::host::joint_topic("m", "::", ""), InputError);
  Robot robot(chain(1));
  vsa::test::FakeTransport transport;
  EXPECT_THROW(vsa::host::RobotTopics(robot, "bad name", transport, nullptr), InputError);
  vsa::host::RobotTopics topics(robot, "m", transport, nullptr);
  topics.update(std::numeric_limits<std::int64_t>::min());
  topics.publish(std::numeric_limits<std::int64_t>::max());
  vsa::host::RobotTopics taken = std::move(topics);
  EXPECT_THROW(topics.update(0), std::logic_error);  // NOLINT(bugprone-use-after-move): that is what is tested
  EXPECT_THROW(topics.publish(0), std::logic_error);
  EXPECT_THROW((void)topics.refused(), std::logic_error);
}

TEST(HostileTree, WrongSizesAndParentsEndTheProgramInWords) {
  using vsa::host::TreeBody;
  vsa::host::TreeInertia tree(2);
  std::vector<TreeBody> bodies(2);
  const std::vector<std::size_t> both{0, 1}, beyond{2};
  std::vector<double> matrix(4), short_matrix(3);
  EXPECT_DEATH(tree.update({bodies[0]}), "as many entries");
  bodies[0].parent = 1;
  EXPECT_DEATH(tree.update(bodies), "before its children");
  bodies[0].parent = TreeBody::kGround;
  bodies[1].parent = 0;
  bodies[1].joint = TreeBody::Joint::revolute;
  bodies[1].axis = {kNan, 0, 0};
  tree.update(bodies);
  EXPECT_DEATH(tree.mobility(bodies, both, short_matrix), "their sizes");
  EXPECT_DEATH(tree.mobility(bodies, beyond, std::span(matrix).first(1)), "no such body");
  tree.mobility(bodies, both, matrix);
  EXPECT_TRUE(std::isnan(matrix[3])) << "without mass";
  vsa::host::TreeInertia none(0);
  none.update({});
  none.mobility({}, {}, {});
}

TEST(HostileTree, BodiesThatHangOnNoneOrOnThemselvesEndTheProgramInWords) {
  using vsa::host::TreeBody;
  std::vector<TreeBody> bodies(2);
  bodies[1].joint = TreeBody::Joint::revolute;
  const std::vector<std::size_t> last{1}, beyond{2};
  EXPECT_DEATH((void)vsa::host::joined(bodies, beyond), "no such body");
  EXPECT_DEATH((void)vsa::host::joined({}, last), "no such body");
  for (const std::size_t wrong : {std::size_t{1}, std::size_t{2}, kNowhere - 1}) {
    bodies[1].parent = wrong;
    EXPECT_DEATH((void)vsa::host::joined(bodies, last), "before their children") << wrong;
  }
  EXPECT_TRUE(vsa::host::joined({}, {}).empty());
}

TEST(HostileTree, AWatchOverOtherJointsEndsTheProgramInWords) {
  vsa::host::MobilityWatch watch(2), none;
  std::vector<JointIn> joints(3);
  EXPECT_DEATH((void)watch.due(std::span<const JointIn>(joints).first(1)), "one entry a driven joint");
  EXPECT_DEATH((void)watch.due(joints), "one entry a driven joint");
  EXPECT_DEATH((void)none.due(joints), "one entry a driven joint");
  EXPECT_TRUE(none.due({}));
  joints[0].angle_rad = kNan;
  EXPECT_TRUE(watch.due(std::span<const JointIn>(joints).first(2)));
}

TEST(HostileTree, ForesightOfOtherBodiesOrWithoutNumbersTellsNothingWrong) {
  using vsa::host::TreeBody, vsa::host::TreeForesight, vsa::host::TreeInertia;
  constexpr double kMost = 1e12;
  std::vector<TreeBody> bodies(2);
  for (std::size_t i = 0; i < 2; ++i) {
    bodies[i] = {i == 0 ? TreeBody::kGround : 0, TreeBody::Joint::revolute, {0, 1, 0}, {}, 1, {1, 0, 0}};
    bodies[i].damping = 0.1;
    bodies[i].weight_N = {0, 0, -9.81};
  }
  TreeInertia inertia(2);
  inertia.update(bodies);
  TreeForesight two(2), none(0);
  TreeForesight::Memory memory = two.begin(), others;
  std::vector<double> one(1), out(2), q(2), v(2);
  EXPECT_DEATH(inertia.answer(bodies, one, out), "as many entries as it has");
  EXPECT_DEATH(inertia.answer({}, q, out), "as many entries as it has");
  EXPECT_DEATH(two.torques(bodies, q, one, out), "as many entries as it has");
  EXPECT_DEATH(two.foresee(bodies, inertia, one, v, 1e-3, memory, out), "as many entries as it has");
  EXPECT_DEATH(two.foresee(bodies, inertia, q, v, 1e-3, others, out), "begin");
  std::vector<TreeBody> turned = bodies;
  turned[0].parent = 1;
  EXPECT_DEATH(two.torques(turned, q, v, out), "a parent comes before its children");
  others = none.begin();
  none.foresee({}, inertia, {}, {}, 1e-3, others, {});
  none.torques({}, {}, {}, {});
  two.foresee(bodies, inertia, q, v, 1e-3, memory, out);
  EXPECT_TRUE(std::isnan(out[0])) << "nothing is known of a step before";
  for (const double x : {kNan, kInfinity, kMost}) {
    for (std::vector<double>* number : {&q, &v}) {
      (*number)[0] = x;
      two.foresee(bodies, inertia, q, v, 1e-3, memory, out);
      (*number)[0] = 0;
      two.foresee(bodies, inertia, q, v, x, memory, out);
      two.foresee(bodies, inertia, q, v, 1e-3, memory, out);
      two.foresee(bodies, inertia, q, v, 1e-3, memory, out);
      EXPECT_EQ(out[0], 0) << x << ": it stands";
    }
  }
  memory.forget();
  two.foresee(bodies, inertia, q, v, 1e-3, memory, out);
  EXPECT_TRUE(std::isnan(out[0]));
}

TEST(HostileKind, AUnitWithoutALawHasNoMotors) {
  vsa::device::UnitConfig unit;
  EXPECT_EQ(vsa::host::kind_of(unit)[3], 0);
  unit.actuator.transmission = vsa::test::maker_pro().actuator.transmission;
  EXPECT_EQ(vsa::host::kind_of(unit), vsa::host::kind_of(vsa::test::maker_pro()));
  EXPECT_EQ(vsa::host::kind_of(unit)[3], 2);
}

TEST(HostileTree, AStepThatIsNoNumberResolvesNothingWrong) {
  for (const double x : {kNan, -kInfinity, -1.0, 0.0}) {
    EXPECT_EQ(vsa::host::resolution(x).radius, 1);
    EXPECT_EQ(vsa::host::resolution(x).frequency, 1);
  }
  for (const double x : {1e-300, 1e3, 1e75, 1e200, kInfinity}) {
    const vsa::host::Resolution r = vsa::host::resolution(x);
    EXPECT_TRUE(r.radius >= 0 && r.radius <= 1 && r.frequency >= 0 && r.frequency <= 1 + 1e-9)
        << x << ": " << r.radius << ", " << r.frequency;
  }
}

TEST(HostileTree, MatricesThatAreNoneLeaveEachJointByItself) {
  vsa::host::Robot robot(vsa::test::chain(2));
  EXPECT_THROW(robot.join({{0, 2}}), InputError);
  EXPECT_THROW(robot.join({{0}, {1, 0}}), InputError);
  robot.join({{1, 0}});
  ASSERT_EQ(robot.mobility_size(), 4u);
  const std::vector<vsa::host::JointIn> in(2, vsa::host::JointIn{0.1, 0.0, 1e3});
  std::vector<double> torques(2);
  EXPECT_DEATH(robot.advance(0, 1'000'000, in, torques, std::vector<double>(3)), "mobility_size");
  EXPECT_DEATH(robot.observe(std::span(in).first(1)), "one entry an actuator");
  std::int64_t t = 0;
  for (const double bad : {kNan, 0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    robot.advance(t, 1'000'000, in, torques, std::vector<double>{bad, 1, 1, 1e3});
    robot.advance(t + 1'000'000, 1'000'000, in, torques, std::vector<double>{1e3, 1e6, 1e6, 1e3});  // not positive definite
    t += 2'000'000;
    for (const double torque : torques) EXPECT_TRUE(std::isfinite(torque)) << bad;
  }
}

}  // namespace
