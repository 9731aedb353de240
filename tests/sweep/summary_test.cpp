// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sweep/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "plans.hpp"

namespace vsa::sweep::testing {
namespace {

TEST(Quartiles, OfWhatIsFinite) {
  const double nan = std::nan("");
  const Quartiles q = quartiles({5, nan, 1, 2, 3, 4, INFINITY});
  EXPECT_EQ(q.count, 5U);
  EXPECT_EQ(q.low, 2);
  EXPECT_EQ(q.median, 3);
  EXPECT_EQ(q.high, 4);
  EXPECT_EQ(quartiles({1, 2}).median, 1.5);
  EXPECT_EQ(quartiles({nan}).count, 0U);
  EXPECT_TRUE(std::isnan(quartiles({}).median));
}

struct Filled {
  Filled() {
    for (std::size_t run = 0; run < plan.runs(); ++run) {
      const auto values = plan.values(run / plan.repetitions());
      const double x = std::get<double>(values[0]), y = std::get<double>(values[1]);
      const double noise = run % 3 == 0 ? -0.01 : run % 3 == 1 ? 0.0 : 0.01;
      results.outcomes.push_back({run, {10 * x + y + noise}, "", "", 0, 0});
    }
    results.outcomes[7].values.clear();
    results.outcomes[7].error = "<b>blown up</b>";
  }
  Scratch scratch;
  Plan plan = plan_of(scratch, "repetitions = 3\n" + kScenario + kMeasure + R"(
[[vary]]
key = "set.drive.friction_Nm"
name = "x"
range = [1.0, 4.0]
count = 4
[[vary]]
key = "set.drive.supply_V"
name = "y"
range = [0.0, 2.0]
count = 3
[[vary]]
key = "scenario.world"
name = "world"
list = ["bench_load", "bench_free"]
)");
  Results results;
};

report::Chart chart(const report::Report& page, const std::string& title) {
  for (const auto& section : page.sections)
    for (const auto& block : section.blocks)
      if (const auto* c = std::get_if<report::Chart>(&block); c != nullptr && c->title == title) return *c;
  throw std::runtime_error("no chart " + title);
}

TEST(Summary, MediansOfEachAxisAreOverAllElse) {
  const Filled f;
  const report::Report page = summary(f.plan, f.results, "vsa sweep");
  const report::Chart by_x = chart(page, "last_rad by x");
  ASSERT_EQ(by_x.curves.size(), 3U);
  EXPECT_EQ(by_x.curves[0].x, (std::vector<double>{1, 2, 3, 4}));
  for (std::size_t i = 1; i < 4; ++i) EXPECT_NEAR(by_x.curves[0].y[i], 10 * by_x.curves[0].x[i] + 1, 1e-9);
  EXPECT_NEAR(by_x.curves[1].y[2], 30.0025, 0.02);
  EXPECT_NEAR(by_x.curves[2].y[2], 31.9975, 0.02);
}

TEST(Summary, AMapHasEveryCellOnceAndItsColoursGrow) {
  const Filled f;
  const report::Chart map = chart(summary(f.plan, f.results, ""), "last_rad");
  std::size_t cells = 0;
  double last = -1e9;
  for (const report::Curve& c : map.curves) {
    double most = last;
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      EXPECT_GE(10 * c.x[i] + c.y[i], last - 0.02);
      most = std::max(most, 10 * c.x[i] + c.y[i]);
      ++cells;
    }
    last = most;
  }
  EXPECT_EQ(cells, 12U);
  EXPECT_EQ(map.curves.size(), 5U);
}

TEST(Summary, ParallelCoordinatesHaveEveryRunThatHasANumber) {
  const Filled f;
  const report::Chart all = chart(summary(f.plan, f.results, ""), "All at once");
  std::size_t lines = 0;
  for (const report::Curve& c : all.curves) {
    for (std::size_t i = 0; i < c.y.size(); ++i) {
      lines += std::isnan(c.y[i]) ? 1 : 0;
      EXPECT_FALSE(c.y[i] < 0 || c.y[i] > 1);
    }
  }
  EXPECT_EQ(lines, f.plan.runs() - 1);
  EXPECT_LT(all.x_label.size(), 60u) << "an axis' label is one line";
  EXPECT_NE(all.caption.find(" 1: "), std::string::npos) << all.caption;
  EXPECT_NE(all.caption.find(" … "), std::string::npos) << all.caption;
}

TEST(Summary, FailuresAndNamesAreTablesAndThePageIsWritten) {
  const Filled f;
  const report::Report page = summary(f.plan, f.results, "");
  EXPECT_NE(report::to_json(page).find("blown up"), std::string::npos);
  EXPECT_EQ(report::to_json(page).find("<b>"), std::string::npos) << "never markup";
  const auto& table = std::get<report::Table>(page.sections[1].blocks[0]);
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0][0], "bench_free");
  EXPECT_EQ(table.rows[0][1], "36");
  // Nothing but failures, and nothing at all.
  Results none;
  EXPECT_FALSE(report::to_json(summary(f.plan, none, "")).empty());
}

}  // namespace
}  // namespace vsa::sweep::testing
