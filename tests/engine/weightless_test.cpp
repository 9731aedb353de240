// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Links with <gravity>false</gravity>, which MuJoCo hasn't.
#include <algorithm>
#include <cmath>
#include <set>

#include "engine/worlds.hpp"

namespace vsa::engine::testing {
namespace {

struct Arm {
  std::set<std::string> weightless = {};  ///< of a, b, c, ball
  std::string gravity = "1 -2 -9.81";
  bool held = true;       ///< by the world, or in free flight
  bool follower = false;  ///< c follows a: the look ahead solves constraints then
  bool actuated = false;  ///< b
  double damping = 0.01;
};

/// Three links about axes askew, centres of mass beside their frames, and a ball.
World make(const Arm& arm) {
  const auto link = [&](const std::string& name, const std::string& pose, double mass, const std::string& at) {
    return "<link name='" + name + "'><pose>" + pose + "</pose>" + inertial(mass, 0.002, at) +
           (arm.weightless.contains(name) ? "<gravity>false</gravity>" : "") + "</link>";
  };
  const auto joint = [&](const std::string& parent, const std::string& child, const std::string& axis,
                         const std::string& more = "") {
    return "<joint name='j_" + child + "' type='revolute'><parent>" + parent + "</parent><child>" + child + "</child><axis><xyz>" +
           axis + "</xyz>" + more + "<dynamics><damping>" + std::to_string(arm.damping) + "</damping></dynamics></axis></joint>";
  };
  std::string text = "<sdf version='1.11'><world name='w'><gravity>" + arm.gravity + "</gravity><model name='m'>" +
                     link("a", "0 0 1 0 0 0", 0.5, "0.1 0.02 0 0.3 0 0") +
                     link("b", "0.2 0 1 0.4 0 0.2", 0.3, "0.05 0 0.03 0 0 0") +
                     link("c", "0.4 0.1 1 0 0.5 0", 0.2, "0 0.07 0 0 0 0.7");
  if (arm.held) text += joint("world", "a", "0 1 0.2");
  text += joint("a", "b", "1 0 0.3") +
          joint("b", "c", "0.2 1 1", arm.follower ? "<mimic joint='j_b'><multiplier>-0.7</multiplier></mimic>" : "");
  if (arm.actuated)
    text +=
        "<plugin name='vsa::Robot' filename='libvsa-robot.so'><actuator><joint>j_b</joint><type>qbmove_maker_pro_6_1</type>"
        "<bus id='1'>arm</bus></actuator><bus name='arm' baud='2000000' cycle_s='auto'/></plugin>";
  return World::load_string(text + "</model><model name='ball'><pose>0 3 2 0 0 0</pose>" +
                            link("ball", "0 0 0 0 0 0", 2, "0.1 0 0 0 0 0") + "</model></world></sdf>");
}

std::vector<double> angles(const World& w) {
  std::vector<double> out;
  for (const JointInfo& joint : w.joints()) out.push_back(w.joint_angle(joint.name));
  return out;
}

double apart(const std::vector<double>& x, const std::vector<double>& y) {
  double most = x.size() == y.size() ? 0 : HUGE_VAL;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) most = std::max(most, std::abs(x[i] - y[i]));
  return most;
}

double apart(const Pose& x, const Pose& y) {
  return apart({x.position.begin(), x.position.end()}, {y.position.begin(), y.position.end()});
}

/// Holds those links up from outside, as long as nobody else does.
void hold_up(World& w, const std::set<std::string>& links) {
  for (const std::string& name : links) {
    const LinkHandle link = w.link(name == "ball" ? "ball::ball" : "m::" + name);
    const double mass = w.link_parameters(link).mass_kg;
    const std::array<double, 3> at = name == "a"   ? std::array{0.1, 0.02, 0.0}
                                     : name == "b" ? std::array{0.05, 0.0, 0.03}
                                     : name == "c" ? std::array{0.0, 0.07, 0.0}
                                                   : std::array{0.1, 0.0, 0.0};
    w.apply_wrench(link, {{-1 * mass, 2 * mass, 9.81 * mass}, {}, at});
  }
}

const std::vector<std::set<std::string>> kSome = {{"a"}, {"b"}, {"c", "ball"}, {"a", "c"}, {"a", "b", "c", "ball"}};

TEST(Weightless, LinksMoveAsIfSomebodyHeldThemUp) {
  for (const std::set<std::string>& links : kSome) {
    for (const bool held : {true, false}) {
      World without = make({.weightless = links, .held = held}), with = make({.held = held});
      hold_up(with, links);
      double most = 0;
      for (int k = 0; k < 500; ++k) {
        without.step();
        with.step();
        most = std::max({most, apart(angles(without), angles(with)), apart(pose_of(without, "m::c"), pose_of(with, "m::c")),
                         apart(pose_of(without, "ball::ball"), pose_of(with, "ball::ball"))});
      }
      EXPECT_LT(most, 1e-4) << links.size() << " links, the first " << *links.begin() << ", held " << held;
    }
  }
}

TEST(Weightless, AllOfThemMoveAsWithoutGravity) {
  for (const auto& [follower, actuated] : {std::pair{false, false}, {true, false}, {false, true}, {true, true}}) {
    World without = make({.weightless = {"a", "b", "c", "ball"}, .follower = follower, .actuated = actuated}),
          nowhere = make({.gravity = "0 0 0", .follower = follower, .actuated = actuated});
    for (World* w : {&without, &nowhere}) {
      w->set_joint("m::j_a", 0.3, 4);
      if (actuated) w->command(w->actuators().front(), 0.4, 0.3);
    }
    for (int k = 0; k < 500; ++k) {
      without.step();
      nowhere.step();
      ASSERT_LT(apart(angles(without), angles(nowhere)), 1e-9) << k;
    }
    EXPECT_NE(angles(without), angles(make({})));
    EXPECT_NEAR(without.energy().gravitational, 0, 1e-12);
    EXPECT_NEAR(without.energy().kinetic, nowhere.energy().kinetic, 1e-9);
    EXPECT_EQ(pose_of(without, "ball::ball").position, pose_of(nowhere, "ball::ball").position);
  }
}

TEST(Weightless, GravityTorquesAreTheSlopeOfTheEnergy) {
  for (const std::set<std::string>& links : kSome) {
    World w = make({.weightless = links});
    const std::vector<double> at{0.3, -0.5, 0.7};
    const auto place = [&](std::size_t moved, double by) {
      for (std::size_t j = 0; j < at.size(); ++j) w.set_joint(w.joints()[j].name, at[j] + (j == moved ? by : 0), 0);
    };
    place(0, 0);
    std::vector<double> torques(w.dof_count()), bias(w.dof_count());
    w.gravity_torques(torques);
    w.bias_torques(bias);
    for (std::size_t j = 0; j < at.size(); ++j) {
      const double h = 1e-4;
      place(j, h);
      const double above = w.energy().gravitational;
      place(j, -h);
      const double below = w.energy().gravitational;
      const std::size_t dof = w.joints()[j].dof.value();
      EXPECT_NEAR(torques[dof], (above - below) / (2 * h), 1e-7) << j << " of " << links.size();
      EXPECT_NEAR(bias[dof], torques[dof], 1e-12);
    }
  }
}

TEST(Weightless, EnergyStaysWhatItIsWithoutDampers) {
  World w = make({.weightless = {"b", "ball"}, .damping = 0});
  w.set_joint("m::j_b", 0.5, 1);
  const auto total = [&] { return w.energy().kinetic + w.energy().gravitational; };
  const double begun = total(), fell = w.energy().kinetic;
  double most = 0, fastest = 0;
  for (int k = 0; k < 1000; ++k) {
    w.step();
    most = std::max(most, std::abs(total() - begun));
    fastest = std::max(fastest, w.energy().kinetic);
  }
  EXPECT_LT(most, 0.01 * (fastest - fell));
  EXPECT_GT(fastest, fell + 1);
}

TEST(Weightless, ABodyFloatsWhateverItWeighsAndACopyToo) {
  World w = make({.weightless = {"ball"}});
  const Pose begun = pose_of(w, "ball::ball");
  const LinkHandle ball = w.link("ball::ball");
  LinkParameters heavier = w.link_parameters(ball);
  heavier.mass_kg *= 7;
  w.set_link_parameters(ball, heavier);
  World copy = w.clone();
  const auto index = static_cast<std::size_t>(
      std::find_if(w.links().begin(), w.links().end(), [](const LinkInfo& l) { return l.name == "ball::ball"; }) -
      w.links().begin());
  w.pull({{index, {0.1, 0, 0}, {0.1, 3, 2}, 50, 5}});  // its centre of mass is there: nothing to pull
  for (int k = 0; k < 300; ++k) {
    w.step();
    copy.step();
  }
  EXPECT_LT(apart(pose_of(w, "ball::ball"), begun), 1e-12);
  EXPECT_LT(apart(pose_of(copy, "ball::ball"), begun), 1e-12);
  EXPECT_GT(apart(pose_of(w, "m::c"), pose_of(make({}), "m::c")), 0.05);  // the others fall
}

}  // namespace
}  // namespace vsa::engine::testing
