// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Draws that repeat, and follow their distributions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "batch_test.hpp"

namespace vsa::batch {
namespace {

using engine::World;
using Kind = Distribution::Kind;

TEST(Draws, AreDrawnBySeedCopyAndNameAlone) {
  const World from = World::load("snake_flat.sdf");
  const std::vector<Spread> what{{"", "drive.friction_Nm", {Kind::uniform, 0.5, 1.0}},
                                 {"", "link.mass_kg", {Kind::uniform, 0.8, 1.2, true}},
                                 {"terrain_flat::link", "link.friction", {Kind::log_uniform, 0.2, 0.9}},
                                 {"", "drive.viscous_Nms_per_rad", {Kind::normal, 1.0, 0.1, true, true}}};
  const std::vector<Spread> other_order(what.rbegin(), what.rend());
  Batch large(from, 4, 2), small(from, 3, 1);
  large.randomize(7, what);
  small.randomize(7, other_order, std::vector<std::size_t>{2, 0});
  small.randomize(7, std::vector<Spread>{what[1]}, std::vector<std::size_t>{1});
  for (const Spread& s : what) {
    EXPECT_EQ(large.values(0, s.who, s.key), small.values(0, s.who, s.key)) << s.key;
    EXPECT_EQ(large.values(2, s.who, s.key), small.values(2, s.who, s.key)) << s.key;
    EXPECT_NE(large.values(0, s.who, s.key), large.values(1, s.who, s.key)) << s.key;
  }
  EXPECT_EQ(large.values(1, "", "link.mass_kg"), small.values(1, "", "link.mass_kg"));
  const std::vector<double> own = large.values(3, "", "drive.friction_Nm"), shared = large.values(3, "", what[3].key);
  EXPECT_NE(own[0], own[1]);
  EXPECT_EQ(std::count(shared.begin(), shared.end(), shared[0]), 12);
  EXPECT_EQ(own[4], large.value(3, "joint_4", "drive.friction_Nm"));
  for (const double v : own) EXPECT_TRUE(v >= 0.5 && v <= 1.0) << v;
  const Numbers& before = own;
  large.randomize(7, what);
  EXPECT_EQ(large.values(3, "", "drive.friction_Nm"), before) << "of what the Batch began with, not of what it has now";
  EXPECT_NEAR(large.value(0, "qbmove_snake::tail", "link.mass_kg"), 0.5, 0.1);
  large.randomize(8, what);
  EXPECT_NE(large.values(3, "", "drive.friction_Nm"), before);
}

TEST(Draws, FollowTheirDistributions) {
  constexpr int kDraws = 20000;
  const auto moments = [](const Distribution& d) {
    double sum = 0, square = 0, low = 1e300, high = -1e300;
    for (std::size_t c = 0; c < kDraws; ++c) {
      const double v = drawn(d, 3, c, "who", "key");
      sum += v, square += v * v, low = std::min(low, v), high = std::max(high, v);
    }
    const double mean = sum / kDraws;
    return std::array<double, 4>{mean, std::sqrt(square / kDraws - mean * mean), low, high};
  };
  const auto uniform = moments({Kind::uniform, 2, 4}), normal = moments({Kind::normal, 5, 2});
  const auto log_uniform = moments({Kind::log_uniform, 0.01, 100});
  EXPECT_NEAR(uniform[0], 3, 0.02);
  EXPECT_NEAR(uniform[1], 2 / std::sqrt(12.0), 0.01);
  EXPECT_GE(uniform[2], 2);
  EXPECT_LE(uniform[3], 4);
  EXPECT_NEAR(normal[0], 5, 0.06);
  EXPECT_NEAR(normal[1], 2 * 0.9866, 0.04);  // cut off at three
  EXPECT_GE(normal[2], -1);
  EXPECT_LE(normal[3], 11);
  EXPECT_NEAR(log_uniform[0], (100 - 0.01) / std::log(1e4), 0.5);
  EXPECT_GE(log_uniform[2], 0.01);
  EXPECT_LE(log_uniform[3], 100);
  EXPECT_EQ(drawn({Kind::uniform, 1, 1}, 0, 0, "", ""), 1);
  EXPECT_NE(drawn({Kind::uniform, 0, 1}, 1, 2, "a", "b"), drawn({Kind::uniform, 0, 1}, 2, 1, "a", "b"));
  EXPECT_NE(drawn({Kind::uniform, 0, 1}, 1, 2, "a", "b"), drawn({Kind::uniform, 0, 1}, 1, 2, "b", "a"));
}

}  // namespace
}  // namespace vsa::batch
