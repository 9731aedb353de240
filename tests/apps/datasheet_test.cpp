// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <sstream>

#include "subprocess.hpp"
#include "vsa/config/actuator_type.hpp"

namespace {

using vsa::test::read_file;
using vsa::test::run_vsa;
using vsa::test::Scratch;

void expect_holds(const std::string& text, const std::vector<std::string>& parts) {
  for (const auto& part : parts) EXPECT_NE(text.find(part), std::string::npos) << "no '" << part << "' in:\n" << text;
}

/// What a written page holds beside the program.
std::string data_of(const std::filesystem::path& page) {
  const std::string html = read_file(page);
  const std::size_t at = html.find("id=\"data\">");
  return at == std::string::npos ? "no page" : html.substr(at, html.find("</script>", at) - at);
}

std::ptrdiff_t files_in(const Scratch& scratch) {
  return std::distance(std::filesystem::directory_iterator((scratch / "x").parent_path()), {});
}

/// The words of the first line that holds `what`, from there on.
std::vector<std::string> words_after(const std::string& text, const std::string& what) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) return {};
  std::istringstream line(text.substr(at + what.size(), text.find('\n', at) - at - what.size()));
  std::vector<std::string> out;
  for (std::string word; line >> word;) out.push_back(word);
  return out;
}

TEST(Datasheet, HasTheNumbersOfLawAndDrive) {
  const Scratch scratch;
  const auto result = run_vsa({"datasheet", "qbmove_maker_pro_paper", "--out", scratch / "sheet.html"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(result.err.empty()) << "no progress in a pipe: " << result.err;
  const std::string html = data_of(scratch / "sheet.html");
  // With V = 12 V · 61/101 and M = K_τ V/R − τ_c: σ from 2 a k to 2 a k cosh(a · 0.785 rad), τ = 2 M − τ_shaft; full output at
  // 100 %/(0.1 %/tick).
  expect_holds(html, {"\"one_page\":true", "\"Stiffness and preset\"", "\"Step of the preset\"", "\"4.82 N·m\"", "\"0.301 … 32.6\"",
                      "two_sinh", "k1 = 0.022 N·m", "vsa datasheet qbmove_maker_pro_paper"});
  expect_holds(result.out, {"2.61 / 5.49", "stiffness variation time", "written: " + (scratch / "sheet.html").string()});
  EXPECT_EQ(files_in(scratch), 1) << "nothing is left beside it";
}

TEST(Datasheet, AgreesWithCharacterize) {
  const Scratch scratch;
  const auto sheet = run_vsa({"datasheet", "qbmove_maker_pro_6_1", "--out", scratch / "sheet.html"});
  const auto measured = run_vsa({"characterize", "qbmove_maker_pro_6_1", "--experiment", "speed", "--experiment", "preset-step",
                                 "--out", scratch / "measured"});
  ASSERT_EQ(sheet.exit_code, 0) << sheet.err;
  ASSERT_EQ(measured.exit_code, 0) << measured.err;
  const auto speeds = words_after(sheet.out, "mean speed 10–90 %, preset 0 / 0.75");  // "4.38 / 3.72 rad/s …"
  const auto stiff = words_after(measured.out, "\n0.75 ");                            // rise, ω shaft, …
  const auto soft = words_after(measured.out, "\n0 ");
  ASSERT_GE(speeds.size(), 3U) << sheet.out;
  ASSERT_GE(stiff.size(), 2U) << measured.out;
  ASSERT_GE(soft.size(), 2U) << measured.out;
  EXPECT_NEAR(std::stod(speeds[0]), std::stod(soft[1]), 0.006);
  EXPECT_NEAR(std::stod(speeds[2]), std::stod(stiff[1]), 0.006);
  const auto times = words_after(sheet.out, "stiffness variation time 10–90 %, no load, up / down");
  const auto none = words_after(measured.out, "\nnone ");  // load, 0 → 0.75 → 0, attained, rise, resting, fall
  ASSERT_GE(times.size(), 3U) << sheet.out;
  ASSERT_GE(none.size(), 10U) << measured.out;
  EXPECT_NEAR(std::stod(times[0]), std::stod(none[7]), 0.0011);
  EXPECT_NEAR(std::stod(times[2]), std::stod(none[9]), 0.0011);
}

TEST(Datasheet, OfAnActuatorWithoutPresetLeavesOutWhatHasNoMeaning) {
  const Scratch scratch;
  const auto result = run_vsa({"datasheet", "sea_example", "--out", scratch / "sheet.html"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string html = data_of(scratch / "sheet.html");
  for (const char* part : {"\"Stiffness and preset\"", "\"Step of the preset\"", "By stiffness preset", "variation"}) {
    EXPECT_EQ(html.find(part), std::string::npos) << part;
  }
  expect_holds(html, {"\"10 N·m/rad\"", "\"Torque and speed\""});
  expect_holds(result.out, {"no-load speed"});
}

TEST(Datasheet, FollowsTheParametersThatAreSet) {
  const Scratch scratch;
  const auto result = run_vsa({"datasheet", "sea_example", "--set", "elastic.stiffness_Nm_per_rad=20", "--set", "drive.supply_V=0",
                               "--out", scratch / "s.html"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_holds(data_of(scratch / "s.html"), {"\"20 N·m/rad\"", "with elastic.stiffness_Nm_per_rad = 20, drive.supply_V = 0"});
}

TEST(Datasheet, RefusesBadInputAndWritesNothing) {
  const Scratch scratch;
  const auto refused = [](const std::vector<std::string>& arguments, const std::vector<std::string>& parts) {
    const auto result = run_vsa(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    expect_holds(result.err, parts);
  };
  refused({"datasheet"}, {"TYPE"});
  refused({"datasheet", "sea_example", "--all"}, {"--all"});
  refused({"datasheet", "--all", "--set", "drive.supply_V=24"}, {"--all"});
  refused({"datasheet", "--all", "--out", "/proc/nothing"}, {"--out"});
  refused({"datasheet", "qbmove_9000"}, {"qbmove_9000", "sea_example"});
  refused({"datasheet", "sea_example", "--set", "drive.supply_V", "--out", scratch / "s.html"}, {"--set", "key=value"});
  refused({"datasheet", "sea_example", "--set", "drive.supply_V=many", "--out", scratch / "s.html"}, {"drive.supply_V", "many"});
  refused({"datasheet", "sea_example", "--out", scratch / "nowhere" / "s.html"}, {"--out", "directory"});
  refused({"datasheet", "sea_example", "--out", (scratch / "nowhere").parent_path()}, {"--out", "is a directory"});
  EXPECT_FALSE(std::filesystem::exists(scratch / "s.html"));
}

TEST(Datasheet, AFullDiskIsAFailureThatLeavesNoHalfPage) {
  const Scratch scratch;
  vsa::test::Surroundings full;
  full.largest_file = 10'000;
  const auto result = run_vsa({"datasheet", "sea_example", "--out", scratch / "s.html"}, full);
  EXPECT_EQ(result.exit_code, 1);
  expect_holds(result.err, {"s.html"});
  EXPECT_EQ(files_in(scratch), 0);
}

TEST(Datasheet, OfAllTypesComesWithAGalleryAndAPageThatComparesThem) {
  const Scratch scratch;
  const auto result = run_vsa({"datasheet", "--all", "--out", scratch / "sheets"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<std::string> names = vsa::config::TypeLibrary({std::filesystem::path(VSA_SOURCE_DIR) / "actuators"}).names();
  const std::string page = data_of(scratch / "sheets/comparison.html"), gallery = data_of(scratch / "sheets/index.html");
  for (const std::string& name : names) {
    EXPECT_NE(result.out.find("\n" + name + ' '), std::string::npos) << name;
    EXPECT_NE(page.find('"' + name + '"'), std::string::npos) << name;
    EXPECT_NE(gallery.find("\"link\":\"" + name + ".html\""), std::string::npos) << name;
    EXPECT_TRUE(std::filesystem::exists(scratch / ("sheets/" + name + ".html"))) << name;
  }
  // 2 a k and 2 a k cosh(a · 0.785 rad) of the paper's.
  expect_holds(page, {"0.301 … 32.6", "\"measured\"", "\"symbolic\"", "\"published\""});
}

}  // namespace
