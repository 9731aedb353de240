// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "plans.hpp"
#include "vsa/engine/world.hpp"
#include "vsa/seat/seat.hpp"
#include "vsa/sweep/pool.hpp"

namespace vsa::sweep::testing {
namespace {

const std::string kPlan = R"(
repetitions = 2
[scenario]
world = "bench_pole"
duration_s = 0.2
faults = ["shaft noise_rad=0.003"]
[[command]]
time_s = 0.01
actuator = "shaft"
equilibrium_rad = 0.3
[[vary]]
key = "set.drive.friction_Nm"
list = [0.3, 0.6]
[[vary]]
key = "link.mass_kg"
of = "qbmove_bench_pole::pole"
name = "mass_factor"
factor = true
list = [1.0, 1.5]
[[vary]]
key = "command.0.equilibrium_rad"
name = "target_rad"
list = [0.3, 0.5]
[[measure]]
name = "shaft_rad"
signal = "shaft_rad"
actuator = "shaft"
[[measure]]
name = "hinge_peak_rad"
signal = "position"
joint = "qbmove_bench_pole::hinge"
statistic = "peak"
[[measure]]
name = "pole_z_m"
signal = "z_m"
link = "qbmove_bench_pole::pole"
statistic = "mean"
from_s = 0.1
[[measure]]
name = "supply_J"
signal = "supply_J"
)";

void expect_same(const Outcome& a, const Outcome& b) {
  EXPECT_EQ(a.error, b.error);
  EXPECT_EQ(a.values, b.values) << "run " << a.run;
}

TEST(Runner, ARunFollowsFromItsNumberWhateverRanBefore) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, kPlan);
  ASSERT_EQ(plan.runs(), 16U);
  Runner forwards(plan), backwards(plan);
  std::vector<Outcome> first(16), second(16);
  for (std::size_t r = 0; r < 16; ++r) first[r] = *forwards.run(r);
  for (std::size_t r = 16; r-- > 0;) second[r] = *backwards.run(r);
  for (std::size_t r = 0; r < 16; ++r) {
    ASSERT_EQ(first[r].error, "");
    expect_same(first[r], second[r]);
    expect_same(first[r], *Runner(plan).run(r));
    for (std::size_t other = 0; other < r; ++other) EXPECT_NE(first[other].values, first[r].values) << other << " " << r;
  }
}

/// The same by hand, from what the plan says.
TEST(Runner, ItsNumbersAreThoseOfAWorldThatIsStepped) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, kPlan);
  const Outcome outcome = *Runner(plan).run(2 * 7);  // 0.6 N·m, 1.5 times the mass, 0.5 rad
  engine::WorldOptions with;
  with.actuator.overrides = {{"drive.friction_Nm", "0.6"}};
  engine::World world = engine::World::load("bench_pole.sdf", with);
  const auto pole = world.link("qbmove_bench_pole::pole");
  engine::LinkParameters parameters = world.link_parameters(pole);
  parameters.mass_kg *= 1.5;
  for (double& moment : parameters.inertia_kgm2) moment *= 1.5;
  world.set_link_parameters(pole, parameters);
  static_cast<void>(world.seat(0).apply_faults("shaft noise_rad=0.003 seed=1", "here"));
  double peak = 0, height = 0;
  int count = 0;
  bool told = false;
  while (world.time_ns() < 200'000'000) {
    if (!told && world.time_s() >= 0.01) told = world.robot(0).command(0, 0.5, std::nullopt);
    world.step();
    peak = std::max(peak, std::abs(world.joint_angle("qbmove_bench_pole::hinge")));
    if (world.time_s() > 0.1) height += world.pose(pole).position[2], ++count;
  }
  const double by_hand[] = {world.read("shaft").shaft_rad, peak, height / count, world.ledger().supply};
  ASSERT_EQ(outcome.values.size(), 4U);
  // A moment of inertia that goes with its mass may differ in its last digit.
  for (std::size_t m = 0; m < 4; ++m) EXPECT_NEAR(outcome.values[m], by_hand[m], 1e-12) << m;
}

/// 0.3 s are 300 steps of 1 ms, whatever 300 000 000 times 1e-9 is.
TEST(Runner, AWindowEndsWithTheStepThatItNames) {
  const Scratch scratch;
  const auto hinge = [](const char* name, const char* more) {
    return std::string("[[measure]]\nname = \"") + name + "\"\nsignal = \"position\"\njoint = \"qbmove_bench_pole::hinge\"\n" +
           more;
  };
  const Plan plan = plan_of(scratch, "[scenario]\nworld = \"bench_pole\"\nduration_s = 0.3\n" + hinge("last", "") +
                                         hinge("until", "to_s = 0.3\n") + hinge("before", "to_s = 0.299\n") +
                                         hinge("from", "from_s = 0.299\nstatistic = \"first\"\n"));
  const auto values = Runner(plan).run(0)->values;
  EXPECT_EQ(values[1], values[0]);
  EXPECT_NE(values[2], values[0]);
  EXPECT_EQ(values[3], values[0]);
}

TEST(Runner, ADistanceThatIsNotMeasuredYetIsNoNumber) {
  const Scratch scratch;
  const auto far = [&](const char* duration_s) {
    return Runner(plan_of(scratch, std::string("[scenario]\nworld = \"snake_flat\"\nduration_s = ") + duration_s +
                                       "\n[motion]\nfile = \"sidewind\"\n[[measure]]\nname = \"far_m\"\nsignal = "
                                       "\"travel_path_m\"\nstatistic = \"max\"\n"))
        .run(0)
        ->values[0];
  };
  EXPECT_TRUE(std::isnan(far("1.0"))) << "less than the gait's period";
  EXPECT_GT(far("4.0"), 0.01);
}

TEST(Runner, RepetitionsOfAFreeRobotBeginElsewhere) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, R"(
repetitions = 8
[scenario]
world = "snake_flat"
duration_s = 0.001
[start]
yaw_deg = 2.0
xy_m = 0.05
[[measure]]
name = "x_m"
signal = "center_x_m"
[[measure]]
name = "y_m"
signal = "center_y_m"
)");
  plan.check();
  Runner runner(plan);
  const auto from = engine::World::load("snake_flat.sdf").center_of_mass("qbmove_snake");
  double least = 1, most = -1;
  for (std::size_t r = 0; r < 8; ++r) {
    const auto values = runner.run(r)->values;
    least = std::min(least, values[0] - from[0]);
    most = std::max(most, values[0] - from[0]);
  }
  EXPECT_GE(least, -0.08);
  EXPECT_LE(most, 0.08);
  EXPECT_GT(most - least, 0.03) << "eight draws from a width of 0.1 m";
}

TEST(Runner, WhatGoesWrongIsTheOutcome) {
  const Scratch scratch;
  const std::string two = R"(
[scenario]
world = "bench_pole"
duration_s = 1.0
[[vary]]
key = "scenario.duration_s"
list = [0.01, 1e6]
[[measure]]
name = "shaft_rad"
signal = "shaft_rad"
actuator = "shaft"
[limits]
run_s = 0.2
)";
  const Plan plan = plan_of(scratch, two);
  Runner runner(plan);
  EXPECT_EQ(runner.run(0)->error, "");
  const Outcome hangs = *runner.run(1);
  EXPECT_NE(hangs.error.find("run_s"), std::string::npos) << hangs.error;
  EXPECT_TRUE(hangs.values.empty());
  EXPECT_GE(hangs.wall_s, 0.2);
  EXPECT_EQ(runner.run(0)->error, "") << "the next one is as well as ever";
  int asked = 0;
  EXPECT_FALSE(runner.run(1, [&] { return ++asked < 5; }).has_value());
}

TEST(Runner, ABlowUpIsTheOutcome) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, kScenario + kMeasure + R"(
[[vary]]
key = "link.inertia_factor"
of = "qbmove_bench_load::flange"
list = [1.0, 1e-6]
[[vary]]
key = "scenario.step_s"
list = [0.001, 1.0]
)");
  Runner runner(plan);
  int failed = 0;
  for (std::size_t r = 0; r < plan.runs(); ++r) {
    const Outcome o = *runner.run(r);
    EXPECT_EQ(o.error.empty(), !o.values.empty());
    failed += o.error.empty() ? 0 : 1;
  }
  EXPECT_EQ(runner.run(0)->error, "");
  EXPECT_GE(failed, 2) << "a step of one second is refused";
}

TEST(Runner, AClampedCommandIsTold) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, kScenario + kMeasure + "[[command]]\ntime_s = 0.0\nactuator = \"shaft\"\npreset_rad = 3.0\n");
  EXPECT_NE(Runner(plan).run(0)->notice.find("preset"), std::string::npos);
}

TEST(Pool, ThreadsChangeNothing) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, kPlan);
  std::vector<std::vector<double>> by_threads[3];
  int k = 0;
  for (const unsigned threads : {1U, 2U, 5U}) {
    std::mutex lock;
    std::size_t next = 0;
    auto& values = by_threads[k++];
    values.resize(plan.runs());
    Work work;
    work.next = [&]() -> std::optional<std::size_t> {
      const std::scoped_lock guard(lock);
      return next < plan.runs() ? std::optional(next++) : std::nullopt;
    };
    work.done = [&](const Outcome& o) {
      const std::scoped_lock guard(lock);
      EXPECT_TRUE(values[o.run].empty()) << "twice";
      values[o.run] = o.values;
    };
    const Account account = run_pool(plan, threads, work);
    EXPECT_EQ(account.runs, plan.runs());
    EXPECT_EQ(account.threads, threads);
    EXPECT_GT(account.run_cpu_s, 0);
    EXPECT_LE(account.run_wall_s, account.span_s * threads * 1.01);
  }
  EXPECT_EQ(by_threads[0], by_threads[1]);
  EXPECT_EQ(by_threads[0], by_threads[2]);
}

TEST(Pool, WhatDoneThrowsEndsAllAndComesOut) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, kPlan);
  std::atomic<std::size_t> next{0};
  Work work;
  work.next = [&]() -> std::optional<std::size_t> { return next++ % plan.runs(); };  // for ever
  work.done = [&](const Outcome& o) {
    if (o.run == 5) throw std::runtime_error("the disk is full");
  };
  EXPECT_THROW(static_cast<void>(run_pool(plan, 3, work)), std::runtime_error);
}

TEST(GuidedChunk, AllAreDealtOutInFewChunksAndTheLastAreSingle) {
  for (const std::size_t total : {1U, 7U, 1000U, 1'000'000U}) {
    for (const std::size_t takers : {1U, 4U, 1000U}) {
      std::size_t left = total, chunks = 0, last = 0;
      while (left > 0) {
        last = guided_chunk(left, takers);
        ASSERT_GE(last, 1U);
        ASSERT_LE(last, left);
        left -= last;
        ++chunks;
      }
      EXPECT_EQ(last, 1U);
      const double each = static_cast<double>(kShare * takers);
      EXPECT_LE(static_cast<double>(chunks), each * (2 + std::log(std::max(1.0, static_cast<double>(total) / each))));
    }
  }
}

}  // namespace
}  // namespace vsa::sweep::testing
