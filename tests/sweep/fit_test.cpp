// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Plans whose runs are fits.
#include "vsa/identify/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plans.hpp"
#include "vsa/identify/bench_model.hpp"

namespace vsa::sweep::testing {
namespace {

const std::string kData = std::string(VSA_SOURCE_DIR) + "/data/qbmove_maker_pro/stiffness_preset_";
const std::string kSoft = kData + "0.0000rad_branches.csv", kStiff = kData + "0.6903rad_branches.csv";
const std::string kFit = R"(
[study]
kind = "fit"
type = "qbmove_maker_pro_6_1"
parameters = ["elastic.c1_Nm_per_rad=elastic.c2_Nm_per_rad", "drive.friction_Nm"]
recordings = [")" + kSoft +
                         "\", \"" + kStiff + R"("]
period_s = 12.0
iterations = 3
weights = "equal"
[study.from]
"drive.friction_Nm" = 0.1
[[vary]]
key = "study.leave_out"
name = "left_out"
list = ["none", ")" + kSoft +
                         R"("]
[[vary]]
key = "study.hold.elastic.c1_Nm_per_rad=elastic.c2_Nm_per_rad"
name = "c_Nm_per_rad"
list = [0.2, 0.28]
[[measure]]
name = "rms_rad"
value = "rms_rad"
[[measure]]
name = "c_rad"
value = "value.elastic.c1_Nm_per_rad=elastic.c2_Nm_per_rad"
[[measure]]
name = "friction_Nm"
value = "value.drive.friction_Nm"
[[measure]]
name = "soft_rad"
value = "left_out_rms_rad.stiffness_preset_0.0000rad_branches.csv"
[[measure]]
name = "fitted_soft_rad"
value = "rms_rad.stiffness_preset_0.0000rad_branches.csv"
)";

/// The same by hand: parameters from the type, the start, one held, one local solution.
TEST(Fit, ARunIsALocalSolutionFromItsStart) {
  const Scratch scratch;
  std::string text = kFit;
  text.insert(text.find("period_s"), "load_kg = 0.9\n");
  const Plan plan = plan_of(scratch, text);
  plan.check();
  ASSERT_EQ(plan.runs(), 4U);
  EXPECT_NE(plan.fingerprint(), plan_of(scratch, kFit).fingerprint());
  const Outcome outcome = *Runner(plan).run(1);
  ASSERT_EQ(outcome.error, "");
  experiment::Specimen specimen;
  specimen.type = "qbmove_maker_pro_6_1";
  const auto type = specimen.library.load(specimen.type);
  identify::Task task;
  task.parameters = identify::parse_parameters("elastic.c1_Nm_per_rad=elastic.c2_Nm_per_rad,drive.friction_Nm", type);
  for (const std::string& file : {kSoft, kStiff}) task.observations.push_back(identify::read_observation(file, type));
  identify::SweepOptions sweep;
  sweep.period_s = 12;
  sweep.load_share = 0.9;
  identify::use_bench(task, specimen, sweep);
  const identify::Residuals residuals(task, 2);
  identify::FitOptions options;
  options.iterations = 3;
  const auto found = identify::solve(residuals, {0.28, 0.1}, {true, false}, options);
  EXPECT_EQ(outcome.values[0], found.rms_rad);
  EXPECT_EQ(outcome.values[1], 0.28) << "held";
  EXPECT_EQ(outcome.values[2], found.to[1]);
  EXPECT_TRUE(std::isnan(outcome.values[3])) << "nothing was left out";
  EXPECT_NE(outcome.values[2], 0.1);
}

TEST(Fit, WhatIsLeftOutIsJudgedAndNotFittedTo) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, kFit);
  const Outcome all = *Runner(plan).run(0), without = *Runner(plan).run(2);
  ASSERT_EQ(without.error, "");
  EXPECT_NE(all.values[2], without.values[2]);
  EXPECT_TRUE(std::isfinite(without.values[3]));
  EXPECT_TRUE(std::isfinite(all.values[4]));
  EXPECT_NE(without.values[3], all.values[4]) << "judged by what was fitted to the others";
  EXPECT_TRUE(std::isnan(without.values[4]));
}

TEST(Fit, ItIsEndedWhereNobodyWantsIt) {
  const Scratch scratch;
  EXPECT_FALSE(Runner(plan_of(scratch, kFit)).run(0, [] { return false; }).has_value());
  EXPECT_NE(Runner(plan_of(scratch, "[limits]\nrun_s = 0.001\n" + kFit)).run(0)->error.find("run_s"), std::string::npos);
}

TEST(Fit, RecordingsOfOneFileNameAndTooFewPointsAreRefused) {
  const Scratch scratch;
  fs::create_directory(scratch / "a");
  fs::create_directory(scratch / "b");
  for (const char* name : {"a/x_points.csv", "b/x_points.csv"})
    scratch.write(name, "load_torque_Nm,deflection_rad\n1,0.01\n-1,-0.01\n");
  const auto fit = [](const std::string& recordings) {
    return "[study]\nkind = \"fit\"\ntype = \"sea_hardening_example\"\nparameters = [\"elastic.stiffness_Nm_per_rad\", "
           "\"elastic.hardening_Nm_per_rad3\"]\nrecordings = [" +
           recordings + "]\n[[measure]]\nname = \"cost\"\nvalue = \"cost\"\n";
  };
  const std::string twice = refusal(scratch, fit("\"a/x_points.csv\", \"b/x_points.csv\""), true);
  EXPECT_NE(twice.find("has the file name of another"), std::string::npos) << twice;
  const Plan two_of_two = plan_of(scratch, fit("\"a/x_points.csv\""));
  EXPECT_NE(Runner(two_of_two).run(0)->error.find("more points than parameters"), std::string::npos)
      << Runner(two_of_two).run(0)->error;
}

TEST(Fit, BadOnesAreRefused) {
  const Scratch scratch;
  const auto expect = [&](const std::string& from, const std::string& to, const char* part) {
    std::string text = kFit;
    text.replace(text.find(from), from.size(), to);
    const std::string told = refusal(scratch, text, true);
    EXPECT_NE(told.find(part), std::string::npos) << part << "\n" << told;
  };
  expect("\"drive.friction_Nm\"]", "\"drive.frictions\"]", "drive.frictions");
  expect("\"drive.friction_Nm\" = 0.1", "\"shaft.friction_Nm\" = 0.1", "isn't one of the parameters");
  expect("\"drive.friction_Nm\" = 0.1", "\"drive.friction_Nm\" = -1.0", "study.from.drive.friction_Nm = -1");
  expect("0.6903rad_branches", "0.7rad_branches", "0.7rad_branches");
  expect("\"value.drive.friction_Nm\"", "\"value.friction\"", "the study has no such number");
  expect("left_out_rms_rad.stiffness", "left_out_rms_rad.stifness", "the study has no such number");
  expect("list = [\"none\"", "list = [\"nothing.csv\"", "isn't one of several recordings");
  expect("\"elastic.c1_Nm_per_rad=elastic.c2_Nm_per_rad\", \"drive.friction_Nm\"]",
         "\"elastic.c1_Nm_per_rad=elastic.c2_Nm_per_rad\"]\n#", "isn't one of the parameters");
}

}  // namespace
}  // namespace vsa::sweep::testing
