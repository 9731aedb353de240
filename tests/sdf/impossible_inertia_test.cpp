// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Inertias that no body can have, by choice: lowered, they turn about their own axes as the nearest body would.
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "engine/worlds.hpp"

namespace vsa::engine::testing {
namespace {

/// A free body with these moments about x, y and z turned by 0.5 rad about x, then 0.7 about z, or not turned; all that in a frame
/// that stands in the link as `pose` says.
std::string turned_body(double x, double y, double z, bool turned = true, const std::string& pose = "0 0 0 0 0 0") {
  const double a = turned ? 0.5 : 0, b = turned ? 0.7 : 0;
  const double r[3][3] = {{std::cos(b), -std::sin(b) * std::cos(a), std::sin(b) * std::sin(a)},
                          {std::sin(b), std::cos(b) * std::cos(a), -std::cos(b) * std::sin(a)},
                          {0, std::sin(a), std::cos(a)}};
  const auto at = [&](int i, int j) {
    std::ostringstream number;
    number.precision(17);
    number << x * r[i][0] * r[j][0] + y * r[i][1] * r[j][1] + z * r[i][2] * r[j][2];
    return number.str();
  };
  return "<model name='m'><link name='a'><inertial><pose>" + pose + "</pose><mass>1</mass><inertia><ixx>" + at(0, 0) +
         "</ixx><iyy>" + at(1, 1) + "</iyy><izz>" + at(2, 2) + "</izz><ixy>" + at(0, 1) + "</ixy><ixz>" + at(0, 2) + "</ixz><iyz>" +
         at(1, 2) + "</iyz></inertia></inertial></link></model>";
}

WorldOptions lower() {
  WorldOptions options;
  options.impossible_inertia = ImpossibleInertia::lower;
  return options;
}

TEST(ImpossibleInertia, LoweredTheLargestMomentIsTheSumOfTheOthersAboutTheSameAxes) {
  // Whichever of them is the largest, with moments beside the diagonal and without, in a frame that is turned itself and in one not.
  for (int kind = 0; kind < 12; ++kind) {
    const int largest = kind % 3;
    const bool turned = kind % 6 < 3;
    const char* const pose = kind < 6 ? "0 0 0 0 0 0" : "0.1 0 -0.2 0.4 -0.3 1.1";
    const double low = 0.01, middle = 0.012, high = 0.05;
    const double given[3][3] = {{high, low, middle}, {low, high, middle}, {low, middle, high}};
    double can[3] = {given[largest][0], given[largest][1], given[largest][2]};
    can[largest] = low + middle;
    World lowered =
        World::load_string(world(turned_body(given[largest][0], given[largest][1], given[largest][2], turned, pose)), lower());
    World nearest = World::load_string(world(turned_body(can[0], can[1], can[2], turned, pose)));
    ASSERT_EQ(lowered.warnings().size(), 1u);
    EXPECT_NE(lowered.warnings()[0].find("m::a (principal moments 0.01"), std::string::npos) << lowered.warnings()[0];
    EXPECT_TRUE(nearest.warnings().empty());
    std::vector<double> a(36), b(36);
    lowered.mass_matrix(a);
    nearest.mass_matrix(b);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-9) << kind << ", " << i;
  }
}

TEST(ImpossibleInertia, WhatABodyCanHaveIsLeftAsItIs) {
  World asked = World::load_string(world(turned_body(0.01, 0.012, 0.02)), lower());
  World plain = World::load_string(world(turned_body(0.01, 0.012, 0.02)));
  EXPECT_TRUE(asked.warnings().empty());
  std::vector<double> a(36), b(36);
  asked.mass_matrix(a);
  plain.mass_matrix(b);
  EXPECT_EQ(a, b);
}

std::string refusal(const std::string& body, const WorldOptions& options) {
  try {
    static_cast<void>(World::load_string(world(body), options));
  } catch (const InputError& error) {
    return error.what();
  }
  return "loads";
}

TEST(ImpossibleInertia, IsRefusedUnlessAskedForAndOneThatIsNotPositiveAlways) {
  EXPECT_NE(refusal(turned_body(0.01, 0.012, 0.05), {}).find("--impossible-inertia lower"), std::string::npos);
  EXPECT_NE(refusal(turned_body(-0.01, 0.012, 0.05), lower()).find("isn't positive definite"), std::string::npos);
  WorldOptions none;
  none.impossible_inertia = static_cast<ImpossibleInertia>(2);
  EXPECT_NE(refusal(turned_body(0.01, 0.012, 0.02), none).find("impossible_inertia = 2"), std::string::npos);
}

TEST(ImpossibleInertia, BothChoicesOfOneFileInOneProcess) {
  const std::string body = turned_body(0.01, 0.012, 0.05);
  EXPECT_EQ(refusal(body, lower()), "loads");
  EXPECT_NE(refusal(body, {}), "loads");
  EXPECT_EQ(refusal(body, lower()), "loads");
}

}  // namespace
}  // namespace vsa::engine::testing
