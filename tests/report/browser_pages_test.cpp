// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Writes the pages that the browser test (tests/scripts/report.test.mjs) opens.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "report/samples.hpp"
#include "vsa/report/report.hpp"

namespace vsa::report {
namespace {

namespace fs = std::filesystem;

fs::path written(const Report& report, const std::string& name) {
  const fs::path directory = fs::path(VSA_BINARY_DIR) / "tests" / "pages" / name;
  fs::create_directories(directory);
  write_report(report, directory / "report.html");
  return directory / "report.html";
}

TEST(ReportPages, AReportIsOneFileThatHoldsItsData) {
  const fs::path page = written(samples::full(), "report");
  std::ifstream in(page, std::ios::binary);
  const std::string html(std::istreambuf_iterator<char>(in), {});
  EXPECT_NE(html.find(to_json(samples::full())), std::string::npos);
  EXPECT_EQ(html.find("@VSA_PAGE_DATA@"), std::string::npos);
  EXPECT_LT(html.size(), 2'000'000U) << "without three.js";
}

TEST(ReportPages, DataSheetsShortAndLong) {
  EXPECT_TRUE(fs::exists(written(samples::sheet(6), "sheet_short")));
  EXPECT_TRUE(fs::exists(written(samples::sheet(22), "sheet")));
  EXPECT_TRUE(fs::exists(written(samples::sheet(60), "sheet_long")));
}

TEST(ReportPages, TextsOfAUserArentMarkup) {
  const std::string evil = "</script><img src=x onerror=\"window.hacked=1\"><a href=\"https://example.org\">b</a>";
  Report r = samples::full();
  Chart& chart = std::get<Chart>(r.sections[1].blocks[0]);
  r.title = r.subtitle = r.footer = r.sections[0].title = chart.title = chart.x_label = chart.y_label = chart.caption = evil;
  chart.curves[0].name = chart.curves[0].group = evil;
  r.sections[0].blocks = {Text{evil}, Table{evil, {evil, evil}, {{evil, evil}}, evil}, Figures{{{evil, evil, evil}}}};
  EXPECT_TRUE(fs::exists(written(r, "report_hostile")));
}

TEST(ReportPages, AGalleryThatLeadsToOtherPages) {
  EXPECT_TRUE(fs::exists(written(samples::gallery(), "gallery")));
  EXPECT_TRUE(fs::exists(written(samples::gallery("<img src=x onerror=\"window.hacked=1\">"), "gallery_hostile")));
}

TEST(ReportPages, ReportsThatHaveNothingToShow) {
  Report r;
  Curve empty;
  Curve gaps;
  gaps.style = Curve::Style::band;
  gaps.x = gaps.y = gaps.error = {samples::kNaN, samples::kNaN};
  r.sections = {{"", {}},
                {"nothing", {Text{}, Table{}, Figures{}, Bars{}, Cards{}, Chart{}, Chart{"", "", "", {empty, gaps}, "", true}}}};
  EXPECT_TRUE(fs::exists(written(r, "report_empty")));
}

}  // namespace
}  // namespace vsa::report
