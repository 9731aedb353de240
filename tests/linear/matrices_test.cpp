// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The matrices against differences of the physics' own right-hand side, and against closed forms.
#include <Eigen/Dense>

#include "smooth.hpp"
#include "vsa/drive/pwm_cycle.hpp"
#include "vsa/errors.hpp"

namespace {

using namespace vsa;
using linear::DryFriction;
using linear::Firmware;
using linear::Model;
using test::Case;

/// ẋ of the smooth unit, from what the rooms below say: spring torques, currents, motor constants.
Eigen::VectorXd rates(const Case& c, const Model& m, const Eigen::VectorXd& x, const Eigen::VectorXd& u) {
  const actuator::ActuatorParams& p = c.unit.actuator;
  const auto current_is_state = [](const actuator::SideParams& s) {
    return s.motor.inductance_H && s.bridge.pin != drive::PwmPin::enable;
  };
  const int motors = p.transmission->motor_count();
  const std::array<int, 2> first{2, current_is_state(p.side[0]) ? 5 : 4};
  elastic::Positions at{x[0], {x[2], motors == 2 ? x[first[1]] : 0}};
  const elastic::Response r = p.transmission->evaluate(at);
  Eigen::VectorXd out(x.size());
  out[0] = x[1];
  out[1] = (r.torque + u[0] - m.damping_Nms_per_rad * x[1]) / m.inertia_kgm2;
  for (int i = 0; i < motors; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const actuator::SideParams& side = p.side[n];
    drive::MotorParams motor = drive::at_pulley(side.motor, side.gearbox.ratio);
    const bool chopped = side.bridge.pin == drive::PwmPin::enable;
    if (!chopped) motor.resistance_Ohm += side.bridge.switch_Ohm;
    const int k = first[n];
    double amps = (u[1 + i] - motor.back_emf_Vs_per_rad * x[k + 1]) / motor.resistance_Ohm;
    if (chopped)
      amps = drive::PwmCycle(side.bridge, p.supply_V, motor.resistance_Ohm, *motor.inductance_H, u[1 + i] / p.supply_V)
                 .mean(motor.back_emf_Vs_per_rad * x[k + 1])
                 .current;
    if (current_is_state(side)) {
      amps = x[k + 2];
      out[k + 2] = (u[1 + i] - motor.resistance_Ohm * amps - motor.back_emf_Vs_per_rad * x[k + 1]) / *motor.inductance_H;
    }
    out[k] = x[k + 1];
    out[k + 1] = (r.load[i] + motor.torque_constant_Nm_per_A * amps - motor.viscous_Nms_per_rad * x[k + 1]) / motor.inertia_kgm2;
  }
  return out;
}

struct Point {
  Eigen::VectorXd x, u;
};

Point point_of(const Model& m, int motors) {
  Point p{Eigen::VectorXd::Zero(m.a.rows()), Eigen::VectorXd::Zero(m.b.cols())};
  p.x[0] = m.rest.at.q;
  p.u[0] = m.rest.load_Nm;
  for (int i = 0; i < motors; ++i) {
    const Eigen::Index at = test::angle_of(m, i);
    p.x[at] = m.rest.at.x[i];
    if (test::has_current(m, i)) p.x[at + 2] = m.rest.motor_A[i];
    p.u[1 + i] = m.rest.motor_V[i];
  }
  return p;
}

Eigen::VectorXd difference(const std::function<Eigen::VectorXd(double)>& f) {
  constexpr double kStep = 2e-5;  // two differences, extrapolated: an error of fourth order
  return (8 * (f(kStep) - f(-kStep)) - (f(2 * kStep) - f(-2 * kStep))) / (12 * kStep);
}

TEST(Matrices, AreTheDerivativesOfTheSmoothUnit) {
  for (const Case& c : test::cases()) {
    const Model m = linear::linearize(c.unit, c.point, Firmware::frozen);
    const Point at = point_of(m, c.unit.actuator.transmission->motor_count());
    EXPECT_LT(rates(c, m, at.x, at.u).norm(), 1e-6 * m.a.norm()) << c.name << ": nothing moves there";
    for (Eigen::Index j = 0; j < at.x.size(); ++j) {
      const auto moved = [&](double by) { return rates(c, m, at.x + by * Eigen::VectorXd::Unit(at.x.size(), j), at.u); };
      EXPECT_LT((m.a.col(j) - difference(moved)).norm(), 1e-6 * m.a.col(j).norm() + 1e-9) << c.name << ", state " << j;
    }
    for (Eigen::Index j = 0; j < at.u.size(); ++j) {
      const auto pushed = [&](double by) { return rates(c, m, at.x, at.u + by * Eigen::VectorXd::Unit(at.u.size(), j)); };
      EXPECT_LT((m.b.col(j) - difference(pushed)).norm(), 1e-6 * m.b.col(j).norm()) << c.name << ", input " << j;
    }
  }
}

TEST(Matrices, NameTheirStatesInputsAndOutputs) {
  for (const Case& c : test::cases()) {
    for (const Firmware f : {Firmware::frozen, Firmware::averaged, Firmware::sampled}) {
      const Model m = linear::linearize(c.unit, c.point, f);
      EXPECT_EQ(static_cast<std::size_t>(m.a.rows()), m.states.size()) << c.name;
      EXPECT_EQ(static_cast<std::size_t>(m.b.cols()), m.inputs.size());
      EXPECT_EQ(static_cast<std::size_t>(m.c.rows()), m.outputs.size());
      EXPECT_EQ(m.c.cols(), m.a.cols());
      EXPECT_EQ(m.d.size(), m.c.rows() * m.b.cols());
    }
  }
}

TEST(Matrices, OutputsAreTheLawsTorqueAndTheAngles) {
  for (const Case& c : test::cases()) {
    const Model m = linear::linearize(c.unit, c.point, Firmware::frozen);
    const int motors = c.unit.actuator.transmission->motor_count();
    const auto torque = [&](double by, int i) {
      elastic::Positions at = m.rest.at;
      (i < 0 ? at.q : at.x[i]) += by;
      return Eigen::VectorXd::Constant(1, c.unit.actuator.transmission->evaluate(at).torque);
    };
    for (int i = -1; i < motors; ++i) {
      const Eigen::Index j = i < 0 ? 0 : test::angle_of(m, i);
      const double expected = difference([&](double by) { return torque(by, i); })[0];
      EXPECT_NEAR(m.c(2, j), expected, 1e-6 * std::abs(expected)) << c.name;
      EXPECT_EQ(m.c(i < 0 ? 0 : 3 + i, j), 1);
    }
  }
}

TEST(Stiffness, WithHeldMotorsIsTheLawsOwn) {
  for (const Case& c : test::cases()) {
    const Model m = linear::linearize(c.unit, c.point, Firmware::frozen);
    const elastic::Hessian h = c.unit.actuator.transmission->evaluate(m.rest.at).curvature;
    EXPECT_EQ(m.held_stiffness_Nm_per_rad, h.qq) << c.name;
    EXPECT_NEAR(-m.a(1, 0) * m.inertia_kgm2, h.qq, 1e-12 * h.qq);
    EXPECT_EQ(m.static_stiffness_Nm_per_rad, 0) << "motors whose voltages are given let the shaft go where it likes";
  }
}

TEST(Stiffness, AtRestIsTheImpedancesLimit) {
  for (const Case& c : test::cases()) {
    for (const Firmware f : {Firmware::averaged, Firmware::sampled}) {
      const Model m = linear::linearize(c.unit, c.point, f);
      const double slow = 1.0 / linear::response(m, 1e-4).compliance.real();
      EXPECT_NEAR(m.static_stiffness_Nm_per_rad, slow, 1e-5 * m.held_stiffness_Nm_per_rad) << c.name;
      EXPECT_LT(m.static_stiffness_Nm_per_rad, m.held_stiffness_Nm_per_rad) << "motors yield";
      EXPECT_GT(m.static_stiffness_Nm_per_rad, 0);
    }
  }
}

TEST(Stiffness, OfOneSpringBehindOneMotorIsTheirSeries) {
  const device::UnitConfig unit = test::smooth("sea_example", {{"drive.dead_band", "0"}});
  const Model m = linear::linearize(unit, test::point(0, 0, 0, 1e-3), Firmware::averaged);
  // 0.1 % per raw of 65536 per turn, in 16.16 fixed point 6553; 61/101 of 12 V at 100 %; 1.02 N·m/A on 2.3 Ω.
  const double motor = 6553.0 / (2 * kPi) * (61.0 / 101 * 12 / 100) * 1.02 / 2.3, spring = 10;
  EXPECT_NEAR(m.static_stiffness_Nm_per_rad, motor * spring / (motor + spring), 1e-9);
}

TEST(DryFriction, StuckIsTheBristlesStiffness) {
  const device::UnitConfig unit = test::loaded("qbmove_maker_pro_6_1");
  const linear::OperatingPoint point = test::point(0, 0.3, 0.05, 1e-3);
  const Model sliding = linear::linearize(unit, point, Firmware::frozen);
  const Model stuck = linear::linearize(unit, point, Firmware::frozen, DryFriction::stuck);
  const elastic::Response r = unit.actuator.transmission->evaluate(sliding.rest.at);
  // 0.02565 N·m on 0.03 rad at the shaft, 0.0479 on 0.03 at a gear, μ = 0.1394 on 0.288 mJ at a tendon.
  const std::array<double, 2> kappa{0.1394 / 0.000288 * r.load[0] * r.load[0], 0.1394 / 0.000288 * r.load[1] * r.load[1]};
  EXPECT_NEAR(stuck.held_stiffness_Nm_per_rad - sliding.held_stiffness_Nm_per_rad, 0.02565 / 0.03 + kappa[0] + kappa[1], 1e-9);
  EXPECT_NEAR((sliding.a(3, 2) - stuck.a(3, 2)) * 0.001, 0.0479 / 0.03 + kappa[0], 1e-9);
  EXPECT_NEAR((stuck.a(3, 0) - sliding.a(3, 0)) * 0.001, kappa[0], 1e-9);
  EXPECT_NEAR((stuck.a(1, 5) - sliding.a(1, 5)) * 1e-3, kappa[1] * 0.0003, 1e-12);
  EXPECT_GT(stuck.static_stiffness_Nm_per_rad, 0) << "gears that stick hold the pulleys";
}

TEST(DryFriction, ChangesNothingWhereThereIsNone) {
  for (const Case& c : test::cases()) {
    const Model sliding = linear::linearize(c.unit, c.point, Firmware::frozen);
    EXPECT_EQ(sliding.a, linear::linearize(c.unit, c.point, Firmware::frozen, DryFriction::stuck).a) << c.name;
  }
}

TEST(OperatingPoint, IsWhereALoadPutsTheShaft) {
  const device::UnitConfig unit = test::smooth("qbmove_maker_pro_6_1");
  linear::OperatingPoint point{0.2, 0.1};
  EXPECT_NEAR(linear::linearize(unit, point, Firmware::frozen).rest.at.q, 0.2, 1e-12) << "without a load at the equilibrium";
  for (const double load : {-0.5, 0.3}) {
    point.load_Nm = load;
    const Model m = linear::linearize(unit, point, Firmware::frozen);
    EXPECT_NEAR(unit.actuator.transmission->evaluate(m.rest.at).torque, -load, 1e-9);
    EXPECT_NEAR(m.rest.load_Nm, load, 1e-9);
    EXPECT_GT((m.rest.at.q - 0.2) * load, 0);
  }
  EXPECT_EQ(linear::linearize(unit, point, Firmware::frozen).inertia_kgm2, 1e-4) << "the bare flange";
}

void expect_refused(const std::function<void()>& what, const std::vector<std::string>& parts) {
  try {
    what();
    ADD_FAILURE() << "not refused: " << parts.front();
  } catch (const InputError& e) {
    for (const auto& part : parts) EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << part << " in " << e.what();
  }
}

TEST(OperatingPoint, RefusesWhatCantBe) {
  const device::UnitConfig unit = test::smooth("qbmove_maker_pro_6_1");
  const auto frozen = [&](const linear::OperatingPoint& p) {
    return [&unit, p] { (void)linear::linearize(unit, p, Firmware::frozen); };
  };
  expect_refused(frozen({0, 0.9}), {"preset", "0.9", "0.785"});
  expect_refused(frozen({NAN, 0}), {"equilibrium_rad"});
  expect_refused(frozen({0, 0, 0.0, 0, 0.0}), {"inertia_kgm2", "above 0"});
  expect_refused(frozen({0, 0, 0.0, 0, 1e-3, -1.0}), {"damping_Nms_per_rad", "≥ 0"});
  expect_refused(frozen({0, 0, std::nullopt, NAN}), {"load_Nm"});
  expect_refused(frozen({0, 0, 1.5}), {"motor 1", "motor 2", "V"});
  expect_refused([] { (void)linear::linearize(test::smooth("sea_example"), {0, 0.1}, Firmware::frozen); }, {"no stiffness preset"});
  device::UnitConfig integral = unit;
  integral.memory.position.i = 655;
  expect_refused([&] { (void)linear::linearize(integral, {}, Firmware::sampled); }, {"firmware.ki_pct_per_tick"});
  EXPECT_NO_THROW((void)linear::linearize(integral, {}, Firmware::frozen));
  device::UnitConfig hard = test::loaded("qbmove_maker_pro_6_1");
  for (auto& side : hard.actuator.side) side.gearbox.friction.presliding_rad = 0;
  expect_refused([&] { (void)linear::linearize(hard, {}, Firmware::frozen, DryFriction::stuck); }, {"drive.presliding_rad"});
  const Model sampled = linear::linearize(unit, {}, Firmware::sampled);
  expect_refused([&] { (void)linear::response(sampled, 500); }, {"frequency_Hz", "loop's rate"});
  expect_refused([&] { (void)linear::response(sampled, 0); }, {"frequency_Hz"});
}

TEST(OperatingPoint, TellsOfADeadBandAndOfAnEnablePinThatGivesNothing) {
  const Model dead = linear::linearize(test::smooth("sea_example"), {}, Firmware::averaged);
  ASSERT_EQ(dead.notices.size(), 1u);
  EXPECT_NE(dead.notices[0].find("motor 1 rests inside its bridge's dead band"), std::string::npos);
  EXPECT_EQ(dead.static_stiffness_Nm_per_rad, 0);
  EXPECT_TRUE(linear::linearize(test::smooth("sea_example"), {}, Firmware::frozen).notices.empty());
  EXPECT_EQ(linear::linearize(test::smooth("qbmove_maker_pro"), {}, Firmware::frozen).notices.size(), 2u);
}

}  // namespace
