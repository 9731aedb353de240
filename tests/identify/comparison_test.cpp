// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Hypotheses side by side: what their file may say, what a fit depends on, and how they are judged.
#include "vsa/identify/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "closed_form.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::identify {
namespace {

namespace fs = std::filesystem;

const fs::path kData = fs::path(VSA_SOURCE_DIR) / "data" / "qbmove_maker_pro";

constexpr const char* kSettings = R"([compare]
recordings = ["RECORDINGS/stiffness_preset_0.0000rad_branches.csv", "RECORDINGS/stiffness_preset_0.6903rad_branches.csv"]
starts = 1
iterations = 1
[bench]
period_s = 3
amplitude_rad = 2.0
)";
constexpr const char* kStiff = R"([[hypothesis]]
name = "stiff"
base = "qbmove_maker_pro"
set = { "firmware.max_stiffness_raw" = 32000, "drive.off_mode" = "coast", "firmware.limits_on" = true }
start = { "tendon.friction" = 0.05 }
free = ["tendon.friction"]
)";
constexpr const char* kFixed = R"([[hypothesis]]
name = "fixed"
title = "nothing free"
base = "qbmove_maker_pro"
free = []
)";

class ComparisonFile : public testing::Test {
 protected:
  ComparisonFile()
      : directory_(fs::temp_directory_path() /
                   ("vsa_comparison_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    fs::create_directories(directory_);
  }
  ~ComparisonFile() override { fs::remove_all(directory_); }

  Comparison read(std::string text) const {
    constexpr std::string_view kMark = "RECORDINGS";
    for (std::size_t at = text.find(kMark); at != std::string::npos; at = text.find(kMark))
      text.replace(at, kMark.size(), kData.string());
    std::ofstream(directory_ / "file.toml") << text;
    return read_comparison(directory_ / "file.toml", test::shipped());
  }
  /// All that is wrong, as one text.
  std::string problems(const std::string& text) const {
    try {
      (void)read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing";
  }
  fs::path directory_;
};

#define EXPECT_TOLD(text, part) EXPECT_NE((text).find(part), std::string::npos) << "no '" << (part) << "' in:\n" << (text)

TEST_F(ComparisonFile, GivesItsSettingsAndItsHypotheses) {
  const Comparison c = read(std::string(kSettings) + kStiff + kFixed);
  EXPECT_EQ(c.fit.starts, 1);
  EXPECT_EQ(c.sweep.period_s, 3);
  ASSERT_EQ(c.recordings.size(), 2u);
  EXPECT_GT(c.recordings[1].weight, 100) << "by its scatter";
  ASSERT_EQ(c.hypotheses.size(), 2u);
  EXPECT_EQ(c.hypotheses[0].type.unit.memory.max_stiffness, 32000);
  EXPECT_FALSE(c.hypotheses[0].type.unit.actuator.side[0].bridge.brake_when_off);
  EXPECT_EQ(c.hypotheses[0].free.size(), 1u);
  EXPECT_EQ(c.hypotheses[1].title, "nothing free");
  EXPECT_TRUE(c.hypotheses[1].free.empty());
  EXPECT_EQ(requests(c).size(), 6u);
  EXPECT_EQ(request_name(c, requests(c)[2]), "stiff.without.stiffness_preset_0.6903rad_branches");
}

TEST_F(ComparisonFile, TakesAPresetBesideItAndStartsOfFreeKeysThatThePresetLacks) {
  std::ifstream shipped(fs::path(VSA_SOURCE_DIR) / "actuators" / "qbmove_maker_pro.toml");
  std::string type{std::istreambuf_iterator<char>(shipped), {}};
  type.replace(type.find("\"qbmove_maker_pro\""), 18, "\"mine\"");
  std::ofstream(directory_ / "mine.toml") << type;
  const Comparison c = read(std::string(kSettings) + R"([[hypothesis]]
name = "back"
base = "mine.toml"
start = { "drive.back_loss" = 0.25 }
free = ["drive.back_loss"]
)");
  EXPECT_EQ(c.hypotheses[0].type.name, "mine");
  EXPECT_EQ(c.hypotheses[0].free[0].start, 0.25);
  std::ofstream(directory_ / "mine.toml") << "nonsense";
  EXPECT_TOLD(problems(std::string(kSettings) + "[[hypothesis]]\nname = \"a\"\nbase = \"mine.toml\"\nfree = []\n"), "mine.toml");
}

TEST_F(ComparisonFile, ThatIsWrongIsToldAllAtOnceWithItsPlace) {
  const std::string told = problems(R"([compare]
recordings = ["no_such_preset_0.1rad.csv"]
starts = 0
colour = "red"
[[hypothesis]]
name = "one"
base = "qbmove_maker_pro"
set = { "tendon.friction" = 0.1, "shaft.frictoin_Nm" = 1 }
free = ["tendon.friction"]
[[hypothesis]]
name = "one"
base = "qbmove_maker_por"
free = ["shaft.friction_Nm"]
[[hypothesis]]
name = "a b"
base = "qbmove_maker_pro"
free = ["shaft.nothing"]
start = { "drive.load_loss" = 1 }
fre = 3
)");
  for (const char* part :
       {"starts = 0", "colour: unknown key", "is both set and free", "shaft.frictoin_Nm", "is there twice", "qbmove_maker_por",
        "isn't a name", "shaft.nothing", "isn't free", "fre: unknown key", "no such file", "hypothesis a b"})
    EXPECT_TOLD(told, part);
}

TEST_F(ComparisonFile, SaysWhatTheBenchCarries) {
  const std::string lighter = std::string(kSettings) + "load_kg = 0.5\n" + kFixed;
  const Comparison c = read(lighter), one = read(std::string(kSettings) + kFixed);
  EXPECT_EQ(c.sweep.load_share, 0.5);
  EXPECT_EQ(one.sweep.load_share, 1);
  const FitRequest all{0, std::nullopt};
  EXPECT_NE(request_hashes(c, {all}, 2), request_hashes(one, {all}, 2)) << "another bench, another fit";
  EXPECT_TOLD(problems(std::string(kSettings) + "load_kg = 0\n" + kFixed), "load_kg = 0");
}

TEST_F(ComparisonFile, WithoutHypothesesOrRecordingsIsRefused) {
  EXPECT_TOLD(problems(kSettings), "one [[hypothesis]] or more");
  EXPECT_TOLD(problems(std::string("[compare]\nrecordings = []\n") + kFixed), "one CSV file or more");
  EXPECT_TOLD(problems(kFixed), "compare: is missing");
  EXPECT_TOLD(problems("[compare"), "file.toml:1");
}

TEST_F(ComparisonFile, WithAPresetThatAHypothesisCantTakeIsRefused) {
  const std::string told = problems(std::string(kSettings) + R"([[hypothesis]]
name = "narrow"
base = "qbmove_maker_pro"
set = { "limits.preset_max" = 0.5 }
free = []
)");
  EXPECT_TOLD(told, "hypothesis narrow");
  EXPECT_TOLD(told, "beyond what");
}

TEST(Comparison, OfTheShippedFileReads) {
  const Comparison c = read_comparison(kData / "hypotheses.toml", test::shipped());
  EXPECT_GE(c.hypotheses.size(), 6u);
  EXPECT_EQ(c.recordings.size(), 2u);
  for (const Hypothesis& h : c.hypotheses) EXPECT_FALSE(h.free.empty()) << h.name;
}

TEST_F(ComparisonFile, AFitsHashChangesWithWhatItDependsOnAndNotWithWhatItIsCalled) {
  const auto hashes = [&](const Comparison& c) { return request_hashes(c, requests(c), 1); };
  const std::string text = std::string(kSettings) + kFixed;
  const auto before = hashes(read(text));
  ASSERT_EQ(before.size(), 3u);
  EXPECT_NE(before[0], before[1]) << "with and without a recording";
  EXPECT_NE(before[1], before[2]);
  Comparison other = read(text);
  other.hypotheses[0].title = "another";
  EXPECT_EQ(hashes(other), before);
  other.fit.seed = 7;
  EXPECT_NE(hashes(other)[0], before[0]);
  other = read(text);
  other.recordings[1].data.rising_rad[20] += 1e-4;
  EXPECT_NE(hashes(other)[0], before[0]);
  EXPECT_NE(hashes(read(std::string(kSettings) + kFixed + "set = { \"shaft.friction_Nm\" = 0.03 }\n"))[0], before[0]);
}

TEST_F(ComparisonFile, AFitJudgesTheRecordingThatItDidntSeeAndIsTheSameOnAnyThreads) {
  Comparison c = read(std::string(kSettings) + kStiff);
  c.sweep.period_s = 6;  // as slow as it takes that the estimates aren't at a bound
  const FitRecord one = run_fit(c, {0, 1}, 1), two = run_fit(c, {0, 1}, 2);
  ASSERT_EQ(one.rms_rad.size(), 2u);
  EXPECT_EQ(one.rms_rad, two.rms_rad);
  EXPECT_EQ(one.estimates[0].value, two.estimates[0].value);
  // The prediction is what a hypothesis that holds the estimate gives.
  std::string held = kFixed;
  held += "set = { \"firmware.max_stiffness_raw\" = 32000, \"drive.off_mode\" = \"coast\", \"tendon.friction\" = " +
          config::number_text(one.estimates[0].value) + " }\n";
  Comparison fixed = read(std::string(kSettings) + held);
  fixed.sweep.period_s = 6;
  EXPECT_EQ(run_fit(fixed, {0, {}}, 1).rms_rad[1], one.rms_rad[1]);
  EXPECT_NE(run_fit(c, {0, {}}, 1).rms_rad[1], one.rms_rad[1]) << "it was left out";
  EXPECT_NEAR(one.weighted_squares, std::pow(c.recordings[0].weight * one.rms_rad[0], 2) * one.points, 1e-6 * one.weighted_squares);
}

TEST_F(ComparisonFile, AHypothesisWithoutFreeParametersIsOnlyJudged) {
  const Comparison c = read(std::string(kSettings) + kFixed);
  const FitRecord whole = run_fit(c, {0, {}}, 1), part = run_fit(c, {0, 0}, 1);
  EXPECT_TRUE(whole.estimates.empty());
  EXPECT_EQ(whole.rms_rad, part.rms_rad);
  EXPECT_EQ(whole.start_rms.size(), 1u);
}

TEST(Aicc, WeighsSquaresAgainstParametersByTheIndependentPoints) {
  // N = 20, p = 3: 20 ln(50/100) + 8 + 40/15
  EXPECT_NEAR(aicc(50, 100, 20, 3), 20 * std::log(0.5) + 8 + 40.0 / 15, 1e-12);
  EXPECT_LT(aicc(50, 100, 20, 3), aicc(50, 100, 20, 4));
  EXPECT_TRUE(std::isnan(aicc(50, 100, 5, 4))) << "as many parameters as points";
}

TEST(Aicc, CountsEveryHypothesisByTheBestOnesIndependentPoints) {
  Comparison c;
  c.hypotheses.resize(2);
  c.hypotheses[1].free.resize(1);
  FitRecord far, near;
  far.weighted_squares = 400;
  near.weighted_squares = 100;
  far.points = near.points = 100;
  far.independent = 5;
  near.independent = 30;
  far.seconds = 2;
  const std::vector<Judgement> rows = judge(c, {far, near});
  EXPECT_EQ(rows[0].aicc, aicc(400, 100, 30, 0));
  EXPECT_EQ(rows[1].aicc, aicc(100, 100, 30, 1));
  EXPECT_EQ(rows[0].seconds, 2);
}

}  // namespace
}  // namespace vsa::identify
