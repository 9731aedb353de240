// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Poles and impedance against simulated motion: the actuator by itself with its voltages held, and the whole unit with its program.
#include <Eigen/Dense>

#include "smooth.hpp"

namespace {

using namespace vsa;
using linear::Firmware;
using linear::Model;
using linear::Pole;
using test::Case;

/// The least damped of the poles that swing.
Pole ringing(const Model& m) {
  Pole best{0, 0, 1};
  for (const Pole& p : linear::poles(m)) {
    if (p.s.imag() > 0 && p.damping_ratio < best.damping_ratio) best = p;
  }
  return best;
}

double damped_Hz(const Pole& p) { return p.s.imag() / (2 * kPi); }

TEST(Release, OfTheShaftRingsAsThePolesTell) {
  int swings = 0;
  for (Case c : test::cases()) {
    for (const double heavier : {1.0, 4.0}) {
      c.point.inertia_kgm2 = *c.point.inertia_kgm2 * heavier;
      const double h = 1e-5;
      test::Stepped unit(c, h);
      const Pole pole = ringing(unit.model());
      if (pole.damping_ratio > 0.5) continue;  // too few turns to read
      ++swings;
      // Released along the swing's own motion: from rest, the motors' settling would lie over the first turns.
      Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(unit.model().a.cast<std::complex<double>>());
      Eigen::Index at = 0;
      (solver.eigenvalues().array() - pole.s).abs().minCoeff(&at);
      const Eigen::VectorXcd shape = solver.eigenvectors().col(at);
      unit.displace((shape * (2e-4 / shape[0])).real());
      std::vector<double> angle;
      for (double t = 0; t < 6 / damped_Hz(pole); t += h) {
        angle.push_back(unit.deviation());
        unit.step(0);
      }
      const test::Swing swing = test::swing_of(angle, h, 6);
      EXPECT_NEAR(swing.damped_Hz, damped_Hz(pole), 0.02 * damped_Hz(pole)) << c.name;
      EXPECT_NEAR(swing.damping_ratio, pole.damping_ratio, 0.02 * pole.damping_ratio) << c.name;
    }
  }
  EXPECT_GE(swings, 12);
}

TEST(Release, FromRestRingsAtTheSameFrequency) {
  for (const double preset : {0.1, 0.4}) {
    const Case c{"", test::smooth("qbmove_maker_pro_6_1"), test::point(0, preset, 0, 0.01)};
    const double h = 2e-5;
    test::Stepped unit(c, h);
    const Pole pole = ringing(unit.model());
    unit.displace(1e-3 * Eigen::VectorXd::Unit(unit.model().a.rows(), 0));
    std::vector<double> angle;
    for (double t = 0; t < 4 / damped_Hz(pole); t += h) {
      angle.push_back(unit.deviation());
      unit.step(0);
    }
    EXPECT_NEAR(test::swing_of(angle, h, 6).damped_Hz, damped_Hz(pole), 0.02 * damped_Hz(pole)) << preset;
  }
}

/// The part of y that follows e^{jωt}, found beside a constant and a drift.
std::complex<double> phasor(const std::vector<double>& t, const std::vector<double>& y, double w) {
  Eigen::MatrixXd basis(static_cast<Eigen::Index>(t.size()), 4);
  for (std::size_t k = 0; k < t.size(); ++k)
    basis.row(static_cast<Eigen::Index>(k)) << std::cos(w * t[k]), -std::sin(w * t[k]), 1, t[k];
  const Eigen::Map<const Eigen::VectorXd> values(y.data(), static_cast<Eigen::Index>(y.size()));
  const Eigen::Vector4d x = basis.colPivHouseholderQr().solve(values);
  return {x[0], x[1]};
}

TEST(Impedance, IsThatOfASineTorque) {
  for (const Case& c : test::cases()) {
    for (const double frequency : {3.0, 12.0, 40.0}) {
      const double w = 2 * kPi * frequency, h = std::min(5e-5, 2e-3 / frequency);
      test::Stepped unit(c, h);
      const linear::Response expected = linear::response(unit.model(), frequency);
      const double torque = 1e-4 * w * std::abs(expected.impedance);  // the shaft swings by a tenth of a milliradian
      // Long enough for what swings freely to die away; what only drifts is fitted.
      double slowest = HUGE_VAL;
      for (const Pole& p : linear::poles(unit.model()))
        if (p.frequency_Hz > 0) slowest = std::min(slowest, -p.s.real());
      const double settle = std::ceil(8 / slowest * frequency) / frequency, end = settle + 3 / frequency;
      std::vector<double> time, speed;
      for (int k = 0; k * h < end; ++k) {
        if (k * h >= settle && k % 5 == 0) {
          time.push_back(k * h - settle);
          speed.push_back(unit.speed());
        }
        unit.step(torque * std::cos(w * (k + 0.5) * h));
      }
      const std::complex<double> found = torque / phasor(time, speed, w);
      EXPECT_LT(std::abs(found - expected.impedance), 0.02 * std::abs(expected.impedance))
          << c.name << " at " << frequency << " Hz: " << found << ", expected " << expected.impedance;
    }
  }
}

TEST(Impedance, OfTheActuatorAloneIsWithoutTheShaftsInertiaAndDamping) {
  const Case c = test::cases()[1];
  Case heavy = c;
  heavy.point.inertia_kgm2 = 1.0;
  heavy.point.damping_Nms_per_rad = 0.3;
  for (const double frequency : {0.5, 5.0, 50.0}) {
    const auto one = linear::response(linear::linearize(c.unit, c.point, Firmware::averaged), frequency);
    const auto other = linear::response(linear::linearize(heavy.unit, heavy.point, Firmware::averaged), frequency);
    EXPECT_NEAR(one.stiffness_Nm_per_rad, other.stiffness_Nm_per_rad, 1e-8 * 1.0 * std::pow(2 * kPi * frequency, 2));
    EXPECT_NEAR(one.damping_Nms_per_rad, other.damping_Nms_per_rad, 1e-8 * 2 * kPi * frequency);
  }
  const auto fast = linear::response(linear::linearize(c.unit, c.point, Firmware::frozen), 1e4);
  EXPECT_NEAR(fast.stiffness_Nm_per_rad, linear::linearize(c.unit, c.point, Firmware::frozen).held_stiffness_Nm_per_rad, 1e-3)
      << "pulleys can't follow";
}

/// The whole unit with its program, which holds the point; begun `aside_rad` from it and pushed by a sine. Its shaft at the ticks.
struct Track {
  std::vector<double> time, angle, speed;
};

Track run_unit(const device::UnitConfig& config, const Model& m, double seconds, double aside_rad, double push_Nm = 0,
               double w = 0) {
  constexpr std::int64_t kStep_ns = 50'000;
  constexpr double kStep_s = 1e-9 * kStep_ns;
  device::Unit unit(config);
  const auto command = unit.config().actuator.transmission->attained(m.rest.at.x);
  double q = m.rest.at.q + aside_rad, v = 0;
  device::UnitState state = unit.initial(command.equilibrium, command.preset, q);
  Track out;
  for (std::int64_t k = 0; static_cast<double>(k) * kStep_s < seconds; ++k) {
    const double t = static_cast<double>(k) * kStep_s;
    if (k % 20 == 0) {
      out.time.push_back(t);
      out.angle.push_back(q);
      out.speed.push_back(v);
    }
    const double torque = unit.step(state, k * kStep_ns, kStep_ns, {q, v, 1.0 / m.inertia_kgm2});
    v += kStep_s * (torque + push_Nm * std::cos(w * (t + 0.5 * kStep_s))) / m.inertia_kgm2;
    q += kStep_s * v;
  }
  return out;
}

struct Programmed {
  std::string name;
  device::UnitConfig unit;
  linear::OperatingPoint point;
};

/// Linear springs, so that a motion may be wide: many percents of duty and many counts, beside which the quantisation is small.
std::vector<Programmed> programmed() {
  using Overrides = std::vector<config::Override>;
  const auto fine = [](const char* type, Overrides more) {
    more.insert(more.end(), {{"sensor.encoder_bits", "16"}, {"drive.dead_band", "0"}});
    return test::smooth(type, more);
  };
  const Overrides weak_sinh{{"elastic.k1_Nm", "1"},        {"elastic.a1_per_rad", "0.7"}, {"elastic.k2_Nm", "1"},
                            {"elastic.a2_per_rad", "0.7"}, {"drive.supply_V", "3"},       {"firmware.kp_pct_per_tick", "-0.04"}};
  const Overrides linear_parts{
      {"elastic.k1_Nm", "1e-6"}, {"elastic.c1_Nm_per_rad", "2"}, {"elastic.k2_Nm", "1e-6"}, {"elastic.c2_Nm_per_rad", "2"}};
  return {{"one motor", fine("sea_example", {}), test::point(0.2, 0, 0.2, 0.02)},
          {"two motors", fine("qbmove_maker_pro_6_1", linear_parts), test::point(-0.1, 0, -0.1, 0.005)},
          {"loop of 500 Hz", fine("sea_example", {{"firmware.generation", "2"}}), test::point(0, 0, 0, 0.02)},
          {"advanced", fine("qbmove_advanced", weak_sinh), test::point(0, 0, 0, 0.02)}};
}

TEST(Program, SampledRingsAsTheWholeUnitDoes) {
  for (const std::size_t which : {0U, 1U}) {
    const Programmed c = programmed()[which];
    const Pole pole = ringing(linear::linearize(c.unit, c.point, Firmware::sampled));
    const double skip = 0.6 / damped_Hz(pole);  // the faster modes have died away by then
    const Model m = linear::linearize(c.unit, c.point, Firmware::sampled);
    std::vector<double> angle = run_unit(c.unit, m, skip + 3.2 / damped_Hz(pole), 0.3).angle;
    angle.erase(angle.begin(), angle.begin() + static_cast<std::ptrdiff_t>(skip / 1e-3));
    const test::Swing swing = test::swing_of(angle, 1e-3, 6);
    EXPECT_NEAR(swing.damped_Hz, damped_Hz(pole), 0.02 * damped_Hz(pole)) << c.name;
    EXPECT_NEAR(swing.damping_ratio, pole.damping_ratio, 0.02 * pole.damping_ratio) << c.name;
  }
}

TEST(Program, WithoutGainsSampledIsTheFrozenUnitSeenEveryMillisecond) {
  for (Case c : test::cases()) {
    c.unit.memory.position = {};
    const Model frozen = linear::linearize(c.unit, c.point, Firmware::frozen),
                sampled = linear::linearize(c.unit, c.point, Firmware::sampled);
    const Pole a = ringing(frozen), b = ringing(sampled);
    EXPECT_NEAR(std::abs(a.s - b.s), 0, 1e-7 * std::abs(a.s)) << c.name;
    const auto x = linear::response(frozen, 20).compliance, y = linear::response(sampled, 20).compliance;
    EXPECT_NEAR(std::abs(x - y), 0, 1e-7 * std::abs(x)) << c.name;
  }
}

TEST(Program, AnswersASineTorqueAsTheWholeUnitDoes) {
  for (const Programmed& c : programmed()) {
    const Model sampled = linear::linearize(c.unit, c.point, Firmware::sampled);
    const Pole pole = ringing(sampled);
    for (const double part : {0.5, 0.8, 1.5}) {
      const double frequency = part * pole.frequency_Hz, w = 2 * kPi * frequency;
      const std::complex<double> expected = linear::response(sampled, frequency).impedance;
      const double push = 0.25 * w * std::abs(expected);
      const double settle = 5 / std::abs(pole.s.real()), end = settle + std::ceil(settle * frequency) / frequency + 3 / frequency;
      Track run = run_unit(c.unit, sampled, end, 0, push, w);
      const auto skip = static_cast<std::ptrdiff_t>(settle / 1e-3);
      run.time.erase(run.time.begin(), run.time.begin() + skip);
      run.speed.erase(run.speed.begin(), run.speed.begin() + skip);
      const std::complex<double> found = push / phasor(run.time, run.speed, w);
      EXPECT_LT(std::abs(found - expected), 0.02 * std::abs(expected)) << c.name << " at " << frequency << " Hz";
      const std::complex<double> averaged =
          linear::response(linear::linearize(c.unit, c.point, Firmware::averaged), frequency).impedance;
      EXPECT_LT(std::abs(found - averaged), 0.02 * std::abs(averaged)) << c.name << ", averaged, at " << frequency << " Hz";
    }
  }
}

}  // namespace
