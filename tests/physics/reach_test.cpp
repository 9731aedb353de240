// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Which trees may ever touch.
#include "vsa/physics/reach.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <stdexcept>
#include <string>

namespace vsa::physics {
namespace {

std::vector<std::size_t> neighbours(const std::string& bodies, const std::vector<int>& dofs, const std::string& more = {}) {
  const std::string xml = "<mujoco><worldbody>" + bodies + "</worldbody>" + more + "</mujoco>";
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
#if mjVERSION_HEADER >= 300
  mj_addBufferVFS(files.get(), "w.xml", xml.data(), static_cast<int>(xml.size()));
#else
  mj_makeEmptyFileVFS(files.get(), "w.xml", static_cast<int>(xml.size()));
  std::copy(xml.begin(), xml.end(), static_cast<char*>(files->filedata[mj_findFileVFS(files.get(), "w.xml")]));
#endif
  std::array<char, 500> error{};
  const std::unique_ptr<mjModel, void (*)(mjModel*)> m(mj_loadXML("w.xml", files.get(), error.data(), 500),
                                                       [](mjModel* model) { mj_deleteModel(model); });
  mj_deleteVFS(files.get());
  if (!m) throw std::runtime_error(error.data());
  return Reach(*m).neighbours(dofs);
}

/// A link of 0.1 m on a hinge, with a ball of 0.01 m at its end.
std::string finger(double x, const std::string& joint = "<joint/>", const std::string& more = {}) {
  return "<body pos='" + std::to_string(x) + " 0 0'>" + joint + "<geom size='0.01' pos='0.1 0 0'/>" + more + "</body>";
}

using Labels = std::vector<std::size_t>;

TEST(Reach, GoesAsFarAsTheShapesWhateverTheJointsDo) {
  EXPECT_EQ(neighbours(finger(0) + finger(0.219), {0, 1}), (Labels{0, 0}));
  EXPECT_EQ(neighbours(finger(0) + finger(0.221), {0, 1}), (Labels{0, 1}));
  EXPECT_EQ(neighbours(finger(0) + finger(0.2) + finger(0.4) + finger(0.7), {0, 1, 2, 3}), (Labels{0, 0, 0, 3}));
}

TEST(Reach, OfAChainIsThatOfAllItsLinks) {
  EXPECT_EQ(neighbours(finger(0, "<joint/>", finger(0.2)) + finger(0.419), {0, 1, 2}), (Labels{0, 0, 0}));
  EXPECT_EQ(neighbours(finger(0, "<joint/>", finger(0.2)) + finger(0.421), {0, 1, 2}), (Labels{0, 0, 1}));
}

TEST(Reach, OfASlideHasItsTravel) {
  EXPECT_EQ(neighbours(finger(0, "<joint type='slide' limited='true' range='-0.1 0.5'/>") + finger(0.719), {0, 1}), (Labels{0, 0}));
  EXPECT_EQ(neighbours(finger(0, "<joint type='slide' limited='true' range='-0.1 0.5'/>") + finger(0.721), {0, 1}), (Labels{0, 1}));
  EXPECT_EQ(neighbours(finger(0, "<joint type='slide'/>") + finger(1000), {0, 1}), (Labels{0, 0}));
}

TEST(Reach, OfAJointBesideItsBodysOriginIsLonger) {
  EXPECT_EQ(neighbours(finger(0, "<joint pos='-0.3 0 0'/>") + finger(0.8), {0, 1}), (Labels{0, 0}));
}

TEST(Reach, TwoHoldAThingThatFloats) {
  EXPECT_EQ(neighbours(finger(0) + finger(0.31) + "<body><freejoint/><geom size='0.05'/></body>", {0, 1}), (Labels{0, 0}));
  EXPECT_EQ(neighbours(finger(0) + finger(0.33) + "<body><freejoint/><geom size='0.05'/></body>", {0, 1}), (Labels{0, 1}));
}

TEST(Reach, TwoHoldADoorThatHangsBetweenThem) {
  EXPECT_EQ(neighbours(finger(0) + finger(0.4) + finger(0.2), {0, 1}), (Labels{0, 0}));
  EXPECT_EQ(neighbours(finger(0) + finger(0.4), {0, 1}), (Labels{0, 1}));
}

TEST(Reach, OfADrivenOneThatFloatsIsEverywhere) {
  const std::string walker = "<body pos='9 0 0'><freejoint/><geom size='0.05'/>" + finger(0) + "</body>";
  EXPECT_EQ(neighbours(finger(0) + walker, {0, 7}), (Labels{0, 0}));
}

TEST(Reach, OfWhatCollidesWithNothingIsNone) {
  EXPECT_EQ(neighbours("<body><joint/><geom size='1' contype='0' conaffinity='0'/></body>" + finger(0), {0, 1}), (Labels{0, 1}));
}

TEST(Reach, OfOneBetweenTwoNeighbourhoodsMakesThemOne) {
  // The last touches the first, then one of two that are neighbours already.
  EXPECT_EQ(neighbours(finger(0) + finger(0.4) + finger(0.6) + finger(0.2), {0, 1, 2, 3}), (Labels{0, 0, 0, 0}));
  EXPECT_EQ(neighbours(finger(0.4) + finger(0.6) + finger(0) + finger(-0.2) + finger(0.2), {0, 1, 2, 3, 4}),
            (Labels{0, 0, 0, 0, 0}));
}

TEST(Reach, OfACrankIsThatOfTheFingerThatItMoves) {
  const auto linkage = [](const std::string& name, double x) {
    return "<body name='crank" + name + "' pos='" + std::to_string(x) +
           " 0 0'><joint/><inertial mass='1' pos='0 0 0' "
           "diaginertia='1 1 1'/></body><body name='finger" +
           name + "' pos='" + std::to_string(x) + " 0 0'><joint/><geom size='0.01' pos='0.1 0 0'/></body>";
  };
  const std::string bodies = linkage("a", 0) + linkage("b", 0.2);
  const std::string tie =
      "<equality><connect body1='cranka' body2='fingera' anchor='0.05 0 0'/>"
      "<connect body1='crankb' body2='fingerb' anchor='0.05 0 0'/></equality>";
  EXPECT_EQ(neighbours(bodies, {0, 2}, tie), (Labels{0, 0}));
  EXPECT_EQ(neighbours(bodies, {0, 2}), (Labels{0, 2})) << "without the ties the cranks have no shapes";
}

TEST(Reach, OfOneOnWhatAProgramMovesIsEverywhere) {
  EXPECT_EQ(neighbours("<body mocap='true' pos='9 0 0'>" + finger(0) + "</body>" + finger(0), {0, 1}), (Labels{0, 0}));
}

TEST(Reach, CountsShapesOfNamedPairsAndMargins) {
  const std::string bodies =
      "<body><joint/><geom name='g' size='0.1' contype='0' conaffinity='0'/></body><body pos='0.15 0 0'><joint/>"
      "<geom name='h' size='0.1' contype='0' conaffinity='0'/></body>";
  EXPECT_EQ(neighbours(bodies, {0, 1}, "<contact><pair geom1='g' geom2='h'/></contact>"), (Labels{0, 0}));
  EXPECT_EQ(neighbours(bodies, {0, 1}), (Labels{0, 1}));
  EXPECT_EQ(
      neighbours("<body><joint/><geom size='0.1' margin='0.02'/></body><body pos='0.21 0 0'><joint/><geom size='0.1'/></body>",
                 {0, 1}),
      (Labels{0, 0}));
}

TEST(Reach, CountsWhatIsFixedToTheWorldAsAPlace) {
  const std::string palm = "<body pos='5 0 0' quat='0 0 0 1'><geom size='0.02'/>" + finger(0.1) + finger(-0.1) + "</body>";
  EXPECT_EQ(neighbours(palm + finger(4.9), {0, 1, 2}), (Labels{0, 0, 0}));
  EXPECT_EQ(neighbours(palm + finger(0), {0, 1, 2}), (Labels{0, 0, 2}));
}

}  // namespace
}  // namespace vsa::physics
