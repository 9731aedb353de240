// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A robot of two hinges and a host that is two pendulums, coupled by nothing.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "vsa/errors.hpp"
#include "vsa/seat/seat.hpp"

namespace vsa::seat::testing {

inline std::string element(const std::string& more = "", const std::string& of_first = "") {
  return "<plugin name='vsa::Robot' filename='libvsa-robot.so'><actuator name='shoulder'><joint>a::hinge</joint>"
         "<type>qbmove_maker_pro_6_1</type><bus id='1'>arm</bus>" +
         of_first +
         "</actuator><actuator name='elbow'><joint>b::hinge</joint><type>qbmove_maker_pro_6_1</type><bus id='2'>arm</bus>"
         "</actuator><bus name='arm'/>" +
         more + "</plugin>";
}

/// As a host lists them: not in the actuators' order, and more than they need.
inline std::vector<Joint> joints() { return {{"spare"}, {"b::hinge"}, {"a::hinge"}}; }

inline Model model(std::string xml = element()) { return {std::move(xml), "lab.sdf: arm", "lab::arm", joints()}; }

/// All that is wrong with a robot, as one text.
inline std::string problems_of(const Model& of, const Options& options = {}) {
  try {
    const Seat seat(of, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// Integrates what hangs on the joints as every engine does, v' = v + dt·a, q' = q + dt·v'.
struct Pendulums {
  static constexpr std::int64_t kStep_ns = 1'000'000;
  static constexpr double kInertia_kgm2 = 0.004, kWeight_Nm = 0.2;
  std::array<double, 2> angle{}, speed{};

  void tell(Seat& seat) const {
    for (std::size_t i = 0; i < 2; ++i) {
      seat.in()[i].angle_rad = angle[i];
      seat.in()[i].speed_rad_per_s = speed[i];
    }
  }
  template <class Torques>
  void move(const Torques& torque) {
    constexpr double dt = 1e-9 * kStep_ns;
    for (std::size_t i = 0; i < 2; ++i) {
      speed[i] += dt * (torque[i] - kWeight_Nm * std::sin(angle[i])) / kInertia_kgm2;
      angle[i] += dt * speed[i];
    }
  }
  void step(Seat& seat) {
    tell(seat);
    if (seat.wants_mobility()) seat.mobility()[0] = seat.mobility()[1] = 1 / kInertia_kgm2;
    seat.step(kStep_ns);
    move(seat.torques());
    tell(seat);
    seat.observe();
  }
};

}  // namespace vsa::seat::testing
