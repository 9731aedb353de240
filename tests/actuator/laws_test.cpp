// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Every law of the library between two motors and a shaft: the balance closes, the slope is the torque's, and laws that tie the motors
// together are solved in as few rounds as those that don't.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "elastic/all_laws.hpp"
#include "vsa/actuator/actuator.hpp"

namespace {

using vsa::actuator::Actuator;
using vsa::actuator::ActuatorParams;
using vsa::drive::Terminal;
using vsa::test::SomeLaw;

/// A law that counts how often it is asked for a segment's mean.
class Counting final : public vsa::elastic::Transmission {
 public:
  explicit Counting(std::shared_ptr<const Transmission> law) : law_(std::move(law)) {}
  [[nodiscard]] vsa::elastic::Response evaluate(const vsa::elastic::Positions& at) const noexcept override {
    return law_->evaluate(at);
  }
  [[nodiscard]] vsa::elastic::SegmentMean mean_over(const vsa::elastic::Positions& from,
                                                    const vsa::elastic::Positions& to) const noexcept override {
    ++count;
    return law_->mean_over(from, to);
  }
  [[nodiscard]] std::array<double, 2> references(const vsa::elastic::EquilibriumPreset& c) const noexcept override {
    return law_->references(c);
  }
  [[nodiscard]] vsa::elastic::EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override {
    return law_->attained(x);
  }
  [[nodiscard]] int motor_count() const noexcept override { return law_->motor_count(); }
  mutable int count = 0;

 private:
  std::shared_ptr<const Transmission> law_;
};

ActuatorParams between_motors(std::shared_ptr<const vsa::elastic::Transmission> law, double friction_Nm) {
  ActuatorParams p;
  p.transmission = std::move(law);
  p.set_both({.motor = {0.001, 0.01, 0.8, 0.8, 2.3, std::nullopt}, .gearbox = {1.0, {friction_Nm, 0.03}}});
  p.shaft_friction = {0.01, 0.03};
  return p;
}

TEST(LawInAnActuator, KeepsTheBalanceWithEveryLossPositive) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const SomeLaw& l : vsa::test::all_laws(3)) {
    for (const double friction : {0.0, 0.3}) {
      Actuator a(between_motors(l.law, friction));
      auto s = a.initial(l.law->references({0.1, 0.5 * l.preset}), 0.1);
      double shaft = 0;
      for (int n = 0; n < 400; ++n) {
        const double next = 0.3 * l.deflection_rad * std::sin(0.05 * n);
        const auto r =
            a.segment(s, 1e-3, {next - shaft, {2 * unit(random), 2 * unit(random)}, {Terminal::driven, Terminal::driven}});
        s.ledger.delivered += r.torque * (next - shaft);  // whoever moves the shaft books that
        shaft = next;
      }
      EXPECT_GT(s.ledger.moved(), 1e-4) << l.name;
      EXPECT_LT(std::abs(s.ledger.imbalance()), 3e-8 * (s.ledger.moved() + 1e-3)) << l.name;
      EXPECT_LT(std::abs(s.ledger.integrator), 1e-3 * (s.ledger.moved() + 1e-3)) << l.name;
      EXPECT_GE(s.ledger.motor_friction, -1e-12) << l.name;
      EXPECT_GE(s.ledger.copper, 0) << l.name;
    }
  }
}

TEST(LawInAnActuator, TellsTheTorquesSlopeWithTheMotorsYielding) {
  for (const SomeLaw& l : vsa::test::all_laws(3)) {
    for (const double h : {1e-4, 1e-3}) {
      Actuator a(between_motors(l.law, 0.0));
      auto s = a.initial(l.law->references({0.1, 0.6 * l.preset}), 0.1 + 0.4 * l.deflection_rad);
      const auto torque = [&](double dq) {
        auto trial = s;
        return a.segment(trial, h, {dq, {1, -1}, {Terminal::driven, Terminal::driven}});
      };
      const double e = 1e-4;
      const double slope = -(torque(e).torque - torque(-e).torque) / (2 * e);
      EXPECT_NEAR(torque(0).slope, slope, 2e-3 * std::abs(slope) + 1e-4) << l.name << " h = " << h;
    }
  }
}

/// Means of the law that a segment of 1 ms needs.
double rounds(const SomeLaw& l) {
  const auto counting = std::make_shared<Counting>(l.law);
  ActuatorParams p = between_motors(counting, 0.0);
  for (auto& side : p.side) side.motor.inertia_kgm2 = 1e-5;  // light: they follow the springs within the step
  Actuator a(p);
  auto s = a.initial(l.law->references({0, 0.6 * l.preset}), 0);
  constexpr int kSegments = 500;
  counting->count = 0;
  double shaft = 0;
  for (int n = 0; n < kSegments; ++n) {
    const double next = 0.5 * l.deflection_rad * std::sin(0.1 * n);
    a.segment(s, 1e-3, {next - shaft, {std::sin(0.03 * n), std::cos(0.05 * n)}, {Terminal::driven, Terminal::driven}});
    shaft = next;
  }
  return static_cast<double>(counting->count) / kSegments;
}

TEST(LawInAnActuator, ThatTiesTheMotorsTogetherIsSolvedWithTwoMeansASegment) {
  for (const SomeLaw& l : vsa::test::all_laws(2)) {
    const auto x = l.law->references({0.1, 0.5 * l.preset});
    if (l.law->evaluate({0.1 + 0.5 * l.deflection_rad, x}).curvature.x0x1 == 0) continue;
    EXPECT_LE(rounds(l), 2.0) << l.name;  // apart they need 1.0 to 1.2
  }
}

}  // namespace
