// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "vsa/scene/link.hpp"
#include "vsa/scene/pose.hpp"

namespace vsa::scene {
namespace {

TEST(LinksOfJoint, AreThoseOfTheJointsScopeOrTheNthInAChain) {
  std::vector<LinkInfo> links;
  for (const char* name : {"ground::link", "snake::m_1::body", "snake::m_1::flange", "snake::m_11::body", "snakes::m_1::body"}) {
    links.push_back({name, "", 1, false, {}});
  }
  using Indices = std::vector<std::size_t>;
  EXPECT_EQ(links_of_joint("snake", "m_1::shaft", 0, links), (Indices{1, 2}));
  EXPECT_EQ(links_of_joint("snake", "m_11::shaft", 1, links), (Indices{3}));
  EXPECT_EQ(links_of_joint("snake", "elbow", 1, links), (Indices{2}));
  EXPECT_EQ(links_of_joint("snake", "elbow", 9, links), Indices{});
}

TEST(Finite, IsAPoseOnlyWithAllOfItsNumbers) {
  EXPECT_TRUE(finite(Pose{}));
  for (std::size_t i = 0; i < 7; ++i) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
      Pose pose;
      (i < 3 ? pose.position[i] : pose.quaternion[i - 3]) = bad;
      EXPECT_FALSE(finite(pose)) << i;
    }
  }
}

}  // namespace
}  // namespace vsa::scene
