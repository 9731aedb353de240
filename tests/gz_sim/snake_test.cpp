// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The snake and the single module for a simulated minute, ten with VSA_TEST_LONG.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

#include "gz_snake.hpp"

namespace vsa::test {
namespace {

int minutes() { return std::getenv("VSA_TEST_LONG") != nullptr ? 10 : 1; }

struct Minutes {
  std::vector<std::vector<double>> angles;  ///< one a gait period
  double path_m = 0;
  long growth_kB = 0;
};

Minutes crawl() {
  SnakeWorld snake(true);
  Minutes out;
  snake.crawl(4);
  const long early = status("VmRSS:");
  for (int period = 4; period < 45 * minutes(); ++period) {
    out.path_m += snake.crawl(1);
    out.angles.push_back(snake.angles());
  }
  out.growth_kB = status("VmRSS:") - early;
  return out;
}

TEST(GzSimSnake, CrawlsWithGripAndShapeWithoutGrowthAndTheSameTwice) {
  const Minutes first = crawl(), second = crawl();
  for (const auto& angles : first.angles) {
    for (const double angle : angles) ASSERT_LT(std::abs(angle), 90 * kDegree);
  }
  std::cout << "path of the last " << first.angles.size() << " gait periods: " << first.path_m << " m, memory " << second.growth_kB
            << " kB\n";
  EXPECT_GT(first.path_m, 6.0 * minutes());
  EXPECT_LT(first.path_m, 14.0 * minutes());
  EXPECT_LT(second.growth_kB, 2'000) << "kB a run";
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

/// The module turning there and back, every 10th ms.
std::vector<double> turn(long& growth_kB) {
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
  w.run(5000);
  const long early = status("VmRSS:");
  w.run(60'000 * minutes() - 5000);
  growth_kB = status("VmRSS:") - early;
  return out;
}

TEST(GzSimModule, TurnsThereAndBackWithoutGrowthAndTheSameTwice) {
  long growth_kB = 0;
  const auto first = turn(growth_kB), second = turn(growth_kB);
  double largest = 0;
  for (const double angle : first) largest = std::max(largest, std::isfinite(angle) ? std::abs(angle) : 1e9);
  EXPECT_GT(largest, 0.8);
  EXPECT_LT(largest, 1.2);
  EXPECT_LT(growth_kB, 2'000);
  EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace vsa::test
