// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/identify/quasi_static.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>

#include "vsa/actuator/actuator.hpp"
#include "vsa/not_a_number.hpp"

namespace vsa::identify {
namespace {

constexpr double kClose_rad = 1e-8;
constexpr double kFirst_rad = 0.02;  // half of the first bracket about a guess
constexpr double kReach_rad = 6.0;   // farther from its guess nothing is looked for

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

/// A bristle's bend after friction let go of what it can't hold.
template <class Friction>
double bent(const Friction& p, double u) {
  return std::clamp(u, -p.presliding_rad, p.presliding_rad);
}

/// Torque against a motion that bends the bristle to `u`; without one, against its sense.
template <class Friction>
double friction_at(const Friction& p, double u, double sense) {
  return p.stiffness > 0 ? p.stiffness * bent(p, u) : sense * p.coulomb_Nm;
}

drive::Friction gear_of(const actuator::SideParams& side) { return {drive::at_pulley(side.gearbox.friction, side.gearbox.ratio)}; }

std::array<StaticDrive, 2> drives_of(const device::UnitConfig& unit) {
  const StaticDrive first(unit, 0);
  const bool alike = unit.actuator.sides() == 1 || unit.actuator.side[0] == unit.actuator.side[1];
  return {first, alike ? first : StaticDrive(unit, 1)};
}

}  // namespace

QuasiStatic::QuasiStatic(const device::UnitConfig& unit, double load_peak_Nm)
    : unit_(unit),
      drive_(drives_of(unit)),
      load_peak_Nm_(load_peak_Nm),
      gear_{gear_of(unit.actuator.side[0]), gear_of(unit.actuator.side[1])},
      shaft_(actuator::shaft_friction(unit.actuator)),
      tendon_(drive::FrictionParams{unit.actuator.tendon.friction, unit.actuator.tendon.presliding_J}),
      shaft_zero_rad_(unit.actuator.shaft_zero_rad),
      motors_(unit.actuator.transmission->motor_count()),
      springs_(unit.actuator.transmission->spring_count()) {}

QuasiStatic::Place QuasiStatic::at_rest(double preset) const {
  Place out;
  out.x = unit_.actuator.transmission->references({0.0, preset});
  out.w = unit_.actuator.transmission->signed_energies({0.0, out.x});
  return out;
}

double QuasiStatic::rub(const Step& s, int spring, double w) const {
  const auto n = static_cast<std::size_t>(spring);
  return friction_at(tendon_, s.from.tendon_u[n] + w - s.from.w[n], -s.sense);
}

drive::FrictionOf<double> QuasiStatic::gear(std::size_t motor, double load, double sense) const {
  const drive::GearboxParams& box = unit_.actuator.side[motor].gearbox;
  return drive::at_load(gear_[motor], load * sense > 0 ? box.back_loss.value_or(box.load_loss) : box.load_loss, load);
}

/// −(M + l − F) of motor i with its pulley at xi: grows with xi.
double QuasiStatic::pulley_residual(const Step& s, std::array<double, 2> x, int i, double xi) const {
  const auto n = static_cast<std::size_t>(i);
  x[n] = xi;
  const elastic::Transmission& law = *unit_.actuator.transmission;
  double load = law.evaluate({0.0, x}).load[n];
  if (i < springs_ && tendon_.coulomb_Nm > 0) load += rub(s, i, law.signed_energies({0.0, x})[n]) * std::abs(load);
  const double moved = xi - s.from.x[n] + s.q - s.from.q;
  return friction_at(gear(n, load, s.sense), s.from.gear_u[n] + moved, s.sense) - load - drive_[n].torque_Nm(s.ref[n] - xi);
}

bool QuasiStatic::solve_pulleys(Step& s, double equilibrium, std::array<double, 2>& x) const {
  constexpr int kRounds = 20;  // of a law whose inputs act on each other
  s.ref = unit_.actuator.transmission->references({equilibrium, s.preset});
  if (motors_ < 2) x[1] = s.ref[1];
  for (int round = 0; round < kRounds; ++round) {
    double moved = 0;
    for (int i = 0; i < motors_; ++i) {
      const auto n = static_cast<std::size_t>(i);
      const double found = root([&](double xi) { return pulley_residual(s, x, i, xi); }, x[n]);
      if (std::isnan(found)) return false;
      moved = std::max(moved, std::abs(found - x[n]));
      x[n] = found;
    }
    if (motors_ < 2 || moved < 10 * kClose_rad) break;
    if (round == 0 && unit_.actuator.transmission->evaluate({0.0, x}).curvature.x0x1 == 0) break;
  }
  return true;
}

double QuasiStatic::shaft_residual(const Step& s, const std::array<double, 2>& x) const {
  const elastic::Transmission& law = *unit_.actuator.transmission;
  const elastic::Response r = law.evaluate({0.0, x});
  double out = r.torque - load_peak_Nm_ * std::sin(s.q) - friction_at(shaft_, s.from.shaft_u + s.q - s.from.q, s.sense);
  if (tendon_.coulomb_Nm <= 0) return out;
  const std::array<double, 2> w = law.signed_energies({0.0, x});
  for (int i = 0; i < springs_; ++i) {
    const auto n = static_cast<std::size_t>(i);
    out -= rub(s, i, w[n]) * std::abs(r.load[n]);
  }
  return out;
}

bool QuasiStatic::go(Place& place, double preset, double q) const {
  if (q == place.q) return true;
  Step s{place, q, preset, q > place.q ? 1.0 : -1.0, {}};
  std::array<double, 2> x = place.x;
  double at = place.equilibrium;
  bool found = true;
  const auto residual = [&](double equilibrium) {
    for (double& v : x) v += equilibrium - at;
    at = equilibrium;
    if (found) found = solve_pulleys(s, equilibrium, x);
    return found ? shaft_residual(s, x) : kNaN;
  };
  const double equilibrium = root(residual, at);
  if (!found || std::isnan(equilibrium) || std::isnan(residual(equilibrium))) return false;
  Place to{q,  equilibrium, x, unit_.actuator.transmission->signed_energies({0.0, x}), bent(shaft_, place.shaft_u + q - place.q),
           {}, {}};
  const elastic::Response r = unit_.actuator.transmission->evaluate({0.0, x});
  for (std::size_t n = 0; n < 2; ++n) {
    to.tendon_u[n] = bent(tendon_, place.tendon_u[n] + to.w[n] - place.w[n]);
    const double load =
        r.load[n] + (static_cast<int>(n) < springs_ ? rub(s, static_cast<int>(n), to.w[n]) * std::abs(r.load[n]) : 0);
    to.gear_u[n] = bent(gear(n, load, s.sense), place.gear_u[n] + x[n] - place.x[n] + q - place.q);
  }
  place = to;
  return true;
}

double QuasiStatic::go_to_turn(Place& place, double preset, const Turn& turn) const {
  constexpr int kSteps = 8;
  const double most = std::abs(turn.shaft_rad);
  for (int i = 1; i <= kSteps; ++i) {
    const Place before = place;
    const double q = most * i / kSteps;
    if (!go(place, preset, q)) break;
    if (!turn.amplitude_rad || place.q + place.equilibrium < *turn.amplitude_rad) continue;
    const double command = before.q + before.equilibrium;
    const double share = (*turn.amplitude_rad - command) / (place.q + place.equilibrium - command);
    place = before;
    (void)go(place, preset, before.q + share * (q - before.q));
    break;
  }
  return place.q;
}

std::vector<double> QuasiStatic::follow(Place& place, double preset, const std::vector<double>& torques_Nm, double turn) const {
  // The recorded torque is that of the lever where the shaft's encoder sees it.
  const double most = std::abs(turn);
  std::vector<double> out;
  for (const double torque : torques_Nm) {
    const double q = std::asin(std::clamp(-torque / load_peak_Nm_, -1.0, 1.0)) - shaft_zero_rad_;
    const bool there = std::abs(q) <= most && go(place, preset, q);
    out.push_back(there ? shaft_zero_rad_ - unit_.actuator.transmission->attained(place.x).equilibrium : kNaN);
  }
  (void)go(place, preset, turn);
  return out;
}

experiment::Branches QuasiStatic::branches(double preset, const std::vector<double>& torques_Nm, const Turn& turn) const {
  experiment::Branches out;
  out.torque_Nm = torques_Nm;
  Place place = at_rest(preset);
  const double most = go_to_turn(place, preset, turn);
  out.rising_rad = follow(place, preset, torques_Nm, -most);
  std::vector<double> falling(torques_Nm.rbegin(), torques_Nm.rend());
  falling = follow(place, preset, falling, most);
  out.falling_rad.assign(falling.rbegin(), falling.rend());
  out.sd_rising_rad = out.sd_falling_rad = std::vector<double>(torques_Nm.size(), 0.0);
  return out;
}

}  // namespace vsa::identify
