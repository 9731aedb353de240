// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A chart as a picture: drawn where its numbers are, and well-formed whatever a user's file had in its texts.
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <clocale>
#include <stdexcept>

#include "report/samples.hpp"
#include "vsa/report/report.hpp"

namespace vsa::report {
namespace {

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

Chart chart_of(std::vector<double> x, std::vector<double> y, Curve::Style style = Curve::Style::line) {
  Curve c;
  c.name = "curve";
  c.x = std::move(x);
  c.y = std::move(y);
  c.style = style;
  Chart out;
  out.curves = {c};
  return out;
}

std::string attribute(const std::string& svg, const std::string& element, const std::string& name) {
  const std::size_t at = svg.find('<' + element + ' ');
  const std::size_t from = svg.find(name + "=\"", at) + name.size() + 2;
  return at == std::string::npos ? "" : svg.substr(from, svg.find('"', from) - from);
}

void expect_xml(const std::string& svg) {
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(svg.c_str()), tinyxml2::XML_SUCCESS) << svg;
  ASSERT_NE(document.RootElement(), nullptr);
  EXPECT_STREQ(document.RootElement()->Name(), "svg");
}

TEST(Svg, OfEveryStyleIsWellFormedAndHasNoNumberThatIsNone) {
  for (const Section& s : samples::full().sections) {
    for (const Block& b : s.blocks) {
      if (const auto* chart = std::get_if<Chart>(&b)) {
        const std::string svg = to_svg(*chart);
        expect_xml(svg);
        EXPECT_EQ(svg.find("nan"), std::string::npos);
        EXPECT_EQ(svg.find("inf"), std::string::npos);
      }
    }
  }
}

/// The frame is 670 × 340 px from (74, 66); 4 % of the data's span is left free at each end.
TEST(Svg, DrawsEachPointWhereItsNumbersAre) {
  const std::string svg = to_svg(chart_of({0, 1, 2}, {-1, 0, 1}));
  const double margin_x = 670 * 0.04 / 1.08, margin_y = 340 * 0.04 / 1.08;
  const std::string points = attribute(svg, "polyline", "points");
  double x[3], y[3];
  ASSERT_EQ(std::sscanf(points.c_str(), "%lf,%lf %lf,%lf %lf,%lf", x, y, x + 1, y + 1, x + 2, y + 2), 6) << points;
  EXPECT_NEAR(x[0], 74 + margin_x, 0.06);
  EXPECT_NEAR(x[1], 74 + 335, 0.06);
  EXPECT_NEAR(x[2], 744 - margin_x, 0.06);
  EXPECT_NEAR(y[0], 406 - margin_y, 0.06) << "the least is at the bottom";
  EXPECT_NEAR(y[2], 66 + margin_y, 0.06);
  for (const char* mark : {">−0.5<", ">−1.0<", ">1.5<", ">2.0<"}) EXPECT_EQ(times(svg, mark), 1u) << mark << '\n' << svg;
}

TEST(Svg, BreaksACurveAtAGapAndLeavesTheMarkersApart) {
  const std::vector<double> x{0, 1, 2, 3, 4, 5}, y{0, 1, samples::kNaN, 3, 4, 5};
  EXPECT_EQ(times(to_svg(chart_of(x, y)), "<polyline"), 2u);
  const std::string rings = to_svg(chart_of(x, y, Curve::Style::markers));
  EXPECT_EQ(times(rings, "<polyline"), 0u);
  EXPECT_EQ(times(rings, "<circle"), 5u + 1u) << "and one in the legend";
}

TEST(Svg, NamesAGroupOnce) {
  Chart chart = chart_of({0, 1}, {0, 1});
  chart.curves.push_back(chart.curves[0]);
  chart.curves[0].group = chart.curves[1].group = "hardware";
  EXPECT_EQ(times(to_svg(chart), ">hardware<"), 1u);
}

TEST(Svg, SpacesALogarithmicAxisByDecadesAndLeavesOutWhatItCantShow) {
  Chart chart = chart_of({0, 1, 2, 3}, {0.1, 1, 10, -5}, Curve::Style::markers);
  chart.y_log = true;
  const std::string svg = to_svg(chart);
  EXPECT_EQ(times(svg, "<circle"), 3u + 1u);
  for (const char* mark : {">0.1<", ">0.2<", ">5<", ">10<"}) EXPECT_EQ(times(svg, mark), 1u) << mark;
}

TEST(Svg, SpacesTheOtherAxisByDecadesToo) {
  Chart chart = chart_of({0, 0.01, 1, 100}, {1, 2, 3, 4}, Curve::Style::markers);
  chart.x_log = true;
  const std::string svg = to_svg(chart);
  EXPECT_EQ(times(svg, "<circle"), 3u + 1u);
  for (const char* mark : {">0.01<", ">0.1<", ">10<", ">100<"}) EXPECT_EQ(times(svg, mark), 1u) << mark;
  EXPECT_EQ(times(svg, ">0.05<"), 0u) << "only whole decades where there are many";
}

TEST(Svg, TakesTextsAsTextsWhateverTheyHold) {
  Chart chart = chart_of({0, 1}, {0, 1});
  chart.title = "<script>\"a\" & b\x01</script>";
  chart.x_label = chart.y_label = chart.curves[0].name = "<&>";
  const std::string svg = to_svg(chart);
  expect_xml(svg);
  EXPECT_EQ(svg.find("<script"), std::string::npos);
}

TEST(Svg, OfNothingOrOfOneValueIsStillAPicture) {
  expect_xml(to_svg({}));
  expect_xml(to_svg(chart_of({}, {})));
  const std::string flat = to_svg(chart_of({2, 2}, {3, 3}));
  expect_xml(flat);
  EXPECT_EQ(flat.find("nan"), std::string::npos);
  expect_xml(to_svg(chart_of({0, 1}, {0, 0})));
}

TEST(Svg, OfACurveWithLengthsThatDifferIsRefused) {
  EXPECT_THROW((void)to_svg(chart_of({0, 1}, {0})), std::invalid_argument);
  EXPECT_THROW((void)to_svg(chart_of({0, 1}, {0, 1}, Curve::Style::band)), std::invalid_argument);
}

TEST(Svg, NumbersDoNotDependOnTheLocale) {
  Chart chart = chart_of({0.25, 0.5, 0.75}, {0.001, 0.05, 2.5});
  Chart logarithmic = chart;
  logarithmic.y_log = true;
  const std::string svg = to_svg(chart), of_decades = to_svg(logarithmic);
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr && std::setlocale(LC_ALL, "fr_FR.UTF-8") == nullptr)
    GTEST_SKIP() << "this machine has no locale with a comma";
  EXPECT_EQ(to_svg(chart), svg);
  EXPECT_EQ(to_svg(logarithmic), of_decades);
  std::setlocale(LC_ALL, before.c_str());
}

}  // namespace
}  // namespace vsa::report
