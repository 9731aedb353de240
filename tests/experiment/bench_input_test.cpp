// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the benches refuse, and the small tools that they use.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "bench_support.hpp"
#include "vsa/elastic/law.hpp"
#include "vsa/elastic/series_spring.hpp"
#include "vsa/elastic/two_sinh.hpp"
#include "vsa/errors.hpp"
#include "vsa/experiment/parallel.hpp"

namespace vsa::experiment {
namespace {

/// Everything wrong, as one text; empty: nothing.
template <class F>
std::string problems_of(F&& f) {
  try {
    static_cast<void>(f());
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Bench, OptionsOutOfRangeAreToldTogether) {
  StiffnessOptions o;
  o.period_s = std::nan("");
  o.amplitude_rad = 11;
  o.cycles = 0;
  const std::string text = problems_of([&] { return run_stiffness(specimen(), o); });
  for (const char* key : {"period_s", "amplitude_rad", "cycles"}) EXPECT_NE(text.find(key), std::string::npos) << text;
  SpeedOptions square = short_square();
  square.hold_s = -1;
  square.steps = 0;
  const std::string other = problems_of([&] { return run_speed(specimen(), square); });
  for (const char* key : {"hold_s", "steps"}) EXPECT_NE(other.find(key), std::string::npos) << other;
}

TEST(Bench, PresetsThatTheActuatorDoesNotHaveAreRefused) {
  for (const double preset : {-0.1, 0.8, std::nan("")}) {
    const std::string text = problems_of([&] { return run_stiffness(specimen(), short_sweep(preset)); });
    EXPECT_NE(text.find("0 … 0.785 rad"), std::string::npos) << text;
  }
  EXPECT_NE(problems_of([&] { return run_stiffness(specimen("sea_example"), short_sweep(0.2)); }).find("no stiffness preset"),
            std::string::npos);
  EXPECT_NE(problems_of([] { return run_preset_step(specimen("sea_example"), {}); }).find("no stiffness preset"),
            std::string::npos);
  EXPECT_NE(problems_of([] { return run_speed(specimen("nosuch"), {}); }).find("unknown actuator type"), std::string::npos);
}

TEST(LawDeflection, IsTheLawTurnedRound) {
  elastic::TwoSinhParams params;
  params.k_Nm = {0.022, 0.022};
  params.a_per_rad = {6.85, 6.85};
  const elastic::TwoSinh law(params);
  for (const double preset : {0.0, 0.3, 0.7}) {
    for (const double load : {-1.4715, -0.2, 0.4, 1.4715}) {
      const double scale = 2 * 0.022 * std::cosh(6.85 * preset);
      EXPECT_NEAR(law_deflection(law, preset, load), std::asinh(load / scale) / 6.85, 1e-12);
    }
  }
  EXPECT_NEAR(law_deflection(elastic::SeriesSpring(10), 0, 1.5), 0.15, 1e-12);
  EXPECT_THROW(static_cast<void>(law_deflection(elastic::SeriesSpring(0.1), 0, 5)), InputError);
}

/// Two quadratic springs, K₁ of the one behind the shaft: τ = −K₁(δ + p + s)² + K₂(δ − p − s)², both taut while |δ| < p + s.
std::shared_ptr<const elastic::Transmission> unequal(double k1, double k2) {
  for (const elastic::Law* law : elastic::laws())
    if (law->name == "two_quadratic") return law->make(std::array{k1, k2, 0.2});
  throw std::runtime_error("no such law");
}

TEST(LawDeflection, OfUnequalSpringsIsFromTheCommandAndNotFromWhereTheyRest) {
  const auto law = unequal(2, 5), mirrored = unequal(5, 2);
  for (const double preset : {0.0, 0.3, 0.6}) {
    const double taut = preset + 0.2;
    // K₂(t − δ)² = K₁(t + δ)² or the other way round, by which spring lies on which side.
    const double rest = taut * (std::sqrt(5.0) - std::sqrt(2.0)) / (std::sqrt(5.0) + std::sqrt(2.0));
    EXPECT_NEAR(std::abs(law_deflection(*law, preset, 0)), rest, 1e-12);
    double before = -10;
    for (const double load : {-1.5, -0.2, -0.05, -1e-6, 0.0, 1e-6, 0.05, 0.2, 1.5}) {
      const double there = law_deflection(*law, preset, load);
      EXPECT_NEAR(law->evaluate({there, law->references({0, preset})}).torque, -load, 1e-12) << load << " N·m at " << preset;
      EXPECT_NEAR(law_deflection(*mirrored, preset, -load), -there, 1e-12) << load << " N·m at " << preset;
      EXPECT_GT(there, before) << load << " N·m at " << preset;
      before = there;
    }
  }
}

TEST(Parallel, EveryJobRunsOnceAndTheFirstFailureIsThrown) {
  for (const unsigned threads : {1u, 2u, 7u, 0u}) {
    std::vector<int> calls(20, 0);
    EXPECT_THROW(run_in_parallel(20, threads,
                                 [&](std::size_t i) {
                                   ++calls[i];
                                   if (i == 13) throw std::invalid_argument("13");
                                   if (i == 4) throw std::out_of_range("4");
                                 }),
                 std::out_of_range);
    EXPECT_EQ(calls, std::vector<int>(20, 1));
  }
  run_in_parallel(0, 3, [](std::size_t) { FAIL(); });
}

}  // namespace
}  // namespace vsa::experiment
