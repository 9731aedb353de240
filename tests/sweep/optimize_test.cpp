// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sweep/optimize.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plans.hpp"

namespace vsa::sweep::testing {
namespace {

/// Two searched axes, two worlds and three repetitions for each candidate.
std::string search(const std::string& objectives, const std::string& optimize = "") {
  return "repetitions = 3\n" + kScenario + kMeasure + R"(
[[measure]]
name = "supply_J"
signal = "supply_J"
[[vary]]
key = "set.drive.friction_Nm"
name = "x"
search = [-4.0, 6.0]
[[vary]]
key = "scenario.world"
list = ["bench_load", "bench_free"]
[[vary]]
key = "set.drive.supply_V"
name = "y"
search = [0.01, 100.0]
law = "log_uniform"
[optimize]
)" + optimize +
         objectives;
}
const std::string kOne = "[[objective]]\nmeasure = \"last_rad\"\ngoal = \"minimize\"\n";
const std::string kTwo = kOne + "[[objective]]\nmeasure = \"supply_J\"\ngoal = \"maximize\"\n";

/// A plan's outcomes by a formula, in place of worlds.
template <class F>
Evaluate by(F&& f) {
  return [f](const Plan& plan, std::size_t first) {
    const std::size_t each = plan.runs() / plan.candidates();
    EXPECT_EQ(first % each, 0U);
    std::vector<Outcome> out;
    for (std::size_t run = 0; run < plan.runs(); ++run) {
      const auto v = plan.values(run / plan.repetitions());
      Outcome o;
      o.run = run;
      o.values = f(std::get<double>(v[0]), std::get<double>(v[2]), run);
      if (o.values.empty()) o.error = "failed";
      out.push_back(o);
    }
    return out;
  };
}

std::pair<double, double> at(const Optimum& found, std::size_t candidate) {
  const auto v = found.plan.values(candidate * found.plan.points() / found.plan.candidates());
  return {std::get<double>(v[0]), std::get<double>(v[2])};
}

class Optimizer : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!has_optimizer()) GTEST_SKIP() << "this build has no pagmo";
  }
};

class OneObjective : public Optimizer {};

/// (x − 2)² + (log₁₀ y − 1)²: its minimum, of runs that differ and of which the median counts.
TEST_P(OneObjective, TheMinimumIsFound) {
  const Scratch scratch;
  const std::string options = "algorithm = \"" + std::string(GetParam()) + "\"\npopulation = 40\ngenerations = 60\n";
  const Plan plan = plan_of(scratch, search(kOne, options));
  const auto bowl = by([](double x, double y, std::size_t run) {
    const double outlier = run % 6 == 0 ? 1e6 : 0;
    return std::vector<double>{std::pow(x - 2, 2) + std::pow(std::log10(y) - 1, 2) + outlier, 0};
  });
  const Optimum found = optimize(plan, bowl);
  ASSERT_EQ(found.best.size(), 1U);
  EXPECT_NEAR(at(found, found.best[0]).first, 2, 0.1);
  EXPECT_NEAR(std::log10(at(found, found.best[0]).second), 1, 0.1);
  EXPECT_LE(found.plan.runs(), plan.most_runs());
  const Optimum again = optimize(plan, bowl);
  EXPECT_EQ(again.plan.candidate_list(), found.plan.candidate_list()) << "the same seed, the same search";
  EXPECT_NE(optimize(plan_of(scratch, "seed = 2\n" + search(kOne, options)), bowl).plan.candidate_list(),
            found.plan.candidate_list());
}
INSTANTIATE_TEST_SUITE_P(Optimize, OneObjective, ::testing::Values("pso", "gaco"));

class SeveralObjectives : public Optimizer {};

/// Schaffer's problem, the second turned over: x² and −(x − 2)². None beats another for x in 0 … 2, whatever y is.
TEST_P(SeveralObjectives, TheFrontIsFound) {
  const Scratch scratch;
  const Plan plan =
      plan_of(scratch, search(kTwo, "algorithm = \"" + std::string(GetParam()) + "\"\npopulation = 40\ngenerations = 40\n"));
  const Optimum found = optimize(plan, by([](double x, double, std::size_t) {
                                   return std::vector<double>{x * x, -(x - 2) * (x - 2)};
                                 }));
  ASSERT_GE(found.best.size(), 20U);
  double least = 9, most = -9, last = -1;
  for (const std::size_t c : found.best) {
    const double x = at(found, c).first;
    EXPECT_GE(x, -0.05);
    EXPECT_LE(x, 2.05);
    least = std::min(least, x);
    most = std::max(most, x);
    EXPECT_GE(found.objectives[c][0], last) << "in the order of the first objective";
    last = found.objectives[c][0];
  }
  EXPECT_LT(least, 0.2);
  EXPECT_GT(most, 1.8);
}
INSTANTIATE_TEST_SUITE_P(Optimize, SeveralObjectives, ::testing::Values("nsga2", "nspso", "maco"));

TEST_F(Optimizer, WhatFailsIsNeverTheBest) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, search(kOne, "population = 16\ngenerations = 20\n"));
  const Optimum found = optimize(plan, by([](double x, double, std::size_t) {
                                   return x < 1 ? std::vector<double>{} : std::vector<double>{x, 0};
                                 }));
  ASSERT_EQ(found.best.size(), 1U);
  EXPECT_NEAR(at(found, found.best[0]).first, 1, 0.2);
  EXPECT_TRUE(std::any_of(found.objectives.begin(), found.objectives.end(), [](const auto& o) { return std::isnan(o[0]); }));
  const Optimum none = optimize(plan, by([](double, double, std::size_t) { return std::vector<double>{}; }));
  EXPECT_TRUE(none.best.empty());
  EXPECT_FALSE(report::to_json(optimum_page(none, "")).empty());
}

TEST_F(Optimizer, WhatEvaluatingThrowsComesOut) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, search(kOne));
  int calls = 0;
  const auto inner = by([](double x, double, std::size_t) { return std::vector<double>{x, 0}; });
  const Evaluate ends = [&](const Plan& p, std::size_t first) {
    if (++calls == 3) throw std::runtime_error("the disk is full");
    return inner(p, first);
  };
  EXPECT_THROW(static_cast<void>(optimize(plan, ends)), std::runtime_error);
  EXPECT_EQ(calls, 3);
}

TEST(Objectives, MeanMedianAndWorstOfACandidatesRuns) {
  const Scratch scratch;
  for (const auto& [over, goal, expected] : {std::tuple{"mean", "minimize", 22.0}, std::tuple{"median", "minimize", 3.5},
                                             std::tuple{"worst", "minimize", 117.0}, std::tuple{"worst", "maximize", 1.0}}) {
    const std::string o = std::string("[[objective]]\nmeasure = \"last_rad\"\ngoal = \"") + goal + "\"\nover = \"" + over + "\"\n";
    const Plan plan = plan_of(scratch, search(o)).with({{0, 0}, {1, 1}});
    ASSERT_EQ(plan.runs(), 12U);
    std::vector<Outcome> outcomes(12);
    const double of_second[] = {5, 1, 117, 2, 3, 4};
    for (std::size_t r = 0; r < 12; ++r) outcomes[r].values = {r < 6 ? 0.0 : of_second[r - 6], 0.0};
    EXPECT_EQ(objectives_of(plan, outcomes, 0)[0], 0);
    EXPECT_DOUBLE_EQ(objectives_of(plan, outcomes, 1)[0], expected) << over << goal;
    outcomes[9].values.clear();
    EXPECT_TRUE(std::isnan(objectives_of(plan, outcomes, 1)[0])) << "one run failed";
  }
}

TEST(Objectives, NotBeatenIsNotBeaten) {
  Search s;
  s.objectives = {{Objective::Over::mean, 0, false}, {Objective::Over::mean, 1, true}};
  const double nan = std::nan("");
  EXPECT_EQ(not_beaten({{3, 3}, {1, 1}, {2, 2}, {2, 1}, {1, 1}, {0, nan}, {4, 3}}, s), (std::vector<std::size_t>{1, 2, 0}));
}

TEST(SearchPlan, CandidatesGoFromEndToEnd) {
  const Scratch scratch;
  const Plan plan = plan_of(scratch, search(kOne)).with({{0, 0}, {1, 1}, {0.5, 0.5}});
  EXPECT_EQ(plan.points(), 6U);
  const auto first = plan.values(0), last = plan.values(2), middle = plan.values(5);
  EXPECT_EQ(std::get<double>(first[0]), -4);
  EXPECT_EQ(std::get<double>(first[2]), 0.01);
  EXPECT_EQ(std::get<double>(last[0]), 6);
  EXPECT_EQ(std::get<double>(last[2]), 100);
  EXPECT_DOUBLE_EQ(std::get<double>(middle[0]), 1);
  EXPECT_DOUBLE_EQ(std::get<double>(middle[2]), 1);
  EXPECT_EQ(value_text(middle[1]), "bench_free");
}

TEST(SearchPlan, BadOnesAreRefused) {
  const Scratch scratch;
  const auto told = [&](const std::string& text) { return refusal(scratch, text); };
  const auto expect = [](const std::string& text, const char* part) { EXPECT_NE(text.find(part), std::string::npos) << text; };
  expect(told(search("")), "objective: is missing");
  expect(told(search("[[objective]]\nmeasure = \"speed\"\ngoal = \"minimize\"\n")), "there is none of that name");
  expect(told(search("[[objective]]\nmeasure = \"supply_J\"\n")), "objective.goal: is missing");
  expect(told(search(kOne, "algorithm = \"nsga2\"\n")), "optimize.algorithm");
  expect(told(search(kTwo, "algorithm = \"pso\"\n")), "optimize.algorithm");
  expect(told(search(kOne, "population = 10\n")), "isn't a multiple of 4");
  expect(told(search(kOne, "population = 1000000\ngenerations = 1000000\n")), "runs are more than a plan may have");
  expect(told(kScenario + kMeasure + "[optimize]\npopulation = 8\n"), "nothing is searched");
}

}  // namespace
}  // namespace vsa::sweep::testing
