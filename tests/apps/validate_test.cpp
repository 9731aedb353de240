// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// `vsa validate` as its users run it, on the shipped recordings and preset.
#include <gtest/gtest.h>

#include <algorithm>
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

/// A row of the history: its first cell is the version.
std::vector<std::string> history_row(const std::string& text, const std::string& version) {
  const std::size_t begin = text.find("<!-- vsa validate: history -->"), end = text.find("<!-- vsa validate: end of history -->");
  EXPECT_LT(begin, end);
  const std::size_t at = text.find("| " + version + " |", begin);
  std::vector<std::string> out;
  if (at >= end) return out;
  std::istringstream row(text.substr(at, text.find('\n', at) - at));
  for (std::string cell; std::getline(row, cell, '|');) out.push_back(cell);
  return out;
}

void has(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
}

/// A record as `vsa identify` writes one, of a preset with another motor friction.
std::string foreign_record() {
  return R"({"program": "vsa", "command": "vsa identify here", "more": [1], "parameters": [{"name": "drive.load_loss", "keys": ["drive.load_loss"], "interval_95": [0, 1]}], "identified_values": {"drive.friction_Nm": "9"},
    "leave_one_preset_out": [{"preset": 0.6903, "values": [], "rms_rad": 0.0412, "rms_rad_fitted_to_all": 0.0123}]})";
}

const std::filesystem::path kRecordings = std::filesystem::path(VSA_SOURCE_DIR) / "data" / "qbmove_maker_pro";

TEST(Validate, HoldsTheStatedBoundsAndWritesTheDocumentsTables) {
  const Scratch scratch;
  const std::string document = read_file(std::filesystem::path(VSA_SOURCE_DIR) / "docs" / "validation.md");
  write_file(scratch / "v.md", document);
  const auto r = run_vsa({"validate", "--out", (scratch / "out").string(), "--markdown", (scratch / "v.md").string()});
  EXPECT_EQ(r.exit_code, 0) << r.out << r.err;
  EXPECT_EQ(r.out.rfind("The recordings (presets 0.0000, 0.6903 rad) are digitised from a figure", 0), 0u) << "said first\n"
                                                                                                           << r.out;
  has(r.out, {"qbmove_maker_pro was calibrated on stiffness.0.0000, stiffness.0.6903",
              "Predictions held: ", "calibrated figures within their guard: "});
  has(read_file(scratch / "out" / "results.json"),
      {"\"passed\": true", "stiffness.0.0000.rms_rad", "stiffness.0.6903.rms_Nm", "stiffness.0.6903.loop_area_ratio",
       "speed.0.1125.mean_pulley_rad_per_s", "preset_step.loaded.attained_rad", "\"period_s\": 76.0", "\"kind\": \"calibrated\""});
  EXPECT_GT(std::filesystem::file_size(scratch / "out" / "report.html"), 100000u);
  const std::string written = read_file(scratch / "v.md");
  for (const char* preset : {"0.0000", "0.6903"}) {
    const std::string name = std::string("figures/v-stiffness-") + preset + ".svg";
    has(written, {"](" + name + ")"});
    has(read_file(scratch / name), {"<svg ", "recorded, rising", "simulated, falling", "</svg>"});
  }
  EXPECT_EQ(form(written), form(document)) << "write them anew: vsa validate --markdown docs/validation.md";
  const auto now = history_row(written, VSA_VERSION), told = history_row(document, VSA_VERSION);
  ASSERT_GE(now.size(), 5u);
  ASSERT_EQ(told.size(), now.size()) << "this version has another row, or none: vsa validate --markdown docs/validation.md";
  for (std::size_t i = 2; i < now.size(); ++i) {
    EXPECT_NEAR(std::stod(told[i]), std::stod(now[i]), 2e-3 * std::abs(std::stod(now[i])))
        << "docs/validation.md says otherwise: vsa validate --markdown docs/validation.md";
  }
}

/// What somebody has recorded since is a prediction, whatever else is broken or out of date.
TEST(Validate, CountsAnUnseenRecordingAsPredictedAndEndsWithOneWhereABoundIsBroken) {
  const Scratch scratch;
  std::filesystem::create_directories(scratch / "mine");
  std::filesystem::copy_file(kRecordings / "stiffness_preset_0.6903rad_branches.csv",
                             scratch / "mine" / "stiffness_preset_0.4602rad_branches.csv");
  write_file(scratch / "b.toml",
             "[[bound]]\nquantity = \"stiffness.0.6903.rms_rad\"\nmax = 1\nwhy = \"fitted\"\n"
             "[[bound]]\nquantity = \"stiffness.0.4602.rms_rad\"\nmax = 1e-6\nwhy = \"nothing does\"\n");
  write_file(scratch / "loo.json", foreign_record());
  write_file(scratch / "doc.md",
             std::string("# Kept\n") + kBegin + "\nold\n" + kEnd +
                 "\nkept too\n<!-- vsa validate: history -->\n\n| version | gone | stiffness.0.4602.rms_rad |\n|---|---|---|\n"
                 "| 0.0.9 | 7 | 8 |\n| " VSA_VERSION " | 1 | 2 |\n\n<!-- vsa validate: end of history -->\nand this\n");
  const auto r = run_vsa({"validate", "--bounds", (scratch / "b.toml").string(), "--out", (scratch / "out").string(), "--markdown",
                          (scratch / "doc.md").string(), "--recordings", (scratch / "mine").string(), "--leave-one-out",
                          (scratch / "loo.json").string()});
  EXPECT_EQ(r.exit_code, 1) << r.err;
  has(r.err, {"bounds broken: stiffness.0.4602.rms_rad = ", "(at most 1e-06)"});
  has(r.out, {"The recording (preset 0.4602 rad) is of an origin that nobody states", "STALE",
              "drive.load_loss was fitted again and every other value held", "drive.friction_Nm was 9 and is", "0.0412",
              "Predictions held: 0 of 1; calibrated figures within their guard: 1 of 1."});
  has(r.out, {"The recordings (presets 0.0000, 0.6903 rad) are digitised from a figure"});
  const std::string errors = r.out.substr(std::min(r.out.size(), r.out.find("Simulated − recorded")));
  EXPECT_LT(errors.find("predicted"), errors.find("calibrated")) << "predictions first\n" << r.out;
  EXPECT_LT(r.out.find("Leave one recording out"), r.out.find("Predictions held to a bound"));
  has(read_file(scratch / "out" / "results.json"),
      {"\"passed\": false", "\"kind\": \"predicted\"", "\"rms_predicted_rad\": 0.0412"});
  const std::string doc = read_file(scratch / "doc.md");
  std::istringstream lines(doc);
  for (std::string line; std::getline(lines, line);) EXPECT_TRUE(line.size() <= 140 || line[0] == '|' || line[0] == '!') << line;
  EXPECT_EQ(doc.rfind("# Kept\n", 0), 0u);
  const auto before = history_row(doc, "0.0.9"), row = history_row(doc, VSA_VERSION);
  EXPECT_EQ(before, (std::vector<std::string>{"", " 0.0.9 ", " 7 ", " 8 ", " – "}))
      << "an old row stays, a new quantity has a column\n"
      << doc;
  ASSERT_EQ(row.size(), 5u);
  EXPECT_EQ(row[2], " – ");
  EXPECT_GT(std::stod(row[3]), 1e-6);
  EXPECT_GT(std::stod(row[4]), 1e-6);
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
  write_file(scratch / "claim.toml",
             "[[bound]]\nquantity = \"stiffness.0.6903.rms_rad\"\nmax = 1\nwhy = \"y\"\nkind = \"predicted\"\n");
  write_file(scratch / "plain.md", "no markers\n");
  refused({"--bounds", (scratch / "broken.toml").string()}, "broken.toml:1");
  refused({"--bounds", (scratch / "none.toml").string()}, "can't be read");
  refused({"--bounds", (scratch / "claim.toml").string()}, "calibrated on stiffness.0.6903.rms_rad");
  refused({"--markdown", (scratch / "plain.md").string()}, "vsa validate: tables");
  refused({"--type", "nobody"}, "nobody");
  refused({"--type", "sea_example"}, "isn't in the unit of sea_example");
  refused({"--set", "shaft.friction_Nm"}, "--set");
}

TEST(Validate, RefusesRecordingsThatItCouldNotNameApart) {
  const Scratch scratch;
  const auto refused = [&](const std::string& directory, const std::string& part) {
    const auto r = run_vsa({"validate", "--recordings", (scratch / directory).string()});
    EXPECT_EQ(r.exit_code, 2) << r.err;
    EXPECT_NE(r.err.find(part), std::string::npos) << r.err;
  };
  for (const char* name : {"empty", "again", "unit", "broken"}) std::filesystem::create_directories(scratch / name);
  std::filesystem::copy_file(kRecordings / "stiffness_preset_0.6903rad_samples.csv",
                             scratch / "again" / "stiffness_preset_0.69030rad_samples.csv");
  std::filesystem::copy_file(kRecordings / "stiffness_preset_0.6903rad_samples.csv",
                             scratch / "unit" / "stiffness_preset_0.4602mm_samples.csv");
  write_file(scratch / "broken" / "stiffness_preset_0.4602rad.csv", "time_s,load_torque_Nm,deflection_rad\n0,1,x\n");
  refused("none", "isn't a directory");
  refused("empty", "holds no recording");
  refused("again", "another recording has this preset: qbmove_maker_pro/stiffness_preset_0.6903rad_branches.csv");
  refused("unit", "isn't in the unit of qbmove_maker_pro");
  refused("broken", "stiffness_preset_0.4602rad.csv:2");
}

TEST(Validate, RefusesALeaveOneOutRecordThatIsNone) {
  const Scratch scratch;
  const auto refused = [&](const std::string& text, const std::string& part) {
    write_file(scratch / "r.json", text);
    const auto r = run_vsa({"validate", "--leave-one-out", (scratch / "r.json").string()});
    EXPECT_EQ(r.exit_code, 2) << r.err;
    EXPECT_NE(r.err.find(part), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("r.json"), std::string::npos) << r.err;
  };
  refused("{", "isn't JSON");
  refused("{\n\"command\": \"x\",\n\"command\": \"y\"}", "r.json:3: command: is given twice");
  refused("[]", "isn't an object");
  refused("{}", "command");
  refused(R"({"command": "x", "parameters": []})", "holds no parameter");
  refused(R"({"command": "x", "parameters": [{"name": 3}]})", "parameters.name");
  refused(R"({"command": "x", "parameters": [{"name": "a", "keys": [], "interval_95": [1]}]})", "parameters.interval_95");
  refused(R"({"command": "x", "parameters": [{"name": "a", "keys": [1], "interval_95": [1, null]}]})", "parameters.keys");
  refused(
      R"({"command": "x", "parameters": [{"name": "a", "keys": ["drive.x"], "interval_95": [1, 2]}], "identified_values": {}, "leave_one_preset_out": []})",
      "no preset that was left out");
  refused(
      R"({"command": "x", "parameters": [{"name": "a", "keys": ["drive.x"], "interval_95": [1, 2]}], "identified_values": {}, "leave_one_preset_out": [{"preset": "a"}]})",
      "leave_one_preset_out.preset");
  refused(
      R"({"command": "x", "parameters": [{"name": "a", "keys": ["drive.x"], "interval_95": [1, 2]}], "identified_values": {"drive.x": 3},
    "leave_one_preset_out": [{"preset": 0, "rms_rad": null, "rms_rad_fitted_to_all": 1}]})",
      "identified_values.drive.x");
  const auto r = run_vsa({"validate", "--leave-one-out", (scratch / "none.json").string()});
  EXPECT_EQ(r.exit_code, 2);
}

TEST(Validate, TakesARecordForStaleWhereAHeldValueDiffersAndTellsWhereAFittedOneEndedElsewhere) {
  const Scratch scratch;
  const std::string shipped = read_file(std::filesystem::path(VSA_SOURCE_DIR) / "data/qbmove_maker_pro/leave_one_out.json");
  const auto stale = [&](const std::string& from, const std::string& to) {
    std::string text = shipped;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    write_file(scratch / "r.json", text);
    const auto r = run_vsa({"validate", "--leave-one-out", (scratch / "r.json").string(), "--out", (scratch / "out").string()});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_NE(r.out.find("ended at other values of elastic.k1_Nm"), std::string::npos) << r.out;
    return r.out.find("STALE") != std::string::npos;
  };
  EXPECT_FALSE(stale("\"drive.supply_V\": \"8", "\"drive.supply_V\": \"8"));
  EXPECT_TRUE(stale("\"drive.supply_V\": \"8", "\"drive.supply_V\": \"9"));
  EXPECT_FALSE(stale("\"drive.resistance_Ohm\": \"5.", "\"drive.resistance_Ohm\": \"7."));
}

}  // namespace
