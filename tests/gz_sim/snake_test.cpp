// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The snake and the single module for a simulated minute, ten with VSA_TEST_LONG.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

#include "gz_snake.hpp"
#include "support/heap.hpp"

namespace vsa::test {
namespace {

int minutes() { return std::getenv("VSA_TEST_LONG") != nullptr ? 10 : 1; }

struct Minutes {
  std::vector<std::vector<double>> angles;  ///< one a gait period
  double path_m = 0;
  std::vector<long> kB;  ///< of heap, after each gait period
};

Minutes crawl() {
  SnakeWorld snake(true);
  Minutes out;
  snake.crawl(4);
  for (int period = 4; period < 45 * minutes(); ++period) {
    out.path_m += snake.crawl(1);
    out.angles.push_back(snake.angles());
    out.kB.push_back(heap_in_use_kB());
  }
  return out;
}

TEST(GzSimSnake, CrawlsWithGripAndShapeWithoutGrowthAndTheSameTwice) {
  let_the_host_fill_its_pools();
  const Minutes first = crawl(), second = crawl();
  for (const auto& angles : first.angles) {
    for (const double angle : angles) ASSERT_LT(std::abs(angle), 90 * kDegree);
  }
  std::cout << "path of the last " << first.angles.size() << " gait periods: " << first.path_m << " m, heap "
            << testing::PrintToString(first.kB) << " kB\n";
  EXPECT_GT(first.path_m, 6.0 * minutes());
  EXPECT_LT(first.path_m, 14.0 * minutes());
  EXPECT_LT(usual_growth(first.kB), may_grow_kB(std::lround(1e3 * kGaitPeriod_s))) << "kB a gait period";
  EXPECT_EQ(first.angles, second.angles);
}

TEST(GzSimSnake, LiesStill) {
  SnakeWorld snake(false);
  snake.world.run(2000);
  const auto from = snake.center();
  snake.world.run(8000);
  const auto to = snake.center();
  std::cout << "in 8 s the still snake moved by " << std::hypot(to[0] - from[0], to[1] - from[1]) << " m\n";
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(from[axis], to[axis], 1e-3) << axis;
  EXPECT_NEAR(to[2], 0.033, 2e-3);
  for (const double angle : snake.angles()) EXPECT_NEAR(angle, 0, 2 * kDegree);
}

constexpr int kParts = 12;
constexpr int kStepsOfAPart = 5'000;  // of the minute's run

/// The module turning there and back, every 10th ms.
std::vector<double> turn(std::vector<long>& kB) {
  std::string model = model_text("qbmove", "module", "0 0 0.0335 0 0 0");
  OwnRobot own(model, "module");
  SimWorld w(sdf_text(world_text(model_text("terrain_flat", "ground") + model)));
  std::vector<double> out;
  out.reserve(static_cast<std::size_t>(6000 * minutes()));
  w.probes[0]->before = [&](const sim::UpdateInfo& info, sim::EntityComponentManager& ecm) {
    own.before_step(info, ecm);
    if (info.iterations % 10 != 0) return;
    own.robot().command(0, std::sin(std::chrono::duration<double>(info.simTime).count()), 0.3);
    out.push_back(own.robot().read(0).shaft_rad);
  };
  for (int part = 0; part < kParts; ++part) {
    w.run(kStepsOfAPart * minutes());
    kB.push_back(heap_in_use_kB());
  }
  return out;
}

TEST(GzSimModule, TurnsThereAndBackWithoutGrowthAndTheSameTwice) {
  let_the_host_fill_its_pools();
  std::vector<long> kB, again_kB;
  const auto first = turn(kB), second = turn(again_kB);
  std::cout << "heap " << testing::PrintToString(kB) << " kB\n";
  double largest = 0;
  for (const double angle : first) largest = std::max(largest, std::isfinite(angle) ? std::abs(angle) : 1e9);
  EXPECT_GT(largest, 0.8);
  EXPECT_LT(largest, 1.2);
  EXPECT_LT(usual_growth(kB), may_grow_kB(kStepsOfAPart * minutes()));
  EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace vsa::test
