// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsa-generate as a program; what it writes is tests/models'.
#include <gtest/gtest.h>

#include <filesystem>

#include "subprocess.hpp"

namespace vsa::test {
namespace {

namespace fs = std::filesystem;

const std::string kRobots = VSA_SOURCE_DIR "/models/robots.toml";

Result generate(const std::vector<std::string>& arguments, Surroundings around = {}) {
  around.program = "vsa-generate";
  return run_vsa(arguments, around);
}

TEST(Generate, TellsItsUseAndRefusesOthers) {
  const Result help = generate({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.out.rfind("usage: vsa-generate DESCRIPTION.toml OUTDIR [ROS2DIR]\n", 0), 0U) << help.out;
  Surroundings full;
  full.full_stdout = true;
  const Result unheard = generate({"--help"}, full);
  EXPECT_EQ(unheard.exit_code, 1);
  EXPECT_NE(unheard.err.find("can't write to standard output"), std::string::npos) << unheard.err;
  for (const std::vector<std::string>& bad :
       {std::vector<std::string>{}, {kRobots}, {kRobots, ""}, {"", "out"}, {kRobots, "--out", "x"}, {kRobots, "a", "b", "c"}}) {
    const Result r = generate(bad);
    EXPECT_EQ(r.exit_code, 2);
    EXPECT_EQ(r.out, "");
    EXPECT_EQ(r.err.rfind("usage: ", 0), 0U) << r.err;
  }
}

TEST(Generate, WritesAllOrNothing) {
  const Scratch scratch;
  fs::create_directories(scratch / "out/worlds/snake_flat.sdf");  // a directory in the way
  write_file(scratch / "out/worlds/bench_free.sdf", "old");
  const Result r = generate({kRobots, (scratch / "out").string()});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("snake_flat.sdf: can't open for writing: Is a directory; 0 of "), std::string::npos) << r.err;
  EXPECT_EQ(read_file(scratch / "out/worlds/bench_free.sdf"), "old");
  EXPECT_EQ(generate({kRobots, (scratch / "new").string(), (scratch / "ros2").string()}).exit_code, 0);
  EXPECT_TRUE(fs::exists(scratch / "new/worlds/snake_flat.sdf"));
  EXPECT_TRUE(fs::exists(scratch / "ros2/config/qbmove_snake/bridge.yaml"));
}

}  // namespace
}  // namespace vsa::test
