// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "subprocess.hpp"

namespace {

using vsa::test::read_file;
using vsa::test::run_vsa;
using vsa::test::Scratch;

void expect_holds(const std::string& text, const std::vector<std::string>& parts) {
  for (const auto& part : parts) EXPECT_NE(text.find(part), std::string::npos) << "no '" << part << "' in:\n" << text;
}

TEST(Linearize, WritesThePageAndTheMatrices) {
  const Scratch scratch;
  const auto result = run_vsa(
      {"linearize", "sea_example", "--at-rad", "0.1", "--inertia-kgm2", "0.02", "--firmware", "frozen", "--out", scratch / "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(result.err.empty()) << result.err;
  // 10 N·m/rad on 0.02 kg·m² with a motor of 0.001: −500 and −10000; the shaft bent by 0.1 rad needs 1 N·m.
  expect_holds(result.out, {"stiffness, pulleys held    10 ", "load torque that holds it  1 ", "Poles", "written: "});
  const std::string json = read_file(scratch / "out" / "results.json");
  expect_holds(json,
               {"\"firmware\": \"frozen\"", "\"friction\": \"sliding\"", "-500.0", "-10000.0", "\"name\": \"motor 1 voltage\"",
                "\"held_stiffness_Nm_per_rad\": 10.0", "\"static_stiffness_Nm_per_rad\": 0.0", "impedance_re_Nms_per_rad",
                "vsa linearize sea_example --at-rad 0.1 --inertia-kgm2 0.02 --firmware frozen"});
  EXPECT_EQ(json.find("preset"), std::string::npos) << "this actuator has none";
  expect_holds(read_file(scratch / "out" / "report.html"), {"\"x_log\":true", "Impedance", "Poles"});
}

TEST(Linearize, SaysWithWhichPeriodItSamples) {
  const Scratch scratch;
  const auto result = run_vsa({"linearize", "qbmove_maker_pro_6_1", "--preset-rad", "0.3", "--firmware", "sampled", "--friction",
                               "stuck", "--out", scratch / "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_holds(read_file(scratch / "out" / "results.json"),
               {"\"period_s\": 0.001", "motor 2 angle at the last loop", "\"friction\": \"stuck\"", "\"preset_rad\": 0.3"});
}

/// Of the ANYdrive on its own shaft the average makes a swing of 204 Hz grow that dies out in ticks.
TEST(Linearize, TellsOfWhatGrowsOnlyInTheAverage) {
  const Scratch scratch;
  const auto with = [&](const char* firmware) {
    return run_vsa({"linearize", "anydrive_ad119e20", "--preset-rad", "35", "--firmware", firmware, "--out", scratch / "out"});
  };
  expect_holds(with("averaged").err, {"grows in the averaged firmware", "take it sampled"});
  EXPECT_EQ(with("sampled").err.find("take it sampled"), std::string::npos);
}

TEST(Linearize, FollowsLoadAndParameters) {
  const Scratch scratch;
  const auto result = run_vsa({"linearize", "sea_example", "--load-Nm", "0.5", "--equilibrium-rad", "0.2", "--damping-Nms-per-rad",
                               "0.01", "--set", "elastic.stiffness_Nm_per_rad=20", "--out", scratch / "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_holds(read_file(scratch / "out" / "results.json"),
               {"\"equilibrium_rad\": 0.2", "\"held_stiffness_Nm_per_rad\": 20.0", "\"damping_Nms_per_rad\": 0.01"});
  const std::string json = read_file(scratch / "out" / "results.json"), key = "\"shaft_rad\": ";
  EXPECT_NEAR(std::stod(json.substr(json.find(key) + key.size())), 0.225, 1e-9);
}

TEST(Linearize, TakesAWorldWithAllItsJoints) {
  const Scratch scratch;
  const auto result =
      run_vsa({"linearize", "manipulator_3r", "--at", "joint_1=0.3", "--preset-rad", "0.3", "--preset-of", "joint_2=0.1",
               "--equilibrium-of", "joint_1=0.35", "--firmware", "frozen", "--out", scratch / "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_holds(result.out, {"Joints", "joint_1", "joint_2", "Poles", "swings farthest", "written: "});
  const std::string json = read_file(scratch / "out" / "results.json");
  expect_holds(
      json,
      {"\"world\": \"manipulator_3r\"", "\"mass_matrix\"", "\"gravity_stiffness\"", "joint_1 motor 2 voltage",
       "joint_2 load torque", "driving_point_re_Nms_per_rad", "\"angle_rad\": 0.3", "\"moves\"",
       "vsa linearize manipulator_3r --at joint_1=0.3 --preset-rad 0.3 --preset-of joint_2=0.1 --equilibrium-of joint_1=0.35"});
  expect_holds(read_file(scratch / "out" / "report.html"), {"\"x_log\":true", "Impedance", "Poles"});
}

TEST(Linearize, PutsAnotherTypeOnAWorld) {
  const Scratch scratch;
  const auto result = run_vsa({"linearize", "bench_free", "--type", "sea_example", "--set", "elastic.stiffness_Nm_per_rad=20",
                               "--firmware", "frozen", "--out", scratch / "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_holds(read_file(scratch / "out" / "results.json"), {"\"held_stiffness_Nm_per_rad\": 20.0"});
}

TEST(Linearize, WarnsWhereTheFirmwareIsOutOfReach) {
  const Scratch scratch;
  const auto result = run_vsa({"linearize", "sea_example", "--out", scratch / "out"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_holds(result.err, {"warning: motor 1 rests inside its bridge's dead band"});
}

TEST(Linearize, RefusesBadInputAndWritesNothing) {
  const Scratch scratch;
  const auto refused = [&](std::vector<std::string> arguments, const std::vector<std::string>& parts) {
    arguments.insert(arguments.begin(), "linearize");
    arguments.insert(arguments.end(), {"--out", scratch / "out"});
    const auto result = run_vsa(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    expect_holds(result.err, parts);
    EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
  };
  refused({}, {"TARGET"});
  refused({"qbmove_9000"}, {"qbmove_9000", "sea_example", "snake_flat"});
  refused({"snake_flat"}, {"flies free"});
  refused({"manipulator_3r", "--at", "wrist=0.1"}, {"--at = wrist", "no such joint"});
  refused({"manipulator_3r", "--at", "0.1"}, {"--at", "elbow=0.3"});
  refused({"manipulator_3r", "--at", "joint_1=0.1", "--at", "joint_1=0.2"}, {"--at", "joint_1=0.2", "named twice"});
  refused({"manipulator_3r", "--preset-of", "wrist=0.1"}, {"--preset-of = wrist", "no such actuator"});
  refused({"manipulator_3r", "--preset-rad", "0.9"}, {"--preset-rad = 0.9", "0.785"});
  refused({"manipulator_3r", "--at-rad", "0.1", "--inertia-kgm2", "1"}, {"--at-rad", "--inertia-kgm2", "is a world"});
  refused({"sea_example", "--at", "j=0.1", "--type", "sea_example"}, {"--at", "--type", "is an actuator type"});
  refused({"sea_example", "--preset-rad", "0.1"}, {"--preset-rad = 0.1", "no stiffness preset"});
  refused({"qbmove_maker_pro_6_1", "--preset-rad", "0.9"}, {"--preset-rad = 0.9", "0.785"});
  refused({"qbmove_maker_pro_6_1", "--inertia-kgm2", "0"}, {"--inertia-kgm2 = 0", "above 0"});
  refused({"qbmove_maker_pro_6_1", "--at-rad", "1.5"}, {"motor 1 voltage", "motor 2 voltage", "drive.supply_V"});
  refused({"qbmove_maker_pro_6_1", "--at-rad", "0.1", "--load-Nm", "0.1"}, {"--load-Nm", "--at-rad"});
  refused({"qbmove_maker_pro_6_1", "--firmware", "asleep"}, {"--firmware", "averaged"});
  refused({"qbmove_maker_pro_6_1", "--set", "firmware.ki_pct_per_tick=0.1"}, {"firmware.ki_pct_per_tick", "averaged or sampled"});
}

}  // namespace
