// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/description/math.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace vsa::description {
namespace {

constexpr double kPi = std::numbers::pi, kClose = 1e-15;

void expect_near(const Vec3& a, const Vec3& b) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 4 * kClose) << "coordinate " << i;
}

TEST(Quat, AQuarterTurnAboutZBringsXToY) {
  const Quat turn = Quat::about({0, 0, 2}, kPi / 2);
  expect_near(turn * Vec3(1, 0, 0), {0, 1, 0});
  expect_near(turn.Inverse() * Vec3(0, 1, 0), {1, 0, 0});
}

TEST(Quat, AProductTurnsByTheRightFactorFirst) {
  const Quat about_x = Quat::about({1, 0, 0}, kPi / 2), about_z = Quat::about({0, 0, 1}, kPi / 2);
  expect_near((about_x * about_z) * Vec3(1, 0, 0), {0, 0, 1});
}

TEST(Quat, NoAxisIsNoTurnAndNoLengthHasTheIdentityForItsInverse) {
  expect_near(Quat::about({0, 0, 0}, 1) * Vec3(1, 2, 3), {1, 2, 3});
  EXPECT_EQ(Quat(0, 0, 0, 0).Inverse().W(), 1);
}

TEST(Pose3, TheInverseGoesBack) {
  const Pose3 pose({1, 2, 3}, Quat::about({1, -2, 0.5}, 0.7));
  EXPECT_TRUE(alike(pose * pose.Inverse(), Pose3()));
  EXPECT_TRUE(alike(pose.Inverse() * pose, Pose3()));
}

TEST(Pose3, AProductPlacesTheInnerInTheOutersFrame) {
  const Pose3 outer({1, 0, 0}, Quat::about({0, 0, 1}, kPi / 2));
  expect_near((outer * Pose3({2, 0, 0}, {})).Pos(), {1, 2, 0});
}

TEST(Mat3, TheInverseSolves) {
  const Mat3 m(4, 1, 0, 1, 3, -1, 0, -1, 2);
  expect_near(m.Inverse() * (m * Vec3(1, -2, 3)), {1, -2, 3});
}

TEST(Vec3, TakesWhatHasCoordinates) {
  struct Other {
    [[nodiscard]] double X() const { return 1; }
    [[nodiscard]] double Y() const { return 2; }
    [[nodiscard]] double Z() const { return 3; }
  };
  EXPECT_EQ(Vec3(Other()), Vec3(1, 2, 3));
}

TEST(Alike, ToAThousandth) {
  EXPECT_TRUE(alike(Vec3(1, 0, 0), Vec3(1.0009, 0, 0)));
  EXPECT_FALSE(alike(Vec3(1, 0, 0), Vec3(1.0011, 0, 0)));
  EXPECT_FALSE(alike(Mat3(1, 0, 0, 0, 1, 0, 0, 0, 1), Mat3(1, 0, 0, 0, 1, 0, 0, 0, 1.00001)));
}

}  // namespace
}  // namespace vsa::description
