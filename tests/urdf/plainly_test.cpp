// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A URDF by urdfdom alone, in any build that has it: against closed forms, and on what is no URDF.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <locale>

#include "urdf/outcome.hpp"
#include "vsa/sdf/feature.hpp"

namespace vsa::reader::testing {
namespace {

using description::Joint;
using description::Vec3;

Outcome read(const std::string& name) { return plainly({{}, robots().at(name)}); }

std::string problems_of(const std::string& text) { return plainly({{}, text}).problems; }

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Rz(yaw) Ry(pitch) Rx(roll) v, as the URDF specification has it, written out.
Vec3 turned(double roll, double pitch, double yaw, const Vec3& v) {
  const double cr = std::cos(roll), sr = std::sin(roll), cp = std::cos(pitch), sp = std::sin(pitch), cy = std::cos(yaw),
               sy = std::sin(yaw);
  const Vec3 x(v.X(), cr * v.Y() - sr * v.Z(), sr * v.Y() + cr * v.Z());
  const Vec3 y(cp * x.X() + sp * x.Z(), x.Y(), -sp * x.X() + cp * x.Z());
  return {cy * y.X() - sy * y.Y(), sy * y.X() + cy * y.Y(), y.Z()};
}

void expect_near(const Vec3& a, const Vec3& b, const std::string& what) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-12) << what << ", " << i;
}

TEST(PlainUrdf, LinksBehindTurnedFixedJointsAreWhereTheirOriginsPutThem) {
  const Outcome out = read("rotated_chain");
  ASSERT_EQ(out.problems, "");
  ASSERT_EQ(out.world.links.size(), 3u) << "base with b and c in it, d with e, f";
  // base is at (1 2 3); b, c and d follow by three origins.
  const auto of_base = [](const Vec3& v) { return Vec3(1, 2, 3) + turned(0.1, 0.2, 0.3, v); };
  const auto of_b = [&](const Vec3& v) { return of_base(Vec3(0.2, 0.1, -0.3) + turned(0.7, -0.6, 0.5, v)); };
  const auto of_c = [&](const Vec3& v) { return of_b(Vec3(-0.1, 0.3, 0.2) + turned(-1.1, 0.4, 0.3, v)); };
  expect_near(out.world.links[1].pose.Pos(), of_c({0.3, 0.2, 0.1}), "d");
  const auto in_d = [&](const Vec3& v) { return Vec3(0.3, 0.2, 0.1) + turned(0.4, 0.5, -0.6, v); };
  expect_near(out.world.joints[1].axes[0].xyz, of_c(in_d({0.6, 0, 0.8})) - of_c(in_d({})), "its axis");
}

TEST(PlainUrdf, WhatFixedJointsJoinWeighsWhatItsPartsWeigh) {
  const Outcome out = read("rotated_chain");
  const auto& base = out.world.links.front();
  EXPECT_NEAR(base.mass, 3.0, 1e-12);
  const auto in_b = [](const Vec3& v) { return Vec3(0.2, 0.1, -0.3) + turned(0.7, -0.6, 0.5, v); };
  const auto in_c = [&](const Vec3& v) { return in_b(Vec3(-0.1, 0.3, 0.2) + turned(-1.1, 0.4, 0.3, v)); };
  const Vec3 centre = (Vec3(0.1, -0.2, 0.3) * 2 + in_b({0.05, 0.06, -0.07}) * 0.7 + in_c({-0.05, 0.02, 0.01}) * 0.3) / 3.0;
  expect_near(base.com, centre, "centre of mass");
  // The trace of an inertia is the same in any frame: the parts' own, and 2 m d² of each.
  const double own = 0.01 + 0.012 + 0.008;
  const auto about = [&](double m, const Vec3& c) { return own + 2 * m * (c - centre).Dot(c - centre); };
  EXPECT_NEAR(base.inertia(0, 0) + base.inertia(1, 1) + base.inertia(2, 2),
              about(2, {0.1, -0.2, 0.3}) + about(0.7, in_b({0.05, 0.06, -0.07})) + about(0.3, in_c({-0.05, 0.02, 0.01})), 1e-12);
}

TEST(PlainUrdf, AnInertiaStandsInTheFrameOfItsOrigin) {
  // A rod along its own x, turned by 90° about z: along the link's y, about which it has the least moment.
  const Outcome out =
      plainly({{},
               "<robot name='r'><link name='a'><inertial><origin xyz='0 0 0' rpy='0 0 1.5707963267948966'/><mass value='1'/>"
               "<inertia ixx='0.001' ixy='0' ixz='0' iyy='0.02' iyz='0' izz='0.02'/></inertial></link></robot>"});
  ASSERT_EQ(out.problems, "");
  EXPECT_NEAR(out.world.links[0].inertia(0, 0), 0.02, 1e-15);
  EXPECT_NEAR(out.world.links[0].inertia(1, 1), 0.001, 1e-15);
}

TEST(PlainUrdf, LimitsDampingFrictionAndMimicAreTheJoints) {
  const Outcome out = read("moving_arm");
  ASSERT_EQ(out.world.joints.size(), 4u);
  const Joint &j1 = out.world.joints[1], &j2 = out.world.joints[2], &j3 = out.world.joints[3];
  EXPECT_EQ(j1.kind, Joint::Kind::hinge);
  EXPECT_EQ(*j1.axes[0].range, (std::array<double, 2>{-3, 3}));
  EXPECT_EQ(j1.axes[0].damping, 0.02);
  EXPECT_EQ(j1.axes[0].friction, 0.01);
  EXPECT_EQ(j2.kind, Joint::Kind::slide);
  EXPECT_EQ(*j2.axes[0].range, (std::array<double, 2>{-0.2, 0.1}));
  EXPECT_EQ(j3.kind, Joint::Kind::hinge);
  EXPECT_FALSE(j3.axes[0].range.has_value()) << "continuous";
  EXPECT_EQ(j3.axes[0].stiffness, 0.4);
  EXPECT_EQ(j3.axes[0].rest, 0.3);
  const Outcome mimic = read("moving_mimic");
  ASSERT_EQ(mimic.world.couplings.size(), 1u);
  EXPECT_EQ(mimic.world.couplings[0].multiplier, -1.5);
  EXPECT_EQ(mimic.world.couplings[0].offset, 0.25);
}

TEST(PlainUrdf, AMeshIsScaledAlongEachAxis) {
  const Outcome scaled = read("mesh_scaled");
  ASSERT_EQ(scaled.problems, "");
  const auto& g = scaled.world.links[1].collisions.at(0).geometry;
  expect_near(g.size, {2, 0.5, -1.25}, "scale");
  Vec3 low, high;
  for (const Vec3& v : g.mesh->vertices) low.Min(v), high.Max(v);
  const Vec3 size = high - low;
  EXPECT_NEAR(size.X() / size.Y(), 4, 1e-6) << "a cube";
  EXPECT_NEAR(size.X() / size.Z(), 1.6, 1e-6);
}

TEST(PlainUrdf, FrictionBelongsToTheLinkThatTheFileNames) {
  const auto mu = [](const Outcome& out) {
    std::vector<double> all;
    for (const auto& c : out.world.links.at(1).collisions) all.push_back(c.surface.mu);
    return all;
  };
  EXPECT_EQ(mu(read("prefix_mu")), (std::vector<double>{0.3, 1}));
  EXPECT_EQ(mu(read("prefix_mu_of_the_tool")), (std::vector<double>{1, 0.3}));
  EXPECT_EQ(mu(read("named_collision_mu")), (std::vector<double>{0.3}));
  EXPECT_EQ(mu(read("gazebo_surface_and_mu")), (std::vector<double>{0.2, 0.2}));
}

TEST(PlainUrdf, AnSdfSaysWhatWouldBringItsReader) {
  const std::string told = problems_of("<sdf version='1.9'><world name='w'/></sdf>");
  EXPECT_TRUE(has(told, sdf_feature().missing())) << told;
  EXPECT_EQ(told.find('\n'), std::string::npos) << "one line";
}

TEST(PlainUrdf, BadInputIsAnErrorThatNamesFileKeyValueAndWhatIsAllowed) {
  for (const auto& [name, phrases] : std::map<std::string, std::vector<std::string>>{
           {"mass_comma", {"1,5"}},
           {"mass_negative", {"link[a]/inertial/mass = -1", "> 0 kg"}},
           {"robot_origin_broken", {"origin@xyz = 1 2", "x y z"}},
           {"cycle_apart", {"link[x]: hangs on no joints", "a tree"}},
           {"two_parents", {"link[b] = j2, j3: is the child of several joints"}},
           {"two_robots", {"SDF text:9: <robot>", "stands outside the file's first element", "one <robot> a file"}},
           {"words_before", {"SDF text:1: lost words: stands outside"}},
           {"words_behind", {"SDF text:9: lost words: stands outside"}},
           {"link_as_joint", {"joint@name = j1: is a link's name"}},
           {"gazebo_unknown", {"gazebo/selfcollide = true", "did you mean selfCollide?"}},
           {"gazebo_self_collide_word", {"gazebo[a]/selfCollide = maybe", "true, yes, 1"}},
           {"damping_negative", {"r::j1/axis/dynamics/damping = -1", "≥ 0"}},
           {"impossible", {"violates the triangle inequality"}},
           {"mesh_concave", {"concave"}},
           {"mesh_of_no_package", {"package://no_such/box.stl: file not found"}}}) {
    const std::string told = read(name).problems;
    for (const std::string& phrase : phrases) EXPECT_TRUE(has(told, phrase)) << name << ": " << told;
    EXPECT_TRUE(has(told, "SDF text")) << told;
  }
}

TEST(PlainUrdf, NoBytesEndInACrashOrOnTheConsole) {
  const std::string whole = robots().at("rotated_chain");
  std::vector<std::string> texts{"",
                                 " ",
                                 "<",
                                 "<robot",
                                 "<robot/>",
                                 "<robot name='r'/>",
                                 "<html/>",
                                 std::string(3, '\0'),
                                 "\xff\xfe<robot name='r'/>",
                                 "<robot name='\xff\xfe'><link name='\xe9'/></robot>",
                                 "{\"robot\": 1}",
                                 "<!DOCTYPE x [<!ENTITY a 'b'>]><robot name='&a;'/>"};
  for (std::size_t cut = 0; cut < whole.size(); cut += 17) texts.push_back(whole.substr(0, cut));
  for (std::size_t at = 0; at < whole.size(); at += 13) {
    texts.push_back(whole);
    texts.back()[at] = static_cast<char>(at * 37 % 256);
  }
  std::string deep = "<robot name='r'>";
  for (int i = 0; i < 100000; ++i) deep += "<link>";
  texts.push_back(deep);
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  std::size_t refused = 0;
  for (const std::string& text : texts) refused += plainly({{}, text}).problems.empty() ? 0 : 1;
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_GT(refused, whole.size() / 17) << "a file that was cut is refused";
}

TEST(PlainUrdf, ALongChainIsReadWithoutALongStack) {
  const std::string mass =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>";
  std::string text = "<robot name='r'><link name='l0'>" + mass;
  constexpr int kLinks = 2000;
  for (int i = 1; i < kLinks; ++i) {
    const std::string k = std::to_string(i);
    text += "<link name='l" + k + "'>" + mass + "<joint name='j" + k + "' type='fixed'><parent link='l" + std::to_string(i - 1) +
            "'/><child link='l" + k + "'/><origin xyz='0.001 0 0'/></joint>";
  }
  const Outcome out = plainly({{}, text + "</robot>"});
  ASSERT_EQ(out.problems, "");
  ASSERT_EQ(out.world.links.size(), 1u);
  EXPECT_NEAR(out.world.links[0].mass, kLinks, 1e-9);
  EXPECT_NEAR(out.world.links[0].com.X(), 0.001 * (kLinks - 1) / 2, 1e-9);
}

/// A comma between whole and part, whatever the machine has installed.
class Comma : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
};

TEST(PlainUrdf, NumbersHaveAPointWhateverTheLocale) {
  const Outcome before = read("rotated_chain"), arm = read("moving_arm"), mesh = read("mesh_scaled");
  const std::locale old = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const Outcome after = read("rotated_chain"), arm_after = read("moving_arm"), mesh_after = read("mesh_scaled");
  const std::string comma = read("mass_comma").problems;
  std::locale::global(old);
  ASSERT_EQ(after.problems, "");
  expect_near(after.world.links[1].pose.Pos(), before.world.links[1].pose.Pos(), "pose");
  EXPECT_EQ(after.world.links[0].mass, before.world.links[0].mass);
  EXPECT_EQ(arm_after.world.joints[2].axes[0].range, arm.world.joints[2].axes[0].range);
  EXPECT_EQ(mesh_after.world.links[1].collisions.size(), mesh.world.links[1].collisions.size());
  EXPECT_NE(comma, "");
}

}  // namespace
}  // namespace vsa::reader::testing
