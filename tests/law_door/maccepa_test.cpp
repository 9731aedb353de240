// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The door is open: a law that the library has never heard of, in this one file and maccepa.toml beside it.
//
// MACCEPA: a motor turns a lever of length B to the equilibrium x₀; a spring pulls the output's pivot, at distance C, towards it
// over a cable that a second motor shortens by r x₁.
//
//   δ = q − x₀,   ℓ(δ) = √(B² + C² − 2BC cos δ),   e = ℓ − (C − B) + r x₁         spring's elongation, m
//   H = ½ κ max(e, 0)²                                                          a cable can't push
//   τ = −κ e ℓ',   load₀ = κ e ℓ',   load₁ = −κ e r,   σ = κ (e ℓ'' + ℓ'²)
//   ℓ' = BC sin δ/ℓ,   ℓ'' = (BC cos δ − ℓ'²)/ℓ
//
// The preset is the winch's angle x₁ in rad, not a half difference: at rest σ = κ r x₁ BC/(C − B). Valid for 0 < B < C, any δ.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/one_joint.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/config/plugin_xml.hpp"

namespace {

using namespace vsa;

struct MaccepaParams {
  double spring_N_per_m, arm_m, pivot_m, winch_m;
};

class Maccepa final : public elastic::Transmission {
 public:
  explicit Maccepa(const MaccepaParams& p) noexcept : p_(p) {}

  [[nodiscard]] elastic::Response evaluate(const elastic::Positions& at) const noexcept override {
    const double delta = at.q - at.x[0], bc = p_.arm_m * p_.pivot_m, k = p_.spring_N_per_m, r = p_.winch_m;
    const double l = std::sqrt(p_.arm_m * p_.arm_m + p_.pivot_m * p_.pivot_m - 2 * bc * std::cos(delta));
    const double l1 = bc * std::sin(delta) / l, l2 = (bc * std::cos(delta) - l1 * l1) / l;
    const double e = l - (p_.pivot_m - p_.arm_m) + r * at.x[1];
    elastic::Response out{};
    if (e <= 0) return out;
    out.energy = 0.5 * k * e * e;
    out.torque = -k * e * l1;
    out.load = {k * e * l1, -k * e * r};
    const double sigma = k * (e * l2 + l1 * l1);
    out.curvature = {.qq = sigma, .qx = {-sigma, k * r * l1}, .x0x0 = sigma, .x0x1 = -k * r * l1, .x1x1 = k * r * r};
    return out;
  }
  [[nodiscard]] std::array<double, 2> references(const elastic::EquilibriumPreset& c) const noexcept override {
    return {c.equilibrium, c.preset};
  }
  [[nodiscard]] elastic::EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override { return {x[0], x[1]}; }

  [[nodiscard]] const MaccepaParams& params() const noexcept { return p_; }

 private:
  MaccepaParams p_;
};

std::shared_ptr<const elastic::Transmission> make_maccepa(config::LawReader& read) {
  const MaccepaParams p{read.number("spring_N_per_m", "N/m", 1e-3, 1e6, "spring rate, kappa"),
                        read.number("arm_m", "m", 1e-4, 10, "lever from the motor to the cable's guide, B"),
                        read.number("pivot_m", "m", 1e-4, 10, "distance of the cable's fixation on the output, C"),
                        read.number("winch_m", "m", 1e-4, 1, "radius of the pretension winch, r")};
  if (!(p.arm_m < p.pivot_m)) throw InputError(Problem{"", "arm_m", "", "must be shorter than elastic.pivot_m", ""});
  return std::make_shared<Maccepa>(p);
}

config::TypeLibrary library() {
  config::LawRegistry laws = config::LawRegistry::standard();
  laws.add("maccepa", make_maccepa);
  return config::TypeLibrary({std::filesystem::path(VSA_SOURCE_DIR) / "tests/law_door"}, laws);
}

TEST(LawDoor, APresetOfAnUnknownLawLoadsOnceTheLawIsRegistered) {
  const config::ActuatorType type = library().load("maccepa");
  EXPECT_EQ(type.law, "maccepa");
  const auto* law = dynamic_cast<const Maccepa*>(type.unit.actuator.transmission.get());
  ASSERT_NE(law, nullptr);
  EXPECT_EQ(law->params().spring_N_per_m, 323.0);
  EXPECT_EQ(law->params().winch_m, 0.010);
  EXPECT_EQ(type.unit.preset_max, 2.5);
  const config::TypeLibrary closed({std::filesystem::path(VSA_SOURCE_DIR) / "tests/law_door"});
  EXPECT_THROW((void)closed.load("maccepa"), InputError);
}

TEST(LawDoor, TheLawsParametersAreOverriddenAndCheckedLikeAnyOther) {
  const config::ActuatorType softer = library().load("maccepa", {{"elastic.spring_N_per_m", "100"}});
  EXPECT_EQ(dynamic_cast<const Maccepa&>(*softer.unit.actuator.transmission).params().spring_N_per_m, 100.0);
  EXPECT_THROW((void)library().load("maccepa", {{"elastic.arm_m", "0.2"}}), InputError);    // longer than C: the law's own check
  EXPECT_THROW((void)library().load("maccepa", {{"elastic.winch_m", "0.5"}}), InputError);  // beyond the type's bounds
}

TEST(LawDoor, ThePluginElementTakesItAsItTakesTheShippedOnes) {
  const char* xml =
      "<plugin name='vsa::Robot'><actuator><joint>hip</joint><type>maccepa</type>"
      "<initial preset_rad='2'/></actuator></plugin>";
  const host::RobotConfig robot = config::parse_plugin(xml, "test", library());
  EXPECT_EQ(robot.actuators.at(0).initial_preset, 2.0);
}

TEST(LawDoor, TorqueLoadsAndCurvatureAreTheDerivativesOfTheEnergy) {
  const auto law = library().load("maccepa").unit.actuator.transmission;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-1.5, 1.5), winch(0.1, 2.5);
  constexpr double h = 1e-5;
  for (int i = 0; i < 200; ++i) {
    const elastic::Positions z{angle(random), {angle(random), winch(random)}};
    const elastic::Response r = law->evaluate(z);
    const auto moved = [&](double dq, double d0, double d1) { return law->evaluate({z.q + dq, {z.x[0] + d0, z.x[1] + d1}}); };
    const auto difference = [&](double dq, double d0, double d1, auto&& of) {
      return (of(moved(h * dq, h * d0, h * d1)) - of(moved(-h * dq, -h * d0, -h * d1))) / (2 * h);
    };
    const auto energy = [](const elastic::Response& v) { return v.energy; };
    const auto torque = [](const elastic::Response& v) { return v.torque; };
    const auto load0 = [](const elastic::Response& v) { return v.load[0]; };
    const auto load1 = [](const elastic::Response& v) { return v.load[1]; };
    EXPECT_NEAR(r.torque, -difference(1, 0, 0, energy), 1e-8);
    EXPECT_NEAR(r.load[0], -difference(0, 1, 0, energy), 1e-8);
    EXPECT_NEAR(r.load[1], -difference(0, 0, 1, energy), 1e-8);
    EXPECT_NEAR(r.curvature.qq, -difference(1, 0, 0, torque), 1e-7);
    EXPECT_NEAR(r.curvature.qx[0], -difference(0, 1, 0, torque), 1e-7);
    EXPECT_NEAR(r.curvature.qx[1], -difference(0, 0, 1, torque), 1e-7);
    EXPECT_NEAR(r.curvature.x0x0, -difference(0, 1, 0, load0), 1e-7);
    EXPECT_NEAR(r.curvature.x0x1, -difference(0, 0, 1, load0), 1e-7);
    EXPECT_NEAR(r.curvature.x1x1, -difference(0, 0, 1, load1), 1e-7);
  }
}

TEST(LawDoor, StiffnessAtRestIsProportionalToThePretension) {
  const auto law = library().load("maccepa").unit.actuator.transmission;
  for (double x1 : {0.5, 1.0, 2.0}) {
    EXPECT_NEAR(law->evaluate({0.3, {0.3, x1}}).curvature.qq, 323.0 * 0.010 * x1 * 0.03 * 0.18 / 0.15, 1e-12);
  }
}

/// The unit on a joint with a little damping in the bearing, commanded from (0, 1) to (0.6, 2) rad and left alone.
test::OneJoint settled(double inertia_kgm2, double duration_s) {
  test::OneJoint joint(library().load("maccepa").unit, 0.0, 1.0, inertia_kgm2, 1'000'000);
  joint.load = [&joint](double) { return -0.05 * joint.v; };
  joint.unit.set_inputs(joint.state, joint.unit.inputs_for(0.6, 2.0));
  while (static_cast<double>(joint.t_ns) * 1e-9 < duration_s) joint.step();
  joint.load = nullptr;
  return joint;
}

TEST(LawDoor, TheUnloadedShaftOfAUnitSettlesAtTheCommandedEquilibrium) {
  const test::OneJoint joint = settled(0.0061, 5.0);
  EXPECT_NEAR(joint.q, 0.6, 0.003);  // two counts of the 12-bit encoder
  EXPECT_NEAR(joint.v, 0.0, 0.005);
  const auto& motor = joint.state.actuator.motor;
  const auto attained = joint.unit.config().actuator.transmission->attained({motor[0].angle, motor[1].angle});
  EXPECT_NEAR(attained.equilibrium, 0.6, 0.003);
  EXPECT_NEAR(attained.preset, 2.0, 0.02);  // the proportional loop gives way to the spring's load on the winch
}

TEST(LawDoor, TheEnergyLedgerOfAUnitWithTheForeignLawCloses) {
  const actuator::Ledger& ledger = settled(0.0061, 5.0).state.actuator.ledger;
  EXPECT_GT(ledger.moved(), 0.1);
  EXPECT_LT(std::abs(ledger.imbalance()), 1e-9 * ledger.moved());
  EXPECT_LT(std::abs(ledger.integrator) + std::abs(ledger.coupling), 0.01 * ledger.moved());
}

}  // namespace
