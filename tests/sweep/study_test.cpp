// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Plans whose runs are studies.
#include <gtest/gtest.h>

#include "plans.hpp"
#include "vsa/study/characterization.hpp"

namespace vsa::sweep::testing {
namespace {

const std::string kStudy = R"(
[study]
kind = "characterize"
type = "qbmove_maker_pro"
experiments = ["speed"]
preset_rad = [0.3]
[[vary]]
key = "set.drive.supply_V"
list = [18, 24]
[[measure]]
name = "speed_rad_per_s"
value = "/speed/0/mean/shaft/mean_speed_rad_per_s"
)";

TEST(Study, ARunIsThatOfTheStudyItself) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, kStudy);
  plan.check();
  Runner runner(plan);
  study::CharacterizationOptions options;
  options.specimen.type = "qbmove_maker_pro";
  options.specimen.overrides = {{"drive.supply_V", "24"}};
  options.experiments = {study::Experiment::speed};
  options.preset = {0.3};
  const auto by_hand = study::run(study::plan_characterization(options));
  EXPECT_EQ(runner.run(1)->values, (std::vector<double>{by_hand->speed[0].mean.shaft.mean_speed}));
  EXPECT_LT(runner.run(0)->values[0], runner.run(1)->values[0]) << "less supply, less speed";
  EXPECT_NE(plan.scenario_text(0).find("18"), std::string::npos);
}

TEST(Study, ItIsEndedWhereNobodyWantsItOrItTakesTooLong) {
  const Scratch scratch;
  const std::string slow = "[limits]\nrun_s = 0.1\n" + kStudy.substr(0, kStudy.find("[[vary]]")) + "period_s = 3600.0\n" +
                           kStudy.substr(kStudy.find("[[vary]]"));
  std::string text = slow;
  text.replace(text.find("\"speed\""), 7, "\"stiffness\"");
  text.replace(text.find("/speed/0"), std::string::npos, "/stiffness/0/loop/area_Nm_rad\"\n");
  const Plan plan = plan_of(scratch, text);
  EXPECT_NE(Runner(plan).run(0)->error.find("run_s"), std::string::npos);
  EXPECT_FALSE(Runner(plan_of(scratch, text.substr(text.find("[study]")))).run(0, [] { return false; }).has_value());
}

TEST(Study, BadOnesAreRefused) {
  const Scratch scratch;
  const auto expect = [&](const std::string& from, const std::string& to, const char* part) {
    std::string text = kStudy;
    text.replace(text.find(from), from.size(), to);
    const std::string told = refusal(scratch, text, true);
    EXPECT_NE(told.find(part), std::string::npos) << part << "\n" << told;
  };
  expect("\"characterize\"", "\"measure\"", "study.kind");
  expect("qbmove_maker_pro", "qbmove_pro", "qbmove_pro");
  expect("\"speed\"", "\"speeds\"", "there is none of that name");
  expect("mean_speed_rad_per_s\"", "speed\"", "the study has no such number");
  expect("set.drive.supply_V", "drive.supply_V", "is no key of a study");
  expect("set.drive.supply_V", "set.drive.supply", "drive.supply");
  expect("[study]", "[scenario]\nworld = \"bench_load\"\n[study]", "this plan has a study");
  expect("preset_rad = [0.3]", "preset = [0.3]", "study.preset");
  expect("/speed/0/mean", "no pointer", "the study has no such number");
}

TEST(Study, AValidationsQuantitiesAreKnownBeforeItRuns) {
  const Scratch scratch;
  const std::string text = "[study]\nkind = \"validate\"\ntype = \"qbmove_maker_pro\"\n[[measure]]\nname = \"rms_rad\"\nvalue = \"";
  plan_of(scratch, text + "stiffness.0.6903.rms_rad\"\n").check();
  EXPECT_NE(refusal(scratch, text + "stiffness.0.7.rms_rad\"\n", true).find("stiffness.0.6903.rms_rad"), std::string::npos);
}

}  // namespace
}  // namespace vsa::sweep::testing
