// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Laws behind leads: still one potential, in the pulleys' angles.
#include "vsa/elastic/travel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "elastic/all_laws.hpp"

namespace vsa::test {
namespace {

using elastic::Positions;
using elastic::Response;

std::shared_ptr<const elastic::Transmission> behind_leads(const SomeLaw& l) {
  return elastic::with_pinion(elastic::with_lead(elastic::with_lead(l.law, 0, 0.7), 1, 1.6), 0.8);
}

/// A place that the law is at home in, in the pulleys' angles.
Positions near(const elastic::Transmission& law, const SomeLaw& l) {
  const auto x = law.references({0.1, 0.5 * l.preset});
  return {0.1 + 0.3 * l.deflection_rad, x};
}

/// ∂/∂q at a place, by differences.
template <class Value>
double slope_q(const elastic::Transmission& law, Positions at, const Value& value) {
  constexpr double kStep = 1e-5;
  Positions back = at;
  at.q += kStep, back.q -= kStep;
  return (value(law.evaluate(at)) - value(law.evaluate(back))) / (2 * kStep);
}

TEST(Travel, HasTheDerivativesOfItsEnergy) {
  for (const SomeLaw& l : all_laws(2)) {
    const auto law = behind_leads(l);
    const Positions at = near(*law, l);
    const Response r = law->evaluate(at);
    constexpr double kStep = 1e-5;
    for (std::size_t i = 0; i < 2; ++i) {
      Positions up = at, down = at;
      up.x[i] += kStep, down.x[i] -= kStep;
      const Response a = law->evaluate(up), b = law->evaluate(down);
      const auto slope = [&](double from, double to) { return (to - from) / (2 * kStep); };
      const double scale = std::abs(r.curvature.qq) + std::abs(r.curvature.xx[1]) + 1e-3;
      EXPECT_NEAR(r.load[i], -slope(b.energy, a.energy), 1e-5 * scale) << l.name;
      EXPECT_NEAR(r.curvature.qx[i], -slope(b.torque, a.torque), 1e-4 * scale) << l.name;
      EXPECT_NEAR(r.curvature.x0x1, -slope(b.load[1 - i], a.load[1 - i]), 1e-4 * scale) << l.name;
      EXPECT_NEAR(r.curvature.qx[i], slope_q(*law, at, [&](const Response& s) { return -s.load[i]; }), 1e-4 * scale) << l.name;
      EXPECT_NEAR(r.curvature.xx[i], -slope(b.load[i], a.load[i]), 1e-4 * scale) << l.name;
    }
    const double scale = std::abs(r.curvature.qq) + 1e-3;
    EXPECT_NEAR(r.torque, -slope_q(*law, at, [](const Response& s) { return s.energy; }), 1e-5 * scale) << l.name;
    EXPECT_NEAR(r.curvature.qq, -slope_q(*law, at, [](const Response& s) { return s.torque; }), 1e-4 * scale) << l.name;
    EXPECT_EQ(law->tangent_of(law->origin(at)).stiffness, r.curvature.qq) << l.name;
    EXPECT_EQ(law->energy(at), r.energy);
  }
}

TEST(Travel, HasMeansThatDoTheWorkOfTheEnergysChange) {
  for (const SomeLaw& l : all_laws(2)) {
    const auto law = behind_leads(l);
    const Positions from = near(*law, l);
    Positions to = from;
    to.q += 0.02 * l.deflection_rad, to.x[0] -= 0.01, to.x[1] += 0.01;
    const double change = law->energy(to) - law->energy(from);
    for (const elastic::SegmentMean& m : {law->mean_over(from, to), law->mean_from(law->origin(from), to, 0.0)}) {
      const double work = m.torque * (to.q - from.q) + m.load[0] * (to.x[0] - from.x[0]) + m.load[1] * (to.x[1] - from.x[1]);
      EXPECT_NEAR(work, -change, 1e-9 * (std::abs(change) + law->energy(from))) << l.name;
    }
    EXPECT_NEAR(law->energy_of(law->moved(law->origin(from), to)), law->energy(to), 1e-12 + 1e-9 * law->energy(to)) << l.name;
  }
}

TEST(Travel, GivesReferencesThatAttainWhatWasCommanded) {
  for (const SomeLaw& l : all_laws(2)) {
    const auto law = behind_leads(l);
    const auto got = law->attained(law->references({0.2, 0.5 * l.preset}));
    EXPECT_NEAR(got.equilibrium, 0.2, 1e-6) << l.name;
    EXPECT_EQ(law->spring_count(), 0) << l.name << ": a spring behind a travel has no deflection q − φ";
    EXPECT_EQ(law->input_unit(0), "rad");
    EXPECT_EQ(law->preset_unit(), l.law->preset_unit());
  }
}

}  // namespace
}  // namespace vsa::test
