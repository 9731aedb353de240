// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Every shipped type on the benches, whatever its law, its preset's unit and its strength.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "vsa/elastic/inverse.hpp"
#include "vsa/experiment/workspace.hpp"
#include "vsa/study/characterization.hpp"
#include "vsa/study/data_sheet.hpp"
#include "vsa/units.hpp"

namespace vsa::study {
namespace {

experiment::Specimen specimen(const std::string& type) {
  experiment::Specimen out;
  out.type = type;
  out.library = config::TypeLibrary({std::filesystem::path(VSA_SOURCE_DIR) / "actuators"});
  return out;
}

class EveryType : public testing::TestWithParam<std::string> {};

TEST_P(EveryType, GivesWayUnderTheBenchsLoadAsItsLawSays) {
  CharacterizationOptions options;
  options.specimen = specimen(GetParam());
  options.experiments = {Experiment::stiffness};
  options.period_s = 8;
  options.cycles = 1;
  const Characterization c = run(plan_characterization(options)).value();
  const device::UnitConfig& unit = c.actuator.unit;
  const elastic::Transmission& law = *unit.actuator.transmission;
  // Two counts, and what the shaft goes on while the motors' words are half a step old.
  const double count_rad = 2 * kPi / std::pow(2.0, unit.actuator.side[0].encoder.bits);
  const double off_rad =
      2 * count_rad / c.load_scale + 0.5e-3 * c.stiffness.front().run.amplitude_rad * 2 * kPi / *options.period_s;
  EXPECT_TRUE(c.fit.carries);
  for (const StiffnessResult& r : c.stiffness) {
    // While the load swings, so does the preset: motors give way.
    const auto law_Nm = [&](double preset, double rad) {
      const auto x = law.references({0.0, std::max(0.0, preset)});
      return -law.evaluate({law.attained(x).equilibrium + rad, x}).torque;
    };
    const double most = r.deflection_rad.most;
    EXPECT_GT(r.load_Nm.most, 0.75 * law_Nm(r.preset.least, most - off_rad)) << "preset " << r.options.preset;
    EXPECT_LT(r.load_Nm.most, 1.25 * law_Nm(r.preset.most, most + off_rad)) << "preset " << r.options.preset;
    EXPECT_GT(r.load_Nm.most, 0.9 * r.run.load_peak_Nm) << "the lever came up";
  }
}

TEST_P(EveryType, HasADataSheetWhoseNumbersFitTogether) {
  const DataSheet sheet = plan_data_sheet(specimen(GetParam()));
  const experiment::DataSheet& s = sheet.computed;
  const elastic::Transmission& law = *s.type.unit.actuator.transmission;
  EXPECT_EQ(sheet.has_preset(), !law.preset_unit().empty());
  EXPECT_EQ(sheet.simulated.preset_step.size(), sheet.has_preset() ? 2u : 0u);
  for (const experiment::PresetColumn& c : s.columns) {
    const auto x = law.references({0, c.preset});
    const auto rest = law.evaluate({elastic::rest_under(law, x).value(), x});
    EXPECT_NEAR(rest.torque, 0, 1e-12);
    EXPECT_NEAR(c.stiffness_at_rest_Nm_per_rad, rest.curvature.qq, 1e-9);
    EXPECT_NEAR(c.energy_at_rest_J, rest.energy, 1e-12);
    EXPECT_GT(c.peak.torque_Nm, 0);
    EXPECT_GT(c.back.peak.torque_Nm, 0);
    EXPECT_GE(c.holding.torque_Nm, c.peak.torque_Nm) << "friction helps to hold";
    EXPECT_GT(c.no_load_speed_rad_per_s, 0);
    EXPECT_GE(c.stiffness_at_half_Nm_per_rad, 0);
    EXPECT_GE(c.held_at_half.power_W, 0) << "what is moved can be held";
    EXPECT_GE(c.held_at_rest.power_W, 0);
    EXPECT_LE(c.energy_at_rest_J, s.most_energy_J);
  }
  EXPECT_GE(s.stiffest_Nm_per_rad, s.columns.front().stiffness_at_rest_Nm_per_rad);
}

std::string named(const testing::TestParamInfo<std::string>& info) { return info.param; }
INSTANTIATE_TEST_SUITE_P(Shipped, EveryType,
                         testing::ValuesIn(config::TypeLibrary({std::filesystem::path(VSA_SOURCE_DIR) / "actuators"}).names()),
                         named);

TEST(BenchFit, GivesTheCableOfAMaccepaALighterLeverSinceNoPresetCarriesTheShippedOne) {
  CharacterizationOptions options;
  options.specimen = specimen("maccepa_example");
  const Characterization plan = plan_characterization(options);
  EXPECT_EQ(plan.fit.load_share, 0.1);
  EXPECT_EQ(plan.stiffness.front().options.load_share, 0.1);
  const double load = experiment::bench_load_peak_Nm(options.specimen);
  EXPECT_GT(experiment::Workspace(plan.actuator.unit).reach(plan.fit.full, 0).torque_Nm, 2 * plan.fit.load_share * load);
}

TEST(BenchFit, TakesTheMassThatItIsGiven) {
  for (const char* type : {"sea_example", "qbmove_maker_pro"}) {
    CharacterizationOptions options;
    options.specimen = specimen(type);
    options.experiments = {Experiment::stiffness};
    options.load_kg = 0.5;
    options.period_s = 6;
    options.cycles = 1;
    const Characterization c = run(plan_characterization(options)).value();
    EXPECT_NEAR(c.stiffness.front().run.load_peak_Nm, 0.5 * experiment::bench_load_peak_Nm(options.specimen), 1e-9);
    EXPECT_NEAR(c.stiffness.front().load_Nm.most, c.stiffness.front().run.load_peak_Nm, 0.02);
  }
}

TEST(BenchFit, BeginsAtTheFirstPresetThatCarriesTheLever) {
  CharacterizationOptions options;
  options.specimen = specimen("maccepa_example");
  options.specimen.overrides = {{"elastic.spring_N_per_m", "1300"}};
  const Characterization plan = plan_characterization(options);
  ASSERT_GT(plan.fit.softest, 0);
  EXPECT_EQ(plan.fit.load_share, 1);
  EXPECT_EQ(plan.stiffness.front().options.preset, plan.fit.softest);
  ASSERT_EQ(plan.preset_step.size(), 2u);
  EXPECT_EQ(plan.preset_step[0].options.from, 0);
  EXPECT_EQ(plan.preset_step[1].options.from, plan.fit.softest);
  const double load = experiment::bench_load_peak_Nm(options.specimen);
  const experiment::Workspace workspace(plan.actuator.unit);
  const auto gives_way_rad = [&](double preset) {
    return experiment::law_deflection(*plan.actuator.unit.actuator.transmission, preset, load);
  };
  EXPECT_GE(workspace.reach(plan.fit.softest, 0).torque_Nm, 1.1 * load);
  EXPECT_LT(gives_way_rad(plan.fit.softest), kPi / 2);
  EXPECT_GE(gives_way_rad(plan.fit.softest - plan.fit.full / 100), kPi / 2);
}

TEST(BenchFit, LeavesThePapersActuatorsWithThePapersBench) {
  for (const char* type : {"qbmove_maker_pro", "qbmove_maker_pro_6_1", "qbmove_advanced"}) {
    CharacterizationOptions options;
    options.specimen = specimen(type);
    const Characterization plan = plan_characterization(options);
    EXPECT_EQ(plan.fit.load_share, 1) << type;
    ASSERT_EQ(plan.stiffness.size(), 3u);
    EXPECT_EQ(plan.stiffness[1].options.preset, 0.4602);
    EXPECT_EQ(plan.stiffness[2].options.preset, 0.6903);
    EXPECT_EQ(plan.preset_step.at(1).options.preset, 0.75);
  }
}

}  // namespace
}  // namespace vsa::study
