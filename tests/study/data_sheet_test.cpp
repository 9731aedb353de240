// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/study/data_sheet.hpp"

#include <gtest/gtest.h>

namespace vsa::study {
namespace {

experiment::Specimen specimen(const std::string& type) {
  experiment::Specimen out;
  out.type = type;
  return out;
}

TEST(DataSheetStudy, PlansThePapersSharesOfThePresetAndOnceWithTheLever) {
  DataSheet sheet = plan_data_sheet(specimen("qbmove_maker_pro"));
  EXPECT_TRUE(sheet.has_preset());
  ASSERT_EQ(sheet.simulated.speed.size(), 4u);
  EXPECT_NEAR(sheet.simulated.speed[1].options.preset, 0.1125, 1e-12);
  ASSERT_EQ(sheet.simulated.preset_step.size(), 2u);
  EXPECT_GT(sheet.computed.columns[0].peak.torque_Nm, 0) << "computed before anything runs";
  sheet.simulated.preset_step[1].run.load_peak_Nm = 1.5;
  EXPECT_EQ(sheet.nominal_load_Nm(), 1.5) << "of the run with the lever";
}

TEST(DataSheetStudy, OfAnActuatorWithoutAPresetIsOneSquareWave) {
  DataSheet plan = plan_data_sheet(specimen("sea_example"));
  EXPECT_FALSE(plan.has_preset());
  EXPECT_FALSE(plan.nominal_load_Nm());
  EXPECT_TRUE(plan.simulated.preset_step.empty());
  ASSERT_EQ(plan.simulated.speed.size(), 1u);
  plan.simulated.speed[0].options.hold_s = 0.1;
  plan.simulated.speed[0].options.steps = 1;
  const auto done = run(std::move(plan));
  ASSERT_TRUE(done);
  EXPECT_FALSE(done->simulated.speed[0].run.samples.empty());
  EXPECT_GT(done->computed.columns[0].no_load_speed_rad_per_s, 0) << "what was computed stays";
}

TEST(DataSheetStudy, EndsWithoutAResultWhereItsWatcherStopsIt) {
  EXPECT_FALSE(run(plan_data_sheet(specimen("qbmove_maker_pro")), [](const Progress&) { return false; }));
}

}  // namespace
}  // namespace vsa::study
