// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/identify/quasi_static.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>

namespace vsa::identify {
namespace {

constexpr double kClose_rad = 1e-8;
constexpr double kFirst_rad = 0.02;  // half of the first bracket about a guess
constexpr double kReach_rad = 6.0;   // farther from its guess nothing is looked for
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The zero of a function that grows, near a guess; NaN where there is none within reach.
template <class Function>
double root(const Function& f, double guess) {
  double low = guess, high = guess, f_low = f(guess), f_high = f_low;
  if (f_low == 0) return guess;
  const bool up = f_low < 0;
  for (double step = kFirst_rad; (up ? f_high < 0 : f_low > 0); step *= 3) {
    if (!(step < kReach_rad)) return kNaN;
    if (up) {
      low = high, f_low = f_high;
      f_high = f(high += step);
    } else {
      high = low, f_high = f_low;
      f_low = f(low -= step);
    }
  }
  if (!(f_low <= 0 && f_high >= 0)) return kNaN;
  if (f_low == 0) return low;
  if (f_high == 0) return high;
  std::uintmax_t most = 60;
  const auto close = [](double a, double b) { return std::abs(b - a) < kClose_rad; };
  const auto found = boost::math::tools::toms748_solve(f, low, high, f_low, f_high, close, most);
  return 0.5 * (found.first + found.second);
}

}  // namespace

QuasiStatic::QuasiStatic(const device::UnitConfig& unit, double load_peak_Nm)
    : unit_(unit),
      drive_(unit),
      load_peak_Nm_(load_peak_Nm),
      gear_friction_Nm_(drive::at_pulley(unit.actuator.gearbox.friction, unit.actuator.gearbox.ratio).coulomb_Nm),
      back_loss_(unit.actuator.gearbox.back_loss.value_or(unit.actuator.gearbox.load_loss)),
      shaft_zero_rad_(unit.actuator.shaft_zero_rad),
      motors_(unit.actuator.transmission->motor_count()),
      springs_(unit.actuator.transmission->spring_count()) {}

/// −(M + l + s F) of motor i with its pulley at xi: grows with xi.
double QuasiStatic::pulley_residual(const Branch& b, const std::array<double, 2>& ref, std::array<double, 2> x, int i,
                                    double xi) const {
  const auto n = static_cast<std::size_t>(i);
  x[n] = xi;
  double load = unit_.actuator.transmission->evaluate({0.0, x}).load[n];
  if (i < springs_) load += unit_.actuator.tendon.friction * b.sense * std::abs(load);
  const bool drives_back = load * -b.sense > 0;
  const double loss = drives_back ? back_loss_ : unit_.actuator.gearbox.load_loss;
  return -(drive_.torque_Nm(ref[n] - xi) + load + b.sense * (gear_friction_Nm_ + loss * std::abs(load)));
}

bool QuasiStatic::solve_pulleys(const Branch& b, double equilibrium, std::array<double, 2>& x) const {
  constexpr int kRounds = 20;  // of a law whose inputs act on each other
  const std::array<double, 2> ref = unit_.actuator.transmission->references({equilibrium, b.preset});
  if (motors_ < 2) x[1] = ref[1];
  for (int round = 0; round < kRounds; ++round) {
    double moved = 0;
    for (int i = 0; i < motors_; ++i) {
      const auto n = static_cast<std::size_t>(i);
      const double found = root([&](double xi) { return pulley_residual(b, ref, x, i, xi); }, x[n]);
      if (std::isnan(found)) return false;
      moved = std::max(moved, std::abs(found - x[n]));
      x[n] = found;
    }
    if (motors_ < 2 || moved < 10 * kClose_rad) break;
    if (round == 0 && unit_.actuator.transmission->evaluate({0.0, x}).curvature.x0x1 == 0) break;
  }
  return true;
}

double QuasiStatic::shaft_residual(const Branch& b, double torque_Nm, const std::array<double, 2>& x) const {
  const elastic::Response r = unit_.actuator.transmission->evaluate({0.0, x});
  double out = torque_Nm + r.torque + b.sense * unit_.actuator.shaft_friction.coulomb_Nm;
  for (int i = 0; i < springs_; ++i)
    out -= unit_.actuator.tendon.friction * b.sense * std::abs(r.load[static_cast<std::size_t>(i)]);
  return out;
}

double QuasiStatic::solve(const Branch& b, double measured_torque_Nm, std::optional<Place>& place) const {
  // The recorded torque is that of the lever where the shaft's encoder sees it.
  const double measured = std::asin(std::clamp(-measured_torque_Nm / load_peak_Nm_, -1.0, 1.0));
  const double torque = -load_peak_Nm_ * std::sin(measured - shaft_zero_rad_);
  Place at = place.value_or(Place{0.0, unit_.actuator.transmission->references({0.0, b.preset})});
  bool found = true;
  const auto residual = [&](double equilibrium) {
    std::array<double, 2> x = at.x;
    for (double& v : x) v += equilibrium - at.equilibrium;
    if (!solve_pulleys(b, equilibrium, x)) {
      found = false;
      return kNaN;
    }
    at = {equilibrium, x};
    return shaft_residual(b, torque, x);
  };
  const double equilibrium = root(residual, at.equilibrium);
  if (!found || std::isnan(equilibrium)) return kNaN;
  (void)residual(equilibrium);
  place = at;
  return shaft_zero_rad_ - unit_.actuator.transmission->attained(at.x).equilibrium;
}

double QuasiStatic::deflection_rad(double preset, double torque_Nm, bool rising) const {
  std::optional<Place> place;
  return solve({preset, rising ? 1.0 : -1.0}, torque_Nm, place);
}

experiment::Branches QuasiStatic::branches(double preset, const std::vector<double>& torques_Nm) const {
  experiment::Branches out;
  out.torque_Nm = torques_Nm;
  for (const bool rising : {true, false}) {
    std::optional<Place> place;
    std::vector<double>& branch = rising ? out.rising_rad : out.falling_rad;
    for (const double torque : torques_Nm) branch.push_back(solve({preset, rising ? 1.0 : -1.0}, torque, place));
  }
  out.sd_rising_rad = out.sd_falling_rad = std::vector<double>(torques_Nm.size(), 0.0);
  return out;
}

}  // namespace vsa::identify
