// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The search of the whole box on a surrogate, and the starts that it gives.
#include "vsa/identify/global_search.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "closed_form.hpp"
#include "vsa/experiment/bench.hpp"
#include "vsa/identify/bench_model.hpp"
#include "vsa/identify/fit.hpp"
#include "vsa/units.hpp"

namespace vsa::identify {
namespace {

constexpr double kBarrier = 0.4, kWell = 0.8;

/// Branches of height f(x) with two wells: at 0.2 one that is shallow, at kWell the lowest point. The second parameter does
/// nothing.
double height(double x) { return std::min(0.3 + 4 * (x - 0.2) * (x - 0.2), 10 * (x - kWell) * (x - kWell)); }

Task two_wells(double start) {
  Task task;
  task.parameters = {{"x", {}, "1", start, 0.0, 1.0}, {"y", {}, "1", 0.7, 0.0, 1.0}};
  experiment::Branches zero = test::closed_form(test::kTruth, 0);
  for (auto* branch : {&zero.rising_rad, &zero.falling_rad}) std::fill(branch->begin(), branch->end(), 0.0);
  task.observations = {{"wells", 0, zero, 1}};
  task.model = [zero](const std::vector<double>& v, std::size_t) {
    experiment::Branches b = zero;
    for (auto* branch : {&b.rising_rad, &b.falling_rad}) std::fill(branch->begin(), branch->end(), height(v[0]));
    return b;
  };
  task.surrogate = task.model;
  return task;
}

TEST(GlobalSearch, FindsTheLowestWellFromBesideTheOtherAndLeavesWhatItCantSee) {
  const Task task = two_wells(0.2);
  const GlobalSearch found = search_globally(task, {});
  ASSERT_FALSE(found.points.empty());
  EXPECT_NEAR(found.points[0].values[0], kWell, 0.01);
  EXPECT_EQ(found.points[0].values[1], 0.7);
  EXPECT_EQ(found.unseen, std::vector<std::size_t>{1});
}

TEST(GlobalSearch, GivesStartsThatLocalSolutionsGoOnFrom) {
  Task task = two_wells(0.23);
  // What the true model has and the surrogate hasn't: the well lies a little beside.
  task.model = [model = task.model](const std::vector<double>& v, std::size_t o) { return model({v[0] - 0.03, v[1]}, o); };
  const Residuals residuals(task, 1);
  FitOptions o;
  o.starts = 2;
  o.tolerance = 1e-9;
  std::string told;
  o.progress = [&](const std::string& text) { told += text + '\n'; };
  EXPECT_NEAR(fit(residuals, o).values[0], kWell + 0.03, 0.01);
  EXPECT_NE(told.find("global search: 1 place"), std::string::npos) << told;
  o.starts = 1;
  EXPECT_LT(fit(residuals, o).values[0], kBarrier) << "one start alone stays where it is";
}

/// Seven parameters, in each of them a shallow well at every tenth and the lowest point at kWell: a new best is often a little
/// better than the one before, long before the place is found.
Task rippled() {
  Task task = two_wells(0.2);
  task.parameters.assign(7, {"x", {}, "1", 0.15, 0.0, 1.0});
  const experiment::Branches zero = task.observations[0].data;
  task.model = task.surrogate = [zero](const std::vector<double>& v, std::size_t) {
    double height = 0;
    for (const double x : v) height += 10 * (x - kWell) * (x - kWell) + 0.07 * (1 - std::cos(20 * kPi * (x - kWell)));
    experiment::Branches b = zero;
    for (auto* branch : {&b.rising_rad, &b.falling_rad}) std::fill(branch->begin(), branch->end(), height);
    return b;
  };
  return task;
}

TEST(GlobalSearch, GoesOnWhereANewBestIsOnlyALittleBetterThanTheOneBefore) {
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    GlobalOptions o;
    o.searches = 1;
    o.seed = seed;
    const GlobalSearch found = search_globally(rippled(), o);
    ASSERT_FALSE(found.points.empty());
    for (const double x : found.points[0].values) EXPECT_NEAR(x, kWell, 0.03) << "seed " << seed;
  }
}

TEST(Fit, GoesDownTheSurrogateBeforeItPaysForASimulationsSlopes) {
  // The surrogate is the truth with other zeros: how far they are apart is the same everywhere, so it leads all the way.
  const std::vector<double> presets{0.0, 0.45, 0.69};
  Task task = test::task_of(
      parse_parameters(test::kFour, test::paper_type()), presets,
      {test::closed_form(test::kTruth, 0.0), test::closed_form(test::kTruth, 0.45), test::closed_form(test::kTruth, 0.69)});
  task.parameters[0].start = 0.9;
  task.parameters[1].start = 0.5;
  std::atomic<int> simulations{0};
  const Model truth = task.model;
  task.model = [truth, &simulations](const std::vector<double>& v, std::size_t o) {
    ++simulations;
    return truth(v, o);
  };
  const auto simulations_of = [&](bool with_surrogate) {
    task.surrogate = nullptr;
    if (with_surrogate) {
      task.surrogate = [truth](const std::vector<double>& v, std::size_t o) {
        std::vector<double> other = v;
        other[3] += 0.01;
        return truth(other, o);
      };
    }
    simulations = 0;
    FitOptions o;
    o.starts = 1;
    const Fit found = fit(Residuals(task, 1), o);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(found.values[k], test::kTruth[k], 2e-3 * test::kTruth[k]) << k;
    return simulations.load();
  };
  const int alone = simulations_of(false), led = simulations_of(true);
  EXPECT_LT(led, 0.9 * alone);
}

TEST(GlobalSearch, SaysWhyThereIsNone) {
  Task task = two_wells(0.2);
  task.surrogate = nullptr;
  task.no_surrogate = "nobody made one";
  std::string told;
  FitOptions o;
  o.starts = 2;
  o.progress = [&](const std::string& text) { told += text + '\n'; };
  (void)fit(Residuals(task, 1), o);
  EXPECT_NE(told.find("no global search: nobody made one"), std::string::npos) << told;
}

/// A task on the bench's surrogate, with recordings that the surrogate itself made.
Task bench_task(const std::vector<double>& truth) {
  experiment::Specimen unit;
  unit.type = "qbmove_maker_pro_6_1";
  unit.library = test::shipped();
  Task task;
  task.parameters = parse_parameters(
      "elastic.k1_Nm=elastic.k2_Nm,elastic.a1_per_rad=elastic.a2_per_rad,tendon.friction,drive.viscous_Nms_per_rad",
      test::shipped().load(unit.type));
  for (const double preset : {0.0, 0.5})
    task.observations.push_back({"made", preset, test::closed_form(test::kTruth, preset), 1000});
  use_bench(task, unit, {});
  for (std::size_t o = 0; o < task.observations.size(); ++o) {
    const experiment::Branches made = task.surrogate(truth, o);
    task.observations[o].data = made;
  }
  return task;
}

TEST(GlobalSearch, FindsAUnitsParametersFromFarAwayWithAnyNumberOfThreads) {
  const std::vector<double> truth{0.003, 9.5, 0.22, 0.01};
  Task task = bench_task(truth);
  task.parameters[0].start = 0.5;
  task.parameters[1].start = 2;
  task.parameters[2].start = 0.8;
  GlobalOptions o;
  o.threads = 1;
  o.evaluations_per_parameter = 120;
  const GlobalSearch one = search_globally(task, o);
  o.threads = 2;
  const GlobalSearch two = search_globally(task, o);
  ASSERT_FALSE(one.points.empty());
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(one.points[0].values[k], truth[k], 0.05 * truth[k]) << k;
  EXPECT_EQ(one.unseen, std::vector<std::size_t>{3}) << "nothing static depends on viscous friction";
  ASSERT_EQ(one.points.size(), two.points.size());
  for (std::size_t i = 0; i < one.points.size(); ++i) EXPECT_EQ(one.points[i].values, two.points[i].values);
}

TEST(GlobalSearch, EndsWhenItsWatchIsStopped) {
  experiment::Specimen unit;
  unit.type = "qbmove_maker_pro_6_1";
  unit.library = test::shipped();
  Task task;
  task.parameters = parse_parameters("tendon.friction", test::shipped().load(unit.type));
  task.observations.push_back({"made", 0, test::closed_form(test::kTruth, 0), 1});
  experiment::Watch watch;
  use_bench(task, unit, {}, &watch);
  watch.stop = true;
  EXPECT_THROW((void)search_globally(task, {}), experiment::Stopped);
}

}  // namespace
}  // namespace vsa::identify
