// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a characterization plans and refuses, how it is watched and stopped, and what it tells.
#include "vsa/study/characterization.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "vsa/errors.hpp"

namespace vsa::study {
namespace {

CharacterizationOptions of(const std::string& preset, std::vector<Experiment> experiments = {}) {
  CharacterizationOptions o;
  o.specimen.type = preset;
  o.experiments = std::move(experiments);
  return o;
}

/// Two edges of 0.2 s at two presets: a tenth of a second's work.
Characterization short_plan() {
  Characterization plan = plan_characterization(of("qbmove_maker_pro", {Experiment::speed}));
  plan.speed.resize(2);
  for (SpeedResult& r : plan.speed) {
    r.options.hold_s = 0.2;
    r.options.steps = 2;
  }
  return plan;
}

/// Minutes of work.
Characterization endless_plan() {
  CharacterizationOptions o = of("qbmove_maker_pro", {Experiment::stiffness});
  o.cycles = 1000;
  return plan_characterization(o);
}

std::vector<std::string> problems_of(const CharacterizationOptions& o) {
  std::vector<std::string> out;
  try {
    (void)plan_characterization(o);
  } catch (const InputError& error) {
    for (const Problem& p : error.problems()) out.push_back(p.key + " " + p.value);
  }
  return out;
}

TEST(Characterization, PlansThePapersRunsUnlessToldOthers) {
  const Characterization plan = plan_characterization(of("qbmove_maker_pro"));
  ASSERT_EQ(plan.stiffness.size(), 3u);
  EXPECT_EQ(plan.stiffness[1].options.preset, 0.4602);
  EXPECT_EQ(plan.stiffness[1].options.period_s, 38);
  ASSERT_EQ(plan.speed.size(), 4u);
  EXPECT_EQ(plan.speed[3].options.preset, 0.75);
  ASSERT_EQ(plan.preset_step.size(), 2u);
  EXPECT_FALSE(plan.preset_step[0].options.loaded);
  EXPECT_TRUE(plan.preset_step[1].options.loaded);
  CharacterizationOptions o = of("qbmove_maker_pro", {Experiment::stiffness, Experiment::preset_step});
  o.preset = {0.1, 0.3};
  o.period_s = 6;
  const Characterization other = plan_characterization(o);
  EXPECT_EQ(other.stiffness.size(), 2u);
  EXPECT_EQ(other.stiffness[0].options.period_s, 6);
  EXPECT_TRUE(other.speed.empty());
  EXPECT_EQ(other.preset_step[0].options.preset, 0.3) << "the largest";
}

TEST(Characterization, AnActuatorWithoutAPresetHasOneSweepOneSquareWaveAndNoPresetStep) {
  const Characterization plan = plan_characterization(of("sea_example"));
  EXPECT_EQ(plan.stiffness.size(), 1u);
  EXPECT_EQ(plan.speed.size(), 1u);
  EXPECT_TRUE(plan.preset_step.empty());
  EXPECT_EQ(csv_name(plan, plan.speed[0]), "speed.csv");
}

TEST(Characterization, TellsAllThatIsWrongWithItsOptionsAtOnce) {
  CharacterizationOptions o = of("qbmove_maker_pro", {Experiment::speed});
  o.preset = {9, 0.1, 0.1};
  o.period_s = 0.5;
  EXPECT_EQ(problems_of(o), (std::vector<std::string>{"--preset-rad 9", "--preset-rad 0.1", "--period-s ", "--period-s 0.5"}));
  EXPECT_EQ(problems_of(of("sea_example", {Experiment::preset_step})), std::vector<std::string>{"--experiment preset-step"});
}

TEST(Characterization, TellsHowFarItIsAndGivesTheSameOnOneThreadAndOnThree) {
  std::vector<Progress> told;
  const auto one = run(
      short_plan(),
      [&](const Progress& p) {
        told.push_back(p);
        return true;
      },
      1);
  ASSERT_FALSE(told.empty());
  EXPECT_NEAR(told.front().total_s, 2 * experiment::simulated_s(short_plan().speed[0].options), 1e-12);
  EXPECT_GT(told.front().total_s, 0.8);
  for (std::size_t i = 1; i < told.size(); ++i) {
    EXPECT_GE(told[i].simulated_s, told[i - 1].simulated_s);
    EXPECT_GT(told[i].wall_s, told[i - 1].wall_s);
  }
  const auto three = run(short_plan(), {}, 3);
  ASSERT_TRUE(one && three);
  EXPECT_EQ(to_json(*one, "test"), to_json(*three, "test"));
  EXPECT_EQ(csv_text(one->speed[1].run), csv_text(three->speed[1].run));
}

TEST(Characterization, EndsWithoutAResultWhereItsWatcherStopsIt) {
  EXPECT_FALSE(run(endless_plan(), [](const Progress&) { return false; }));
  int calls = 0;
  EXPECT_FALSE(run(endless_plan(), [&](const Progress& p) { return ++calls < 3 || p.simulated_s == 0; })) << "in the middle, too";
}

TEST(Characterization, WhatItsWatcherThrowsStopsTheRunsAndComesOut) {
  EXPECT_THROW((void)run(endless_plan(), [](const Progress&) -> bool { throw std::runtime_error("enough"); }), std::runtime_error);
}

TEST(Characterization, ItsResultsNameTheProgramTheCommandAndTheFiles) {
  const auto done = run(short_plan());
  ASSERT_TRUE(done);
  const auto json = nlohmann::json::parse(to_json(*done, "my own program"));
  EXPECT_EQ(json["command"], "my own program");
  EXPECT_EQ(json["program"].get<std::string>().rfind("vsa ", 0), 0u);
  ASSERT_EQ(json["speed"].size(), 2u);
  EXPECT_EQ(json["speed"][1]["file"], csv_name(*done, done->speed[1]));
  EXPECT_EQ(json["speed"][1]["edges"].size(), 2u);
  EXPECT_NEAR(json["speed"][0]["mean"]["shaft"]["mean_speed_rad_per_s"].get<double>(), done->speed[0].mean.shaft.mean_speed, 1e-12);
  const std::string csv = csv_text(done->speed[0].run);
  EXPECT_EQ(csv.rfind("time_s,load_torque_Nm,deflection_rad,", 0), 0u) << csv.substr(0, 100);
}

/// Motors that wind their springs to no preset leave nothing to step.
TEST(Characterization, WithNothingToDoItIsRefused) {
  CharacterizationOptions o = of("fsj_example", {Experiment::preset_step});
  o.specimen.overrides = {{"drive.friction_Nm", "9"}};
  try {
    static_cast<void>(plan_characterization(o));
    FAIL() << "planned nothing";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("wind its springs to no preset"), std::string::npos) << error.what();
  }
}

/// The benches' pinion is none that anybody asked for.
TEST(Characterization, OfALinearActuatorTellsTheOverridesThatWereGiven) {
  CharacterizationOptions o = of("linear_sea_example", {Experiment::speed});
  o.specimen.overrides = {{"drive.friction_Nm", "0.02"}};
  Characterization c = plan_characterization(o);
  c.speed.resize(1);
  c.speed[0].options.hold_s = 0.2;
  c.speed[0].options.steps = 2;
  const auto done = run(c);
  ASSERT_TRUE(done);
  const auto told = nlohmann::json::parse(to_json(*done, "vsa")).at("actuator").at("overrides");
  EXPECT_EQ(told.size(), 1U) << told;
  EXPECT_TRUE(told.contains("drive.friction_Nm")) << told;
}

}  // namespace
}  // namespace vsa::study
