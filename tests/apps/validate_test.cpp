// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// `vsa validate` as its users run it, on the shipped recordings and preset.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "subprocess.hpp"

namespace {

using vsa::test::read_file;
using vsa::test::run_vsa;
using vsa::test::Scratch;
using vsa::test::write_file;

constexpr const char* kBegin = "<!-- vsa validate: tables -->";
constexpr const char* kEnd = "<!-- vsa validate: end of tables -->";

/// Titles and heads of the tables between the markers: their form without their numbers.
std::vector<std::string> form(const std::string& text) {
  const std::size_t begin = text.find(kBegin), end = text.find(kEnd);
  EXPECT_NE(begin, std::string::npos);
  EXPECT_NE(end, std::string::npos);
  if (begin == std::string::npos || end == std::string::npos) return {};
  std::istringstream lines(text.substr(begin, end - begin));
  std::vector<std::string> out;
  std::string line, before;
  for (; std::getline(lines, line); before = line) {
    if (line.rfind("**", 0) == 0) out.push_back(line);
    if (line.rfind("|---", 0) == 0) out.push_back(before);
  }
  return out;
}

TEST(Validate, HoldsTheStatedBoundsAndWritesTheDocumentsTables) {
  const Scratch scratch;
  const auto r = run_vsa({"validate", "--out", (scratch / "out").string(), "--markdown", (scratch / "v.md").string()});
  EXPECT_EQ(r.exit_code, 0) << r.out << r.err;
  const std::string json = read_file(scratch / "out" / "results.json");
  for (const char* part : {"\"passed\": true", "stiffness.0.0000.rms_rad", "stiffness.0.6903.loop_area_ratio",
                           "speed.0.1125.mean_pulley_rad_per_s", "preset_step.loaded.attained_rad", "\"period_s\": 76.0"}) {
    EXPECT_NE(json.find(part), std::string::npos) << part;
  }
  EXPECT_GT(std::filesystem::file_size(scratch / "out" / "report.html"), 100000u);
  const auto written = form(read_file(scratch / "v.md"));
  EXPECT_EQ(written.size(), 12u);
  EXPECT_EQ(written, form(read_file(std::filesystem::path(VSA_SOURCE_DIR) / "docs" / "validation.md")))
      << "write them anew: vsa validate --markdown docs/validation.md";
}

TEST(Validate, EndsWithOneWhereABoundIsBrokenAndStillWrites) {
  const Scratch scratch;
  write_file(scratch / "b.toml", "[[bound]]\nquantity = \"stiffness.0.6903.rms_rad\"\nmax = 1e-6\nwhy = \"nothing does\"\n");
  write_file(scratch / "doc.md", std::string("# Kept\n") + kBegin + "\nold\n" + kEnd + "\nkept too\n");
  const auto r = run_vsa({"validate", "--bounds", (scratch / "b.toml").string(), "--out", (scratch / "out").string(), "--markdown",
                          (scratch / "doc.md").string()});
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_NE(r.err.find("broken"), std::string::npos);
  EXPECT_NE(read_file(scratch / "out" / "results.json").find("\"passed\": false"), std::string::npos);
  const std::string doc = read_file(scratch / "doc.md");
  EXPECT_EQ(doc.rfind("# Kept\n", 0), 0u);
  EXPECT_NE(doc.find("\nkept too\n"), std::string::npos);
  EXPECT_EQ(doc.find("\nold\n"), std::string::npos);
}

TEST(Validate, RefusesBadInputBeforeItSimulates) {
  const Scratch scratch;
  const auto refused = [](std::vector<std::string> more, const std::string& part) {
    more.insert(more.begin(), "validate");
    const auto r = run_vsa(more);
    EXPECT_EQ(r.exit_code, 2) << r.err;
    EXPECT_NE(r.err.find(part), std::string::npos) << r.err;
  };
  write_file(scratch / "broken.toml", "[[bound]\n");
  write_file(scratch / "plain.md", "no markers\n");
  refused({"--bounds", (scratch / "broken.toml").string()}, "broken.toml:1");
  refused({"--bounds", (scratch / "none.toml").string()}, "can't be read");
  refused({"--markdown", (scratch / "plain.md").string()}, "vsa validate: tables");
  refused({"--preset", "nobody"}, "nobody");
  refused({"--set", "shaft.friction_Nm"}, "--set");
}

}  // namespace
