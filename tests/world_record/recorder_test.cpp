// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The recorder on a real, small world.
#include "vsa/record/recorder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "record/scratch.hpp"
#include "vsa/engine/world.hpp"

namespace vsa::record {
namespace {

namespace fs = std::filesystem;

class RecorderTest : public testing::Test {
 protected:
  void SetUp() override {
    options_.page_template = dir_.path() / "template.html";
    spew(options_.page_template, "@VSA_PAGE_DATA@");
  }
  [[nodiscard]] static engine::World bench() {
    engine::WorldOptions options;
    options.types = config::TypeLibrary({fs::path(VSA_SOURCE_DIR) / "actuators"});
    options.model_path = {fs::path(VSA_SOURCE_DIR) / "models"};
    return engine::World::load(fs::path(VSA_SOURCE_DIR) / "models" / "worlds" / "bench_load.sdf", options);
  }
  /// Commands the one actuator, runs 0.1 s and records it.
  void record(engine::World& world, const fs::path& out) const {
    Recorder recorder(world, out, options_);
    const engine::ActuatorRef& a = world.actuators().at(0);
    world.command(a.model + "/" + a.name, 0.5, 0.3);
    while (world.time_s() < 0.1) {
      world.step();
      recorder.sample(world);
    }
    recorder.finish();
  }
  Scratch dir_;
  RecorderOptions options_;
};

std::string last_line(const std::string& text) { return text.substr(text.rfind('\n', text.size() - 2) + 1); }

std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// A torque servo's preset is a stiffness, and the record says so.
TEST_F(RecorderTest, TellsTheUnitOfAServosPreset) {
  engine::WorldOptions options;
  options.types = config::TypeLibrary({fs::path(VSA_SOURCE_DIR) / "actuators"});
  options.model_path = {fs::path(VSA_SOURCE_DIR) / "models"};
  options.actuator.type = "ugurlu_sea";
  engine::World world = engine::World::load(fs::path(VSA_SOURCE_DIR) / "models" / "worlds" / "bench_free.sdf", options);
  const RunInfo info = describe(world);
  EXPECT_EQ(info.robots.at(0).actuators.at(0).preset_unit, "N·m/rad");
  record(world, dir_.path() / "out");
  const std::string csv = slurp(dir_.path() / "out" / (info.robots.at(0).model + "_actuators.csv"));
  EXPECT_NE(csv.find(",preset_command_Nm_per_rad,preset_Nm_per_rad,"), std::string::npos) << csv.substr(0, 300);
}

TEST_F(RecorderTest, BeginsBeforeTheFirstStepAndEndsWithWhatTheWorldSays) {
  engine::World world = bench();
  record(world, dir_.path() / "out");
  const RunInfo info = describe(world);
  const std::string csv = slurp(dir_.path() / "out" / (info.robots.at(0).model + "_actuators.csv"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 12) << "a header, then 0, 0.01 … 0.1 s";
  const auto reading = world.read(world.actuators().at(0));
  EXPECT_NE(reading.shaft_rad, 0);
  EXPECT_EQ(last_line(csv).find("0.1," + info.robots[0].actuators.at(0).name + "," + shortest(reading.shaft_rad) + ","), 0u) << csv;
  const std::string energy = slurp(dir_.path() / "out" / "energy.csv");
  EXPECT_EQ(last_line(energy).find("0.1," + shortest(world.ledger().supply) + ","), 0u) << energy;
  const std::string gravity = "," + shortest(world.energy().gravitational) + ",0\n";
  EXPECT_NE(last_line(energy).find(gravity), std::string::npos) << energy;
}

TEST_F(RecorderTest, TwoRunsGiveTheSameBytes) {
  for (const char* name : {"a", "b"}) {
    engine::World world = bench();
    record(world, dir_.path() / name);
  }
  int files = 0;
  for (const auto& entry : fs::directory_iterator(dir_.path() / "a")) {
    EXPECT_EQ(slurp(entry.path()), slurp(dir_.path() / "b" / entry.path().filename())) << entry.path();
    ++files;
  }
  EXPECT_EQ(files, 5);
}

TEST_F(RecorderTest, AResetStartsTheRecordOver) {
  engine::World world = bench();
  Recorder recorder(world, dir_.path() / "out", options_);
  for (int i = 0; i < 50; ++i) {
    world.step();
    recorder.sample(world);
  }
  world.reset();
  recorder.sample(world);
  const std::string energy = slurp(dir_.path() / "out" / "energy.csv");
  EXPECT_EQ(std::count(energy.begin(), energy.end(), '\n'), 2);
  EXPECT_NE(slurp(recorder.finish()).find("The world went back"), std::string::npos);
}

TEST_F(RecorderTest, WithoutAnyTemplateTheFilesAreWrittenAndItSaysSo) {
  engine::World world = bench();
  const char* before = std::getenv("VSA_DATA_DIR");
  const std::string kept = before != nullptr ? before : "";
  ::setenv("VSA_DATA_DIR", dir_.path().c_str(), 1);
  Recorder recorder(world, dir_.path() / "out");
  kept.empty() ? ::unsetenv("VSA_DATA_DIR") : ::setenv("VSA_DATA_DIR", kept.c_str(), 1);
  world.step();
  recorder.sample(world);
  EXPECT_TRUE(recorder.finish().empty());
  EXPECT_FALSE(fs::exists(dir_.path() / "out" / "replay.html"));
  EXPECT_NE(slurp(dir_.path() / "out" / "energy.csv").find("\n0,"), std::string::npos);
  EXPECT_NE(recorder.without_page().find(dir_.path().string()), std::string::npos) << recorder.without_page();
  EXPECT_TRUE(Recorder(world, dir_.path() / "paged", options_).without_page().empty());
}

TEST_F(RecorderTest, AnActuatorKnowsTheBodyToHighlight) {
  const RunInfo info = describe(bench());
  ASSERT_EQ(info.robots.size(), 1u);
  for (const ActuatorInfo& a : info.robots[0].actuators) {
    ASSERT_FALSE(a.links.empty()) << a.joint;
    EXPECT_FALSE(info.links.at(a.links[0]).is_static);
    EXPECT_EQ(a.preset_unit, "rad");
    EXPECT_EQ(a.motors, 2);
  }
}

}  // namespace
}  // namespace vsa::record
