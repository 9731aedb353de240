// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a seat takes for a robot, and what it refuses.
#include <gtest/gtest.h>

#include "seat/seats.hpp"

namespace vsa::seat::testing {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(SeatLoad, JointsThatArentThereOrCantBeDrivenAreNamedAllAtOnce) {
  Model of = model();
  of.joints = {{"b::hinge", {}, "is prismatic"}};
  const std::string text = problems_of(of);
  EXPECT_TRUE(has(text, "lab.sdf: arm: actuator[shoulder]/joint")) << text;
  EXPECT_TRUE(has(text, "no such joint")) << text;
  EXPECT_TRUE(has(text, "actuator[elbow]/joint")) << text;
  EXPECT_TRUE(has(text, "is prismatic")) << text;
  of.joints = joints();
  of.joints[0].refusal = "is prismatic";
  EXPECT_EQ(problems_of(of), "") << "nobody drives the spare one";
}

TEST(SeatLoad, SubstepsAreForHostsThatMakeThem) {
  const Model of = model(element("<substeps>4</substeps>"));
  EXPECT_TRUE(has(problems_of(of), "substeps = 4")) << problems_of(of);
  Options options;
  options.makes_substeps = true;
  EXPECT_EQ(problems_of(of, options), "");
}

TEST(SeatLoad, TwoRobotsOnOneJointOfAWorldAreRefusedAndOneAfterTheOtherIsnt) {
  const int world = 0, other = 0;
  Model of = model();
  for (std::size_t j = 0; j < of.joints.size(); ++j) of.joints[j].key = {&world, j};
  auto first = std::make_unique<Seat>(of, Options{});
  const std::string text = problems_of(of);
  EXPECT_TRUE(has(text, "actuator[shoulder]/joint = \"a::hinge\": another vsa::Robot drives it already, that of lab.sdf: arm"))
      << text;
  EXPECT_TRUE(has(text, "actuator[elbow]/joint")) << text;
  EXPECT_TRUE(has(problems_of(of), "already")) << "one that was refused gives nothing back";
  Model elsewhere = of;
  for (Joint& joint : elsewhere.joints) joint.key.world = &other;
  EXPECT_EQ(problems_of(elsewhere), "");
  EXPECT_EQ(problems_of(model()), "") << "without keys nobody looks";
  const auto copy = first->clone();
  first.reset();
  EXPECT_EQ(problems_of(of), "");
}

TEST(SeatLoad, AnActuatorStartsWhereItsJointDoesUnlessItsTextSaysWhere) {
  Model of = model(element("", "<initial equilibrium_rad='0.1'/>"));
  for (Joint& joint : of.joints) joint.start_rad = 0.4;
  const Seat seat(of, {});
  EXPECT_EQ(seat.robot().config().actuators[0].initial_equilibrium_rad, 0.1);
  EXPECT_EQ(seat.robot().config().actuators[1].initial_equilibrium_rad, 0.4);
  of.joints[1].start_rad = 3.5;
  EXPECT_TRUE(has(problems_of(of), "its joint starts at 3.5 rad")) << problems_of(of);
}

TEST(SeatLoad, AnotherActuatorMayBePutOnTheRobot) {
  Options options;
  options.actuator.type = "qbmove_advanced";
  const Seat seat(model(), options);
  EXPECT_EQ(seat.robot().config().actuators[0].type, "qbmove_advanced");
}

}  // namespace
}  // namespace vsa::seat::testing
