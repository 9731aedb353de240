// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A seat's steps: the robot's own bits, what stops it, what it costs, and how it goes back.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "seat/seats.hpp"

long allocation_count();  // allocation_count.cpp

namespace vsa::seat::testing {
namespace {

TEST(Seat, DrivesTheRobotAsTheRobotAloneWouldBeBitForBit) {
  Seat seat(model(), {});
  seat.join({{0}, {1}});
  host::Robot alone(config::parse_plugin(element(), "", config::TypeLibrary()));
  alone.join({{0}, {1}});
  Pendulums a, b;
  std::vector<double> torque(2);
  const std::vector<double> mobility(2, 1 / Pendulums::kInertia_kgm2);
  for (int k = 0; k < 500; ++k) {
    if (k == 100) {
      EXPECT_TRUE(seat.robot().command(0, 0.7, 0.3));
      EXPECT_TRUE(alone.command(0, 0.7, 0.3));
    }
    a.step(seat);
    std::vector<host::JointIn> in(2);
    for (std::size_t i = 0; i < 2; ++i) in[i] = {b.angle[i], b.speed[i], std::nullopt, false};
    alone.advance(k * Pendulums::kStep_ns, Pendulums::kStep_ns, in, torque, mobility);
    b.move(torque);
    ASSERT_EQ(a.angle, b.angle) << "step " << k;
  }
  EXPECT_GT(a.angle[0], 0.3);
  EXPECT_EQ(seat.robot().read(0).shaft_rad, a.angle[0]) << "observed";
}

TEST(Seat, TellsWhichOfTheHostsJointsItsActuatorsDrive) {
  const Seat seat(model(), {});
  EXPECT_EQ(seat.joints(), (std::vector<std::size_t>{2, 1}));
  EXPECT_EQ(seat.model(), "lab::arm");
}

TEST(Seat, AStepTakesNothingFromTheHeapWithAWayBackAsWithout) {
  Seat seat(model(), {});
  seat.join({{0}, {1}});
  Pendulums host;
  const auto run = [&](int steps) {
    for (int k = 0; k < steps; ++k) {
      host.tell(seat);
      if (seat.wants_mobility()) std::fill(seat.mobility().begin(), seat.mobility().end(), 1 / Pendulums::kInertia_kgm2);
      seat.robot().command(0, 0.3 * std::sin(0.01 * k), 0.3);
      seat.keep();
      seat.step(Pendulums::kStep_ns);
      if (k % 7 == 0) seat.go_back();
      host.move(seat.torques());
      seat.publish_step(k * Pendulums::kStep_ns);
    }
  };
  run(50);
  const long before = allocation_count();
  run(90);
  EXPECT_EQ(allocation_count(), before);
}

TEST(Seat, AJointThatIsNoLongerFiniteStopsItsActuatorsWithOneLineUntilAReset) {
  std::vector<std::string> lines;
  Options options;
  options.report = [&](const std::string& line) { lines.push_back(line); };
  Seat seat(model(), options);
  Pendulums host;
  seat.robot().command(0, 0.7, 0.3);
  for (int k = 0; k < 100; ++k) host.step(seat);
  EXPECT_NE(seat.torques()[0], 0);
  host.angle[1] = std::numeric_limits<double>::quiet_NaN();
  host.step(seat);
  host.step(seat);
  EXPECT_TRUE(seat.stopped());
  EXPECT_EQ(seat.torques()[0], 0);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("lab::arm: joint b::hinge is no longer at a finite angle"), std::string::npos) << lines[0];
  host = {};
  seat.reset();
  EXPECT_FALSE(seat.stopped());
  Seat fresh(model(), {});
  Pendulums of_fresh;
  for (int k = 0; k < 50; ++k) {
    host.step(seat);
    of_fresh.step(fresh);
  }
  EXPECT_EQ(host.angle, of_fresh.angle) << "a reset is a beginning";
}

TEST(Seat, ASnapshotOfOneThatHasStoppedGivesNoTorqueAgain) {
  Seat seat(model(), {});
  Pendulums host;
  seat.robot().command(0, 0.7, 0.3);
  for (int k = 0; k < 100; ++k) host.step(seat);
  const auto moving = seat.snapshot();
  seat.step(0);
  const auto stopped = seat.snapshot();
  seat.restore(*moving);
  host.step(seat);
  EXPECT_NE(seat.torques()[0], 0);
  seat.restore(*stopped);
  host.step(seat);
  EXPECT_EQ(seat.torques()[0], 0) << "the torque of a step before";
}

TEST(Seat, AnActuatorThatIsntThereCannotHaveMoved) {
  Seat seat(model(), {});
  EXPECT_NO_THROW(seat.moved(1));
  EXPECT_THROW(seat.moved(2), InputError);
}

TEST(Seat, AStepThatTheUnitsDontKnowStopsThem) {
  for (const std::int64_t dt_ns : {std::int64_t{0}, std::int64_t{-1'000'000}, std::int64_t{16'000'001}}) {
    Seat seat(model(), {});
    seat.step(dt_ns);
    EXPECT_TRUE(seat.stopped()) << dt_ns;
  }
  Seat seat(model(), {});
  seat.step(16'000'000);
  EXPECT_FALSE(seat.stopped());
}

TEST(Seat, GoesBackToWhatItKeptAndToSnapshotsBitForBit) {
  Seat seat(model(), {});
  seat.join({{0}, {1}});
  Pendulums host;
  seat.robot().command(0, 0.7, 0.3);
  for (int k = 0; k < 137; ++k) host.step(seat);
  const auto future = [&](int steps) {
    Pendulums of = host;
    for (int k = 0; k < steps; ++k) of.step(seat);
    return std::pair(of.angle, seat.robot().ledger().supply);
  };
  seat.keep();
  const auto snapshot = seat.snapshot();
  const auto kept_on = seat.clone();
  const auto first = future(60);
  seat.step(300'000);  // so that a clock that didn't go back would stand beside the units' ticks
  seat.go_back();
  EXPECT_EQ(future(60), first);
  (void)future(200);
  seat.restore(*snapshot);
  EXPECT_EQ(future(60), first);
  Pendulums of_clone = host;
  for (int k = 0; k < 60; ++k) of_clone.step(*kept_on);
  EXPECT_EQ(of_clone.angle, first.first);
}

TEST(Seat, AJointPutElsewhereIsNeitherWorkNorForgottenByAWayBack) {
  Seat seat(model(), {});
  seat.join({{0}, {1}});
  Pendulums host;
  for (int k = 0; k < 50; ++k) host.step(seat);
  const double coupling = std::abs(seat.robot().ledger(0).coupling);
  host.angle[0] += 0.2;
  seat.moved(0);
  EXPECT_TRUE(seat.in()[0].placed);
  seat.keep();
  Pendulums tried = host;
  tried.step(seat);
  EXPECT_FALSE(seat.in()[0].placed) << "once";
  seat.go_back();
  EXPECT_TRUE(seat.in()[0].placed) << "as it was before";
  host.step(seat);
  EXPECT_LT(std::abs(seat.robot().ledger(0).coupling), coupling + 1e-3);
}

TEST(Seat, AsksForMobilityAtOnceWhereBodiesAreElsewhere) {
  Seat seat(model(), {});
  seat.join({{0}, {1}});
  EXPECT_EQ(seat.mobility().size(), 2U);
  EXPECT_TRUE(seat.wants_mobility());
  EXPECT_FALSE(seat.wants_mobility());
  seat.moved();
  EXPECT_TRUE(seat.wants_mobility());
  seat.moved(1);
  EXPECT_TRUE(seat.wants_mobility());
  seat.go_back();
  EXPECT_TRUE(seat.wants_mobility());
  seat.reset();
  EXPECT_TRUE(seat.wants_mobility());
  EXPECT_FALSE(seat.wants_mobility());
}

TEST(Seat, AModelThatIsNoTreeIsToldOfAndWantsNoMobility) {
  std::string told;
  Options options;
  options.report = [&](const std::string& line) { told += line; };
  Seat seat(model(), options);
  seat.join({});
  EXPECT_NE(told.find("no tree"), std::string::npos) << told;
  EXPECT_FALSE(seat.wants_mobility());
}

}  // namespace
}  // namespace vsa::seat::testing
