// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Worlds in the embedded engine and, as `vsa export --mjcf --plugin` writes them, in a MuJoCo of the same version that steps the
// plug-in's units: the same arithmetic, so deflections within 1e-9 rad.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "../record/scratch.hpp"
#include "motion.hpp"
#include "rig.hpp"
#include "vsa/engine/mjcf.hpp"
#include "vsa/engine/world.hpp"
#include "vsa/physics/mujoco.hpp"

namespace vsa::mujoco::test {
namespace {

constexpr double kTolerance = 1e-9;  // rad, of the issue

/// The engine, as MuJoCo's own step has the bodies move.
engine::WorldOptions as_in_mj_step() {
  engine::WorldOptions options;
  options.physics = physics::mujoco(physics::Coriolis::as_in_mj_step);
  return options;
}

std::string plugin_mjcf(const char* world) {
  // The MJCF beside the SDF: what a build without SDF has.
  const auto file = std::filesystem::path(VSA_SOURCE_DIR) / "models/worlds" / (std::string(world) + ".xml");
  return engine::export_plugin_mjcf(file).file.bytes;
}

struct Case {
  const char* world;
  double duration_s;
};

class SameAsOwnEngine : public testing::TestWithParam<Case> {};

TEST_P(SameAsOwnEngine, InDeflectionAndAngleAndWhatItsSensorsTell) {
  const auto file = std::filesystem::path(VSA_SOURCE_DIR) / "models/worlds" / (std::string(GetParam().world) + ".xml");
  engine::World world = engine::World::load(file, as_in_mj_step());
  const Rig rig(plugin_mjcf(GetParam().world));
  Data data(rig);
  const std::size_t n = world.actuators().size();
  ASSERT_EQ(rig.units().size(), n);
  double worst = 0, moved = 0;
  for (int step = 0; world.time_s() < GetParam().duration_s; ++step) {
    if (step % kCommandEvery == 0) {
      for (std::size_t i = 0; i < n; ++i) {
        const Command c = command_at(i, world.time_s());
        world.command(world.actuators()[i], c.equilibrium, c.preset);
        data.d().ctrl[2 * i] = c.equilibrium;
        data.d().ctrl[2 * i + 1] = c.preset;
      }
    }
    world.step();
    data.step();
    if (step % 50 != 0) continue;
    const std::vector<double> here = data.all();
    data.forward();      // sensors tell of the step before, as all of MuJoCo's
    data.set_all(here);  // which leaves the solver another first guess
    for (std::size_t i = 0; i < n; ++i) {
      const host::ActuatorReading r = world.read(world.actuators()[i]);
      const auto told = [&](Reading which) { return data.sensor(i)[static_cast<std::size_t>(which)]; };
      worst = std::max(worst, std::abs(told(Reading::deflection) - r.deflection_rad));
      moved = std::max(moved, std::abs(r.shaft_rad));
      ASSERT_NEAR(told(Reading::deflection), r.deflection_rad, kTolerance) << GetParam().world << " unit " << i << " step " << step;
      EXPECT_NEAR(told(Reading::equilibrium), r.equilibrium_rad, kTolerance);
      EXPECT_NEAR(told(Reading::preset), r.preset, kTolerance);
      EXPECT_NEAR(told(Reading::torque), r.mean_torque_Nm, 1e-6);
      EXPECT_NEAR(told(Reading::stiffness), r.stiffness_Nm_per_rad, 1e-6);
      EXPECT_EQ(told(Reading::ticks_1), r.measured[0].value);
      EXPECT_EQ(told(Reading::ticks_2), r.measured[1].value);
      EXPECT_EQ(told(Reading::ticks_shaft), r.measured[2].value);
      EXPECT_NEAR(told(Reading::current_1_A), r.current_A[0], 1e-6);
      EXPECT_NEAR(told(Reading::energy_supply), world.robot(0).ledger(i).supply, 1e-6);
    }
  }
  EXPECT_GT(moved, 0.3) << "nothing moved";
  RecordProperty("worst_deflection_rad", std::to_string(worst));
  std::printf("%s: %zu units, %.1f s: deflections differ by at most %.3g rad\n", GetParam().world, n, GetParam().duration_s, worst);
}

INSTANTIATE_TEST_SUITE_P(Worlds, SameAsOwnEngine, testing::Values(Case{"bench_load", 4}, Case{"snake_flat", 3}),
                         [](const auto& of) { return std::string(of.param.world); });

std::vector<std::string> built_in_worlds() {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(VSA_SOURCE_DIR) / "models/worlds")) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".xml") && !name.ends_with(".vsa.xml")) out.push_back(name.substr(0, name.size() - 4));
  }
  std::sort(out.begin(), out.end());
  return out;
}

class EveryWorld : public testing::TestWithParam<std::string> {};

TEST_P(EveryWorld, BeginsAndMovesAsInTheEmbeddedEngine) {
  const auto folder = std::filesystem::path(VSA_SOURCE_DIR) / "models/worlds";
  engine::World world = engine::World::load(folder / (GetParam() + ".xml"), as_in_mj_step());
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".bin") files.emplace_back(entry.path().filename().string(), record::slurp(entry.path()));
  const Rig rig(plugin_mjcf(GetParam().c_str()), files);
  ASSERT_EQ(rig.model().nkey, 1);
  Data data(rig);
  data.key(0);
  std::vector<double> start_rad;
  for (const engine::ActuatorRef& a : world.actuators()) start_rad.push_back(world.read(a).shaft_rad);
  double worst = 0, moved = 0;
  for (int step = 0; step < 400; ++step) {
    for (std::size_t i = 0; i < world.actuators().size() && step % 10 == 0; ++i) {
      const std::vector<int>& controls = rig.units().unit(i).actuators;
      const double* start = rig.model().key_ctrl;
      const double equilibrium = start[controls[0]] + 0.1 * std::sin(9 * world.time_s()),
                   preset = controls.size() > 1 ? start[controls[1]] : 0;
      world.command(world.actuators()[i], equilibrium, preset);
      data.d().ctrl[controls[0]] = equilibrium;
    }
    world.step();
    data.step();
    for (std::size_t i = 0; i < world.actuators().size(); ++i)
      moved = std::max(moved, std::abs(world.joint_angle(world.joint(world.actuators()[i])) - start_rad[i]));
  }
  data.forward();
  for (std::size_t i = 0; i < world.actuators().size(); ++i) {
    const double off =
        data.sensor(i)[static_cast<std::size_t>(Reading::deflection)] - world.read(world.actuators()[i]).deflection_rad;
    worst = std::max(worst, std::abs(off));
  }
  // The engine has a damper in its contacts, too (World's dampers); MuJoCo solves them without.
  EXPECT_LT(worst, GetParam() == "gripper_soft" ? 1e-5 : kTolerance);
  EXPECT_GT(moved, 0.01);
  std::printf("%s: at most %.3g rad\n", GetParam().c_str(), worst);
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, EveryWorld, testing::ValuesIn(built_in_worlds()), [](const auto& of) { return of.param; });

}  // namespace
}  // namespace vsa::mujoco::test
