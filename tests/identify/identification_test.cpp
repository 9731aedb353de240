// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Profiles, cross-validation and the bootstrap show what they should, whoever does their jobs.
#include "vsa/identify/identification.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "closed_form.hpp"
#include "vsa/errors.hpp"

namespace vsa::identify {
namespace {

using test::closed_form;
using test::kTruth;
using test::paper_type;
using test::task_of;

const std::vector<double> kPresets{0.0, 0.45, 0.69};

/// Errors that any fit leaves, so that an interval has a width.
std::vector<experiment::Branches> noisy(const std::vector<double>& presets, double sd = 0.001, double rho = 0, unsigned seed = 11) {
  std::mt19937 random(seed);
  std::vector<experiment::Branches> out;
  for (double p : presets) {
    out.push_back(closed_form(kTruth, p));
    test::add_errors(out.back().rising_rad, sd, rho, random);
    test::add_errors(out.back().falling_rad, sd, rho, random);
  }
  return out;
}

MakeTask make(Task task) {
  return [task = std::move(task)](unsigned) { return task; };
}

Identification found(const Task& task, const IdentificationOptions& o) {
  return identify(make(task), o, one_by_one(make(task), o.fit));
}

Task four(const std::vector<double>& presets, const std::vector<experiment::Branches>& data) {
  return task_of(parse_parameters(test::kFour, paper_type()), presets, data);
}

TEST(Identification, FindsWhatTheFitFindsAndCrossValidatesOnlyWhereItCan) {
  const Task task = four(kPresets, noisy(kPresets, 0.003));
  const Residuals residuals(task, 1);
  const Fit alone = fit(residuals, {});
  const Identification r = found(task, {});
  EXPECT_EQ(r.fit.values, alone.values);
  EXPECT_EQ(r.fit.jacobian, alone.jacobian);
  ASSERT_EQ(r.fit.starts.size(), alone.starts.size());
  for (std::size_t i = 0; i < alone.starts.size(); ++i) {
    EXPECT_EQ(r.fit.starts[i].from, alone.starts[i].from) << i;
    EXPECT_EQ(r.fit.starts[i].to, alone.starts[i].to) << i;
    EXPECT_EQ(r.fit.starts[i].cost, alone.starts[i].cost) << i;
  }
  EXPECT_EQ(r.left_out.size(), 3u);
  EXPECT_TRUE(r.profiles.empty());
  EXPECT_FALSE(r.bootstrap);
  IdentificationOptions without;
  without.cross_validation = false;
  EXPECT_TRUE(found(task, without).left_out.empty());
  const std::vector<double> twice{0.45, 0.45};
  Task one = task_of(parse_parameters("shaft.friction_Nm", paper_type()), twice, noisy(twice));
  one.model = [](const std::vector<double>& v, std::size_t) { return closed_form({kTruth[0], kTruth[1], v[0], kTruth[3]}, 0.45); };
  const Identification two = found(one, {});
  EXPECT_NEAR(two.fit.values[0], kTruth[2], 1e-3);
  EXPECT_EQ(two.misfits.size(), 2u);
  EXPECT_TRUE(two.left_out.empty()) << "one preset";
}

TEST(Identification, IsTheSameBitsWhateverTheOrderOfItsJobs) {
  const Task task = four(kPresets, noisy(kPresets, 0.003));
  IdentificationOptions o;
  o.profile = 3;
  o.draws = 5;
  o.digits = 5;
  const Identification straight = found(task, o);
  const DoJobs serial = one_by_one(make(task), o.fit);
  const DoJobs backwards = [&](const std::vector<Job>& jobs) {
    std::vector<Job> turned(jobs.rbegin(), jobs.rend());
    for (Job& job : turned) job = job_of(numbers_of(job));  // as over a wire
    std::vector<Done> out = serial(turned);
    std::reverse(out.begin(), out.end());
    for (std::size_t i = 0; i < out.size(); ++i) {
      const StartResult there = *out[i].result;
      out[i].result = result_of(numbers_of(there));
      out[i].result->from = jobs[i].from;
    }
    return out;
  };
  const Identification turned = identify(make(task), o, backwards);
  EXPECT_EQ(straight.fit.values, turned.fit.values);
  EXPECT_EQ(straight.fit.jacobian, turned.fit.jacobian);
  EXPECT_EQ(straight.uncertainty.low, turned.uncertainty.low);
  EXPECT_EQ(straight.bootstrap->values, turned.bootstrap->values);
  EXPECT_EQ(straight.evaluations, turned.evaluations);
  for (std::size_t p = 0; p < 3; ++p) EXPECT_EQ(straight.left_out[p].values, turned.left_out[p].values) << p;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(straight.profiles[k][i].rms_rad, turned.profiles[k][i].rms_rad) << k;
  for (const double v : straight.fit.values) EXPECT_EQ(v, rounded(v, 5));
}

TEST(Identification, GoesOnWhereOthersFailAndSaysWhatFailedWhereNoneIsLeft) {
  const Task task = four(kPresets, noisy(kPresets));
  const DoJobs serial = one_by_one(make(task), {});
  const auto failing = [&](const auto& fails) -> DoJobs {
    return [&serial, fails](const std::vector<Job>& jobs) {
      std::vector<Done> out = serial(jobs);
      for (std::size_t i = 0; i < out.size(); ++i)
        if (fails(i, jobs[i])) out[i] = {std::nullopt, "it rained"};
      return out;
    };
  };
  IdentificationOptions o;
  o.draws = 4;
  o.profile = 2;
  const Identification r = identify(make(task), o, failing([](std::size_t i, const Job&) { return i == 0; }));
  EXPECT_EQ(r.fit.starts.size() + 1, found(task, {}).fit.starts.size());
  EXPECT_NEAR(r.fit.values[0], kTruth[0], 2e-3);
  EXPECT_TRUE(std::isnan(r.profiles[0][0].rms_rad));
  const Identification half = identify(make(task), o, failing([](std::size_t, const Job& job) { return job.draw % 2 == 1; }));
  EXPECT_EQ(half.bootstrap->values.size(), 2u);
  EXPECT_EQ(half.bootstrap->failed, 2u);
  EXPECT_EQ(half.bootstrap->unconverged, 0u);
  const DoJobs cut_short = [&](const std::vector<Job>& jobs) {
    std::vector<Done> out = serial(jobs);
    for (std::size_t i = 0; i < out.size(); ++i) out[i].result->converged = jobs[i].draw != 3;
    return out;
  };
  EXPECT_EQ(identify(make(task), o, cut_short).bootstrap->unconverged, 1u);
  try {
    (void)identify(make(task), o, failing([](std::size_t, const Job&) { return true; }));
    FAIL() << "no start is left";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("it rained"), std::string::npos);
  }
}

TEST(Profile, IsLowestAtTheEstimateAndRisesToBothSides) {
  IdentificationOptions o;
  o.profile = 5;
  o.cross_validation = false;
  const Identification r = found(four(kPresets, noisy(kPresets, 0.003)), o);
  ASSERT_EQ(r.profiles.size(), 4u);
  const auto& curve = r.profiles[2];
  ASSERT_EQ(curve.size(), 5u);
  EXPECT_NEAR(curve[2].value, r.fit.values[2], 1e-9);
  EXPECT_NEAR(curve[4].value - curve[2].value, 3 * r.uncertainty.standard_error[2], 1e-9);
  EXPECT_GT(curve[0].rms_rad, curve[1].rms_rad);
  EXPECT_GT(curve[1].rms_rad, curve[2].rms_rad);
  EXPECT_LT(curve[2].rms_rad, curve[3].rms_rad);
  EXPECT_LT(curve[3].rms_rad, curve[4].rms_rad);
}

TEST(CrossValidation, OfATrueModelPredictsTheLeftOutPresetAboutAsWellAsTheRest) {
  const std::vector<double> presets{0.0, 0.1, 0.45, 0.69};  // without either of the first two, the other still tells k from a
  const Identification r = found(four(presets, noisy(presets, 0.003)), {});
  ASSERT_EQ(r.left_out.size(), 4u);
  for (const LeftOut& l : r.left_out) {
    EXPECT_LT(l.rms_rad, 2 * l.rms_rad_of_all) << l.preset << " " << l.rms_rad_of_all;
    EXPECT_EQ(l.misfits.size(), 1u);
  }
}

TEST(CrossValidation, OfAWrongModelFails) {
  std::vector<experiment::Branches> data = noisy(kPresets);
  for (double& v : data[2].rising_rad) v *= 1.5;  // one preset that obeys another law
  for (double& v : data[2].falling_rad) v *= 1.5;
  const Identification r = found(four(kPresets, data), {});
  EXPECT_GT(r.left_out[2].rms_rad, 10 * 0.001);
  EXPECT_GT(r.left_out[2].rms_rad, r.left_out[2].rms_rad_of_all);
}

TEST(CrossValidation, OfATrueModelThatTheRestDoesNotDetermineSaysSo) {
  const Identification r = found(four(kPresets, noisy(kPresets, 0.003)), {});
  EXPECT_GT(r.left_out[0].rms_rad, 5 * r.left_out[0].rms_rad_of_all) << "two stiff presets fit k·e^(a·preset), not k and a";
}

TEST(CrossValidation, BeginsNothingAtTheFitToEverything) {
  // The recording left out says something else each time; what was fitted to the others doesn't know it.
  std::vector<experiment::Branches> data = noisy(kPresets, 0.003);
  const Identification one = found(four(kPresets, data), {});
  for (double& v : data[2].rising_rad) v *= 1.5;
  const Identification two = found(four(kPresets, data), {});
  EXPECT_NE(one.fit.values, two.fit.values);
  EXPECT_EQ(one.left_out[2].values, two.left_out[2].values);
}

TEST(Draws, AreTheRecordingsWithErrorsOfTheSameSizeInTheirPlaces) {
  const Task task = four(kPresets, noisy(kPresets, 0.003, 0.8));
  const Residuals residuals(task, 1);
  const std::vector<double> at = residuals.at(fit(residuals, {}).values);
  const auto residuals_of = [&](const std::vector<Observation>& with) {
    Task other = task;
    other.observations = with;
    return Residuals(other, 1).at(fit(residuals, {}).values);
  };
  std::size_t turned = 0, changes = 0;
  for (unsigned draw = 1; draw <= 40; ++draw) {
    const std::vector<double> now = residuals_of(drawn(residuals, at, 3, draw));
    for (std::size_t i = 0; i < at.size(); ++i) {
      ASSERT_NEAR(std::abs(now[i]), std::abs(at[i]), 1e-12);
      turned += now[i] * at[i] < 0 ? 1 : 0;
      changes += i > 0 && (now[i] * at[i] < 0) != (now[i - 1] * at[i - 1] < 0) ? 1 : 0;
    }
  }
  const double points = 40.0 * static_cast<double>(at.size());
  EXPECT_NEAR(static_cast<double>(turned) / points, 0.5, 0.06);
  // ρ ≈ 0.75: blocks of about 21 of 57 points, half of whose borders show.
  EXPECT_LT(static_cast<double>(changes) / points, 0.05);
  EXPECT_GT(static_cast<double>(changes) / points, 0.015);
  EXPECT_EQ(drawn(residuals, at, 3, 7)[0].data.rising_rad, drawn(residuals, at, 3, 7)[0].data.rising_rad);
  EXPECT_NE(drawn(residuals, at, 3, 7)[0].data.rising_rad, drawn(residuals, at, 3, 8)[0].data.rising_rad);
  EXPECT_NE(drawn(residuals, at, 3, 7)[0].data.rising_rad, drawn(residuals, at, 4, 7)[0].data.rising_rad);
}

/// The bootstrap's scatter over the sandwich's, the mean of several recordings.
std::vector<double> scatter_ratio(double rho) {
  constexpr unsigned kRecordings = 6;
  std::vector<double> out(4, 0.0);
  for (unsigned seed = 1; seed <= kRecordings; ++seed) {
    IdentificationOptions o;
    o.cross_validation = false;
    o.fit.starts = 1;
    o.fit.tolerance = 1e-6;
    o.draws = 100;
    const Identification r = found(four(kPresets, noisy(kPresets, 0.003, rho, seed)), o);
    EXPECT_EQ(r.bootstrap->values.size(), 100u);
    for (std::size_t k = 0; k < 4; ++k) {
      out[k] += r.bootstrap->standard_error[k] / r.uncertainty.standard_error[k] / kRecordings;
      EXPECT_LT(r.bootstrap->low[k], r.fit.values[k]);
      EXPECT_GT(r.bootstrap->high[k], r.fit.values[k]);
    }
  }
  return out;
}

/// docs/howto/identify.md has these.
void print(double rho, const std::vector<double>& ratios) {
  std::printf("rho %.1f: scatter of the draws over the intervals'", rho);
  for (const double ratio : ratios) std::printf(" %.3f", ratio);
  std::printf("\n");
}

TEST(Bootstrap, ScattersAsTheIntervalsSayWhereErrorsAreIndependent) {
  const std::vector<double> ratios = scatter_ratio(0.0);
  print(0.0, ratios);
  for (const double ratio : ratios) EXPECT_NEAR(ratio, 0.92, 0.12);
}

TEST(Bootstrap, ScattersAsTheIntervalsSayWhereErrorsAreCorrelated) {
  const std::vector<double> ratios = scatter_ratio(0.8);
  print(0.8, ratios);
  for (const double ratio : ratios) EXPECT_NEAR(ratio, 0.86, 0.12);
}

TEST(Bootstrap, SeesErrorsThatAreLargerAtOnePreset) {
  // Tenfold errors of the stiffest recording, with the weight that the others have: what that recording determines scatters more.
  std::vector<experiment::Branches> data = noisy(kPresets, 0.001), other = noisy(kPresets, 0.010, 0, 12);
  data[2] = other[2];
  IdentificationOptions o;
  o.cross_validation = false;
  o.draws = 100;
  const Bootstrap even = *found(four(kPresets, noisy(kPresets, 0.001)), o).bootstrap,
                  odd = *found(four(kPresets, data), o).bootstrap;
  EXPECT_GT(odd.standard_error[1], 3 * even.standard_error[1]) << "the shortfall of the preset, known from the stiff ones";
}

}  // namespace
}  // namespace vsa::identify
