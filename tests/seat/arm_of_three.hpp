// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// An arm of three joints for seats that have some of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "seat/seats.hpp"
#include "vsa/seat/seat_group.hpp"

namespace vsa::seat::testing {

inline constexpr std::int64_t kStep_ns = Pendulums::kStep_ns;
inline constexpr std::array<std::string_view, 3> kNames{"shoulder", "elbow", "wrist"};
/// Of light links one behind the other.
inline constexpr std::array<std::array<double, 3>, 3> kB{{{3e3, -2e3, 4e2}, {-2e3, 9e3, -3e3}, {4e2, -3e3, 1.2e4}}};

/// A robot of some of the joints.
inline Model part(std::size_t first, std::size_t count) {
  std::string xml = "<plugin name='vsa::Robot' filename='libvsa-robot.so'>";
  Model out{"", "lab.sdf: part", "lab::part" + std::to_string(first), {}};
  for (std::size_t i = first; i < first + count; ++i) {
    const std::string name(kNames[i]);
    xml += "<actuator name='" + name + "'><joint>" + name + "</joint><type>qbmove_maker_pro_6_1</type><bus id='" +
           std::to_string(i + 1) + "'>arm</bus><initial preset_rad='0.6'/></actuator>";
    out.joints.push_back({name});
  }
  out.xml = xml + "<bus name='arm'/></plugin>";
  return out;
}

/// v' = v + dt·B·τ, q' = q + dt·v'. `tied`: how many of the joints, from the first on, move each other.
struct Arm {
  std::size_t tied = 3;
  std::array<double, 3> angle{0.2, -0.1, 0.15}, speed{}, torque{};

  [[nodiscard]] double b(std::size_t i, std::size_t k) const { return i == k || std::max(i, k) < tied ? kB[i][k] : 0; }
  void tell(Seat& seat, std::size_t first) const {
    for (std::size_t i = 0; i < seat.in().size(); ++i) {
      seat.in()[i].angle_rad = angle[first + i];
      seat.in()[i].speed_rad_per_s = speed[first + i];
    }
  }
  void fill(std::size_t first, std::size_t n, std::span<double> out) const {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) out[i * n + k] = b(first + i, first + k);
  }
  void move() {
    constexpr double dt = 1e-9 * kStep_ns;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) speed[i] += dt * b(i, k) * torque[k];
    for (std::size_t i = 0; i < 3; ++i) angle[i] += dt * speed[i];
  }
};

}  // namespace vsa::seat::testing
