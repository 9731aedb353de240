// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a validation plans from data/, and what its figures and verdicts are called. The runs themselves: tests/apps/validate_test.cpp.
#include "vsa/study/validation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "vsa/errors.hpp"

namespace vsa::study {
namespace {

TEST(Validation, PlansEveryRecordingAtThreePeriodsAndThePapersSteps) {
  const ValidationPlan plan = plan_validation({});
  ASSERT_GE(plan.recordings.size(), 2u);
  EXPECT_TRUE(std::is_sorted(plan.recordings.begin(), plan.recordings.end(),
                             [](const Recording& a, const Recording& b) { return a.preset < b.preset; }));
  ASSERT_EQ(plan.runs.stiffness.size(), 3 * plan.recordings.size());
  for (std::size_t i = 0; i < plan.recordings.size(); ++i) {
    EXPECT_EQ(plan.runs.stiffness[i].options.preset, plan.recordings[i].preset);
    EXPECT_EQ(plan.runs.stiffness[i].options.period_s, 38) << "the judged ones first";
  }
  EXPECT_EQ(plan.runs.speed.size(), 4u);
  EXPECT_EQ(plan.runs.preset_step.size(), 2u);
  EXPECT_FALSE(plan.bounds.bounds.empty());
  ASSERT_TRUE(plan.left_out);
  EXPECT_EQ(plan.left_out->file, "data/qbmove_maker_pro/leave_one_out.json");
  EXPECT_GT(plan.step_command_s, 0);
}

TEST(Validation, RefusesAnActuatorWhosePresetIsInAnotherUnit) {
  ValidationOptions o;
  o.specimen.type = "sea_example";
  try {
    (void)plan_validation(o);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_GE(error.problems().size(), 2u) << "every recording";
    EXPECT_NE(error.problems()[0].text().find("isn't in the unit of sea_example"), std::string::npos);
  }
}

TEST(Validation, EndsWithoutAResultWhereItsWatcherStopsIt) {
  EXPECT_FALSE(run(plan_validation({}), [](const Progress&) { return false; }));
}

TEST(Validation, NamesItsFiguresByExperimentAndPreset) {
  Validation v;
  RecordingCheck& r = v.recordings.emplace_back();
  r.preset = 0.6903;
  r.torque.both_Nm = 0.05;
  r.our_loop.area_Nm_rad = 0.3;
  r.data_loop.area_Nm_rad = 0.2;
  v.speeds.emplace_back().preset = 0.1125;
  v.speeds[0].pulleys.mean_speed = 4;
  v.preset_steps.emplace_back().loaded = true;
  v.preset_steps[0].up.final_value = 0.7;
  const auto all = quantities(v);
  EXPECT_EQ(all.at("stiffness.0.6903.rms_Nm"), 0.05);
  EXPECT_NEAR(all.at("stiffness.0.6903.loop_area_ratio"), 1.5, 1e-12);
  EXPECT_EQ(all.at("speed.0.1125.mean_pulley_rad_per_s"), 4);
  EXPECT_EQ(all.at("preset_step.loaded.attained_rad"), 0.7);
  EXPECT_EQ(recording_kind(v, r), "not stated") << "without evidence nobody knows";
  v.verdicts.push_back({{"speed.0.1125.mean_pulley_rad_per_s", 5, {}, "why", {}, ""}, 4, false, experiment::Kind::predicted});
  const auto json = nlohmann::json::parse(to_json(v, "test"));
  EXPECT_EQ(json["passed"], false);
  EXPECT_EQ(json["predictions"]["all"], 1);
  EXPECT_EQ(json["bounds"][0]["max"], nullptr);
}

}  // namespace
}  // namespace vsa::study
