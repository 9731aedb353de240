// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Friction with <fdir1>: boxes on slopes. The slope is gravity's: sine and cosine of its angle along the ground and into it.
#include <cmath>
#include <numbers>

#include "engine/worlds.hpp"

namespace vsa::engine::testing {
namespace {

constexpr double kSlope = 0.5;  // rad: tan is 0.546
const double kDown = kGravity * std::sin(kSlope), kInto = kGravity * std::cos(kSlope);

std::string surface(const std::string& mu, const std::string& mu2, const std::string& fdir1) {
  return "<surface><friction><ode><mu>" + mu + "</mu><mu2>" + mu2 + "</mu2>" +
         (fdir1.empty() ? "" : "<fdir1" + std::string(fdir1[0] == ' ' ? "" : ">") + fdir1 + "</fdir1>") +
         "</ode></friction></surface>";
}

struct Slide {
  double towards = 0;  ///< where the slope goes down, rad from x
  double yaw = 0;      ///< of the box, rad
  std::string box = surface("0.2", "0.9", "1 0 0");
  std::string ground = surface("5", "5", "");
  double ground_yaw = 0;
};

World make(const Slide& s) {
  const std::string gravity = std::to_string(kDown * std::cos(s.towards)) + " " + std::to_string(kDown * std::sin(s.towards)) +
                              " " + std::to_string(-kInto);
  return World::load_string(world("<model name='ground'><static>true</static><pose>0 0 0 0 0 " + std::to_string(s.ground_yaw) +
                                      "</pose><link name='l'><collision name='c'><geometry><plane><normal>0 0 1</normal><size>9 9"
                                      "</size></plane></geometry>" +
                                      s.ground + "</collision></link></model><model name='box'><pose>0 0 0.0999 0 0 " +
                                      std::to_string(s.yaw) + "</pose><link name='l'>" + inertial(2, 0.02) +
                                      "<collision name='c'><geometry><box><size>0.6 0.6 0.2</size></box></geometry>" + s.box +
                                      "</collision></link></model>",
                                  gravity));
}

/// Mean acceleration along and across the slope over 0.4 s.
std::array<double, 2> acceleration(World w, double towards) {
  const double t = 0.4;
  const Pose begun = pose_of(w, "box::l");
  w.run(t);
  const Pose now = pose_of(w, "box::l");
  const double x = now.position[0] - begun.position[0], y = now.position[1] - begun.position[1];
  return {2 * (x * std::cos(towards) + y * std::sin(towards)) / (t * t),
          2 * (y * std::cos(towards) - x * std::sin(towards)) / (t * t)};
}
double down(const Slide& s) { return acceleration(make(s), s.towards)[0]; }

double expected(double mu) { return std::max(0.0, kDown - mu * kInto); }

constexpr double kQuarter = std::numbers::pi / 2, kNear = 0.05;  // m/s²: contacts are soft and take 20 ms to settle

TEST(DirectedFriction, CountsAlongAndAcross) {
  for (const double yaw : {0.0, kQuarter, 0.7}) {  // the direction goes with the body
    EXPECT_NEAR(down({.towards = yaw, .yaw = yaw}), expected(0.2), kNear) << yaw;
    EXPECT_NEAR(down({.towards = yaw + 2 * kQuarter, .yaw = yaw}), expected(0.2), kNear) << yaw;
    EXPECT_NEAR(down({.towards = yaw + kQuarter, .yaw = yaw}), 0, kNear) << yaw;
  }
  EXPECT_NEAR(down({.box = surface("0.9", "0.2", "1 0 0")}), 0, kNear);
  for (const char* any_length : {"0 3 0", "0 1e308 0", "0 1e-200 0"})
    EXPECT_NEAR(down({.box = surface("0.9", "0.2", any_length)}), expected(0.2), kNear) << any_length;
  EXPECT_NEAR(down({.box = surface("0", "0.9", "1 0 0")}), kDown, kNear);
  EXPECT_NEAR(down({.towards = kQuarter, .box = surface("0.9", "0", "1 0 0")}), kDown, kNear);
}

TEST(DirectedFriction, PushesAcrossASlopeThatIsAskew) {
  // Friction lies on the ellipse (f_x/μ)² + (f_y/μ2)² = N² with the slip as its normal: it turns the box towards the easy way, x.
  const auto [along, across] = acceleration(make({.towards = 0.6}), 0.6);
  EXPECT_GT(along, expected(0.9) + 0.3);
  EXPECT_LT(across, -0.5);
  const auto [straight, aside] = acceleration(make({.towards = 0.6, .box = surface("0.3", "0.3", "1 0 0")}), 0.6);
  EXPECT_NEAR(straight, expected(0.3), kNear);
  EXPECT_NEAR(aside, 0, kNear);
}

TEST(DirectedFriction, OfTwoShapesTheSmallerCounts) {
  for (const double towards : {0.0, kQuarter})
    EXPECT_NEAR(down({.towards = towards, .ground = surface("0.1", "0.1", "")}), expected(0.1), kNear) << towards;
  EXPECT_NEAR(down({.ground = surface("0.4", "0.4", "")}), expected(0.2), kNear);
  EXPECT_NEAR(down({.towards = kQuarter, .ground = surface("0.4", "0.4", "")}), expected(0.4), kNear);
  EXPECT_NEAR(down({.ground = surface("0", "0", "")}), kDown, kNear);
}

TEST(DirectedFriction, OfTheGroundIsTheGrounds) {
  for (const double yaw : {0.0, 0.8}) {
    const Slide easy{
        .towards = yaw, .yaw = 0.3, .box = surface("5", "5", ""), .ground = surface("0.2", "0.9", "1 0 0"), .ground_yaw = yaw};
    EXPECT_NEAR(down(easy), expected(0.2), kNear) << yaw;
    Slide hard = easy;
    hard.towards += kQuarter;
    EXPECT_NEAR(down(hard), 0, kNear) << yaw;
  }
}

TEST(DirectedFriction, OfTwoDirectionsThatOfTheSmallerCoefficientCounts) {
  const std::string lesser = surface("0.2", "0.9", "1 0 0"), larger = surface("0.3", "0.9", "0 1 0");
  EXPECT_NEAR(down({.box = lesser, .ground = larger}), expected(0.2), kNear);
  EXPECT_NEAR(down({.box = larger, .ground = lesser}), expected(0.2), kNear);
  EXPECT_NEAR(down({.towards = kQuarter, .box = larger, .ground = lesser}), 0, kNear);
}

TEST(DirectedFriction, AlongTheNormalTheSmallerCounts) {
  for (const double towards : {0.0, kQuarter})
    EXPECT_NEAR(down({.towards = towards, .box = surface("0.9", "0.2", "0 0 1")}), expected(0.2), kNear) << towards;
}

TEST(DirectedFriction, WithoutADirectionTheSmallerCountsAndItIsTold) {
  World w = make({.box = surface("0.2", "0.9", "")});
  EXPECT_TRUE(std::any_of(w.warnings().begin(), w.warnings().end(),
                          [](const std::string& text) { return text.find("without <fdir1> the smaller") != std::string::npos; }));
  EXPECT_NEAR(down({.towards = kQuarter, .box = surface("0.2", "0.9", "")}), expected(0.2), kNear);
}

TEST(DirectedFriction, FollowsTheLinksOwnParametersAndCopies) {
  World w = make({});
  const LinkHandle link = w.link("box::l");
  LinkParameters half = w.link_parameters(link);
  EXPECT_EQ(half.friction, 0.9);
  *half.friction /= 2;
  w.set_link_parameters(link, half);
  EXPECT_NEAR(acceleration(w.clone(), 0)[0], expected(0.1), kNear);
  World across = make({.towards = kQuarter});
  across.set_link_parameters(across.link("box::l"), half);
  EXPECT_NEAR(acceleration(across.clone(), kQuarter)[0], expected(0.45), kNear);
}

/// A foot under a body that turns on it: whose the direction is.
World on_a_foot(const std::string& fdir1) {
  return World::load_string(world(ground(5) + "<model name='m'><link name='foot'><pose>0 0 0.05 0 0 0</pose>" + inertial(3, 0.05) +
                                      "<collision name='c'><geometry><box><size>0.5 0.5 0.1</size></box></geometry>" +
                                      surface("0.9", "0.2", fdir1) +
                                      "</collision></link><link name='body'><pose>0 0 0.12 0 0 0</pose>" + inertial(0.1, 0.01) +
                                      "</link><joint name='j' type='revolute'><parent>foot</parent><child>body</child><axis><xyz>0 "
                                      "0 1</xyz></axis></joint></model>",
                                  std::to_string(kDown) + " 0 " + std::to_string(-kInto)));
}

TEST(DirectedFriction, IsOfTheLinkThatItIsExpressedIn) {
  for (const char* attribute : {"gz:expressed_in", "ignition:expressed_in"}) {
    World own = on_a_foot("1 0 0"), others = on_a_foot(" " + std::string(attribute) + "='body'>1 0 0");
    for (World* w : {&own, &others}) w->set_joint("m::j", kQuarter, 0);
    own.run(0.3);
    others.run(0.3);
    EXPECT_NEAR(pose_of(own, "m::foot").position[0], 0, 2e-3);
    EXPECT_NEAR(pose_of(others, "m::foot").position[0], expected(0.2) * 0.3 * 0.3 / 2, 0.01);
  }
  EXPECT_NE(problems_of(world("<model name='m'><link name='l'>" + inertial(1, 1) +
                              "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry>" +
                              surface("1", "0.5", " gz:expressed_in='ghost'>1 0 0") + "</collision></link></model>"))
                .find("ode/fdir1@expressed_in = ghost: no such link"),
            std::string::npos);
  const std::string of_bullet = problems_of(
      world("<model name='m'><link name='l'>" + inertial(1, 1) +
            "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry><surface><friction><bullet><friction>1"
            "</friction><friction2>0.5</friction2><fdir1 gz:expressed_in='ghost'>1 0 0</fdir1></bullet></friction></surface>"
            "</collision></link></model>"));
  EXPECT_NE(of_bullet.find("bullet/fdir1@expressed_in = ghost: no such link"), std::string::npos) << of_bullet;
}

}  // namespace
}  // namespace vsa::engine::testing
