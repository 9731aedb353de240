// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "report/samples.hpp"
#include "vsa/report/report.hpp"

namespace vsa::report {
namespace {

Report with(Block block) {
  Report r;
  r.sections = {{"s", {std::move(block)}}};
  return r;
}

void expect_holds(const std::string& json, const std::string& part) {
  EXPECT_NE(json.find(part), std::string::npos) << part << "\nisn't in\n" << json;
}

TEST(ReportJson, OfAnEmptyReportIsComplete) {
  EXPECT_EQ(to_json({}), R"({"format":1,"title":"","subtitle":"","footer":"","one_page":false,"sections":[]})");
}

TEST(ReportJson, HoldsEveryKindOfBlock) {
  expect_holds(to_json(with(Text{"a paragraph"})), R"({"kind":"text","text":"a paragraph"})");
  expect_holds(to_json(with(Table{"t", {"a", "b"}, {{"1", "2"}, {}}, "c"})),
               R"({"kind":"table","title":"t","head":["a","b"],"rows":[["1","2"],[]],"caption":"c"})");
  expect_holds(
      to_json(with(Figures{{{"l", "v", "n", Figure::Verdict::bad}, {"m", "w", "", Figure::Verdict::good}, {}}})),
      R"("figures":[{"label":"l","value":"v","note":"n","verdict":"bad"},{"label":"m","value":"w","note":"","verdict":"good"},)"
      R"({"label":"","value":"","note":"","verdict":"none"}])");
  const std::string chart = to_json(with(Chart{"t", "x [rad]", "y [N·m]", {}, "c", true}));
  expect_holds(chart,
               R"({"kind":"chart","title":"t","x_label":"x [rad]","y_label":"y [N·m]","y_log":true,"x_log":false,"caption":"c",)");
  expect_holds(chart, R"("curves":[])");
}

TEST(ReportJson, HasLinksAndRangesWhereTheyAre) {
  const std::string json = to_json(samples::gallery("two"));
  expect_holds(json, R"("links":[["two","comparison.html"]])");
  expect_holds(json, R"("links":["one \u0026 only.html",""])");
  expect_holds(json, R"("x_range":[1.0,100.0],"y_range":[0.0,5.0])");
  expect_holds(json, R"({"label":"none","value":null,"text":"–","note":"","link":""})");
  expect_holds(json, R"("x":[0.02,0.2,2],"low":[0.5,0.6,4],"high":[30,31,60],"figures":[["torque","2 N·m"]])");
  Cards cards;
  cards.cards = {{"c", "", "", "", {1, 2}, {1}, {1, 2}, {}}};
  EXPECT_THROW((void)to_json(with(cards)), std::invalid_argument);
}

TEST(ReportJson, NamesEveryStyleOfCurve) {
  const std::string json = to_json(samples::full());
  for (const char* style : {"line", "dashed", "dotted", "markers", "band"})
    expect_holds(json, std::string(R"("style":")") + style + '"');
  expect_holds(json, R"({"name":"scatter","group":"hardware","style":"band","color":0,)");
}

TEST(ReportJson, MakesAGapOfWhatIsNoNumber) {
  Curve c;
  c.x = {0, 0.1, -2e-7};
  c.y = {samples::kNaN, 1e300, -std::numeric_limits<double>::infinity()};
  c.error = {0.5, samples::kNaN, 1.0 / 3};
  Chart chart;
  chart.curves = {c};
  expect_holds(to_json(with(chart)), R"("x":[0,0.1,-2e-07],"y":[null,1e+300,null],"error":[0.5,null,0.333333])");
}

TEST(ReportJson, KeepsHostileTextInsideItsStrings) {
  const std::string evil = "</script><img src=x onerror=\"alert(1)\">\n\\ \xff";
  const std::string safe = R"(\u003c/script\u003e\u003cimg src=x onerror=\"alert(1)\"\u003e\n\\ )"
                           "\uFFFD";
  Curve curve;
  curve.name = curve.group = evil;
  Report r;
  r.title = r.subtitle = r.footer = evil;
  r.sections = {{evil,
                 {Text{evil}, Table{evil, {evil}, {{evil}}, evil}, Chart{evil, evil, evil, {curve}, evil, false},
                  Figures{{{evil, evil, evil}}}}}};
  const std::string json = to_json(r);
  EXPECT_EQ(json.find('<'), std::string::npos);
  std::size_t found = 0;
  for (std::size_t at = json.find(safe); at != std::string::npos; at = json.find(safe, at + 1)) ++found;
  EXPECT_EQ(found, 18U) << "every text of the report, once";
}

TEST(ReportJson, RefusesCurvesWhosePartsDiffInLength) {
  const auto refused = [](std::vector<double> x, std::vector<double> y, std::vector<double> error, Curve::Style style) {
    Curve c;
    c.name = "slope";
    c.x = std::move(x);
    c.y = std::move(y);
    c.error = std::move(error);
    c.style = style;
    Chart chart;
    chart.curves = {c};
    try {
      (void)to_json(with(chart));
    } catch (const std::invalid_argument& e) {
      return std::string(e.what()).find("\"slope\"") != std::string::npos;
    }
    return false;
  };
  EXPECT_TRUE(refused({1, 2}, {1}, {}, Curve::Style::line));
  EXPECT_TRUE(refused({1, 2}, {1, 2}, {1}, Curve::Style::markers));
  EXPECT_TRUE(refused({1, 2}, {1, 2}, {}, Curve::Style::band)) << "a band without its half width";
  EXPECT_FALSE(refused({1, 2}, {1, 2}, {}, Curve::Style::line));
  EXPECT_FALSE(refused({}, {}, {}, Curve::Style::band)) << "nothing to draw is no mistake";
}

}  // namespace
}  // namespace vsa::report
