// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A unit whose two sides differ: each motor has its own gearbox, bridge, encoder and wiring, and a law's input may be a travel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "support/one_joint.hpp"
#include "vsa/elastic/law.hpp"
#include "vsa/elastic/series_spring.hpp"
#include "vsa/elastic/travel.hpp"
#include "vsa/errors.hpp"

namespace vsa::test {
namespace {

using actuator::SideParams;
using device::UnitConfig;

/// Another side in all that it has.
SideParams other(SideParams side) {
  side.motor.inertia_kgm2 *= 2.5;
  side.motor.viscous_Nms_per_rad *= 3;
  side.motor.torque_constant_Nm_per_A *= 0.8;
  side.motor.back_emf_Vs_per_rad *= 0.7;
  side.motor.resistance_Ohm *= 1.3;
  side.gearbox = {1.5, {0.2, 0.01}, 0.1, 0.3};
  side.bridge.dead_band = 0.1;
  side.bridge.switch_Ohm = 0.4;
  side.encoder = {14, 0.0};
  return side;
}

UnitConfig unlike() {
  UnitConfig c = maker_pro();
  c.actuator.side[1] = other(c.actuator.side[0]);
  c.actuator.tendon = {0.06, 2e-3, 3e-3};
  return c;
}

void command(OneJoint& joint, double equilibrium, double preset) {
  joint.unit.set_inputs(joint.state, joint.unit.inputs_for(equilibrium, preset));
}

/// A second and a half with commands of equilibrium and preset and a load.
void travel(OneJoint& joint, double preset) {
  joint.load = [](double q) { return 0.3 - 0.5 * std::sin(q); };
  for (int n = 0; n < 1500; ++n) {
    if (n % 300 == 100) command(joint, n % 600 == 100 ? 0.6 : -0.4, (n < 800 ? 1.0 : 0.5) * preset);
    joint.step();
  }
}

TEST(Sides, ThatChangePlacesMirrorTheMotionWhereTheLawIsSymmetric) {
  UnitConfig swapped = unlike();
  std::swap(swapped.actuator.side[0], swapped.actuator.side[1]);
  OneJoint a(unlike(), 0.0, 0.4, 1e-3, 1'000'000), b(swapped, 0.0, -0.4, 1e-3, 1'000'000);
  travel(a, 0.4);
  travel(b, -0.4);
  EXPECT_NEAR(a.q, b.q, 1e-10) << "sums of three have an order";
  EXPECT_NEAR(a.state.actuator.motor[0].angle, b.state.actuator.motor[1].angle, 1e-10);
  EXPECT_NEAR(a.state.actuator.motor[1].angle, b.state.actuator.motor[0].angle, 1e-10);
  EXPECT_EQ(a.state.program.loop.current[1].value, b.state.program.loop.current[0].value);
  OneJoint alike(maker_pro(), 0.0, 0.4, 1e-3, 1'000'000);
  travel(alike, 0.4);
  EXPECT_GT(std::abs(alike.q - a.q), 1e-3) << "the second side counts";
}

TEST(Sides, OfWhichOneHasAGearboxGoAsIfItsNumbersWereReflectedByHand) {
  UnitConfig geared = unlike();
  SideParams& side = geared.actuator.side[1];
  constexpr double n = 8;  // a power of two: reflected without rounding
  side.motor.inertia_kgm2 /= n * n;
  side.motor.viscous_Nms_per_rad /= n * n;
  side.motor.torque_constant_Nm_per_A /= n;
  side.motor.back_emf_Vs_per_rad /= n;
  side.gearbox.friction.coulomb_Nm /= n;
  side.gearbox.ratio *= n;
  OneJoint a(unlike(), 0.0, 0.4, 1e-3, 1'000'000), b(geared, 0.0, 0.4, 1e-3, 1'000'000);
  travel(a, 0.4);
  travel(b, 0.4);
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.state.actuator.motor[1].angle, b.state.actuator.motor[1].angle);
  EXPECT_EQ(a.state.actuator.ledger.copper, b.state.actuator.ledger.copper);
}

TEST(Sides, KeepTheLedgerAlsoWithAWindingOnOneAndAModulatedEnablePinOnTheOther) {
  UnitConfig plain = unlike();
  for (SideParams& side : plain.actuator.side) side.motor.back_emf_Vs_per_rad = side.motor.torque_constant_Nm_per_A;
  plain.actuator.supply_V = 24;
  UnitConfig mixed = plain;
  mixed.actuator.side[0].motor.inductance_H = 1e-3;
  mixed.actuator.side[1].motor.inductance_H = 2e-4;
  mixed.actuator.side[1].bridge.pin = drive::PwmPin::enable;
  mixed.actuator.side[1].bridge.period_s = 50.5e-6;
  mixed.actuator.side[1].bridge.diode_V = 0.6;
  for (const UnitConfig& c : {plain, mixed}) {
    for (const std::int64_t dt_ns : {250'000, 1'000'000, 3'000'000}) {
      OneJoint joint(c, 0.0, 0.4, 1e-3, dt_ns);
      travel(joint, 0.4);
      const auto& l = joint.state.actuator.ledger;
      EXPECT_GT(l.moved(), 1) << dt_ns;
      EXPECT_LT(std::abs(l.imbalance()), 1e-9 * l.moved()) << dt_ns;
      EXPECT_NEAR(l.conversion, 0, 1e-12);
      EXPECT_EQ(joint.state.actuator.motor[1].current, 0) << "no inductance, or chopped: no state";
      EXPECT_EQ(joint.state.actuator.motor[0].current != 0, c.actuator.side[0].motor.inductance_H.has_value());
    }
  }
}

TEST(Sides, HaveEncodersOfTheirOwn) {
  UnitConfig c = maker_pro();
  c.actuator.side[0].encoder = {12, 0.1};
  c.actuator.side[1].encoder = {6, -0.15};
  c.actuator.shaft_encoder = {9, 0.05};
  OneJoint joint(c, 0.4, 0.2, 0, 1'000'000);
  joint.step();
  const auto& read = joint.state.last_encoder;
  EXPECT_EQ(read[0], sensor::encoder_sample({12, 0.1}, 0.6));
  EXPECT_EQ(read[1], sensor::encoder_sample({6, -0.15}, 0.2));
  EXPECT_EQ(read[2], sensor::encoder_sample({9, 0.05}, 0.4));
}

TEST(Sides, HaveBridgesAndWiringOfTheirOwn) {
  const auto after = [](const UnitConfig& config, double equilibrium) {
    OneJoint joint(config, 0.0, 0.1, 1e-3, 1'000'000);
    for (int n = 0; n < 20; ++n) joint.step();
    command(joint, equilibrium, 0.1);
    for (int n = 0; n < 3; ++n) joint.step();
    return joint.state.held;
  };
  UnitConfig deaf = maker_pro(), crossed = maker_pro();
  deaf.actuator.side[0].bridge.dead_band = 0;
  deaf.actuator.side[1].bridge.dead_band = 0.9;
  const device::Held half = after(deaf, 0.03);
  EXPECT_GT(half.voltage[0], 0.5) << "half of the output";
  EXPECT_EQ(half.voltage[1], 0);
  crossed.actuator.side[1].polarity = -1;
  const device::Held full = after(crossed, 0.2);
  EXPECT_GT(full.voltage[0], 0.5);
  EXPECT_EQ(full.voltage[1], -full.voltage[0]);
  UnitConfig mixed = maker_pro();
  mixed.actuator.side[0].bridge.brake_when_off = false;
  OneJoint off(mixed, 0.0, 0.1, 1e-3, 1'000'000);
  off.state = off.unit.switched_on(0, 1, 0);
  off.step();
  EXPECT_EQ(off.state.held.terminal[0], drive::Terminal::open);
  EXPECT_EQ(off.state.held.terminal[1], drive::Terminal::driven) << "braked";
}

TEST(Sides, OfALawWithOneMotorAreOne) {
  UnitConfig alike = maker_pro(), first = maker_pro();
  alike.actuator.transmission = first.actuator.transmission = std::make_shared<elastic::SeriesSpring>(10.0);
  first.actuator.side[1] = {};  // forgotten
  OneJoint a(alike, 0.0, 0.0, 1e-3, 1'000'000), b(first, 0.0, 0.0, 1e-3, 1'000'000);
  travel(a, 0);
  travel(b, 0);
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.state.program.loop.current[1].value, b.state.program.loop.current[1].value);
}

/// A law that says that its second input is a travel.
class InMetres final : public elastic::Transmission {
 public:
  explicit InMetres(std::shared_ptr<const Transmission> law) : law_(std::move(law)) {}
  [[nodiscard]] elastic::Response evaluate(const elastic::Positions& at) const noexcept override { return law_->evaluate(at); }
  [[nodiscard]] std::array<double, 2> references(const elastic::EquilibriumPreset& c) const noexcept override {
    return law_->references(c);
  }
  [[nodiscard]] elastic::EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override {
    return law_->attained(x);
  }
  [[nodiscard]] std::string_view preset_unit() const noexcept override { return "m"; }
  [[nodiscard]] std::string_view input_unit(std::size_t input) const noexcept override { return input == 1 ? "m" : "rad"; }

 private:
  std::shared_ptr<const Transmission> law_;
};

/// The lever along which springs move, h metres a radian of its second input.
std::shared_ptr<const elastic::Transmission> lever(double screw_m_per_rad) {
  const auto all = elastic::laws();
  const auto at = std::find_if(all.begin(), all.end(), [](const elastic::Law* l) { return l->name == "lever_spring"; });
  const std::array values{4000.0, 0.02, screw_m_per_rad};
  return (*at)->make(values);
}

constexpr double kScrew = 0.004;

UnitConfig by_screw() {
  UnitConfig c = unlike();
  c.actuator.tendon = {};
  c.actuator.transmission = elastic::with_lead(std::make_shared<InMetres>(lever(1.0)), 1, kScrew);
  return c;
}

TEST(TravelInput, GoesAsTheLawThatHasTheScrewAmongItsParameters) {
  UnitConfig folded = by_screw();
  folded.actuator.transmission = lever(kScrew);
  folded.preset_max = 4;
  OneJoint a(by_screw(), 0.0, 2 * kScrew, 1e-3, 1'000'000), b(folded, 0.0, 2, 1e-3, 1'000'000);
  travel(a, 3 * kScrew);
  travel(b, 3);
  EXPECT_NEAR(a.q, b.q, 1e-6);
  EXPECT_NEAR(a.state.actuator.motor[0].angle, b.state.actuator.motor[0].angle, 1e-6);
  EXPECT_NEAR(a.state.actuator.motor[1].angle, b.state.actuator.motor[1].angle, 1e-6);
  EXPECT_NEAR(a.state.actuator.load[1], b.state.actuator.load[1], 1e-5) << "N·m at the pulley";
  EXPECT_GT(std::abs(b.state.actuator.motor[1].angle), 1) << "the pulley's angle, as its encoder reads it";
  const auto& l = a.state.actuator.ledger;
  EXPECT_LT(std::abs(l.imbalance()), 1e-8 * l.moved());
}

TEST(TravelInput, WithoutALeadOrALeadWithoutATravelIsRefused) {
  const auto problems = [](const std::shared_ptr<const elastic::Transmission>& law) {
    UnitConfig c = by_screw();
    c.actuator.transmission = law;
    Problems found;
    device::validate(c, "", found);
    return found.list();
  };
  EXPECT_TRUE(problems(by_screw().actuator.transmission).empty());
  const auto bare = problems(std::make_shared<InMetres>(lever(1.0)));
  ASSERT_EQ(bare.size(), 1U);
  EXPECT_EQ(bare[0].key, "drive_2.lead_m_per_rad");
  const auto angle = problems(elastic::with_lead(lever(kScrew), 1, kScrew));
  ASSERT_EQ(angle.size(), 1U);
  EXPECT_EQ(angle[0].message, "this input of the law is an angle");
  EXPECT_EQ(problems(elastic::with_lead(std::make_shared<InMetres>(lever(1.0)), 1, -1)).size(), 1U);
}

TEST(TravelInput, IsEqualToAnotherOfTheSameLawAndLead) {
  const auto law = lever(1.0), a = elastic::with_lead(law, 1, 0.01);
  EXPECT_TRUE(a->equals(*elastic::with_lead(lever(1.0), 1, 0.01)));
  EXPECT_FALSE(a->equals(*elastic::with_lead(law, 1, 0.02)));
  EXPECT_FALSE(a->equals(*elastic::with_lead(law, 0, 0.01)));
  EXPECT_FALSE(a->equals(*law));
  EXPECT_TRUE(elastic::with_lead(a, 1, 0.02)->equals(*elastic::with_lead(law, 1, 0.02))) << "another lead takes its place";
}

}  // namespace
}  // namespace vsa::test
