// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Shipped types without dry friction, and the same physics stepped by actuator::Actuator about a point.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/linear/linear.hpp"

namespace vsa::test {

inline device::UnitConfig loaded(const std::string& type, const std::vector<config::Override>& overrides = {}) {
  return config::TypeLibrary().load(type, overrides).unit;
}

inline device::UnitConfig smooth(const std::string& type, std::vector<config::Override> overrides = {}) {
  for (const char* key : {"drive.friction_Nm", "drive.load_loss", "tendon.friction", "shaft.friction_Nm"}) {
    overrides.push_back({key, "0"});
  }
  return loaded(type, overrides);
}

/// A differential: the shaft hangs at the mean of two pulleys, which a spring of their own joins. H has all its mixed terms.
class Differential : public elastic::Transmission {
 public:
  [[nodiscard]] elastic::Response evaluate(const elastic::Positions& at) const noexcept override {
    const double bend = at.q - 0.5 * (at.x[0] + at.x[1]), apart = at.x[0] - at.x[1];
    elastic::Response r;
    r.energy = 0.5 * kShaft * bend * bend + 0.5 * kBetween * apart * apart;
    r.torque = -kShaft * bend;
    r.load = {0.5 * kShaft * bend - kBetween * apart, 0.5 * kShaft * bend + kBetween * apart};
    const double own = 0.25 * kShaft + kBetween;
    r.curvature = {.qq = kShaft, .qx = {-0.5 * kShaft, -0.5 * kShaft}, .xx = {own, own}, .x0x1 = 0.25 * kShaft - kBetween};
    return r;
  }
  [[nodiscard]] std::array<double, 2> references(const elastic::EquilibriumPreset& c) const noexcept override {
    return {c.equilibrium + c.preset, c.equilibrium - c.preset};
  }
  [[nodiscard]] elastic::EquilibriumPreset attained(const std::array<double, 2>& x) const noexcept override {
    return {0.5 * (x[0] + x[1]), 0.5 * (x[0] - x[1])};
  }
  static constexpr double kShaft = 6, kBetween = 0.8;
};

inline device::UnitConfig with_differential(device::UnitConfig unit) {
  unit.actuator.transmission = std::make_shared<Differential>();
  return unit;
}

/// Where a motor's angle is among a model's states; its speed follows, and its current where that is one.
inline Eigen::Index angle_of(const linear::Model& m, int motor) {
  const std::string name = "motor " + std::to_string(motor + 1) + " angle";
  const auto at = std::find_if(m.states.begin(), m.states.end(), [&](const linear::Signal& s) { return s.name == name; });
  return at - m.states.begin();
}
inline bool has_current(const linear::Model& m, int motor) {
  const auto n = static_cast<std::size_t>(angle_of(m, motor)) + 2;
  return n < m.states.size() && m.states[n].unit == "A";
}

/// A type at a point, as the tests go through them: equal and unequal springs, one spring, tangents beyond an edge, an inductance, a
/// modulated enable pin; centred and off it; light and heavy.
struct Case {
  std::string name;
  device::UnitConfig unit;
  linear::OperatingPoint point;
};

inline linear::OperatingPoint point(double equilibrium, double preset, double shaft, double inertia, double damping = 0) {
  return {equilibrium, preset, shaft, 0, inertia, damping};
}

inline std::vector<Case> cases() {
  const auto high_supply = std::vector<config::Override>{{"drive.supply_V", "24"}, {"firmware.supply_limit", "false"}};
  auto slow_winding = high_supply;
  slow_winding.push_back({"drive.inductance_H", "0.02"});
  auto mixed = slow_winding;
  mixed.insert(mixed.end(), {{"drive_2.pwm_pin", "enable"}, {"drive_2.pwm_period_s", "5e-5"}, {"drive_2.inductance_H", "2e-4"}});
  return {{"mixed terms", with_differential(smooth("qbmove_maker_pro_6_1")), point(0.1, 0.2, 0.15, 2e-3)},
          {"two sinh, centred", smooth("qbmove_maker_pro_paper"), point(0, 0.3, 0, 1e-3)},
          {"two sinh, aside", smooth("qbmove_maker_pro_paper"), point(0.4, 0.3, 0.6, 5e-3, 0.01)},
          {"two unequal sinh", smooth("qbmove_maker_pro_datasheet"), point(-0.2, 0.2, 0.0, 2e-3)},
          {"advanced", smooth("qbmove_advanced"), point(0, 0.2, 0.1, 1e-3)},
          {"with linear parts", smooth("qbmove_maker_pro_6_1"), point(0, 0.3, 0.05, 1e-3)},
          {"tangents beyond the edge", smooth("qbmove_maker_pro_6_1", high_supply), point(0, 0.6, 0.2, 1e-2)},
          {"enable pin modulated", smooth("qbmove_maker_pro"), point(0, 0.3, 0.05, 2e-3)},
          {"winding with a current of its own", smooth("qbmove_maker_pro_6_1", slow_winding), point(0, 0.3, 0.05, 1e-3)},
          {"two unlike sides",
           smooth("qbmove_maker_pro_6_1", {{"drive_2.inertia_kgm2", "0.002"},
                                           {"drive_2.viscous_Nms_per_rad", "0.05"},
                                           {"drive_2.torque_constant_Nm_per_A", "1.4"},
                                           {"drive_2.back_emf_Vs_per_rad", "1.1"},
                                           {"drive_2.resistance_Ohm", "4"},
                                           {"drive_2.switch_Ohm", "0.3"},
                                           {"drive_2.gear_ratio", "0.9"}}),
           point(0, 0.3, 0.05, 1e-3)},
          {"a winding on one side, a modulated enable pin on the other", smooth("qbmove_maker_pro_6_1", mixed),
           point(0, 0.3, 0.05, 1e-3)},
          {"one spring", smooth("sea_example"), point(0.3, 0, 0.35, 2e-3, 0.002)}};
}

/// The unit at its point with the bridges' voltages as they are there; leapfrog for the shaft, whose own errors are of second order.
class Stepped {
 public:
  Stepped(const Case& c, double h_s)
      : actuator_(c.unit.actuator), model_(linear::linearize(c.unit, c.point, linear::Firmware::frozen)), h_(h_s) {
    shaft_ = model_.rest.at.q;
    state_ = actuator_.initial(model_.rest.at.x, shaft_);
    for (int i = 0; i < actuator_.motors(); ++i)
      if (has_current(model_, i)) state_.motor[i].current = model_.rest.motor_A[i];
    supply_ = c.unit.actuator.supply_V;
    acceleration_ = 0;
  }

  [[nodiscard]] const linear::Model& model() const { return model_; }
  [[nodiscard]] double deviation() const { return shaft_ - model_.rest.at.q; }
  [[nodiscard]] double speed() const { return speed_; }

  /// Moves shaft, pulleys and currents by this much, in the order of the model's states.
  void displace(const Eigen::VectorXd& by) {
    auto x = model_.rest.at.x;
    shaft_ = model_.rest.at.q + by[0];
    speed_ = by[1];
    for (int i = 0, k = 2; i < actuator_.motors(); ++i) {
      x[i] += by[k++];
      state_.motor[i].speed = by[k++];
      if (has_current(model_, i)) state_.motor[i].current = model_.rest.motor_A[i] + by[k++];
      state_.motor[i].angle = state_.motor_anchor[i] = x[i];
    }
    actuator_.place(state_, shaft_);
    acceleration_ =
        (actuator_.spring(state_, shaft_).torque + model_.rest.load_Nm - model_.damping_Nms_per_rad * speed_) / model_.inertia_kgm2;
  }

  /// One step under the point's load and this torque beside it, which is that of the step's middle.
  void step(double torque_Nm) {
    const double dq = h_ * speed_ + 0.5 * h_ * h_ * acceleration_;
    actuator::SegmentInput in;
    in.dq = dq;
    in.voltage = model_.rest.motor_V;
    in.supply_V = supply_;
    const double spring = actuator_.segment(state_, h_, in).torque;
    const double rub = model_.damping_Nms_per_rad * dq / h_;
    acceleration_ = (spring + model_.rest.load_Nm + torque_Nm - rub) / model_.inertia_kgm2;
    shaft_ += dq;
    speed_ += h_ * acceleration_;
  }

 private:
  actuator::Actuator actuator_;
  linear::Model model_;
  double h_, supply_ = 0, shaft_ = 0, speed_ = 0, acceleration_ = 0;
  actuator::ActuatorState state_;
};

/// Frequency and damping of a swing from its turning points, whatever slow motion lies under it: half a period lies between two, and
/// the ways from one to the next shrink by e^(−πζ/√(1−ζ²)).
struct Swing {
  double damped_Hz = 0, damping_ratio = 0;
};

inline Swing swing_of(const std::vector<double>& angle, double h_s, std::size_t turns) {
  std::vector<double> at, value;
  for (std::size_t i = 1; i + 1 < angle.size() && at.size() < turns; ++i) {
    const double before = angle[i] - angle[i - 1], after = angle[i + 1] - angle[i];
    if ((before > 0) == (after > 0)) continue;
    const double part = before / (before - after);  // a parabola through the three
    at.push_back((static_cast<double>(i) - 0.5 + part) * h_s);
    value.push_back(angle[i] + 0.125 * (before - after) * std::pow(2 * part - 1, 2));
  }
  if (at.size() < 3) return {};
  const auto way = [&](std::size_t k) { return std::abs(value[k + 1] - value[k]); };
  const std::size_t last = at.size() - 2;
  const double halves = static_cast<double>(last);
  const double decrement = std::log(way(0) / way(last)) / halves / kPi;
  return {0.5 * (halves + 1) / (at.back() - at.front()), decrement / std::hypot(1.0, decrement)};
}

}  // namespace vsa::test
