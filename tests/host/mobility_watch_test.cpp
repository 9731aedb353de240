// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// When B is worked out anew. What becomes of a chain whose B stays what it was: SerialChain.OfBareFlanges… blows up.
#include "vsa/host/mobility_watch.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <optional>

namespace {

using vsa::host::JointIn;
using vsa::host::MobilityWatch;

JointIn at(double angle_rad) { return {angle_rad, 0, std::nullopt, false}; }

TEST(MobilityWatch, OfAnArmAtRestIsDueAtOnceAndThenEverySixteenthStep) {
  MobilityWatch watch(2);
  const std::array<JointIn, 2> joints{at(0.5), at(-0.5)};
  for (int n = 0; n < 64; ++n) EXPECT_EQ(watch.due(joints), n % 16 == 0) << n;
}

TEST(MobilityWatch, IsDueAsSoonAsAnyJointHasTurnedByTwoHundredthsSince) {
  MobilityWatch watch(2);
  std::array<JointIn, 2> joints{at(0.5), at(-0.5)};
  EXPECT_TRUE(watch.due(joints));
  for (const std::size_t moved : {0u, 1u}) {
    for (const double way : {1.0, -1.0}) {
      joints[moved].angle_rad += way * 0.015;
      EXPECT_FALSE(watch.due(joints));
      joints[moved].angle_rad += way * 0.015;
      EXPECT_TRUE(watch.due(joints)) << moved << ", " << way;
      EXPECT_FALSE(watch.due(joints)) << "it is that of these angles now";
    }
  }
}

TEST(MobilityWatch, IsDueAgainInTheNextStepWhereSomebodyPutTheArmElsewhere) {
  MobilityWatch watch(1);
  const std::array<JointIn, 1> joint{at(0.5)};
  EXPECT_TRUE(watch.due(joint));
  EXPECT_FALSE(watch.due(joint));
  watch.again();
  EXPECT_TRUE(watch.due(joint));
}

TEST(MobilityWatch, IsDueAsSoonAsAnotherJointHasTurnedByAHundredthInAll) {
  MobilityWatch watch(1);
  const std::array<JointIn, 1> joint{at(0.5)};
  EXPECT_TRUE(watch.due(joint));
  for (int round = 0; round < 3; ++round)
    for (const bool due : {false, false, true}) {
      watch.turned(0.004);
      EXPECT_EQ(watch.due(joint), due) << round;
    }
}

TEST(MobilityWatch, OfATurnThatIsNoneGoesOnAsItWas) {
  MobilityWatch watch(1), plain(1);
  const std::array<JointIn, 1> joint{at(0.5)};
  for (int n = 0; n < 40; ++n) {
    watch.turned(n % 2 == 0 ? std::numeric_limits<double>::quiet_NaN() : -1.0);
    EXPECT_EQ(watch.due(joint), plain.due(joint)) << n;
    EXPECT_EQ(watch.impossible(), nullptr);
  }
  watch.turned(std::numeric_limits<double>::infinity());
  EXPECT_TRUE(watch.due(joint));
  EXPECT_EQ(watch.impossible(), nullptr);
}

}  // namespace
