// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Seats on one kinematic tree: what one seat with all of the joints does, bit for bit, in whatever order a host calls them.
#include "vsa/seat/seat_group.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "seat/arm_of_three.hpp"

namespace vsa::seat::testing {
namespace {

/// The angles after each step of one seat with all joints.
std::vector<std::array<double, 3>> as_one(int steps, std::size_t tied = 3) {
  Seat seat(part(0, 3), {});
  seat.join(tied == 3 ? SeatGroup::Trees{{0, 1, 2}} : SeatGroup::Trees{{0, 1}, {2}});
  Arm arm{tied};
  std::vector<std::array<double, 3>> out;
  for (int n = 0; n < steps; ++n) {
    arm.tell(seat, 0);
    if (seat.wants_mobility()) {
      arm.fill(0, tied, seat.mobility());
      if (tied == 2) seat.mobility()[4] = kB[2][2];
    }
    seat.step(kStep_ns);
    arm.torque = {seat.torques()[0], seat.torques()[1], seat.torques()[2]};
    arm.move();
    out.push_back(arm.angle);
  }
  return out;
}

/// The same joints with two seats: 0 and 1, and 2.
struct Two {
  explicit Two(const SeatGroup::Trees& trees = {{0, 1, 2}}) : group({&upper, &hand}, trees) {}
  std::array<double, 3> step(SeatGroup& with, Seat& a, Seat& b) {
    arm.tell(a, 0);
    arm.tell(b, 2);
    with.update([this](std::size_t tree, std::span<double> out) {
      ++asked[tree];
      if (arm.tied == 3) return arm.fill(0, 3, out);
      arm.fill(tree == 0 ? 0 : 2, tree == 0 ? 2 : 1, out);
    });
    with.step(kStep_ns);
    arm.torque = {a.torques()[0], a.torques()[1], b.torques()[0]};
    arm.move();
    return arm.angle;
  }
  std::array<double, 3> step() { return step(group, upper, hand); }

  Seat upper{part(0, 2), {}}, hand{part(2, 1), {}};
  SeatGroup group;
  Arm arm;
  std::array<int, 2> asked{};
};

TEST(SeatGroup, OnOneTreeMovesAsOneSeatWithAllOfTheJoints) {
  const auto whole = as_one(600);
  Two two;
  for (std::size_t n = 0; n < 600; ++n) ASSERT_EQ(two.step(), whole[n]) << "step " << n;
  EXPECT_EQ(two.asked[0], 600) << "B of what several drive is due each time";
  EXPECT_GT(std::abs(whole[599][2] - 0.15), 0.05) << "nothing moved";
}

TEST(SeatGroup, OnTreesOfTheirOwnEachStepsByItself) {
  const auto whole = as_one(300, 2);
  Two two({{0, 1}, {2}});
  two.arm.tied = 2;
  for (std::size_t n = 0; n < 300; ++n) ASSERT_EQ(two.step(), whole[n]) << "step " << n;
  EXPECT_LT(two.asked[0], 300) << "only where it is due";
  two.arm.speed[2] = std::numeric_limits<double>::quiet_NaN();
  two.step();
  EXPECT_TRUE(two.hand.stopped());
  EXPECT_FALSE(two.upper.stopped());
}

TEST(SeatGroup, OnOneTreeStopsWhereOneStops) {
  Two two;
  two.arm.speed[2] = std::numeric_limits<double>::quiet_NaN();
  two.step();
  EXPECT_TRUE(two.hand.stopped());
  EXPECT_TRUE(two.upper.stopped());
  EXPECT_EQ(two.upper.torques()[0], 0);
}

TEST(SeatGroup, OfClonesGoesOnTheSameWay) {
  Two two;
  for (int n = 0; n < 100; ++n) two.step();
  const auto upper = two.upper.clone(), hand = two.hand.clone();
  SeatGroup theirs = two.group.another({upper.get(), hand.get()});
  Two copy;
  copy.arm = two.arm;
  for (int n = 0; n < 200; ++n) ASSERT_EQ(copy.step(theirs, *upper, *hand), two.step()) << "step " << n;
}

TEST(SeatGroup, MadeAnewWhileItRunsGoesOnTheSameWay) {
  Two once, again;
  for (int n = 0; n < 300; ++n) {
    if (n == 100) again.group = SeatGroup({&again.upper, &again.hand}, {{0, 1, 2}});
    if (n == 200) {  // apart, and together again
      again.group = SeatGroup({&again.upper, &again.hand}, {{0, 1}, {2}});
      again.group = SeatGroup({&again.upper, &again.hand}, {{0, 1, 2}});
    }
    ASSERT_EQ(again.step(), once.step()) << "step " << n;
  }
}

TEST(SeatGroup, MadeAnewAsksForItsTreesAtOnce) {
  const SeatGroup::Trees apart{{0, 1}, {2}}, together{{0, 1, 2}};
  for (const SeatGroup::Trees& before : {apart, together}) {
    Two two(before);
    two.arm.tied = before.size() == 2 ? 2 : 3;
    two.arm.angle = {};  // at rest: nothing but time makes it due
    for (int n = 0; n < 5; ++n) two.step();
    two.group = SeatGroup({&two.upper, &two.hand}, apart);
    two.arm.tied = 2;
    two.asked = {};
    two.step();
    EXPECT_EQ(two.asked, (std::array{1, 1})) << "after " << before.size() << " trees";
    two.step();
    EXPECT_EQ(two.asked, (std::array{1, 1})) << "and then when it is due";
  }
}

TEST(SeatGroup, RefusesTreesThatCannotBe) {
  Seat upper(part(0, 2), {}), hand(part(2, 1), {});
  EXPECT_THROW(SeatGroup({&upper, &hand}, {{0, 3}}), InputError);
  EXPECT_THROW(SeatGroup({&upper, &hand}, {{0, 2}, {1, 2}}), InputError);
  EXPECT_THROW(SeatGroup({&upper, &hand}, {{0, 0}}), InputError);
  const SeatGroup group({&upper, &hand}, {{0, 1, 2}});
  EXPECT_THROW(static_cast<void>(group.another({&upper})), InputError);
  SeatGroup nobody({}, {});
  nobody.update([](std::size_t, std::span<double>) { FAIL(); });
  nobody.step(kStep_ns);
}

}  // namespace
}  // namespace vsa::seat::testing
