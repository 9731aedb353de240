// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Every way to get a type's file wrong, and what the user reads then.
#include <gtest/gtest.h>

#include "support.hpp"

namespace vsa::test {
namespace {

struct BadType {
  const char* name;
  std::string from, to;             ///< a replacement in the maker pro's file
  std::vector<std::string> pieces;  ///< of the message
  std::size_t problems = 1;
};

std::ostream& operator<<(std::ostream& out, const BadType& bad) { return out << bad.name; }

const char* const kInertia = "inertia_kgm2 = { value = 0.001, unit = \"kg·m²\", bounds = [1e-6, 0.1]";

class TypeBadInput : public testing::TestWithParam<BadType> {};

TEST_P(TypeBadInput, IsRefusedWithWhatIsWrong) {
  const BadType& bad = GetParam();
  const Directory directory(std::string("bad_") + bad.name);
  const std::string text = replaced(read(source_dir() / "actuators/qbmove_maker_pro_paper.toml"), bad.from, bad.to);
  const auto file = directory.write("qbmove_maker_pro_paper.toml", text);
  const auto problems = problems_of([&] { (void)shipped().load_file(file); });
  EXPECT_EQ(problems.size(), bad.problems) << text_of(problems);
  expect_pieces(text_of(problems), bad.pieces);
  for (const Problem& p : problems) EXPECT_EQ(p.file.rfind(file.string(), 0), 0u) << p.file;
}

std::string inertia(const std::string& value, const std::string& unit = "kg·m²", const std::string& bounds = "[1e-6, 0.1]") {
  return "inertia_kgm2 = { value = " + value + ", unit = \"" + unit + "\", bounds = " + bounds;
}

INSTANTIATE_TEST_SUITE_P(
    Values, TypeBadInput,
    testing::Values(
        BadType{"text_for_number", kInertia, inertia("\"much\""), {"drive.inertia_kgm2 = \"much\"", "must be a number"}},
        BadType{"switch_for_number", kInertia, inertia("true"), {"drive.inertia_kgm2 = true", "must be a number"}},
        BadType{"table_for_number", kInertia, inertia("{}"), {"drive.inertia_kgm2.value = a table", "must be a number"}},
        BadType{"nan", kInertia, inertia("nan"), {"drive.inertia_kgm2 = nan", "must be finite"}},
        BadType{"infinite", kInertia, inertia("inf"), {"drive.inertia_kgm2 = inf", "must be finite"}},
        BadType{"beyond_own_bounds", kInertia, inertia("0.5"), {"= 0.5: is outside of the type's own bounds", "1e-06 … 0.1 kg·m²"}},
        BadType{"beyond_model", kInertia, inertia("-1.0"), {"= -1: is outside of what the model accepts", "1e-09 … 100 kg·m²"}},
        BadType{"wrong_unit", kInertia, inertia("0.001", "g·cm²"), {"inertia_kgm2.unit = \"g·cm²\": is the wrong unit", "kg·m²"}},
        BadType{"empty_unit", kInertia, inertia("0.001", ""), {"inertia_kgm2.unit", "must be a text that is not empty"}},
        BadType{"bounds_too_wide_below", kInertia, inertia("0.001", "kg·m²", "[0.0, 0.1]"), {".bounds = 0 … 0.1: is wider"}},
        BadType{"bounds_too_wide_above", kInertia, inertia("0.001", "kg·m²", "[1e-6, 101.0]"), {".bounds = 1e-06 … 101: is wider"}},
        BadType{
            "bounds_reversed", kInertia, inertia("0.001", "kg·m²", "[1.0, 0.1]"), {".bounds", "two finite numbers in order"}, 2},
        BadType{"bounds_of_three", kInertia, inertia("0.001", "kg·m²", "[0.1, 0.2, 0.3]"), {".bounds = an array"}, 2},
        BadType{"bounds_of_texts", kInertia, inertia("0.001", "kg·m²", "[\"a\", \"b\"]"), {".bounds = an array"}, 2},
        BadType{"bounds_nan", kInertia, inertia("0.001", "kg·m²", "[nan, 1.0]"), {".bounds = an array"}, 2},
        BadType{"half_a_bit", "encoder_bits = { value = 12", "encoder_bits = { value = 12.5", {"= 12.5: must be a whole number"}},
        BadType{"seventeen_bits", "encoder_bits = { value = 12", "encoder_bits = { value = 17", {"= 17: is outside", "1 … 16 bit"}},
        BadType{"word", "value = \"brake\"", "value = \"break\"", {"drive.off_mode = \"break\": is not one of", "brake, coast"}},
        BadType{"polarity", "polarity = { value = 1", "polarity = { value = 0", {"drive.polarity = 0: is not one of", "-1, 1"}},
        BadType{"switch", "limits_on = { value = true", "limits_on = { value = 1", {"limits_on = 1: must be true or false"}},
        BadType{"switch_with_unit", "limits_on = { value = true", "limits_on = { unit = \"1\", value = true", {"has no meaning"}},
        BadType{"limits_swapped", "value = -30000", "value = 30001", {"limit_low_raw = 30001", "must be below", "below 30000"}}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Form, TypeBadInput,
    testing::Values(
        BadType{"not_toml", "[drive]", "[drive", {"qbmove_maker_pro_paper.toml:20"}},
        BadType{"twice", "[drive]", "[drive]\npolarity = { value = 1, source = \"x\" }", {"polarity"}},
        BadType{"bare_number", "polarity = { value = 1", "polarity = 1 #", {"drive.polarity = 1: must be a table"}},
        BadType{"unknown_key",
                "dead_band =",
                "deadband =",
                {"drive.deadband", "did you mean drive.dead_band?", "drive.dead_band: is missing"},
                2},
        BadType{"unknown_table",
                "[shaft]",
                "[shafts]",
                {"shafts: unknown table, did you mean shaft?", "shaft.friction_Nm: is missing"},
                4},
        BadType{"table_is_array", "[shaft]", "[[shaft]]", {"shaft = an array: must be a table", "[shaft]"}, 4},
        BadType{
            "unknown_part", kInertia, std::string("inertia_kgm2 = { units = \"kg\", ") + (kInertia + 17), {"did you mean unit?"}},
        BadType{"no_value", "encoder_bits = { value = 12, ", "encoder_bits = { ", {"sensor.encoder_bits.value: is missing"}},
        BadType{"no_source", ", source = \"NMMI/qbmove-maker-pro 6.1: positive gains\"", "", {"drive.polarity.source: is missing"}},
        BadType{"empty_source", "NMMI/qbmove-maker-pro 6.1: positive gains", " ", {"drive.polarity.source", "not empty"}},
        BadType{"no_unit", "value = 12.0, unit = \"V\"", "value = 12.0", {"drive.supply_V.unit: is missing", "V"}},
        BadType{"no_bounds", "unit = \"V\", bounds = [0.0, 25.5]", "unit = \"V\"", {"supply_V.bounds: is missing", "0 … 100"}},
        BadType{"unknown_law",
                "\"two_sinh\"",
                "\"three_sinh\"",
                {"elastic.law = \"three_sinh\": unknown law", "series_travel, table, two_cams", "two_sinh, two_sinh_linear"}},
        BadType{"no_law", "law = \"two_sinh\"", "", {"elastic.law: is missing"}},
        BadType{"law_key_missing", "k1_Nm =", "k3_Nm =", {"elastic.k1_Nm: is missing", "elastic.k3_Nm: unknown key"}, 2},
        BadType{"law_unit", "bounds = [1e-6, 1.0]", "bounds = [1e-6, 1.0], units = 1", {"elastic.k1_Nm.units"}},
        BadType{"name",
                "name = \"qbmove_maker_pro_paper\"",
                "name = \"qbmove\"",
                {"differs from the file's name", "qbmove_maker_pro_paper"}},
        BadType{"title_missing", "title =", "titel =", {"type.titel", "did you mean title?", "type.title: is missing"}, 2},
        BadType{"title_number", "title = \"qbmove maker pro (paper, Table I)\"", "title = 5", {"type.title = 5: must be a text"}}),
    [](const auto& test) { return test.param.name; });

TEST(TypeFile, AProblemNamesTheLineItStandsOn) {
  const Directory directory("lines");
  const std::string good = read(source_dir() / "actuators/sea_example.toml");
  const auto file = directory.write("sea_example.toml", replaced(good, "value = 2.3", "value = -2.3"));
  const auto problems = problems_of([&] { (void)shipped().load_file(file); });
  ASSERT_EQ(problems.size(), 1u);
  const std::string before = good.substr(0, good.find("resistance_Ohm"));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  EXPECT_EQ(problems[0].file, file.string() + ":" + std::to_string(line));
  EXPECT_EQ(problems[0].key, "drive.resistance_Ohm");
}

TEST(TypeFile, AllProblemsOfAFileComeTogether) {
  const Directory directory("together");
  std::string text = read(source_dir() / "actuators/sea_example.toml");
  text = replaced(text, "value = 2.3", "value = -2.3");
  text = replaced(text, "dead_band", "death_band");
  text = replaced(text, "\"brake\"", "\"fly\"");
  const auto file = directory.write("sea_example.toml", text);
  EXPECT_EQ(problems_of([&] { (void)shipped().load_file(file); }).size(), 4u);  // a key unknown and one missing
}

TEST(TypeFile, APresetLimitForALawWithoutPresetIsRefused) {
  const std::string limit = "[limits]\npreset_max = { value = 0.5, unit = \"rad\", bounds = [0.0, 1.0], source = \"x\" }\n";
  const std::string text = replaced(read(source_dir() / "actuators/sea_example.toml"), "[physics]", limit + "[physics]");
  const auto problems = problems_of([&] { (void)shipped().load_text(text, "sea_example.toml"); });
  ASSERT_EQ(problems.size(), 1u) << text_of(problems);
  EXPECT_EQ(problems[0].key, "limits.preset_max");
  expect_pieces(problems[0].message, {"the law has no preset"});
}

TEST(TypeFile, AnUnreadableFileIsAnInputError) {
  const Directory directory("unreadable");
  EXPECT_EQ(problems_of([&] { (void)shipped().load_file(directory.path()); }).size(), 1u);
  EXPECT_EQ(problems_of([&] { (void)shipped().load_file(directory.path() / "none.toml"); }).size(), 1u);
}

}  // namespace
}  // namespace vsa::test
