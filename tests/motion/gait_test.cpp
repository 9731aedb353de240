// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/motion/gait.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/gait_file.hpp"
#include "vsa/units.hpp"

namespace vsa::motion {
namespace {

namespace fs = std::filesystem;

const fs::path kGaits = fs::path(VSA_SOURCE_DIR) / "models" / "gaits";

constexpr const char* kGood = R"(title = "test"
frequency_rad_per_s = 4.71
ramp_s = 2.0
period_s = 0.01
[group.a]
actuators = ["x", "y"]
n = [0, 1]
amplitude_deg = 30.0
lambda = 5.0
preset_deg = 10.0
)";

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Gait, IsEquationTenWithTableTwo) {
  const Gait gait = Gait::load(kGaits / "sidewind.toml");
  const GaitGroup& v = group(gait, "vertical");
  const GaitGroup& h = group(gait, "horizontal");
  ASSERT_EQ(v.n, (std::vector<int>{1, 3, 5, 7, 9, 11}));
  ASSERT_EQ(h.n, (std::vector<int>{0, 2, 4, 6, 8, 10}));
  // Worked out apart from this program: A sin(4.71 t + n pi/5 + delta).
  EXPECT_NEAR(gait.equilibrium(v, 0, 3.0), 0.8515902672360913, 1e-12);
  EXPECT_NEAR(gait.equilibrium(v, 5, 7.25), -0.2267911963983377, 1e-12);
  EXPECT_NEAR(gait.equilibrium(h, 0, 3.0), 0.002501712991809006, 1e-12);
  EXPECT_NEAR(gait.equilibrium(h, 5, 7.25), -0.3201328898333732, 1e-12);
  EXPECT_NEAR(v.preset_rad, 35 * kPi / 180, 1e-15);
}

TEST(Gait, GrowsIntoTheWaveFromRest) {
  const Gait gait = Gait::load(kGaits / "sidewind.toml");
  const GaitGroup& v = group(gait, "vertical");
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(gait.equilibrium(v, k, 0.0), 0.0);
  EXPECT_NEAR(gait.equilibrium(v, 1, 1.0), 0.1606108139025735, 1e-12);  // half the amplitude after half of the ramp
}

TEST(Gait, VariantsTakeEverythingButThePresetFromTheirBase) {
  const Gait base = Gait::load(kGaits / "sidewind.toml");
  for (const auto& [file, preset] : {std::pair{"sidewind_soft.toml", 10.0},
                                     {"sidewind_stiff.toml", 44.9},
                                     {"steered_soft.toml", 10.0},
                                     {"steered_stiff.toml", 44.9}}) {
    const Gait variant = Gait::load(kGaits / file);
    for (const char* name : {"vertical", "horizontal"}) {
      EXPECT_NEAR(group(variant, name).preset_rad, preset * kPi / 180, 1e-15) << file;
      EXPECT_EQ(group(variant, name).actuators, group(base, name).actuators) << file;
      EXPECT_EQ(group(variant, name).amplitude_rad, group(base, name).amplitude_rad) << file;
    }
    EXPECT_EQ(variant.params().steering.has_value(), std::string(file).rfind("steered", 0) == 0) << file;
  }
}

TEST(Gait, NoVariantAsksForMoreThanAUnitAccepts) {
  for (const auto& entry : fs::directory_iterator(kGaits)) {
    const Gait gait = Gait::load(entry.path());
    for (const GaitGroup& g : gait.params().groups) EXPECT_LE(g.preset_rad, 0.785) << entry.path();
  }
}

TEST(GaitFile, ThatIsMissingIsNamed) { EXPECT_TRUE(says(problems_of("/nowhere/gait.toml"), "/nowhere/gait.toml")); }

TEST(GaitFile, WithBrokenSyntaxTellsTheLine) { EXPECT_TRUE(says(problems_of(written("title = \"a\"\nramp_s = = 2\n")), "line 2")); }

TEST(GaitFile, WithAnUnknownKeyNamesItAndTheKeysThereAre) {
  const std::string text = problems_of(written(replaced(kGood, "ramp_s", "ramp")));
  EXPECT_TRUE(says(text, "ramp = 2")) << text;
  EXPECT_TRUE(says(text, "unknown key")) << text;
  EXPECT_TRUE(says(text, "ramp_s")) << text;
}

TEST(GaitFile, WithNotANumberOrInfinityIsRefused) {
  EXPECT_TRUE(says(problems_of(written(replaced(kGood, "= 30.0", "= nan"))), "group.a.amplitude_deg"));
  EXPECT_TRUE(says(problems_of(written(replaced(kGood, "= 4.71", "= inf"))), "frequency_rad_per_s"));
}

TEST(GaitFile, WithATextForANumberIsRefused) {
  EXPECT_TRUE(says(problems_of(written(replaced(kGood, "= 30.0", "= \"30\""))), "not a number"));
}

TEST(GaitFile, ReportsAllItsMistakesAtOnce) {
  const std::string text = problems_of(written(replaced(replaced(kGood, "n = [0, 1]", "n = [0]"), "lambda = 5.0", "lambda = 0")));
  EXPECT_TRUE(says(text, "group.a.n")) << text;
  EXPECT_TRUE(says(text, "group.a.lambda")) << text;
}

TEST(GaitFile, WithAnActuatorListedTwiceIsRefused) {
  EXPECT_TRUE(says(problems_of(written(replaced(kGood, "[\"x\", \"y\"]", "[\"x\", \"x\"]"))), "listed twice"));
}

TEST(GaitFile, SteeringAGroupThatIsNotThereNamesThoseThatAre) {
  const std::string steering = "[steering]\ngroup = \"b\"\ngain = 1.0\nlimit_rad = 0.8\nslew_rad_per_s = 0.35\n";
  EXPECT_TRUE(says(problems_of(written(kGood + steering)), "steering.group = b: no such group (allowed: a)"));
}

TEST(GaitFile, WithoutAGroupIsRefused) {
  EXPECT_TRUE(says(problems_of(written("title = \"a\"\nfrequency_rad_per_s = 1.0\n")), "at least one [group.NAME]"));
}

TEST(GaitFile, ThatIsItsOwnBaseIsRefused) {
  EXPECT_TRUE(says(problems_of(written("base = \"vsa_gait_test.toml\"\n")), "too many bases"));
}

class Steering : public testing::Test {
 protected:
  /// Walks along `angle_rad` with `speed` for so many control periods of 10 ms.
  void walk(double angle_rad, double speed, int periods) {
    for (int i = 0; i < periods; ++i) {
      x_ += speed * 0.01 * std::cos(angle_rad);
      y_ += speed * 0.01 * std::sin(angle_rad);
      const double before = state_.phase_rad;
      steer(params_, state_, {x_, y_}, 133, 0.01, true);
      fastest_ = std::max(fastest_, std::abs(state_.phase_rad - before) / 0.01);
      largest_ = std::max(largest_, std::abs(state_.phase_rad));
    }
  }
  SteeringParams params_{"horizontal", 1.0, 0.8, 0.35, 0.03, 0.0};
  SteeringState state_;
  double x_ = 0, y_ = 0, fastest_ = 0, largest_ = 0;
};

TEST_F(Steering, GoesToGainTimesErrorAndStaysThere) {
  walk(-0.3, 0.3, 1000);
  EXPECT_NEAR(state_.phase_rad, 0.3, 1e-9);
}

TEST_F(Steering, NeverExceedsItsLimit) {
  walk(-2.5, 0.3, 1000);
  EXPECT_DOUBLE_EQ(largest_, 0.8);
  EXPECT_DOUBLE_EQ(state_.phase_rad, 0.8);
}

TEST_F(Steering, NeverMovesFasterThanItsSlewRate) {
  walk(-2.5, 0.3, 400);
  walk(2.5, 0.3, 400);
  EXPECT_NEAR(fastest_, 0.35, 1e-9);
}

TEST_F(Steering, TakesTheShortWayRound) {
  params_.target_rad = 3.0;
  walk(-3.0, 0.3, 1000);
  EXPECT_NEAR(state_.phase_rad, 6.0 - 2 * kPi, 1e-9);
}

TEST_F(Steering, DoesNothingBeforeAWholePeriodHasPassed) {
  walk(-2.5, 0.3, 133);
  EXPECT_EQ(state_.phase_rad, 0.0);
  walk(-2.5, 0.3, 1);
  EXPECT_NE(state_.phase_rad, 0.0);
}

TEST_F(Steering, HoldsItsLastDirectionWhileTheModelIsStuck) {
  walk(-0.3, 0.3, 1000);
  walk(2.0, 1e-6, 1000);
  EXPECT_NEAR(state_.phase_rad, 0.3, 0.02);
}

TEST_F(Steering, WithoutATargetKeepsTheDirectionThatItBeganWith) {
  params_.target_rad.reset();
  walk(1.0, 0.3, 200);
  EXPECT_NEAR(*state_.target_rad, 1.0, 1e-9);
  walk(1.2, 0.3, 1000);
  EXPECT_NEAR(state_.phase_rad, -0.2, 1e-9);
}

TEST_F(Steering, IgnoresAWobbleWithTheGaitsOwnPeriod) {
  for (int i = 0; i < 2000; ++i) {
    const double wobble = 0.1 * std::sin(2 * kPi * i / 133);
    steer(params_, state_, {0.003 * i, wobble}, 133, 0.01, true);
  }
  EXPECT_NEAR(state_.phase_rad, 0.0, 1e-9);
}

TEST_F(Steering, MeasuresOverTheShorterPeriodAsSoonAsThereIsOne) {
  for (int i = 0; i < 500; ++i) steer(params_, state_, {0.003 * i, 0.1 * std::sin(2 * kPi * i / 209)}, 209, 0.01, true);
  for (int i = 500; i < 500 + 2 * 133; ++i)
    steer(params_, state_, {0.003 * i, 0.1 * std::sin(2 * kPi * (i - 500) / 133)}, 133, 0.01, true);
  EXPECT_NEAR(*state_.heading_rad, 0, 1e-9);
  EXPECT_EQ(state_.trail.size(), 133U);
}

double largest_jump(const Gait& gait, double from_s, double to_s) {
  double largest = 0;
  for (const GaitGroup& g : gait.params().groups) {
    double last = gait.equilibrium(g, 1, from_s);
    for (double t = from_s; t < to_s; t += 1e-3) {
      const double now = gait.equilibrium(g, 1, t);
      largest = std::max(largest, std::abs(now - last));
      last = now;
    }
  }
  return largest;
}

TEST(GaitChange, NeverJumpsWhateverChanges) {
  Gait gait = Gait::load(kGaits / "sidewind.toml");
  const double before = gait.equilibrium(gait.params().groups[0], 2, 7.0);
  GaitChange to = gait.values();
  to.frequency_rad_per_s = 9;
  to.groups[0] = {0.3, 0.2, 8, -2.5, 0.1};
  gait.change(to, 7.0);
  EXPECT_NEAR(gait.equilibrium(gait.params().groups[0], 2, 7.0), before, 1e-12);
  // A·ω·1 ms and what the blends of amplitude, offset and phases add in a second's 1000 steps
  EXPECT_LT(largest_jump(gait, 7.0, 12.0), 1.05 * (9 + 5) * 1e-3);
  // Changed again before the first change is through:
  to.frequency_rad_per_s = 2;
  to.groups[0].amplitude_rad = 1;
  Gait twice = gait;
  const double between = twice.equilibrium(twice.params().groups[0], 2, 7.4);
  twice.change(to, 7.4);
  EXPECT_NEAR(twice.equilibrium(twice.params().groups[0], 2, 7.4), between, 1e-12);
  EXPECT_LT(largest_jump(twice, 7.4, 12.0), 1.05 * (9 + 5) * 1e-3);
}

TEST(GaitChange, PlaysTheNewValuesAfterTheBlend) {
  Gait gait = Gait::load(kGaits / "sidewind.toml");
  GaitChange to = gait.values();
  to.frequency_rad_per_s = 6;
  to.groups[0] = {0.25, 0.1, 4, 0.5, 0.2};
  gait.change(to, 10.0);
  const GaitGroup& g = gait.params().groups[0];
  double least = 10, most = -10, crossings = 0, last = 0;
  for (double t = 11.0; t < 11.0 + 10 * 2 * kPi / 6; t += 1e-3) {
    const double y = gait.equilibrium(g, 0, t);
    least = std::min(least, y), most = std::max(most, y);
    if (last < 0.1 && y >= 0.1) ++crossings;
    last = y;
  }
  EXPECT_NEAR(most, 0.35, 1e-5);
  EXPECT_NEAR(least, -0.15, 1e-5);
  EXPECT_NEAR(crossings, 10, 1);
}

TEST(GaitChange, RefusesNumbersThatAFileMayNotSayAndChangesNothing) {
  Gait gait = Gait::load(kGaits / "sidewind.toml");
  const GaitChange good = gait.values();
  const auto refused = [&](auto&& spoil) {
    GaitChange bad = good;
    spoil(bad);
    EXPECT_THROW(gait.change(bad, 1.0), InputError);
    EXPECT_EQ(gait.values().groups[0].amplitude_rad, good.groups[0].amplitude_rad);
    EXPECT_FALSE(gait.state().blend);
  };
  refused([](GaitChange& c) { c.frequency_rad_per_s = 0; });
  refused([](GaitChange& c) { c.frequency_rad_per_s = NAN; });
  refused([](GaitChange& c) { c.groups[0].amplitude_rad = 3; });
  refused([](GaitChange& c) { c.groups[1].lambda = 0; });
  refused([](GaitChange& c) { c.groups[1].preset_rad = INFINITY; });
  refused([](GaitChange& c) { c.groups.pop_back(); });
}

TEST(GaitChange, AHeldGaitGoesOnWhereItStood) {
  Gait gait = Gait::load(kGaits / "sidewind.toml");
  const GaitGroup& g = gait.params().groups[0];
  const double before = gait.equilibrium(g, 3, 5.0);
  gait.hold(5.0);
  EXPECT_TRUE(gait.held());
  gait.resume(8.3);
  EXPECT_FALSE(gait.held());
  EXPECT_NEAR(gait.equilibrium(g, 3, 8.3), before, 1e-12);
}

}  // namespace
}  // namespace vsa::motion
