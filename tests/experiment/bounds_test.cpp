// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/experiment/bounds.hpp"

#include <cmath>

#include "recording_support.hpp"

namespace vsa::experiment {
namespace {

using test::Files;
using test::has;
using test::problems;

Bound bound(std::optional<double> min, std::optional<double> max) { return {"x", min, max, "because", {}, ""}; }

bool holds(const Bound& b, double value) { return judge({b}, {{"x", value}}, {}).at(0).held; }

TEST(Bounds, AreHeldWithinTheirEndsAndBrokenBeyond) {
  EXPECT_TRUE(holds(bound(1, 2), 1) && holds(bound(1, 2), 2));
  EXPECT_FALSE(holds(bound(1, 2), 0.999) || holds(bound(1, 2), 2.001));
  EXPECT_TRUE(holds(bound({}, 2), -1e9));
  EXPECT_FALSE(holds(bound({}, 2), 2.1));
  EXPECT_FALSE(holds(bound(1, {}), 0.9));
}

TEST(Bounds, AreBrokenByWhatIsNotANumber) {
  EXPECT_FALSE(holds(bound({}, 2), std::nan("")));
  EXPECT_FALSE(holds(bound(1, {}), INFINITY));
}

TEST(Bounds, OnAQuantityThatIsntThereAreAnErrorAndNotAPass) {
  const auto found = problems([] {
    (void)judge({{"stiffness.0.000.rms_rad", {}, 1.0, "y", {}, ""}}, {{"stiffness.0.0000.rms_rad", 0.1}}, {});
  });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(has(found[0], "stiffness.0.0000.rms_rad")) << "the nearest is offered";
}

TEST(Bounds, OneBrokenBreaksAll) {
  EXPECT_TRUE(all_held(judge({bound(0, 2), bound(1, 2)}, {{"x", 1}}, {})));
  EXPECT_FALSE(all_held(judge({bound(0, 2), bound(1.5, 2)}, {{"x", 1}}, {})));
}

const std::map<std::string, double> kMeasured{{"stiffness.0.4602.rms_rad", 0.02}, {"stiffness.0.6903.rms_rad", 0.004}};
const config::Evidence kFitted{{"stiffness.0.6903"}, "vsa identify"};

std::vector<Verdict> judged(std::optional<Kind> kind, const std::optional<config::Evidence>& evidence) {
  return judge({{"stiffness.0.6903.rms_rad", {}, 0.01, "y", kind, "b.toml:1"}, {"stiffness.0.4602.rms_rad", {}, 0.01, "y", {}, ""}},
               kMeasured, evidence);
}

TEST(Kinds, FollowFromWhatThePresetWasCalibratedOn) {
  const auto v = judged({}, kFitted);
  EXPECT_EQ(v[0].kind, Kind::calibrated);
  EXPECT_EQ(v[1].kind, Kind::predicted);
  EXPECT_EQ(count(v, Kind::calibrated).held, 1u);
  EXPECT_EQ(count(v, Kind::calibrated).all, 1u);
  EXPECT_EQ(count(v, Kind::predicted).held, 0u) << "0.02 breaks 0.01";
  EXPECT_EQ(count(v, Kind::predicted).all, 1u);
}

TEST(Kinds, OfAPresetThatDoesntSayAreNeverPredicted) {
  for (const Verdict& v : judged({}, {})) EXPECT_EQ(v.kind, Kind::calibrated);
  EXPECT_EQ(judged({}, config::Evidence{}).at(0).kind, Kind::predicted) << "it says: on nothing";
}

TEST(Kinds, MayBeStatedButNoFitMayBeCalledAPrediction) {
  EXPECT_EQ(judged(Kind::calibrated, config::Evidence{}).at(0).kind, Kind::calibrated);
  EXPECT_EQ(judged(Kind::predicted, {}).at(0).kind, Kind::predicted) << "who wrote the bound says so";
  const auto found = problems([] { (void)judged(Kind::predicted, kFitted); });
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(has(found[0], "b.toml:1") && has(found[0], "calibrated on stiffness.0.6903.rms_rad"));
}

TEST(BoundsFile, TheShippedOneHasAReasonForEachAndTheIssuesNumbers) {
  const BoundsFile f = read_bounds(std::filesystem::path(VSA_SOURCE_DIR) / "data" / "bounds.toml");
  EXPECT_GE(f.bounds.size(), 5u);
  EXPECT_EQ(f.published.size(), 2u);
  const auto max_of = [&](const std::string& quantity) {
    for (const Bound& b : f.bounds) {
      if (b.quantity == quantity) return b.max.value_or(NAN);
    }
    return static_cast<double>(NAN);
  };
  EXPECT_LE(max_of("stiffness.0.0000.rms_rad"), 0.020);
  EXPECT_LE(max_of("stiffness.0.6903.rms_rad"), 0.009);
  EXPECT_LE(max_of("speed.0.7500.mean_pulley_rad_per_s"), 3.75 * 1.1 + 1e-9);
}

TEST(BoundsFile, ThatIsWrongIsTold) {
  Files files("bounds");
  const auto told = [&](const std::string& text) { return problems([&] { (void)read_bounds(files.write("b.toml", text)); }); };
  const std::string fine = "[[bound]]\nquantity = \"x\"\nmax = 1\nwhy = \"y\"\n";
  EXPECT_TRUE(told(fine).empty());
  EXPECT_TRUE(told("").empty()) << "no bounds, nothing to hold";
  EXPECT_TRUE(has(told("[[bound]\n").at(0), "b.toml:1"));
  EXPECT_TRUE(has(told("[[bound]]\nquantity = \"x\"\nmax = 1\n").at(0), "why"));
  EXPECT_TRUE(has(told("[[bound]]\nquantity = \"x\"\nwhy = \"y\"\n").at(0), "no bound"));
  EXPECT_TRUE(has(told("[[bound]]\nquantity = \"x\"\nmin = 2\nmax = 1\nwhy = \"y\"\n").at(0), "no value can hold it"));
  EXPECT_TRUE(has(told(fine + "maxx = 3\n").at(0), "unknown key"));
  EXPECT_TRUE(has(told("[[bound]]\nquantity = \"x\"\nmax = nan\nwhy = \"y\"\n").at(0), "number"));
  EXPECT_TRUE(has(told("[[bound]]\nquantity = \"x\"\nmax = \"1\"\nwhy = \"y\"\n").at(0), "number"));
  EXPECT_TRUE(told(fine + "kind = \"predicted\"\n").empty());
  EXPECT_TRUE(has(told(fine + "kind = \"guess\"\n").at(0), "\"guess\": is no kind"));
  EXPECT_TRUE(has(told(fine + "kind = 3\n").at(0), "some text"));
  EXPECT_TRUE(has(told("bound = 3\n").at(0), "array of tables"));
  EXPECT_TRUE(has(told("bonds = 3\n").at(0), "unknown key"));
  EXPECT_TRUE(has(problems([&] { (void)read_bounds(files.path()); }).at(0), "can't be read"));
}

}  // namespace
}  // namespace vsa::experiment
