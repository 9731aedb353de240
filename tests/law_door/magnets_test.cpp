// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The door is open: a law that the library has never heard of, in this one file and magnets.toml beside it.
//
// Two rings of magnets with n pole pairs: motor 1 turns one to the equilibrium x₀, motor 2 pushes them together by x₁.
//
//   δ = q − x₀,   H = (m + s x₁) (1 − cos n δ)/n,   τ = −(m + s x₁) sin n δ,   σ = n (m + s x₁) cos n δ
//
// The preset is motor 2's angle x₁ in rad. For x₁ > −m/s; the joint slips beyond |δ| = π/(2n).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/one_joint.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/config/plugin_xml.hpp"

namespace {

using namespace vsa;

struct MagnetsParams {
  double torque_Nm, torque_Nm_per_rad, pole_pairs;
};

class Magnets final : public elastic::Transmission {
 public:
  explicit Magnets(const MagnetsParams& p) noexcept : p_(p) {}

  [[nodiscard]] elastic::Response evaluate(const elastic::Positions& at) const noexcept override {
    const double n = p_.pole_pairs, angle = n * (at.q - at.x[0]), m = p_.torque_Nm + p_.torque_Nm_per_rad * at.x[1];
    const double height = (1 - std::cos(angle)) / n, slope = std::sin(angle), bend = n * std::cos(angle);
    elastic::Response out{};
    out.energy = m * height;
    out.torque = -m * slope;
    out.load = {m * slope, -p_.torque_Nm_per_rad * height};
    const double tie = p_.torque_Nm_per_rad * slope;
    out.curvature = {.qq = m * bend, .qx = {-m * bend, tie}, .xx = {m * bend, 0}, .x0x1 = -tie};
    return out;
  }
  [[nodiscard]] std::array<double, 2> references(const elastic::EquilibriumPreset& c) const noexcept override {
    return {c.equilibrium, c.preset};
  }
  [[nodiscard]] elastic::EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override { return {x[0], x[1]}; }

  [[nodiscard]] const MagnetsParams& params() const noexcept { return p_; }

 private:
  MagnetsParams p_;
};

std::shared_ptr<const elastic::Transmission> make_magnets(config::LawReader& read) {
  const MagnetsParams p{read.number("torque_Nm", "N·m", 1e-3, 1e3, "largest torque with the rings at rest, m"),
                        read.number("torque_Nm_per_rad", "N·m/rad", 0, 1e3, "what motor 2 adds a radian, s"),
                        read.number("pole_pairs", "1", 1, 100, "of each ring, n")};
  if (p.pole_pairs != std::floor(p.pole_pairs)) throw InputError(Problem{"", "pole_pairs", "", "must be whole", "1, 2, …"});
  return std::make_shared<Magnets>(p);
}

config::TypeLibrary library() {
  config::LawRegistry laws = config::LawRegistry::standard();
  laws.add("magnets", make_magnets);
  return config::TypeLibrary({std::filesystem::path(VSA_SOURCE_DIR) / "tests/law_door"}, laws);
}

TEST(LawDoor, APresetOfAnUnknownLawLoadsOnceTheLawIsRegistered) {
  const config::ActuatorType type = library().load("magnets");
  EXPECT_EQ(type.law, "magnets");
  const auto* law = dynamic_cast<const Magnets*>(type.unit.actuator.transmission.get());
  ASSERT_NE(law, nullptr);
  EXPECT_EQ(law->params().torque_Nm, 0.2);
  EXPECT_EQ(law->params().pole_pairs, 2.0);
  EXPECT_EQ(type.unit.preset_max, 2.5);
  const config::TypeLibrary closed({std::filesystem::path(VSA_SOURCE_DIR) / "tests/law_door"});
  EXPECT_THROW((void)closed.load("magnets"), InputError);
}

TEST(LawDoor, TheLawsParametersAreOverriddenAndCheckedLikeAnyOther) {
  const config::ActuatorType softer = library().load("magnets", {{"elastic.torque_Nm", "0.1"}});
  EXPECT_EQ(dynamic_cast<const Magnets&>(*softer.unit.actuator.transmission).params().torque_Nm, 0.1);
  EXPECT_THROW((void)library().load("magnets", {{"elastic.pole_pairs", "2.5"}}), InputError);  // the law's own check
  EXPECT_THROW((void)library().load("magnets", {{"elastic.torque_Nm", "50"}}), InputError);    // beyond the type's bounds
}

TEST(LawDoor, ThePluginElementTakesItAsItTakesTheShippedOnes) {
  const char* xml =
      "<plugin name='vsa::Robot'><actuator><joint>hip</joint><type>magnets</type>"
      "<initial preset_rad='2'/></actuator></plugin>";
  const host::RobotConfig robot = config::parse_plugin(xml, "test", library());
  EXPECT_EQ(robot.actuators.at(0).initial_preset, 2.0);
}

TEST(LawDoor, TorqueLoadsAndCurvatureAreTheDerivativesOfTheEnergy) {
  const auto law = library().load("magnets").unit.actuator.transmission;
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
    EXPECT_NEAR(r.curvature.xx[0], -difference(0, 1, 0, load0), 1e-7);
    EXPECT_NEAR(r.curvature.x0x1, -difference(0, 0, 1, load0), 1e-7);
    EXPECT_NEAR(r.curvature.xx[1], -difference(0, 0, 1, load1), 1e-7);
  }
}

TEST(LawDoor, StiffnessAtRestRisesWithThePreset) {
  const auto law = library().load("magnets").unit.actuator.transmission;
  for (double x1 : {0.5, 1.0, 2.0}) EXPECT_NEAR(law->evaluate({0.3, {0.3, x1}}).curvature.qq, 2 * (0.2 + 0.4 * x1), 1e-12);
}

/// The unit on a joint with a little damping in the bearing, commanded from (0, 1) to (0.6, 2) rad and left alone.
test::OneJoint settled(double inertia_kgm2, double duration_s) {
  test::OneJoint joint(library().load("magnets").unit, 0.0, 1.0, inertia_kgm2, 1'000'000);
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
