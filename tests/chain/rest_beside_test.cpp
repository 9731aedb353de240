// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A robot that is left alone comes to rest, whatever else acts on its joints: dampers and springs of the file, passive joints before
// and behind the actuators, followers, a heavy load on light links. A host that goes on with what these did in the last step, instead
// of asking what they do now, shook or blew up in every case here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "chain/rest.hpp"

namespace {

using vsa::engine::World;
using vsa::test::kCreated;
using vsa::test::kQuiet_rad_per_s;
using vsa::test::Rest;
using vsa::test::rest_of;

enum class Kind { actuated, hinge, slide, follower };

struct Link {
  Kind kind = Kind::actuated;
  double mass_kg = 0.3, length_m = 0.08, damping = 0, spring = 0, multiplier = 1;  ///< the last: of a follower of the first joint
  bool beside = false;  ///< hangs on the fixed link, not on the one before
};

struct Chain {
  std::vector<Link> links;
  double step_s = 1e-3, preset = 0.785;  ///< preset: 0 is the type's own
  bool gravity = false;
  std::string type = "qbmove_maker_pro_6_1";
  double command_rad = 0;  ///< of every actuator, at once
};

/// Links in series below a fixed one, all about y; a slide moves along x.
std::string world_of(const Chain& c) {
  std::ostringstream s;
  s << "<sdf version='1.11'><world name='w'><gravity>0 0 " << (c.gravity ? -9.81 : 0)
    << "</gravity><physics name='p' type='ode'><max_step_size>" << c.step_s << "</max_step_size></physics><model name='m'>"
    << "<link name='l0'><inertial><mass>1</mass></inertial></link>"
    << "<joint name='fix' type='fixed'><parent>world</parent><child>l0</child></joint>";
  std::string actuators;
  double z = 0;
  for (std::size_t i = 1; i <= c.links.size(); ++i) {
    const Link& l = c.links[i - 1];
    if (l.beside) z = 0;
    const double inertia = l.mass_kg * l.length_m * l.length_m / 12;
    const bool slides = l.kind == Kind::slide;
    s << "<link name='l" << i << "'><pose>0 0 " << z << " 0 0 0</pose><inertial><pose>0 0 " << -l.length_m / 2
      << " 0 0 0</pose><mass>" << l.mass_kg << "</mass><inertia><ixx>" << inertia << "</ixx><iyy>" << inertia << "</iyy><izz>"
      << inertia << "</izz></inertia></inertial></link><joint name='j" << i << "' type='" << (slides ? "prismatic" : "revolute")
      << "'><parent>l" << (l.beside ? 0 : i - 1) << "</parent><child>l" << i << "</child><axis><xyz>"
      << (slides ? "1 0 0" : "0 1 0") << "</xyz>";
    if (l.kind == Kind::follower) s << "<mimic joint='j1'><multiplier>" << l.multiplier << "</multiplier></mimic>";
    s << "<dynamics><damping>" << l.damping << "</damping><spring_stiffness>" << l.spring
      << "</spring_stiffness></dynamics></axis></joint>";
    if (l.kind == Kind::actuated)
      actuators += "<actuator><joint>j" + std::to_string(i) + "</joint><type>" + c.type + "</type><bus id='" + std::to_string(i) +
                   "'>b</bus>" + (c.preset > 0 ? "<initial preset_rad='" + std::to_string(c.preset) + "'/>" : "") + "</actuator>";
    z -= l.length_m;
  }
  s << "<plugin name='vsa::Robot' filename='libvsa-robot.so'>" << actuators << "<bus name='b'/></plugin></model></world></sdf>";
  return s.str();
}

struct Left {
  Rest rest;               ///< of the actuated joints
  double created_J = 0;    ///< out of nothing
  double passive_rms = 0;  ///< of all others, rad/s or m/s
};

Left left_alone(const Chain& c, double seconds = 3) {
  World world = World::load_string(world_of(c));
  if (c.command_rad != 0)
    for (std::size_t i = 0; i < world.actuators().size(); ++i) world.robot(0).command(i, c.command_rad, std::nullopt);
  Left left{rest_of(world, seconds)};
  left.created_J = -world.ledger().coupling;
  double vv = 0;
  constexpr int kSteps = 200;
  for (int k = 0; k < kSteps; ++k) {
    world.step();
    for (std::size_t i = 0; i < c.links.size(); ++i) {
      const double v = world.joint_speed("m::j" + std::to_string(i + 1));
      if (c.links[i].kind != Kind::actuated) vv += v * v / kSteps;
    }
  }
  left.passive_rms = std::sqrt(vv);
  return left;
}

/// Where the unit's own program plucks a joint at an encoder count's edge, it is as busy in steps a tenth as long.
void expect_quiet(const Chain& c, const std::string& named) {
  Left left;
  ASSERT_NO_THROW(left = left_alone(c)) << named;
  EXPECT_LT(left.created_J, 2e-3) << named;
  EXPECT_GT(left.rest.coupling_part, kCreated) << named;
  if (left.rest.rms_speed < kQuiet_rad_per_s && left.passive_rms < kQuiet_rad_per_s) return;
  Chain fine = c;
  fine.step_s = 1e-4;
  const Left at = left_alone(fine);
  EXPECT_LT(left.rest.rms_speed, 2 * std::max(kQuiet_rad_per_s, at.rest.rms_speed)) << named;
  EXPECT_LT(left.passive_rms, 2 * std::max(kQuiet_rad_per_s, at.passive_rms)) << named;
}

TEST(RestBeside, DampersAtActuatedJoints) {
  for (const int joints : {1, 4}) {
    for (const double damping : {0.01, 0.1, 1.0}) {
      for (const double step_s : {1e-3, 2e-3, 4e-3}) {
        for (const double mass_kg : {0.1, 0.45}) {
          Chain c{std::vector<Link>(static_cast<std::size_t>(joints), {Kind::actuated, mass_kg, 0.08, damping}), step_s};
          c.command_rad = 0.1;
          std::ostringstream named;
          named << joints << " joints, " << damping << " N m s/rad, " << step_s * 1e3 << " ms, " << mass_kg << " kg";
          expect_quiet(c, named.str());
        }
      }
    }
  }
}

TEST(RestBeside, SpringsOfTheFileAtActuatedJoints) {
  for (const double spring : {1.0, 10.0, 100.0})
    for (const double step_s : {1e-3, 4e-3})
      expect_quiet({std::vector<Link>(2, {Kind::actuated, 0.3, 0.08, 0, spring}), step_s},
                   std::to_string(spring) + " N m/rad, " + std::to_string(step_s));
}

TEST(RestBeside, PassiveJointsBeforeAndBehindActuatedOnes) {
  for (const double step_s : {0.5e-3, 1e-3, 2e-3}) {
    for (const double damping : {0.03, 0.3}) {
      const std::string named = std::to_string(damping) + ", " + std::to_string(step_s);
      expect_quiet({{{Kind::actuated, 0.05, 0.1}, {Kind::hinge, 0.05, 0.1, damping}}, step_s}, "hinge behind " + named);
      expect_quiet({{{Kind::hinge, 0.1, 0.08, damping}, {Kind::actuated, 0.1}}, step_s}, "hinge before " + named);
    }
    expect_quiet({{{Kind::actuated, 0.1, 0.1}, {Kind::slide, 0.02, 0.1, 10, 1e4}}, step_s}, "slide, " + std::to_string(step_s));
  }
}

TEST(RestBeside, FollowersWithAnotherActuatorBehindThem) {
  for (const double step_s : {1e-3, 2e-3, 4e-3}) {
    for (const double multiplier : {-1.0, 1.0}) {
      for (const auto& [leader, follower] : {std::pair{0.1, 0.1}, {0.45, 0.45}, {0.5, 0.05}}) {
        std::ostringstream named;
        named << leader << " and " << follower << " kg, x " << multiplier << ", " << step_s * 1e3 << " ms";
        expect_quiet(
            {{{Kind::actuated, leader, 0.06}, {Kind::follower, follower, 0.06, 0, 0, multiplier}, {Kind::actuated, leader, 0.06}},
             step_s},
            named.str());
      }
    }
  }
}

/// As parallel grippers are: fingers of two light links follow a damped joint.
TEST(RestBeside, ADampedLeaderWithTwoFingersThatFollowIt) {
  for (const double damping : {0.0, 0.003, 0.03, 0.3}) {
    for (const double step_s : {0.5e-3, 1e-3, 2e-3}) {
      for (const char* type : {"anydrive_ad119e20", "qbmove_maker_pro_6_1"}) {
        Chain c{{{Kind::actuated, 0.016, 0.04, damping},
                 {Kind::follower, 0.02, 0.04, 0, 0, 1, true},
                 {Kind::follower, 0.03, 0.03, 0, 0, -1},
                 {Kind::follower, 0.02, 0.04, 0, 0, -1, true},
                 {Kind::follower, 0.03, 0.03, 0, 0, 1}},
                step_s,
                0,
                true,
                type};
        c.command_rad = 0.1;
        expect_quiet(c, std::string(type) + ", " + std::to_string(damping) + ", " + std::to_string(step_s));
      }
    }
  }
}

TEST(RestBeside, AHeavyLoadThatHangsOnLightLinks) {
  for (const double preset : {0.2, 0.4, 0.785})
    for (const double load_kg : {1.0, 3.0, 10.0})
      for (const double step_s : {1e-3, 2e-3})
        expect_quiet(
            {{{Kind::actuated, 0.01, 0.02}, {Kind::actuated, 0.01, 0.02}, {Kind::actuated, load_kg, 0.1}}, step_s, preset, true},
            std::to_string(load_kg) + " kg, preset " + std::to_string(preset) + ", " + std::to_string(step_s));
}

}  // namespace
