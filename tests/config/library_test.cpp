// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Where presets come from, what overrides and defaults do, and how values are written.
#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "support.hpp"
#include "vsa/config/installed.hpp"
#include "vsa/config/notices.hpp"
#include "vsa/config/schema.hpp"
#include "vsa/config/text.hpp"

namespace vsa::test {
namespace {

using config::Override;
using config::TypeLibrary;

const config::Entry& entry(const config::ActuatorType& type, const std::string& key) {
  const auto same = [&](const config::Entry& e) { return e.key == key; };
  const auto at = std::find_if(type.entries.begin(), type.entries.end(), same);
  EXPECT_NE(at, type.entries.end()) << key;
  return *at;
}

/// Sets an environment variable for a scope.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
  ~Environment() { unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
};

TEST(Override, ReplacesAValueAndSaysSoInTheSource) {
  const auto type = shipped().load("qbmove_maker_pro_paper", {{"drive.friction_Nm", "0.7"}, {"elastic.k1_Nm", "0.03"}});
  EXPECT_EQ(type.unit.actuator.side[0].gearbox.friction.coulomb_Nm, 0.7);
  EXPECT_EQ(entry(type, "drive.friction_Nm").value, "0.7");
  expect_pieces(entry(type, "drive.friction_Nm").source, {"override", "the type has 0.8", "Table I"});
  EXPECT_EQ(entry(type, "elastic.k1_Nm").value, "0.03");
}

TEST(Entry, HasTheNumbersOfItsTexts) {
  const auto preset = shipped().load("qbmove_maker_pro", {{"drive.off_mode", "coast"}, {"firmware.limits_on", "true"}});
  for (const config::Entry& e : preset.entries) {
    if (e.kind != config::Kind::number && e.kind != config::Kind::integer) continue;
    EXPECT_EQ(config::number_text(e.number), e.value) << e.key;
    EXPECT_EQ(config::range_text(e.min, e.max), e.bounds) << e.key << ": the file's own, not the table's";
  }
  EXPECT_EQ(entry(preset, "sensor.encoder_bits").kind, config::Kind::integer);
  EXPECT_EQ(entry(preset, "drive.off_mode").kind, config::Kind::word);
  EXPECT_EQ(entry(preset, "drive.off_mode").number, 1) << "the second word";
  EXPECT_EQ(entry(preset, "firmware.limits_on").number, 1);
  EXPECT_EQ(entry(preset, "elastic.k1_Nm").kind, config::Kind::number) << "a law's own";
}

TEST(Override, WorksForWordsSwitchesWholeNumbersAndAbsentOptionalKeys) {
  const auto type = shipped().load("qbmove_maker_pro", {{"drive.off_mode", "coast"},
                                                        {"firmware.limits_on", "false"},
                                                        {"drive.polarity", "-1"},
                                                        {"sensor.encoder_bits", "14"},
                                                        {"drive.inductance_H", "1e-3"}});
  EXPECT_FALSE(type.unit.actuator.side[0].bridge.brake_when_off);
  EXPECT_EQ(type.unit.memory.limits_on, 0);
  EXPECT_EQ(type.unit.actuator.side[0].polarity, -1);
  EXPECT_EQ(type.unit.actuator.side[0].encoder.bits, 14);
  EXPECT_EQ(type.unit.actuator.side[0].motor.inductance_H, 1e-3);
}

TEST(Override, TurnsOnTheBridgeAsACircuitAndAnOlderLoop) {
  const auto as_shipped = shipped().load("qbmove_maker_pro_6_1").unit;
  EXPECT_EQ(as_shipped.actuator.side[0].bridge.pin, drive::PwmPin::input);
  EXPECT_EQ(as_shipped.actuator.side[0].bridge.period_s, 50.5e-6);
  EXPECT_EQ(as_shipped.actuator.side[0].bridge.switch_Ohm, 0.0);
  EXPECT_FALSE(as_shipped.actuator.side[0].gearbox.back_loss.has_value());
  EXPECT_EQ(as_shipped.program.generation, firmware::Generation::v6);
  const auto u = shipped()
                     .load("qbmove_maker_pro_6_1", {{"drive.pwm_pin", "enable"},
                                                    {"drive.pwm_period_s", "1e-5"},
                                                    {"drive.inductance_H", "2e-4"},
                                                    {"drive.switch_Ohm", "0.24"},
                                                    {"drive.diode_V", "0.7"},
                                                    {"drive.back_loss", "0.1"},
                                                    {"firmware.generation", "3"}})
                     .unit;
  EXPECT_EQ(u.actuator.side[0].bridge.pin, drive::PwmPin::enable);
  EXPECT_EQ(u.actuator.side[0].bridge.period_s, 1e-5);
  EXPECT_EQ(u.actuator.side[0].bridge.switch_Ohm, 0.24);
  EXPECT_EQ(u.actuator.side[0].bridge.diode_V, 0.7);
  EXPECT_EQ(u.actuator.side[0].gearbox.back_loss, 0.1);
  EXPECT_EQ(u.program.generation, firmware::Generation::v3);
}

TEST(Override, OfTheBridgeOrTheLoopThatDoNotGoTogetherAreRefused) {
  const auto told = [](std::vector<Override> o) {
    return text_of(problems_of([&] { (void)shipped().load("qbmove_maker_pro_6_1", o); }));
  };
  expect_pieces(told({{"drive.pwm_pin", "enable"}}), {"drive.inductance_H", "needs the winding's inductance"});
  expect_pieces(told({{"firmware.model", "advanced"}, {"firmware.generation", "4"}}), {"firmware.generation", "maker pro"});
  expect_pieces(told({{"firmware.model", "advanced"}}), {"firmware.kp_pct_per_tick", "0.1", "drives the motors away", "below 0"});
}

TEST(Override, ThatIsBadIsRefusedByNameOfTheOverride) {
  const std::pair<Override, const char*> table[] = {
      {{"drive.friction_Nm", "0.7 "}, "must be a number"},
      {{"drive.friction_Nm", "0.7abc"}, "must be a number"},
      {{"drive.friction_Nm", ""}, "must be a number"},
      {{"drive.friction_Nm", "nan"}, "must be a number"},
      {{"drive.friction_Nm", "1e999"}, "must be a number"},
      {{"drive.friction_Nm", "0x10"}, "must be a number"},
      {{"drive.friction_Nm", "0,7"}, "must be a number"},
      {{"drive.friction_Nm", "-0.1"}, "is outside of what the model accepts"},
      {{"drive.friction_Nm", "11"}, "is outside of the type's own bounds"},
      {{"drive.inductance_H", "1e9"}, "is outside of what the model accepts"},  // the type has none, so no bounds of its own
      {{"drive.frction_Nm", "0.7"}, "did you mean drive.friction_Nm?"},
      {{"elastic.k3_Nm", "0.7"}, "did you mean elastic.k1_Nm?"},
      {{"elastic.law", "series_spring"}, "can't be overridden"},
      {{"drive.off_mode", "Brake"}, "is not one of the words"},
      {{"firmware.limits_on", "1"}, "must be true or false"},
      {{"sensor.encoder_bits", "12.0"}, "must be a whole number"},
  };
  for (const auto& [given, message] : table) {
    const auto problems = problems_of([&, o = given] { (void)shipped().load("qbmove_maker_pro_6_1", {o}); });
    ASSERT_EQ(problems.size(), 1u) << given.key << " " << given.value << "\n" << text_of(problems);
    EXPECT_EQ(problems[0].key, "override " + given.key);
    EXPECT_EQ(problems[0].value, '"' + given.value + '"');
    expect_pieces(problems[0].message, {message});
  }
}

TEST(Override, GivenTwiceIsRefused) {
  const std::vector<Override> twice{{"drive.friction_Nm", "0.7"}, {"drive.friction_Nm", "0.6"}};
  expect_pieces(text_of(problems_of([&] { (void)shipped().load("sea_example", twice); })), {"is given more than once"});
}

TEST(Default, StandsInForAKeyThatTheFileLeavesOutAndIsListedAsOne) {
  const Directory directory("defaults");
  std::string text = read(source_dir() / "actuators/qbmove_maker_pro.toml");
  const std::size_t from = text.find("[firmware]"), to = text.find("[limits]");
  text.erase(from, to - from);
  const auto type = shipped().load_file(directory.write("qbmove_maker_pro.toml", text));
  EXPECT_EQ(type.unit.memory.position.p, 6553);
  EXPECT_EQ(type.unit.memory, firmware::initial_memory(firmware::Model::maker_pro));
  EXPECT_EQ(entry(type, "firmware.kp_pct_per_tick").value, "0.1");
  expect_pieces(entry(type, "firmware.kp_pct_per_tick").source, {"default: ", "6.1"});
}

TEST(Default, OfEveryDefaultedParameterIsWithinItsOwnBoundsAndHasASource) {
  for (const config::Parameter& p : config::parameters()) {
    EXPECT_EQ(p.need == config::Need::defaulted, !p.default_value.empty()) << p.key;
    EXPECT_EQ(p.need == config::Need::defaulted, !p.default_source.empty()) << p.key;
    EXPECT_FALSE(p.meaning.empty()) << p.key;
    if (p.need != config::Need::defaulted || !p.words.empty() || p.kind == config::Kind::toggle) continue;
    const auto value = config::parse_number(p.default_value);
    ASSERT_TRUE(value.has_value()) << p.key;
    EXPECT_TRUE(*value >= p.min && *value <= p.max) << p.key;
  }
}

TEST(TypeLibrary, AnUnknownNameIsRefusedWithTheNamesThereAre) {
  for (const char* name : {"qbmove", "", "../actuators/sea_example", "sea_example.toml", "/etc/passwd"}) {
    const auto problems = problems_of([&] { (void)shipped().load(name); });
    ASSERT_EQ(problems.size(), 1u);
    expect_pieces(problems[0].text(), {"unknown actuator type", "qbmove_advanced, qbmove_maker_pro,", "searched", "actuators"});
  }
}

TEST(TypeLibrary, TheFirstDirectoryWinsAndActuatorPathComesBeforeTheShippedOnes) {
  const Directory directory("path");
  directory.write("sea_example.toml", replaced(read(source_dir() / "actuators/sea_example.toml"), "value = 10.0", "value = 20.0"));
  const Environment path("VSA_ACTUATOR_PATH", "/nowhere::" + directory.path().string());
  const Environment data("VSA_DATA_DIR", VSA_SOURCE_DIR);
  const TypeLibrary library;
  EXPECT_EQ(library.load("sea_example").unit.actuator.transmission->evaluate({}).curvature.qq, 20.0);
  EXPECT_EQ(library.load("qbmove_maker_pro").name, "qbmove_maker_pro");
  EXPECT_EQ(library.directories().size(), 3u);
}

TEST(TypeLibrary, OldSpellingsAreUnderstoodAndTold) {
  const Directory data("data"), own("own");
  std::string text = read(source_dir() / "actuators/sea_example.toml");
  text = replaced(text, "[type]", "[preset]");
  std::filesystem::create_directory(data.path() / "presets");
  std::ofstream(data.path() / "presets" / "sea_example.toml") << text;
  const Environment set("VSA_DATA_DIR", data.path().string()), path("VSA_PRESET_PATH", own.path().string());
  EXPECT_EQ(config::data_directory(), data.path());
  const TypeLibrary library;
  ASSERT_EQ(library.notices().size(), 2u);
  expect_pieces(library.notices()[0], {"VSA_PRESET_PATH is called VSA_ACTUATOR_PATH now"});
  expect_pieces(library.notices()[1], {"presets is called actuators now"});
  const config::ActuatorType type = library.load("sea_example");
  EXPECT_FALSE(type.title.empty());
  ASSERT_EQ(type.notices.size(), 1u);
  expect_pieces(type.notices[0], {"sea_example.toml:", "[preset] is called [type] now"});
  EXPECT_TRUE(shipped().load("sea_example").notices.empty());
  EXPECT_TRUE(shipped().notices().empty());
}

TEST(TypeLibrary, AListenerHearsOldSpellingsOfLibrariesTypesAndTheirBases) {
  const Directory own("own");
  own.write("base_of_old.toml", replaced(replaced(read(source_dir() / "actuators/sea_example.toml"), "[type]", "[preset]"),
                                         "name = \"sea_example\"", "name = \"base_of_old\""));
  own.write("made_of_it.toml", "[type]\nname = \"made_of_it\"\ntitle = \"T\"\nbase = \"base_of_old\"\n");
  const Environment path("VSA_PRESET_PATH", own.path().string());
  std::vector<std::string> heard;
  config::listen_to_notices([&](const std::string& notice) { heard.push_back(notice); });
  static_cast<void>(TypeLibrary().load("made_of_it"));
  config::listen_to_notices({});
  static_cast<void>(TypeLibrary().load("made_of_it"));
  ASSERT_EQ(heard.size(), 2u);
  expect_pieces(heard[0], {"VSA_PRESET_PATH is called VSA_ACTUATOR_PATH now"});
  expect_pieces(heard[1], {"base_of_old.toml:", "[preset] is called [type] now"});
}

TEST(DataDirectory, IsFoundFromAnExecutableInTheBuildTree) {
  EXPECT_TRUE(std::filesystem::exists(config::data_directory() / "actuators"));
  ASSERT_TRUE(config::find_data("actuators/sea_example.toml").has_value());
  EXPECT_FALSE(config::find_data("no such thing").has_value());
  EXPECT_EQ(config::data_directories().front().filename(), "vsa");
  EXPECT_EQ(config::data_directories().front().parent_path().filename(), "share");
}

TEST(DataDirectory, FromTheEnvironmentIsTheOnlyOne) {
  const Environment data("VSA_DATA_DIR", "/nowhere");
  EXPECT_EQ(config::data_directories(), std::vector<std::filesystem::path>{"/nowhere"});
  const auto problems = problems_of([] { (void)config::data_directory(); });
  expect_pieces(text_of(problems), {"VSA_DATA_DIR", "/nowhere", "has no actuators/"});
  EXPECT_TRUE(TypeLibrary().names().empty());
}

TEST(DataDirectory, OfAModuleIsItsOwnAndTheEnvironmentStillComesFirst) {
  config::loaded_with("/a/module");
  EXPECT_EQ(config::data_directories(), std::vector<std::filesystem::path>{"/a/module"});
  {
    const Environment data("VSA_DATA_DIR", "/nowhere");
    EXPECT_EQ(config::data_directories(), std::vector<std::filesystem::path>{"/nowhere"});
  }
  config::loaded_with(nullptr);
  EXPECT_NE(config::data_directories().front(), "/a/module");
}

/// A type that differs from its base, beside it or in the library.
std::string derived(const std::string& base, const std::string& rest, const std::string& name = "mine") {
  return "[type]\nname = \"" + name + "\"\ntitle = \"mine\"\nbase = \"" + base + "\"\n" + rest;
}
const std::string kStiffer =
    "[elastic]\nstiffness_Nm_per_rad = { value = 20.0, unit = \"N·m/rad\", bounds = [1.0, 100.0], source = \"mine\" }\n";

TEST(Base, HasWhateverATypeHasnt) {
  const config::ActuatorType base = shipped().load("sea_example");
  const config::ActuatorType mine = shipped().load_text(derived("sea_example", kStiffer), "mine.toml");
  EXPECT_EQ(mine.name, "mine");
  EXPECT_EQ(mine.base, "sea_example");
  EXPECT_EQ(mine.rank, "") << "a base's rank isn't that of what was made of it";
  EXPECT_FALSE(mine.evidence) << "nor its evidence";
  EXPECT_EQ(mine.unit.actuator.transmission->evaluate({}).curvature.qq, 20.0);
  ASSERT_EQ(mine.entries.size(), base.entries.size());
  for (const config::Entry& e : base.entries) {
    const auto same =
        std::find_if(mine.entries.begin(), mine.entries.end(), [&](const config::Entry& m) { return m.key == e.key; });
    ASSERT_NE(same, mine.entries.end()) << e.key;
    const bool own = e.key == "elastic.stiffness_Nm_per_rad";
    EXPECT_EQ(same->value, own ? "20" : e.value);
    const bool given = e.source.rfind("default:", 0) != 0;  // the base hasn't it either
    EXPECT_EQ(same->source, own ? "mine" : given ? "as sea_example: " + e.source : e.source);
  }
  EXPECT_EQ(shipped()
                .load_text(derived("sea_example", kStiffer), "mine.toml", {{"shaft.friction_Nm", "0.5"}})
                .unit.actuator.shaft_friction.coulomb_Nm,
            0.5);
}

TEST(Mass, IsWhatTheFileStatesAndNoBaseStatesItForAnother) {
  const config::ActuatorType maker = shipped().load("qbmove_maker_pro_6_1");
  ASSERT_TRUE(maker.mass_kg);
  EXPECT_EQ(maker.mass_kg->value, 0.45);
  EXPECT_FALSE(maker.mass_kg->source.empty());
  const auto with = [](const std::string& mass) {
    return shipped().load_text(replaced(derived("qbmove_maker_pro_6_1", ""), "base", mass + "\nbase"), "mine.toml");
  };
  EXPECT_FALSE(with("").mass_kg);
  EXPECT_EQ(with("mass_kg = { value = 2, unit = \"kg\", source = \"scales\" }").mass_kg->value, 2);
  const auto told = [&](const std::string& mass) { return text_of(problems_of([&] { (void)with(mass); })); };
  expect_pieces(told("mass_kg = 2"), {"mine.toml:4: type.mass_kg", "must be a table"});
  expect_pieces(told("mass_kg = { value = -2, unit = \"g\", colour = \"red\" }"),
                {"type.mass_kg.value", "out of range", "type.mass_kg.unit", "kg", "type.mass_kg.source", "type.mass_kg.colour"});
}

TEST(Base, OfAnotherLawGivesNothingOfThatLaw) {
  const std::string law =
      "[elastic]\nlaw = \"series_spring\"\nstiffness_Nm_per_rad = { value = 20.0, unit = \"N·m/rad\", bounds = "
      "[1.0, 100.0], source = \"mine\" }\n";
  const config::ActuatorType mine = shipped().load_text(derived("qbmove_maker_pro_paper", law), "mine.toml");
  EXPECT_EQ(mine.law, "series_spring");
  EXPECT_EQ(mine.unit.preset_max, 0.0);
  EXPECT_EQ(mine.unit.actuator.side[0].motor.resistance_Ohm,
            shipped().load("qbmove_maker_pro_paper").unit.actuator.side[0].motor.resistance_Ohm);
  const auto missing = problems_of(
      [&] { (void)shipped().load_text(derived("qbmove_maker_pro_paper", "[elastic]\nlaw = \"two_exp\"\n"), "mine.toml"); });
  EXPECT_EQ(missing.size(), 4u) << "its four numbers; limits.preset_max is in the law's unit, which nobody knows:\n"
                                << text_of(missing);
}

TEST(Base, MayHaveABaseItself) {
  const Directory directory("bases");
  directory.write("first.toml", derived("sea_example", kStiffer, "first"));
  const auto file = directory.write("mine.toml", derived("first",
                                                         "[shaft]\nfriction_Nm = { value = 0.5, unit = \"N·m\", bounds = "
                                                         "[0.0, 1.0], source = \"mine\" }\n"));
  const config::ActuatorType mine = shipped().load_file(file);  // its base is beside it, that one's in the library
  EXPECT_EQ(mine.unit.actuator.transmission->evaluate({}).curvature.qq, 20.0);
  EXPECT_EQ(mine.unit.actuator.shaft_friction.coulomb_Nm, 0.5);
}

TEST(Base, ThatIsWrongIsToldWhereItStands) {
  const Directory directory("wrong_bases");
  const auto told = [&](const std::string& text) {
    return text_of(problems_of([&] { (void)shipped().load_text(text, (directory.path() / "mine.toml").string()); }));
  };
  expect_pieces(told(derived("sea_exmaple", kStiffer)), {"mine.toml:4: type.base", "did you mean sea_example?"});
  expect_pieces(told(derived("../sea_example", kStiffer)), {"type.base", "unknown actuator type"});
  directory.write("mine.toml", derived("mine", kStiffer));
  expect_pieces(told(derived("mine", kStiffer)), {"goes in a circle: mine → mine"});
  directory.write("one.toml", derived("two", "", "one"));
  directory.write("two.toml", derived("one", "", "two"));
  expect_pieces(told(derived("one", kStiffer)), {"two.toml:4", "goes in a circle: mine → one → two → one"});
  directory.write("bad.toml", replaced(read(source_dir() / "actuators/sea_example.toml"), "value = 2.3", "value = -2.3"));
  expect_pieces(told(derived("bad", kStiffer)), {"bad.toml:", "drive.resistance_Ohm"});
  directory.write("rank.toml", derived("sea_example", kStiffer, "rank"));
  expect_pieces(text_of(problems_of([&] {
                  (void)shipped().load_text(replaced(derived("sea_example", kStiffer), "base", "rank = \"best\"\nbase"),
                                            "mine.toml");
                })),
                {"type.rank", "measured, published, symbolic"});
}

TEST(LawRegistry, HasTheStandardLawsAndTakesMore) {
  config::LawRegistry laws = config::LawRegistry::standard();
  std::vector<std::string> known;
  for (const elastic::Law* law : elastic::laws()) known.emplace_back(law->name);
  EXPECT_EQ(laws.names(), known) << "by name";
  laws.add("mine", [](config::LawReader&) { return nullptr; });
  EXPECT_NE(laws.find("mine"), nullptr);
  EXPECT_EQ(laws.find("yours"), nullptr);
}

TEST(LawRegistry, AFactorysOwnComplaintIsAProblemOfTheType) {
  const Directory directory("complaint");
  const auto file = directory.write("sea_example.toml", read(source_dir() / "actuators/sea_example.toml"));
  config::LawRegistry laws = config::LawRegistry::standard();
  laws.add("series_spring", [](config::LawReader& reader) -> std::shared_ptr<const elastic::Transmission> {
    (void)reader.number("stiffness_Nm_per_rad", "N·m/rad", 0, 1e6, "stiffness");
    throw InputError(Problem{"", "stiffness_Nm_per_rad", "10", "is too soft for this test", "11"});
  });
  const auto problems = problems_of([&] { (void)TypeLibrary({directory.path()}, laws).load("sea_example"); });
  ASSERT_EQ(problems.size(), 1u) << text_of(problems);
  EXPECT_EQ(problems[0].key, "elastic.stiffness_Nm_per_rad");
  EXPECT_EQ(problems[0].file, file.string() + ":12");
  laws.add("series_spring", [](config::LawReader& reader) {
    (void)reader.number("stiffness_Nm_per_rad", "N·m/rad", 0, 1e6, "stiffness");
    return nullptr;
  });
  expect_pieces(text_of(problems_of([&] { (void)TypeLibrary({directory.path()}, laws).load("sea_example"); })),
                {"returned nothing"});
}

TEST(Text, OfANumberIsTheShortestThatReadsBackTheSame) {
  const std::pair<double, const char*> table[] = {
      {0.1, "0.1"}, {-30000, "-30000"}, {2e6, "2000000"}, {1e-6, "1e-06"}, {1.0 / 3, "0.3333333333333333"},
      {0, "0"},     {6.85, "6.85"}};
  for (const auto& [value, text] : table) {
    EXPECT_EQ(config::number_text(value), text);
    EXPECT_EQ(config::parse_number(text), value);
  }
}

TEST(Text, NumbersDoNotDependOnTheLocale) {
  // Not every machine has a locale with a comma; where there is none the test shows the "C" locale only.
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  }
  EXPECT_EQ(config::parse_number("0.5"), 0.5);
  EXPECT_EQ(config::parse_number("0,5"), std::nullopt);
  EXPECT_EQ(config::number_text(0.5), "0.5");
  std::setlocale(LC_ALL, before.c_str());
}

TEST(Documentation, NamesEveryKeyUnitAndBoundOfTheSchema) {
  const std::string text = read(source_dir() / "docs/reference/config.md");
  const auto expect_row = [&](const std::string& key, const std::string& unit, const std::string& bounds,
                              std::string_view meaning) {
    const std::size_t at = text.find("| `" + key + "` |");
    ASSERT_NE(at, std::string::npos) << key << " has no row in docs/reference/config.md";
    const std::string row = text.substr(at, text.find('\n', at) - at);
    expect_pieces(row, {unit, bounds, std::string(meaning)});
  };
  for (const config::Parameter& p : config::parameters()) {
    if (p.second) {
      EXPECT_NE(text.find('`' + std::string(p.key) + '`'), std::string::npos) << p.key;
      continue;
    }
    const bool numeric = p.kind == config::Kind::number || p.kind == config::Kind::integer;
    expect_row(std::string(p.key), std::string(p.unit), numeric ? config::range_text(p.min, p.max) : "", p.meaning);
    if (p.need == config::Need::defaulted)
      expect_row(std::string(p.key), "", "`" + std::string(p.default_value) + "`", p.default_source);
  }
  for (const elastic::Law* law : elastic::laws()) {
    const std::size_t heading = text.find("| `" + std::string(law->name) + "` |");
    ASSERT_NE(heading, std::string::npos) << law->name << " has no row";
    expect_pieces(text.substr(heading, text.find('\n', heading) - heading),
                  {std::string(law->title), std::string(law->equation), std::string(law->source)});
    for (const elastic::LawParameter& p : law->parameters) {
      const std::string row = "| `" + std::string(law->name) + "` | `elastic." + std::string(p.key) + "` |";
      const std::size_t at = text.find(row);
      ASSERT_NE(at, std::string::npos) << row;
      expect_pieces(text.substr(at, text.find('\n', at) - at),
                    {std::string(p.unit), config::range_text(p.min, p.max), std::string(p.meaning)});
    }
    if (law->file == nullptr) continue;
    const std::string row = "| `" + std::string(law->name) + "` | `elastic." + std::string(law->file->key) + "` |";
    EXPECT_NE(text.find(row), std::string::npos) << row;
    for (const elastic::LawColumn& c : law->file->columns)
      expect_row(std::string(c.name), "", config::range_text(c.min, c.max), c.meaning);
  }
}

TEST(Base, GivesItsTendonsWithItsSprings) {
  const std::string levers =
      "[elastic]\nlaw = \"lever_spring\"\n"
      "spring_N_per_m = { value = 5000.0, unit = \"N/m\", bounds = [100.0, 1e6], source = \"x\" }\n"
      "start_m = { value = 0.02, unit = \"m\", bounds = [0.0, 0.1], source = \"x\" }\n"
      "screw_m_per_rad = { value = 0.01, unit = \"m/rad\", bounds = [1e-4, 0.1], source = \"x\" }\n"
      "[limits]\npreset_max = { value = 1.5, unit = \"rad\", bounds = [0.0, 1.5], source = \"x\" }\n";
  ASSERT_GT(shipped().load("qbmove_maker_pro").unit.actuator.tendon.friction, 0);
  const config::ActuatorType mine = shipped().load_text(derived("qbmove_maker_pro", levers), "mine.toml");
  EXPECT_EQ(mine.unit.actuator.tendon.friction, 0);
  const auto entry =
      std::find_if(mine.entries.begin(), mine.entries.end(), [](const auto& e) { return e.key == "tendon.friction"; });
  ASSERT_NE(entry, mine.entries.end());
  EXPECT_NE(entry->source.find("springs that this law hasn't"), std::string::npos) << entry->source;
  // One of one's own is refused, where it stands.
  const std::string own = levers + "[tendon]\nfriction = { value = 0.1, unit = \"1\", bounds = [0.0, 0.5], source = \"x\" }\n";
  expect_pieces(text_of(problems_of([&] { (void)shipped().load_text(derived("qbmove_maker_pro", own), "mine.toml"); })),
                {"mine.toml:13: tendon.friction", "names no spring"});
  // Springs of their own keep them.
  const config::ActuatorType softer = shipped().load("qbmove_maker_pro", {{"elastic.k1_Nm", "0.02"}});
  EXPECT_GT(softer.unit.actuator.tendon.friction, 0);
}

}  // namespace
}  // namespace vsa::test
