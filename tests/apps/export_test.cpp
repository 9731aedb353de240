// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsa export; what is in the files, and how they run, is tests/fmu's.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "subprocess.hpp"

namespace vsa::test {
namespace {

namespace fs = std::filesystem;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Export, WritesTypesAndWorldsInBothVersionsAndNothingElse) {
  const Scratch scratch;
  fs::create_directories(scratch / "out");
  for (const char* what : {"sea_example", "bench_load"}) {
    for (const char* fmi : {"2", "3"}) {
      const fs::path file = scratch / "out" / (std::string(what) + fmi + ".fmu");
      const Result r = run_vsa({"export", "--fmu", what, "--fmi", fmi, "--out", file.string()});
      EXPECT_EQ(r.exit_code, 0) << r.err;
      EXPECT_TRUE(has(r.out, "written: " + file.string())) << r.out;
      EXPECT_EQ(read_file(file).substr(0, 2), "PK");
    }
  }
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(scratch / "out")) ++files;
  EXPECT_EQ(files, 4U);
}

TEST(Export, WritesAWorldAsMjcfWhichRunsWhereItStands) {
  const Scratch scratch;
  const Result r = run_vsa({"export", "--mjcf", "bench_load", "--out", (scratch / "out").string()});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  const Result run = run_vsa({"run", (scratch / "out/bench_load.xml").string(), "--duration-s", "0.1", "--no-topics"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run_vsa({"export", "--mjcf", "bench_load"}).exit_code, 2) << "without --out";
  EXPECT_NE(run_vsa({"export", "--mjcf", "bench_load", "--fmu", "sea_example"}).exit_code, 0);
  EXPECT_NE(run_vsa({"export", "--mjcf", "bench_load", "--out", (scratch / "x").string(), "--fmi", "2"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(scratch / "x"));
}

TEST(Export, OfAnMjcfsFilesNoneIsNewWhereOneCantBeWritten) {
  const Scratch scratch;
  fs::create_directories(scratch / "out/bench_load.vsa.xml");  // a directory in the way of the second
  const std::string old = "<mujoco model=\"old\">\n<!-- written of SDF 0123456789abcdef -->\n</mujoco>\n";
  write_file(scratch / "out/bench_load.xml", old);
  const Result r = run_vsa({"export", "--mjcf", "bench_load", "--out", (scratch / "out").string()});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_TRUE(has(r.err, "bench_load.vsa.xml: can't open for writing: Is a directory")) << r.err;
  EXPECT_EQ(read_file(scratch / "out/bench_load.xml"), old);
}

TEST(Export, AnMjcfThatSomebodyWroteIsKept) {
  const Scratch scratch;
  fs::create_directories(scratch / "out");
  const std::string own = "<mujoco model=\"bench\">\n<worldbody/>\n</mujoco>\n";
  const std::vector<std::string> arguments{"export", "--mjcf", "bench_load", "--out", (scratch / "out").string()};
  write_file(scratch / "out/bench_load.xml", own);
  const Result r = run_vsa(arguments);
  EXPECT_EQ(r.exit_code, 2);
  EXPECT_TRUE(has(r.err, "bench_load.xml: is there and wasn't written by vsa export")) << r.err;
  EXPECT_EQ(read_file(scratch / "out/bench_load.xml"), own);
  EXPECT_FALSE(fs::exists(scratch / "out/bench_load.vsa.xml"));
  fs::remove(scratch / "out/bench_load.xml");
  EXPECT_EQ(run_vsa(arguments).exit_code, 0);
  EXPECT_EQ(run_vsa(arguments).exit_code, 0) << "its own is written anew";
  // One of before there were marks.
  std::string unmarked = read_file(scratch / "out/bench_load.xml");
  const std::size_t mark = unmarked.find("<!-- written of");
  unmarked.erase(mark, unmarked.find('\n', mark) + 1 - mark);
  write_file(scratch / "out/bench_load.xml", unmarked);
  EXPECT_EQ(run_vsa(arguments).exit_code, 0);
}

TEST(Export, ARobotThatCantBeReadIsRefusedAsARunRefusesIt) {
  const Scratch scratch;
  write_file(scratch / "w.sdf", R"(<sdf version="1.7"><model name="m"><static>false</static>
<link name="a"><inertial><mass>1</mass></inertial></link><link name="b"><inertial><mass>1</mass></inertial></link>
<joint name="j" type="revolute"><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>
<plugin name="vsa::Robot" filename="vsa-robot"><type>no_such_type</type><actuator name="x"><joint>j</joint></actuator></plugin>
</model></sdf>)");
  const Result run = run_vsa({"run", (scratch / "w.sdf").string(), "--no-topics", "--duration-s", "0.1"});
  EXPECT_EQ(run.exit_code, 2);
  const Result r = run_vsa({"export", "--mjcf", (scratch / "w.sdf").string(), "--out", (scratch / "out").string()});
  EXPECT_EQ(r.exit_code, 2);
  EXPECT_EQ(r.err, run.err);
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

TEST(Export, WritesAnMjcfForThePluginBesideTheOthers) {
  const Scratch scratch;
  const Result r = run_vsa({"export", "--mjcf", "bench_load", "--plugin", "--out", (scratch / "out").string()});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  for (const char* file : {"bench_load.xml", "bench_load.vsa.xml", "bench_load_plugin.xml"})
    EXPECT_TRUE(fs::exists(scratch / "out" / file)) << file;
  // Of an MJCF that is there already only its own: tests/mujoco moves it.
  const Result again =
      run_vsa({"export", "--mjcf", (scratch / "out/bench_load.xml").string(), "--plugin", "--out", (scratch / "two").string()});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out, (scratch / "two/bench_load_plugin.xml").string() + "\n");
  EXPECT_EQ(read_file(scratch / "two/bench_load_plugin.xml"), read_file(scratch / "out/bench_load_plugin.xml"));
  EXPECT_NE(run_vsa({"export", "--plugin", "--fmu", "sea_example"}).exit_code, 0);
}

TEST(Export, TellsWhatOfARobotMujocoCannotBeTold) {
  const Scratch scratch;
  const fs::path w = scratch / "w";
  (void)run_vsa({"export", "--mjcf", "bench_load", "--out", w.string()});
  std::string beside = read_file(w / "bench_load.vsa.xml");
  const std::string end = "<state_rate_Hz>";
  beside.insert(beside.find(end), "<record directory='r'/>");
  std::ofstream(w / "bench_load.vsa.xml") << beside;
  const Result r = run_vsa({"export", "--mjcf", (w / "bench_load.xml").string(), "--plugin", "--out", w.string()});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.err.find("<record> isn't for MuJoCo: left out"), std::string::npos) << r.err;
  beside.insert(beside.find(end), "<substeps>2</substeps>");
  std::ofstream(w / "bench_load.vsa.xml") << beside;
  const Result refused = run_vsa({"export", "--mjcf", (w / "bench_load.xml").string(), "--plugin", "--out", w.string()});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("MuJoCo makes its steps itself"), std::string::npos) << refused.err;
}

TEST(Export, BadInputIsOneLineAndExitCodeTwoAndLeavesNoFile) {
  const Scratch scratch;
  fs::create_directories(scratch / "out");
  const std::string file = (scratch / "out/x.fmu").string();
  struct Case {
    std::vector<std::string> arguments;
    const char* says;
  };
  for (const Case& c : {Case{{"--fmu", "sea_exampel"}, "did you mean sea_example"},
                        Case{{"--fmu", "no_such_file.sdf"}, "neither an actuator type nor a world"},
                        Case{{"--fmu", "sea_example", "--set", "drive.wheels=4"}, "unknown key"},
                        Case{{"--fmu", "sea_example", "--set", "drive.supply_V=1e9"}, "drive.supply_V"},
                        Case{{"--fmu", "sea_example", "--coupling", "implicit"}, "--load-inertia-kgm2"},
                        Case{{"--fmu", "sea_example", "--load-inertia-kgm2", "-1"}, "out of range"},
                        Case{{"--fmu", "bench_load", "--names", "gazebo_fmi"}, "for one actuator"}}) {
    std::vector<std::string> arguments{"export", "--out", file};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    const Result r = run_vsa(arguments);
    EXPECT_EQ(r.exit_code, 2) << c.says;
    EXPECT_TRUE(has(r.err, c.says)) << r.err;
    EXPECT_TRUE(fs::is_empty(scratch / "out")) << c.says;
  }
  EXPECT_EQ(run_vsa({"export"}).exit_code, 2);
  EXPECT_EQ(run_vsa({"export", "--fmu", "sea_example", "--fmi", "1", "--out", file}).exit_code, 2);
  const Result nowhere = run_vsa({"export", "--fmu", "sea_example", "--out", (scratch / "nowhere/x.fmu").string()});
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_TRUE(has(nowhere.err, "its directory doesn't exist")) << nowhere.err;
}

TEST(Export, AFullDiskIsToldAndNoHalfFileStays) {
  const Scratch scratch;
  fs::create_directories(scratch / "out");
  Surroundings small;
  small.largest_file = 100'000;
  const Result r = run_vsa({"export", "--fmu", "sea_example", "--out", (scratch / "out/x.fmu").string()}, small);
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_TRUE(has(r.err, "x.fmu")) << r.err;
  EXPECT_TRUE(fs::is_empty(scratch / "out"));
}

}  // namespace
}  // namespace vsa::test
