// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What `vsa run` tells of a robot file and of what its actuators didn't do, whatever the transport.
#include <gtest/gtest.h>

#include "subprocess.hpp"

namespace {

namespace fs = std::filesystem;
using vsa::test::read_file;
using vsa::test::run_vsa;
using vsa::test::Scratch;
using vsa::test::write_file;

const fs::path kFiles = fs::path(VSA_SOURCE_DIR) / "tests/sdf/robot_files";

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

std::string motion_with_preset(const char* preset_deg) {
  return std::string("title = \"t\"\n\n[[keyframe]]\ntime_s = 0.0\npreset_deg = { j1 = ") + preset_deg +
         " }\n\n[[keyframe]]\ntime_s = 0.1\npreset_deg = { j1 = 10.0 }\n";
}

TEST(RunFiles, AClampedPresetIsToldOnceWithAndWithoutTopics) {
  const Scratch scratch;
  write_file(scratch / "over.toml", motion_with_preset("60.0"));
  for (const bool topics : {false, true}) {
    std::vector<std::string> arguments{"run",    (kFiles / "actuated.sdf").string(), "--duration-s", "0.3",
                                       "--gait", (scratch / "over.toml").string()};
    if (!topics) arguments.emplace_back("--no-topics");
    const auto result = run_vsa(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(count(result.err, "j1: preset 1.0"), 1u) << result.err;
    EXPECT_EQ(count(result.err, "clamped"), 1u) << result.err;
  }
}

TEST(RunFiles, CommandsRefusedForASerialPortAreToldWithoutTopics) {
  const Scratch scratch;
  std::string robot = read_file(kFiles / "actuated.sdf");
  const std::string end = "</actuator></plugin>";
  const std::size_t at = robot.find(end);
  ASSERT_NE(at, std::string::npos);
  robot.replace(at, end.size(),
                "<bus id=\"1\">arm</bus></actuator><bus name=\"arm\"><serial_port>" + (scratch / "port").string() +
                    "</serial_port></bus></plugin>");
  write_file(scratch / "robot.sdf", robot);
  write_file(scratch / "motion.toml", motion_with_preset("20.0"));
  const auto result = run_vsa({"run", (scratch / "robot.sdf").string(), "--no-topics", "--duration-s", "0.3", "--gait",
                               (scratch / "motion.toml").string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(count(result.err, "commands aren't taken: its bus belongs to the serial port"), 1u) << result.err;
}

TEST(RunFiles, AWorldWithoutActuatorsIsToldAndAMistakenNameAskedAbout) {
  const auto none = run_vsa({"run", (kFiles / "plain_1_12.sdf").string(), "--no-topics", "--duration-s", "0.01"});
  ASSERT_EQ(none.exit_code, 0) << none.err;
  EXPECT_EQ(count(none.err, "the world has no actuator"), 1u) << none.err;
  const auto named = run_vsa({"run", (kFiles / "plugin_name.sdf").string(), "--no-topics", "--duration-s", "0.01"});
  EXPECT_EQ(count(named.err, "did you mean vsa::Robot?"), 1u) << named.err;
  const auto driven = run_vsa({"run", (kFiles / "actuated.sdf").string(), "--no-topics", "--duration-s", "0.01"});
  EXPECT_EQ(count(driven.err, "warning"), 0u) << driven.err;
}

TEST(RunFiles, ConcaveMeshesRunAsAsked) {
  const auto run = [](const char* how) {
    return run_vsa({"run", (kFiles / "mesh_concave.sdf").string(), "--no-topics", "--duration-s", "0.01", "--concave", how});
  };
  EXPECT_EQ(run("refuse").exit_code, 2);
  EXPECT_EQ(count(run("hull").err, "filled to their convex hulls"), 1u);
  EXPECT_EQ(count(run("decompose").err, "cut into convex parts"), 1u);
  EXPECT_EQ(run("melt").exit_code, 2);
}

TEST(RunFiles, WhatARefusedFileHasIsToldByTheDoctorToo) {
  const auto refused = run_vsa({"doctor", (kFiles / "dummy_leaf.urdf").string()});
  EXPECT_NE((refused.out + refused.err).find("link[tip]: is moved by a joint"), std::string::npos) << refused.out << refused.err;
  const auto two = run_vsa({"doctor", (kFiles / "two_robots.urdf").string()});
  EXPECT_NE((two.out + two.err).find("stands outside the file's first element"), std::string::npos) << two.out << two.err;
  EXPECT_EQ(run_vsa({"run", (kFiles / "two_robots.urdf").string(), "--duration-s", "0.01"}).exit_code, 2);
  const auto named = run_vsa({"doctor", (kFiles / "plugin_name.sdf").string()});
  EXPECT_NE((named.out + named.err).find("did you mean vsa::Robot?"), std::string::npos) << named.out << named.err;
}

}  // namespace
