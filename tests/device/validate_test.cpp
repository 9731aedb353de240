// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Every number of every parameter struct, wrong in turn: each is reported once, under its key. The structs are taken apart by
// structured bindings, so that a member that is added doesn't compile here until it is told.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "support/one_joint.hpp"
#include "support/servos.hpp"
#include "vsa/elastic/law.hpp"
#include "vsa/elastic/series_spring.hpp"
#include "vsa/errors.hpp"

namespace vsa::test {
namespace {

using device::UnitConfig;

/// Sees a number; `bad`: gives it another, as far as its type has it.
struct Visitor {
  int wanted = -1;
  double bad = 0;
  int count = 0;
  std::string key{};  // of the wanted one
  bool changed = false;

  template <class T>
  void operator()(const std::string& name, T& number) {
    if (count++ != wanted) return;
    key = name;
    const bool held = std::is_floating_point_v<T> || (std::isfinite(bad) && (bad >= 0 || std::is_signed_v<T>));
    if (!held) return;
    number = static_cast<T>(bad);
    changed = true;
  }
};

void visit(drive::FrictionParams& p, const std::string& where, Visitor& see) {
  auto& [coulomb, presliding] = p;
  see(where + "friction_Nm", coulomb);
  see(where + "presliding_rad", presliding);
}

void visit(sensor::EncoderParams& p, const std::string& where, Visitor& see) {
  auto& [bits, zero] = p;
  see(where + "encoder_bits", bits);
  see(where + "encoder_zero_rad", zero);
}

void visit(actuator::SideParams& p, const std::string& number, Visitor& see) {
  auto& [motor, gearbox, bridge, encoder, polarity] = p;
  const std::string where = "drive" + number + '.';
  auto& [inertia, viscous, torque_constant, back_emf, resistance, inductance] = motor;
  see(where + "inertia_kgm2", inertia);
  see(where + "viscous_Nms_per_rad", viscous);
  see(where + "torque_constant_Nm_per_A", torque_constant);
  see(where + "back_emf_Vs_per_rad", back_emf);
  see(where + "resistance_Ohm", resistance);
  see(where + "inductance_H", inductance.emplace(1e-3));
  auto& [ratio, friction, load_loss, back_loss] = gearbox;
  see(where + "gear_ratio", ratio);
  visit(friction, where, see);
  see(where + "load_loss", load_loss);
  see(where + "back_loss", back_loss.emplace(0.1));
  auto& [dead_band, brake_when_off, pin, period, switches, diode] = bridge;
  static_cast<void>(brake_when_off), static_cast<void>(pin);
  see(where + "dead_band", dead_band);
  see(where + "pwm_period_s", period);
  see(where + "switch_Ohm", switches);
  see(where + "diode_V", diode);
  visit(encoder, "sensor" + number + '.', see);
  see(where + "polarity", polarity);
}

void visit(actuator::ActuatorParams& p, Visitor& see) {
  auto& [transmission, side, supply, shaft_friction, tendon, shaft_encoder, shaft_zero, shaft_scale, shaft_inertia] = p;
  static_cast<void>(transmission);
  visit(side[0], "", see);
  visit(side[1], "_2", see);
  see("drive.supply_V", supply);
  visit(shaft_friction, "shaft.", see);
  auto& [friction, presliding, damping] = tendon;
  see("tendon.friction", friction);
  see("tendon.presliding_J", presliding);
  see("tendon.damping_s", damping);
  visit(shaft_encoder, "sensor.", see);
  see("sensor.shaft_zero_rad", shaft_zero);
  see("sensor.shaft_scale", shaft_scale);
  see("shaft.inertia_kgm2", shaft_inertia);
}

void visit(UnitConfig& c, Visitor& see) {
  auto& [actuator, program, memory, preset_max, substep_max, servo] = c;
  static_cast<void>(servo);
  visit(actuator, see);
  see("firmware.row_write_ns", program.row_write_ns);
  see("firmware.limit_low_raw", memory.limit_low[0]);
  see("firmware.limit_low_raw", memory.limit_low[1]);
  for (auto& factor : memory.multiplier) see("firmware.multiplier", factor);
  for (auto& bits : memory.resolution) see("firmware.resolution", bits);
  see("limits.preset_max", preset_max);
  see("physics.substep_max_s", substep_max);
}

void visit(control::ServoParams& p, Visitor& see) {
  auto& [kind, current_max, speed_filter, reference_max, position, torque] = p;
  see("control.current_max_A", current_max);
  see("control.speed_filter_s", speed_filter);
  if (kind == control::ServoKind::position_servo) {
    auto& [gain, speed_max, speed_gain, integral] = position;
    see("control.reference_max_rad", reference_max);
    see("control.position_gain_per_s", gain);
    see("control.speed_max_rad_per_s", speed_max);
    see("control.speed_gain_Nms_per_rad", speed_gain);
    see("control.speed_integral_Nm_per_rad", integral);
  } else {
    auto& [gain, integral, dead_zone, motor_damping, stiffness, damping] = torque;
    see("control.torque_gain", gain);
    see("control.torque_integral_per_s", integral);
    see("control.torque_dead_zone_Nm", dead_zone);
    see("control.motor_damping_Nms_per_rad", motor_damping);
    see("control.stiffness_Nm_per_rad", stiffness);
    see("control.damping_Nms_per_rad", damping);
  }
}

UnitConfig whole() {
  UnitConfig c = maker_pro();
  c.actuator.tendon = {0.1, 1e-3, 1e-3};
  return c;
}

std::vector<Problem> problems_of(const UnitConfig& c) {
  Problems found;
  device::validate(c, "", found);
  return found.list();
}

TEST(Validate, HasNothingAgainstAUnitThatIsWhole) { EXPECT_TRUE(problems_of(whole()).empty()); }

TEST(Validate, ReportsEveryNumberThatIsNoneOrOutOfRangeOnceUnderItsKey) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity(), kFarBelow = -2e3;
  std::set<std::string> keys;
  for (const double bad : {std::nan(""), kInfinity, -kInfinity, kFarBelow}) {
    for (int n = 0;; ++n) {
      UnitConfig c = whole();
      Visitor see{n, bad};
      visit(c, see);
      if (n >= see.count) break;
      const bool takes_it = bad == kFarBelow && (see.key == "firmware.limit_low_raw" || see.key == "firmware.multiplier");
      if (!see.changed || takes_it) continue;
      keys.insert(see.key);
      const auto problems = problems_of(c);
      ASSERT_EQ(problems.size(), 1U) << see.key << " = " << bad << (problems.empty() ? "" : ": " + problems[0].text());
      EXPECT_EQ(problems[0].key, see.key);
      EXPECT_THROW(device::Unit{c}, InputError) << see.key;
    }
  }
  EXPECT_EQ(keys.size(), 49U);
}

TEST(Validate, ReportsEveryNumberOfAServoToo) {
  for (const control::ServoParams& good : {position_servo(), torque_servo()}) {
    int count = 1;
    for (int n = 0; n < count; ++n) {
      for (const double bad : {std::nan(""), -1.0, 1e300}) {
        control::ServoParams p = good;
        Visitor see{n, bad};
        visit(p, see);
        count = see.count;
        Problems found;
        control::validate(p, "", found);
        ASSERT_EQ(found.list().size(), 1U) << see.key << " = " << bad;
        EXPECT_EQ(found.list()[0].key, see.key);
      }
    }
    EXPECT_EQ(count, good.kind == control::ServoKind::position_servo ? 7 : 8);
  }
}

TEST(Validate, TellsWhatBothSidesHaveWrongOnce) {
  UnitConfig c = whole();
  for (auto& side : c.actuator.side) side.motor.resistance_Ohm = std::nan(""), side.encoder.bits = 40;
  c.actuator.shaft_encoder.bits = 40;
  const auto problems = problems_of(c);
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_EQ(problems[0].key, "drive.resistance_Ohm");
  EXPECT_EQ(problems[1].key, "sensor.encoder_bits");
}

TEST(Validate, ReportsWhatDoesntGoTogether) {
  const auto only = [](const std::function<void(UnitConfig&)>& change, const char* key) {
    UnitConfig c = whole();
    change(c);
    const auto problems = problems_of(c);
    ASSERT_EQ(problems.size(), 1U) << key;
    EXPECT_EQ(problems[0].key, key);
    EXPECT_FALSE(problems[0].allowed.empty());
  };
  only([](auto& c) { c.actuator.tendon.presliding_J = 0; }, "tendon.presliding_J");
  only([](auto& c) { c.actuator.side[1].bridge = {0, true, drive::PwmPin::enable, 1e-4}; }, "drive_2.inductance_H");
  only([](auto& c) { c.program.model = firmware::Model::advanced, c.program.generation = firmware::Generation::v3; },
       "firmware.generation");
  only([](auto& c) { c.memory.limit_low.fill(5), c.memory.limit_high.fill(5); }, "firmware.limit_low_raw");
  only([](auto& c) { c.actuator.transmission = nullptr; }, "elastic.law");
  only([](auto& c) { c.memory.resolution[2] = 9; }, "firmware.resolution");
}

TEST(Validate, SeesIntoLawsThatWereMadeByHand) {
  for (std::size_t n = 0; n < 7; ++n) {
    elastic::TwoSinhParams p{{0.02, 0.02}, {7, 7}, {0.1, 0.1}, 1.0};
    double* const numbers[] = {&p.k_Nm[0],         &p.k_Nm[1],         &p.a_per_rad[0],     &p.a_per_rad[1],
                               &p.c_Nm_per_rad[0], &p.c_Nm_per_rad[1], &p.linear_beyond_rad};
    const char* const keys[] = {"k1_Nm",         "k2_Nm",         "a1_per_rad",       "a2_per_rad",
                                "c1_Nm_per_rad", "c2_Nm_per_rad", "linear_beyond_rad"};
    for (const double bad : {std::nan(""), -1.0}) {
      *numbers[n] = bad;
      UnitConfig c = whole();
      c.actuator.transmission = std::make_shared<elastic::TwoSinh>(p);
      const auto problems = problems_of(c);
      ASSERT_EQ(problems.size(), 1U) << keys[n];
      EXPECT_EQ(problems[0].key, "elastic." + std::string(keys[n]));
    }
  }
  UnitConfig c = whole();
  c.actuator.tendon = {};
  c.actuator.transmission = std::make_shared<elastic::SeriesSpring>(std::nan(""));
  EXPECT_EQ(problems_of(c).size(), 1U);
}

TEST(Validate, ReportsEveryFaultThatIsOutOfRange) {
  for (const double bad : {std::nan(""), -1.0, 1e9}) {
    for (int n = 0; n < 7; ++n) {
      device::Faults f;
      double* const numbers[] = {&f.lost_byte,
                                 &f.flipped_byte,
                                 &f.late_s,
                                 &f.encoder[0].noise_rad,
                                 &f.encoder[1].noise_rad,
                                 &f.encoder[2].noise_rad,
                                 &f.supply_V.emplace(12)};
      *numbers[n] = bad;
      Problems found;
      device::validate(f, "joint_1: ", found);
      ASSERT_EQ(found.list().size(), 1U) << n;
      EXPECT_EQ(found.list()[0].key.rfind("joint_1: ", 0), 0U);
      EXPECT_NE(f.impossible(), nullptr);
    }
  }
}

TEST(Validate, OfALawsValuesKnowsItsBoundsAndWhatDoesntGoTogether) {
  for (const elastic::Law* law : elastic::laws()) {
    std::vector<double> values;
    for (const elastic::LawParameter& p : law->parameters) values.push_back(std::sqrt(std::max(p.min, 1e-6) * p.max));
    for (std::size_t i = 0; i < values.size(); ++i) {
      const elastic::LawParameter& p = law->parameters[i];
      for (const double bad : {std::nan(""), p.min - 1, 2 * p.max + 1}) {
        std::vector<double> wrong = values;
        wrong[i] = bad;
        Problems found;
        elastic::validate(*law, wrong, "elastic.", found);
        ASSERT_EQ(found.list().size(), 1U) << law->name << ' ' << p.key;
        EXPECT_EQ(found.list()[0].key, "elastic." + std::string(p.key));
      }
    }
    Problems found;
    elastic::validate(*law, std::vector<double>(values.size() + 1, 1.0), "", found);
    EXPECT_EQ(found.list().size(), 1U) << law->name;
  }
}

}  // namespace
}  // namespace vsa::test
