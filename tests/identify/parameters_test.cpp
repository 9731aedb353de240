// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The --parameters text and the type's file that comes out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "closed_form.hpp"
#include "vsa/errors.hpp"
#include "vsa/identify/type_file.hpp"

namespace vsa::identify {
namespace {

using test::paper_type;
using test::shipped;

std::vector<std::string> told(const std::string& text) {
  std::vector<std::string> out;
  try {
    (void)parse_parameters(text, paper_type());
  } catch (const InputError& error) {
    for (const Problem& p : error.problems()) out.push_back(p.text());
  }
  return out;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Parameters, HaveStartUnitAndBoundsOfThePreset) {
  const auto p = parse_parameters("elastic.k1_Nm=elastic.k2_Nm, shaft.friction_Nm", paper_type());
  ASSERT_EQ(p.size(), 2u);
  EXPECT_EQ(p[0].keys, (std::vector<std::string>{"elastic.k1_Nm", "elastic.k2_Nm"}));
  EXPECT_EQ(p[0].unit, "N·m");
  EXPECT_EQ(p[0].start, 0.0227);
  EXPECT_EQ(p[0].min, 1e-6);
  EXPECT_EQ(p[1].name, "shaft.friction_Nm");
  EXPECT_GT(p[1].max, p[1].start);
}

TEST(Parameters, ThatAreWrongAreAllToldAtOnce) {
  EXPECT_EQ(told("elastic.k1_Nm,shaft.frictoin_Nm,drive.off_mode,sensor.encoder_bits,elastic.k1_Nm").size(), 4u);
  EXPECT_TRUE(has(told("shaft.frictoin_Nm").at(0), "shaft.friction_Nm")) << "the nearest key is offered";
  EXPECT_TRUE(has(told("foo").at(0), "has no such key (allowed: keys with a unit and bounds")) << told("foo").at(0);
  EXPECT_FALSE(has(told("drive.off_mod").at(0), "drive.off_mode")) << "what would be refused next isn't offered";
  EXPECT_TRUE(has(told("drive.off_mode").at(0), "isn't a real number"));
  EXPECT_TRUE(has(told("firmware.limits_on").at(0), "isn't a real number"));
  EXPECT_TRUE(has(told("sensor.encoder_bits").at(0), "isn't a real number")) << "a whole number has no derivative";
  EXPECT_TRUE(has(told("elastic.k1_Nm,elastic.k1_Nm").at(0), "twice"));
  EXPECT_TRUE(has(told("elastic.k1_Nm=elastic.a1_per_rad").at(0), "another unit"));
  EXPECT_TRUE(has(told("elastic.k1_Nm,,shaft.friction_Nm").at(0), "a key is missing"));
  EXPECT_TRUE(has(told("").at(0), "a key is missing"));
}

TEST(Parameters, AreCountedInTheirLogarithmWhereTheirBoundsSpanDecades) {
  const auto p = parse_parameters("elastic.k1_Nm=elastic.k2_Nm,shaft.friction_Nm", paper_type());
  ASSERT_TRUE(p[0].logarithmic());
  EXPECT_FALSE(p[1].logarithmic()) << "its bound is 0";
  EXPECT_NEAR(p[0].value_at(p[0].coordinate(1e-3) + std::log(2.0)), 2e-3, 1e-12);
  EXPECT_EQ(p[0].value_at(p[0].coordinate(p[0].min) - 1), p[0].min);
  EXPECT_EQ(p[0].value_at(p[0].coordinate(p[0].max)), p[0].max) << "the bound itself, and not what exp(ln) makes of it";
  EXPECT_EQ(p[1].coordinate(0.03), 0.03);
}

TEST(Parameters, BecomeOverridesOfEveryTiedKey) {
  const auto p = parse_parameters("elastic.k1_Nm=elastic.k2_Nm,shaft.friction_Nm", paper_type());
  const auto o = overrides(p, {0.03, 0.02});
  ASSERT_EQ(o.size(), 3u);
  EXPECT_EQ(o[1].key, "elastic.k2_Nm");
  EXPECT_EQ(o[1].value, "0.03");
  EXPECT_EQ(o[2].value, "0.02");
}

TEST(Parameters, TakeThePlaceOfOverridesOfTheirKeys) {
  const auto p = parse_parameters("elastic.k1_Nm=elastic.k2_Nm", paper_type());
  const auto o = overrides(p, {0.03}, {{"elastic.k2_Nm", "0.5"}, {"shaft.friction_Nm", "0.1"}});
  ASSERT_EQ(o.size(), 3u);
  EXPECT_EQ(o[0].key, "shaft.friction_Nm");
  EXPECT_EQ(o[2].key, "elastic.k2_Nm");
  EXPECT_EQ(o[2].value, "0.03");
}

TEST(Rounding, KeepsSignificantDigits) {
  EXPECT_EQ(rounded(0.0123456, 3), 0.0123);
  EXPECT_EQ(rounded(-98765.0, 2), -99000.0);
  EXPECT_EQ(rounded(0.0, 4), 0.0);
}

TEST(ScatterWeight, OfWhatTellsNoScatterIsThatOfTheOthers) {
  std::vector<Observation> all(3);
  for (Observation& o : all) o.data = test::closed_form(test::kTruth, 0);
  for (auto* sd : {&all[1].data.sd_rising_rad, &all[1].data.sd_falling_rad}) sd->assign(sd->size(), std::nan(""));
  weigh_by_scatter(all);
  EXPECT_NEAR(all[1].weight, 1 / 0.003, 1e-6);
  EXPECT_NEAR(all[2].weight, 1 / 0.003, 1e-6);
  weigh_by_scatter(std::span(all).subspan(1, 1));
  EXPECT_EQ(all[1].weight, scatter_weight(all[1].data)) << "alone it has no others";
}

TEST(ScatterWeight, IsTheInverseOfTheScatter) { EXPECT_NEAR(scatter_weight(test::closed_form(test::kTruth, 0)), 1 / 0.003, 1e-6); }

const config::Evidence kFitted{{"stiffness.0.6903", "stiffness.0.4602"}, "vsa identify \"a.csv\""};

TEST(TypeFile, SaysWhatItWasFittedToBesideWhatThePresetHadBeen) {
  const config::TypeLibrary library = shipped();
  const auto written = [&](const config::ActuatorType& before) {
    return library.load_text(type_text(before, "new_one", {}, kFitted, library), "new_one.toml").evidence.value();
  };
  config::ActuatorType before = library.load("sea_example");
  before.evidence = config::Evidence{{"speed.0.7500", "stiffness.0.6903"}, "by hand"};
  EXPECT_EQ(written(before).calibrated_on, (std::vector<std::string>{"speed.0.7500", "stiffness.0.6903", "stiffness.0.4602"}));
  EXPECT_EQ(written(before).source, "by hand; vsa identify \"a.csv\"");
  before.evidence = written(before);
  EXPECT_EQ(written(before).source, "by hand; vsa identify \"a.csv\"") << "the same command again adds nothing";
  before.evidence.reset();
  EXPECT_EQ(written(before).calibrated_on, kFitted.calibrated_on);
  EXPECT_NE(written(before).source.find("doesn't say"), std::string::npos);
}

/// Every shipped type can be written with a changed value and reads back equal in all else.
TEST(TypeFile, KeepsWhatWasntIdentified) {
  const config::TypeLibrary library = shipped();
  for (const std::string& name : library.names()) {
    const config::ActuatorType before = library.load(name);
    const std::string text =
        type_text(before, "new_one", {{"shaft.friction_Nm", 0.0123, "identified: vsa \"identify\" \\ x"}}, kFitted, library);
    const config::ActuatorType after = library.load_text(text, "new_one.toml");
    ASSERT_EQ(after.entries.size(), before.entries.size()) << name;
    EXPECT_EQ(after.law, before.law);
    EXPECT_EQ(after.name, "new_one");
    for (const config::Entry& e : before.entries) {
      const auto it =
          std::find_if(after.entries.begin(), after.entries.end(), [&](const config::Entry& x) { return x.key == e.key; });
      ASSERT_NE(it, after.entries.end()) << e.key;
      EXPECT_EQ(it->unit, e.unit);
      EXPECT_EQ(it->bounds, e.bounds);
      const bool changed = e.key == "shaft.friction_Nm";
      EXPECT_EQ(it->value, changed ? "0.0123" : e.value) << e.key;
      EXPECT_EQ(it->source, changed ? "identified: vsa \"identify\" \\ x" : e.source) << e.key;
    }
  }
}

TEST(TypeFile, OfAValueBeyondItsBoundsIsRefused) {
  EXPECT_THROW((void)type_text(paper_type(), "new_one", {{"shaft.friction_Nm", -1.0, "x"}}, kFitted, shipped()), InputError);
}

}  // namespace
}  // namespace vsa::identify
