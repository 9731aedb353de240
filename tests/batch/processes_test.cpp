// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A batch in a child of fork(), threads that throw, batches that are moved.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <limits>
#include <stdexcept>

#include "batch_test.hpp"
#include "vsa/elastic/series_spring.hpp"

namespace vsa::batch {
namespace {

using engine::World;

/// 0 where `work` in a child says so within 20 s, and nothing there crashes.
int child_status(const std::function<bool()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);
    _exit(work() ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  return status;
}

class BatchAfterAFork : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the thread sanitizer has no threads in a child of fork(): it takes them for those of the parent";
#endif
  }
};

TEST_F(BatchAfterAFork, EndsInTheChildAndInTheParent) {
  const World from = World::load("bench_load.sdf");
  auto batch = std::make_unique<Batch>(from, 4, 3);
  batch->step(5);
  EXPECT_EQ(child_status([&] {
              batch.reset();
              return true;
            }),
            0);
  EXPECT_EQ(child_status([&] {
              Batch moved = std::move(*batch);
              moved = Batch(from, 2, 2);
              moved.step();
              return moved.size() == 2;
            }),
            0);
  batch->step(5);
  EXPECT_EQ(batch->time_s()[3], 10 * from.step_s());
}

TEST_F(BatchAfterAFork, StepsInTheChildAsInTheParent) {
  const World from = World::load("bench_load.sdf");
  Batch batch(from, 4, 3), same(from, 4, 1);
  command(batch, 1);
  command(same, 1);
  batch.step(5);
  same.step(15);
  EXPECT_EQ(child_status([&] {
              batch.step(10);
              bool equal = true;
              for (std::size_t c = 0; c < 4; ++c) equal = equal && !first_difference(batch.state(c), same.state(c));
              // A grandchild, too; there the child's threads are left.
              return equal && child_status([&] {
                                batch.step(1);
                                return batch.status(0) == Status::running;
                              }) == 0;
            }),
            0);
  batch.step(10);
  for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(first_difference(batch.state(c), same.state(c)), std::nullopt) << c;
}

/// A law whose factory breaks for some numbers in a way that it shouldn't.
config::LawRegistry breaking() {
  config::LawRegistry laws = config::LawRegistry::standard();
  laws.add("series_spring", [](config::LawReader& reader) {
    const double k = reader.number("stiffness_Nm_per_rad", "N·m/rad", 1e-6, 1e7, "stiffness");
    if (k == 13) throw std::runtime_error("thirteen");
    if (k == 14) throw 14;
    return std::make_shared<elastic::SeriesSpring>(k);
  });
  return laws;
}

TEST(ABatchWhoseThreadThrows, TellsItWhenAllAreThroughAndGoesOn) {
  engine::WorldOptions options;
  options.types = config::TypeLibrary({}, breaking());
  options.actuator.type = "sea_example";
  Batch batch(World::load("bench_load.sdf", options), 6, 3);
  batch.set(2, "shaft", "elastic.stiffness_Nm_per_rad", 12.0);
  const Numbers before(batch.state(4).begin(), batch.state(4).end());
  for (const double bad : {13.0, 14.0}) {
    std::vector<Setting> all;
    for (std::size_t c = 0; c < 6; ++c) all.push_back({c, "shaft", "elastic.stiffness_Nm_per_rad", c == 4 ? bad : 20.0});
    if (bad == 13) {
      EXPECT_THROW(batch.set(all), std::runtime_error);
    } else {
      EXPECT_THROW(batch.set(all), int);
    }
  }
  EXPECT_EQ(batch.value(2, "shaft", "elastic.stiffness_Nm_per_rad"), 12.0);
  EXPECT_EQ(batch.parameters(0), batch.parameters(5));
  EXPECT_EQ(first_difference(batch.state(4), before), std::nullopt);
  batch.step(20);
  EXPECT_EQ(batch.time_s()[5], 20 * batch.world().step_s());
  EXPECT_NE(first_difference(batch.state(2), before), std::nullopt);
}

TEST(AMovedBatch, KeepsItsArraysAndParametersAndTheOtherSaysThatItIsGone) {
  const World from = World::load("bench_load.sdf");
  Batch first(from, 2, 2);
  first.set(1, "shaft", "drive.friction_Nm", 0.9);
  const double* const shaft = first.shaft_rad().data();
  Batch second = std::move(first);
  EXPECT_EQ(second.shaft_rad().data(), shaft);
  EXPECT_EQ(second.value(1, "", "drive.friction_Nm"), 0.9);
  // NOLINTBEGIN(bugprone-use-after-move)
  EXPECT_THROW(first.step(), std::logic_error);
  EXPECT_THROW(first.set(0, "shaft", "drive.friction_Nm", 1.0), std::logic_error);
  EXPECT_THROW(first.randomize(1, {}), std::logic_error);
  EXPECT_THROW(first.reset_parameters(), std::logic_error);
  EXPECT_THROW(static_cast<void>(first.parameters(0)), std::logic_error);
  // NOLINTEND(bugprone-use-after-move)
  first = Batch(from, 3, 1);
  second = std::move(first);
  second.step();
  EXPECT_EQ(second.size(), 3u);
}

TEST(ABatchOfNothing, DoesntLoadAndSaysWhy) {
  EXPECT_THROW(Batch(World::load("no_such_world.sdf"), 3), InputError);
  EXPECT_THROW(Batch(World::load("bench_load.sdf"), 0), InputError);
  Batch batch(World::load("bench_load.sdf"), 2, 2);
  for (const double wrong : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
    batch.preset()[1] = wrong;
    EXPECT_THROW(batch.step(), InputError);
  }
  batch.preset()[1] = std::nan("");
  batch.step();
  EXPECT_EQ(batch.time_s()[1], batch.world().step_s());
}

}  // namespace
}  // namespace vsa::batch
