// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A robot that is left alone comes to rest, whatever its joints, presets and steps; and what moves, moves as in short steps.
#include "chain/rest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "chain/rest_cases.hpp"
#include "chain/serial_worlds.hpp"

namespace {

using vsa::engine::World;
using vsa::test::kCreated;
using vsa::test::kQuiet_rad_per_s;
using vsa::test::named;
using vsa::test::Rest;
using vsa::test::rest_of;
using vsa::test::serial_world;
using vsa::test::SerialWorld;

Rest rest_in(const SerialWorld& w, bool supply, double seconds) {
  World world = World::load_string(serial_world(w));
  if (!supply) world.robot(0).set_supply(false);
  return rest_of(world, seconds);
}

/// Slow, and its torque steady or, where the unit's own program plucks it at a count's edge, no less so than in steps a tenth as long.
void expect_quiet(const SerialWorld& w, bool supply = true, double seconds = 3) {
  const Rest rest = rest_in(w, supply, seconds);
  EXPECT_LT(rest.rms_speed, kQuiet_rad_per_s) << named({w, supply});
  if (!rest.steady()) {
    SerialWorld fine = w;
    fine.step_s = 1e-4;
    EXPECT_TRUE(supply) << named({w, supply}) << ": nothing plucks a unit that is off, but its torque scatters by " << rest.scatter;
    EXPECT_LT(rest.scatter, 2 * rest_in(fine, supply, seconds).scatter) << named({w, supply});
  }
  EXPECT_GT(rest.coupling_part, kCreated) << named({w, supply});
}

TEST(Rest, ChainsAtTheLargestPresetAreQuietAtEveryStep) {
  // The case that every user of two parallel joints meets. Before the joints were solved together, it shook at 1.8 to 6.6 rad/s.
  for (const int joints : {1, 2, 4, 12}) {
    for (const double step_s : {0.5e-3, 1e-3, 2e-3, 4e-3}) {
      if (joints == 12 && step_s < 1e-3) continue;  // test-long has it
      SerialWorld w;
      w.joints = joints;
      w.step_s = step_s;
      for (const bool supply : {true, false}) expect_quiet(w, supply);
    }
  }
}

TEST(Rest, GravityAxesAndPresetsDoNotMatter) {
  for (const double preset : {0.2, 0.785}) {
    for (const bool gravity : {false, true}) {
      for (const bool alternating : {false, true}) {
        SerialWorld w;
        w.joints = 4;
        w.preset = preset;
        w.gravity = gravity;
        w.alternating = alternating;
        expect_quiet(w);
        w.step_s = 4e-3;
        expect_quiet(w);
      }
    }
  }
}

TEST(Rest, EveryShippedTypeIsAsQuietAsItIsInStepsATenthAsLong) {
  // The paper's and the data sheet's parameters have hardly any friction for small swings, so what the programs pluck swings on:
  // that is the type's own, and no step length's.
  for (const char* type : {"qbmove_maker_pro_paper", "qbmove_maker_pro_datasheet", "qbmove_advanced", "sea_example"}) {
    SerialWorld w;
    w.joints = 4;
    w.type = type;
    w.step_s = 1e-4;
    World fine_world = World::load_string(serial_world(w));
    const double fine = rest_of(fine_world, 3).rms_speed;
    for (const double step_s : {1e-3, 4e-3}) {
      w.step_s = step_s;
      World world = World::load_string(serial_world(w));
      const Rest rest = rest_of(world, 3);
      EXPECT_LT(rest.rms_speed, std::max(kQuiet_rad_per_s, 2 * fine)) << named({w}) << ", fine: " << fine;
      EXPECT_GT(rest.coupling_part, kCreated) << named({w});
    }
  }
}

TEST(Rest, EveryShippedRobotIsQuietInItsWorld) {
  int robots = 0;
  for (const auto& file : std::filesystem::directory_iterator(std::string(VSA_SOURCE_DIR) + "/models/worlds")) {
    if (file.path().extension() != ".sdf") continue;
    World world = World::load(file.path());
    if (world.actuators().empty()) continue;
    ++robots;
    const Rest rest = rest_of(world, 5);
    // Frank and the 3R arm rest on edges of encoder counts: 0.02 rad/s. The pole stands on a hinge without friction or actuator: it
    // falls and swings for ever.
    if (file.path().stem() != "bench_pole") {
      EXPECT_LT(rest.rms_speed, 1.5 * kQuiet_rad_per_s) << file.path().filename();
    }
    EXPECT_GT(rest.coupling_part, kCreated) << file.path().filename();
  }
  EXPECT_GE(robots, 10);
}

TEST(Rest, LightLinksAndABareFingerAtTheEndAreQuiet) {
  SerialWorld light;
  light.joints = 3;
  light.mass_kg = 0.05;
  light.inertia_kgm2 = 3e-5;
  SerialWorld finger;
  finger.joints = 4;
  finger.last_mass_kg = 0.02;
  finger.last_inertia_kgm2 = 2e-5;
  for (const double step_s : {0.5e-3, 1e-3, 2e-3, 4e-3}) {
    light.step_s = finger.step_s = step_s;
    expect_quiet(light);
    expect_quiet(finger);
  }
}

TEST(Rest, OneCountOfTheEncoderKeepsTheFirmwareBusyAtSomePresetsAndThatIsTheUnitsOwn) {
  // Preset 0.575 rad lies at the edge of a count: the program's D term answers each count with 12.8 % of full output. The motion is
  // the same at a tenth of the step, and without that gain less than half is left.
  SerialWorld w;
  w.preset = 0.575;
  World world = World::load_string(serial_world(w));
  const Rest coarse = rest_of(world, 2);
  w.step_s = 1e-4;
  World fine_world = World::load_string(serial_world(w));
  const Rest fine = rest_of(fine_world, 2);
  EXPECT_LT(coarse.rms_speed, 0.05);
  EXPECT_LT(coarse.rms_speed, 2 * fine.rms_speed + 1e-3);
  EXPECT_GT(fine.rms_speed, 0.005) << "no longer busy: then the bounds above may be those of the other presets";
  w.step_s = 1e-3;
  w.overrides = "<override key='firmware.kd_pct_per_tick' value='0'/>";
  const Rest without = rest_in(w, true, 2);
  EXPECT_LT(without.rms_speed, 0.5 * coarse.rms_speed);
}

/// Places y of all joints every 4 ms for 0.4 s after a kick of 0.2 rad, motors unpowered.
std::vector<double> kicked(int joints, double step_s, const std::string& overrides = "") {
  SerialWorld w;
  w.overrides = overrides;
  w.joints = joints;
  w.preset = 0.4;
  w.step_s = step_s;
  World world = World::load_string(serial_world(w));
  world.robot(0).set_supply(false);
  world.set_joint("m::j1", 0.2, 0);
  std::vector<double> y;
  while (world.time_ns() < 400'000'000) {
    world.step();
    if (world.time_ns() % 4'000'000 != 0) continue;
    for (int i = 1; i <= joints; ++i) {
      const std::string joint = "m::j" + std::to_string(i);
      y.push_back(world.joint_angle(joint) - 0.5 * step_s * world.joint_speed(joint));
    }
  }
  return y;
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

TEST(Accuracy, OfAKickedJointAndOfTwoAgainstStepsAHundredTimesShorter) {
  for (const int joints : {1, 2}) {
    const std::vector<double> reference = kicked(joints, 1e-5);
    const double at_2 = farthest(kicked(joints, 2e-3), reference), at_1 = farthest(kicked(joints, 1e-3), reference),
                 at_quarter = farthest(kicked(joints, 2.5e-4), reference);
    EXPECT_LT(at_1, joints == 1 ? 1e-3 : 2.5e-3) << joints;
    EXPECT_LT(at_1, at_2) << joints;
    EXPECT_LT(at_quarter, at_1 / 4) << joints << ": second order would be a sixteenth, but frictions stick";
  }
}

TEST(Accuracy, IsOfSecondOrderWhereNoFrictionSticks) {
  for (const int joints : {1, 2}) {
    const std::string smooth = "<override key='tendon.friction' value='0'/>";
    const std::vector<double> reference = kicked(joints, 1e-5, smooth);
    const double at_1 = farthest(kicked(joints, 1e-3, smooth), reference),
                 at_half = farthest(kicked(joints, 5e-4, smooth), reference),
                 at_quarter = farthest(kicked(joints, 2.5e-4, smooth), reference);
    EXPECT_NEAR(at_1 / at_half, 4.0, 0.5) << joints;
    EXPECT_NEAR(at_half / at_quarter, 4.0, 0.5) << joints;
  }
}

TEST(Snapshots, TellOfJointsThatWerePutElsewhereAndForgetThoseOfLater) {
  SerialWorld w;
  World world = World::load_string(serial_world(w));
  world.run(0.1);
  const auto later = [&] {
    world.run(0.05);
    return world.joint_angle("m::j2") + world.ledger().coupling + world.ledger().stored_at_start;
  };
  const auto before = world.snapshot();
  const double untouched = later();
  world.restore(*before);
  world.set_joint("m::j1", 0.3, 0);
  const auto put = world.snapshot();
  const double moved = later();
  world.restore(*put);
  EXPECT_EQ(later(), moved);
  EXPECT_NE(moved, untouched);
  world.set_joint("m::j1", 0.1, 0);
  world.restore(*before);
  EXPECT_EQ(later(), untouched);
}

TEST(Accuracy, OfAnArmThatFoldsWhileItsMobilityChangesTenfold) {
  // Straight, B of the elbow is 3.1e3 1/(kg·m²), folded by 2.1 rad a tenth of it. The motors push all the
  // time, so the balance is of what they and the bodies exchange. A B that stays what it was hardly shows here, as torques change
  // little from step to step; it does in SerialChain.OfBareFlanges…, which blows up.
  for (const double step_s : {1e-3, 4e-3}) {
    SerialWorld w;
    w.joints = 2;
    w.length_m = 0.25;
    w.mass_kg = 0.2;
    w.inertia_kgm2 = 1e-5;
    w.preset = 0.3;
    w.step_s = step_s;
    World world = World::load_string(serial_world(w));
    const double before = world.joint_angle("m::j2");
    world.command("j2", 2.6, 0.3);
    world.run(1.5);
    EXPECT_GT(world.joint_angle("m::j2") - before, 2.0);
    const auto ledger = world.ledger();
    EXPECT_GT(ledger.moved(), 1);
    EXPECT_LT(std::abs(ledger.coupling), 3e-5 * ledger.moved()) << step_s;
    EXPECT_LT(std::abs(ledger.integrator), 3e-5 * ledger.moved()) << step_s;
  }
}

}  // namespace
