// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Recordings that are wrong, one a row: what is written, and what the message must tell.
#include <random>

#include "recording_support.hpp"
#include "vsa/experiment/recording.hpp"

namespace vsa::experiment {
namespace {

using test::Files;
using test::has;
using test::problems;

constexpr const char* kName = "stiffness_preset_0.5000rad.csv";

struct Row {
  const char* name;
  std::string text;
  std::vector<std::string> told;  ///< parts of the first message
  std::size_t count = 1;
};

std::string repeated(const std::string& text, int times) {
  std::string out;
  for (int i = 0; i < times; ++i) out += text;
  return out;
}

std::vector<Row> rows() {
  const std::string head = "load_torque_Nm,deflection_rad\n", timed = "time_s,load_torque_Nm,deflection_rad\n";
  return {
      {"Empty", "", {kName, "empty"}},
      {"BlankLines", "\n\n  \n", {"empty"}},
      {"HeaderOnly", head, {"0 samples", "too few"}},
      {"OneSample", head + "0.1,0.2\n", {"1 sample", "too few", "two or more"}},
      {"NoHeader", "0.1,0.2\n0.2,0.3\n", {":1", "0.1", "unknown column"}, 4},
      {"UnknownColumn", "load_torque_Nm,deflection_rad,foo\n1,2,3\n1,2,3\n", {":1", "foo", "unknown column"}},
      {"UnitMissing", "load_torque,deflection_rad\n1,2\n1,2\n", {"load_torque", "no unit", "load_torque_Nm"}, 2},
      {"OtherTorqueUnit", "load_torque_mNm,deflection_rad\n1,2\n1,2\n", {"load_torque_mNm", "unit", "load_torque_Nm"}, 2},
      {"Degrees", "load_torque_Nm,deflection_deg\n1,2\n1,2\n", {"deflection_deg", "unit", "deflection_rad"}, 2},
      {"Milliseconds", "time_ms,load_torque_Nm,deflection_rad\n0,1,2\n1,1,2\n", {"time_ms", "unit", "time_s"}},
      {"ColumnMissing", "load_torque_Nm\n1\n1\n", {"missing", "deflection_rad"}},
      {"ColumnTwice", "load_torque_Nm,load_torque_Nm,deflection_rad\n1,1,2\n1,1,2\n", {"load_torque_Nm", "twice"}},
      {"NotANumber", head + "0.1,0.2\n0.2,x1\n", {":3", "deflection_rad", "x1", "not a number"}},
      {"NaN", head + "0.1,nan\n0.2,0.1\n", {":2", "deflection_rad", "nan", "finite"}},
      {"Infinite", head + "inf,0.1\n0.2,0.1\n", {":2", "load_torque_Nm", "inf", "finite"}},
      {"TooLargeForADouble", head + "1e999,0.1\n0.2,0.1\n", {":2", "load_torque_Nm", "1e999"}},
      {"TrailingText", head + "0.1 N,0.1\n0.2,0.1\n", {":2", "0.1 N", "not a number"}},
      {"DecimalComma", head + "0,1,0,2\n0,2,0,3\n", {":2", "4 cells", "2, as the header has"}, 2},
      {"EmptyCell", head + "0.1,\n0.2,0.1\n", {":2", "empty cell"}},
      {"TooFewCells", head + "0.1\n0.2,0.1\n", {":2", "1 cells"}},
      {"TorqueOutOfRange", head + "0.1,0.1\n-11,0.1\n", {":3", "load_torque_Nm", "-11", "-10"}},
      {"DeflectionOutOfRange", head + "0.1,0.1\n0.1,57.3\n", {":3", "deflection_rad", "57.3"}},
      {"TimeGoesBack", timed + "0,0,0\n2,0,0\n1,0,0\n", {":4", "time_s", "1", "doesn't increase"}},
      {"TimeStandsStill", timed + "0,0,0\n1,0,0\n1,0,0\n", {":4", "time_s", "doesn't increase"}},
      {"SamplesOutOfOrder", "sample,load_torque_Nm,deflection_rad\n1,0,0\n0,0,0\n", {":3", "sample", "doesn't increase"}},
      {"ZeroBytes", head + std::string("0.1,\0.2\n", 8), {"isn't text"}},
      {"HugeLine", head + std::string(100000, '7') + ",1\n", {":2", "100002 characters", "4096"}},
      {"HugeHeader", repeated("a_rad,", 10000), {":1", "60000 characters"}},
      {"AllWrongAtOnce", head + "a,b\nc,d\n", {":2", "a"}, 4},
      {"GarbageIsCutShort", head + repeated("x,y\n", 5000), {":2", "x"}, 20},
  };
}

TEST(BadRecording, IsRefusedWithAMessageThatHelps) {
  Files files("bad_input");
  for (const Row& row : rows()) {
    const auto file = files.write(kName, row.text);
    const auto found = problems([&] { (void)read_load_recording(file); });
    ASSERT_EQ(found.size(), row.count) << row.name << ": " << (found.empty() ? "" : found[0]);
    EXPECT_TRUE(has(found[0], kName)) << row.name;
    for (const std::string& part : row.told) EXPECT_TRUE(has(found[0], part)) << row.name << ": " << found[0];
    EXPECT_LT(found[0].size(), 600u) << row.name;
  }
}

TEST(BadRecording, RandomBytesNeverDoWorse) {
  Files files("garbage");
  std::mt19937 random(7);
  std::uniform_int_distribution<int> byte(0, 255);
  for (int i = 0; i < 200; ++i) {
    std::string text = i % 2 == 0 ? "load_torque_Nm,deflection_rad\n" : "";
    for (int k = 0; k < 300; ++k) text += static_cast<char>(byte(random));
    const auto file = files.write(kName, text);
    const auto found = problems([&] { (void)read_load_recording(file); });
    EXPECT_FALSE(found.empty());
    for (const auto& p : found) {
      for (char c : p) EXPECT_GE(static_cast<unsigned char>(c), 0x20) << "a control character reaches the terminal";
    }
  }
}

TEST(BadRecording, ADirectoryAMissingFileAndADeviceAreTold) {
  Files files("places");
  std::filesystem::create_directories(files.path() / kName);
  EXPECT_TRUE(has(problems([&] { (void)read_load_recording(files.path() / kName); }).at(0), "directory"));
  EXPECT_TRUE(has(problems([&] { (void)read_load_recording(files.path() / "no_preset_1rad.csv"); }).at(0), "no such file"));
  EXPECT_TRUE(has(problems([&] { (void)read_load_recording("/dev/zero"); }).at(0), "regular file"));
}

TEST(BadRecording, ANameWithoutAPresetIsTold) {
  Files files("names");
  const std::string fine = "load_torque_Nm,deflection_rad\n0.1,0.2\n0.2,0.3\n";
  const char* names[] = {"loads.csv",
                         "stiffness_preset_rad.csv",
                         "stiffness_preset_0.5.csv",
                         "stiffness_preset_40deg.csv",
                         "stiffness_preset_-1rad.csv",
                         "stiffness_preset_1.2.3rad.csv"};
  for (const char* name : names) {
    const auto found = problems([&] { (void)read_load_recording(files.write(name, fine)); });
    ASSERT_EQ(found.size(), 1u) << name;
    EXPECT_TRUE(has(found[0], name) && has(found[0], "0.6903rad")) << found[0];
  }
}

TEST(BadRecording, TheTorqueLimitIsTheCallers) {
  Files files("limit");
  const auto file = files.write(kName, "load_torque_Nm,deflection_rad\n11,0.2\n-11,-0.2\n");
  EXPECT_EQ(problems([&] { (void)read_load_recording(file); }).size(), 2u);
  EXPECT_NO_THROW((void)read_load_recording(file, 20.0));
}

TEST(GoodRecording, MayHaveAByteOrderMarkCarriageReturnsAndOtherColumnsWithUnits) {
  Files files("good");
  const auto file =
      files.write(kName, "\xEF\xBB\xBFpreset_rad,deflection_rad,load_torque_Nm,time_s\r\n0,0.2,0.1,0\r\n0,0.3,0.2,0.5\r\n\r\n");
  const LoadRecording r = read_load_recording(file);
  EXPECT_EQ(r.torque_Nm, (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(r.deflection_rad, (std::vector<double>{0.2, 0.3}));
  EXPECT_EQ(r.time_s, (std::vector<double>{0, 0.5}));
  EXPECT_EQ(r.preset, 0.5);
}

TEST(BadRecording, CantBeWrittenWhereThereIsNoPlace) {
  LoadRecording r;
  r.torque_Nm = r.deflection_rad = {0, 1};
  EXPECT_EQ(problems([&] { write_load_recording(r, "/proc/no/such/place.csv"); }).size(), 1u);
}

TEST(BadBranchFile, IsTold) {
  Files files("branch");
  const std::string head = "load_torque_Nm,deflection_rising_rad,deflection_falling_rad,sd_rising_rad,sd_falling_rad\n";
  const auto told = [&](const std::string& text) { return problems([&] { (void)read_branches(files.write("b.csv", text)); }); };
  EXPECT_TRUE(has(told(head + "0,0,0,0,0\n").at(0), "too few"));
  EXPECT_TRUE(has(told(head + "0,0,0,0,0\n0,0,0,0,0\n").at(0), "doesn't increase"));
  EXPECT_TRUE(has(told("load_torque_Nm,deflection_rising_deg\n").at(0), "deflection_rising_rad"));
  EXPECT_TRUE(told(head + "0,,0,,0\n1,0,,0,\n").empty()) << "a branch may have gaps";
  const auto uneven = told(head + "-1,0,0,0,0\n0,0,0,0,0\n3.5,0,0,0,0\n5,0,0,0,0\n").at(0);
  for (const char* part : {"b.csv:4", "load_torque_Nm", "3.5", "isn't on one grid", "multiples of the least, 1"})
    EXPECT_TRUE(has(uneven, part)) << part;
  const std::string gap = head + "-1,0,0,0,0\n0.5,0,0,0,0\n1,0,0,0,0\n";
  EXPECT_TRUE(told(gap).empty()) << "rows may be missing";
  EXPECT_EQ(read_branches(files.write("b.csv", gap)).spacing_Nm(), 0.5) << "whichever come first";
  EXPECT_TRUE(told(head + "0,0,0,0,0\n0.33,0,0,0,0\n0.67,0,0,0,0\n1,0,0,0,0\n").empty()) << "rounded";
  for (const auto& [row, key] : std::vector<std::pair<std::string, std::string>>{{"1e5,0,0,0,0", "load_torque_Nm"},
                                                                                 {"1,7,0,0,0", "deflection_rising_rad"},
                                                                                 {"1,0,-7,0,0", "deflection_falling_rad"},
                                                                                 {"1,0,0,-0.1,0", "sd_rising_rad"},
                                                                                 {"1,0,0,0,7", "sd_falling_rad"}}) {
    const auto text = told(head + "0,0,0,0,0\n" + row + "\n");
    ASSERT_EQ(text.size(), 1u) << row;
    EXPECT_TRUE(has(text[0], "b.csv:3") && has(text[0], key) && has(text[0], "out of range")) << text[0];
  }
}

TEST(BadSeries, IsTold) {
  Files files("series");
  const auto told = [&](const std::string& text) {
    return problems([&] { (void)read_series(files.write("s.csv", text), "shaft_angle_rad"); });
  };
  EXPECT_TRUE(told("time_s,shaft_angle_rad\n0,0\n1,1\n").empty());
  EXPECT_TRUE(has(told("time_s,preset_rad\n0,0\n1,1\n").at(0), "shaft_angle_rad"));
  EXPECT_TRUE(has(told("time_s,shaft_angle_rad\n1,0\n0,1\n").at(0), "doesn't increase"));
}

}  // namespace
}  // namespace vsa::experiment
