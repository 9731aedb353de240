// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Chains of light links whose joints belong to several robots, for every host: what one robot with all joints does, they do.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "chain/serial_worlds.hpp"

namespace vsa::test {

inline constexpr double kAside_rad = 0.2, kSharedTree_s = 3, kLateFrom_s = 1.5;

/// The joints' root mean square speed from a time on.
class LateSpeed {
 public:
  explicit LateSpeed(double from_s) : from_s_(from_s) {}
  void add(double t_s, double angle_rad, double speed_rad_per_s) {
    farthest_ = std::max(farthest_, std::abs(angle_rad - kAside_rad));
    if (t_s <= from_s_) return;
    sum_ += speed_rad_per_s * speed_rad_per_s;
    ++count_;
  }
  [[nodiscard]] double rad_per_s() const { return std::sqrt(sum_ / count_); }
  [[nodiscard]] double farthest_rad() const { return farthest_; }  ///< from where it began

 private:
  double from_s_, sum_ = 0, farthest_ = 0;
  int count_ = 0;
};

inline SerialWorld light_chain(int joints, bool alternating, std::vector<int> robots) {
  SerialWorld out;
  out.joints = joints;
  out.preset = 0.6;
  out.alternating = alternating;
  out.mass_kg = 0.05;
  out.inertia_kgm2 = 1e-4;
  out.length_m = 0.1;
  out.robots = std::move(robots);
  return out;
}

/// The last of three joints belongs to a model of its own below the arm's, whose robot is another.
inline std::string nested_chain() {
  const auto joint = [](const std::string& name, const std::string& parent, const std::string& child) {
    return "<joint name='" + name + "' type='revolute'><parent>" + parent + "</parent><child>" + child +
           "</child><axis><xyz>0 1 0</xyz></axis></joint>";
  };
  const auto link = [](const std::string& name, const std::string& z_m) {
    return "<link name='" + name + "'><pose>0 0 " + z_m +
           " 0 0 0</pose><inertial><pose>0 0 -0.05 0 0 0</pose><mass>0.05</mass>"
           "<inertia><ixx>1e-4</ixx><iyy>1e-4</iyy><izz>1e-4</izz></inertia></inertial></link>";
  };
  const auto robot = [](const std::vector<std::string>& joints) {
    std::string out = "<plugin name='vsa::Robot' filename='libvsa-robot.so'>";
    for (const std::string& name : joints)
      out += "<actuator><joint>" + name +
             "</joint><type>qbmove_maker_pro_6_1</type><bus>b</bus><initial preset_rad='0.6'/></actuator>";
    return out + "<bus name='b'/></plugin>";
  };
  return "<model name='m'>" + link("l1", "0") + "<model name='hand'><pose>0 0 -0.1 0 0 0</pose>" + link("l2", "0") +
         link("l3", "-0.1") + joint("j3", "l2", "l3") + robot({"j3"}) + "</model>" + joint("j1", "world", "l1") +
         joint("j2", "l1", "hand::l2") + robot({"j1", "j2"}) + "</model>";
}

/// A host's run: the joints set aside, then left alone.
using LeaveAlone = std::function<LateSpeed(const std::string& model, const std::vector<std::string>& joints, double step_s)>;

/// `nests`: the host takes nested models.
inline void expect_rest_whatever_drives(const LeaveAlone& run, bool nests = true) {
  const auto names = [](int joints) {
    std::vector<std::string> out;
    for (int i = 1; i <= joints; ++i) out.push_back("j" + std::to_string(i));
    return out;
  };
  const auto expect_rest = [](const LateSpeed& of, double like_rad_per_s, const std::string& what) {
    std::printf("%-40s %.4f rad/s, one robot %.4f\n", what.c_str(), of.rad_per_s(), like_rad_per_s);
    EXPECT_LT(of.rad_per_s(), like_rad_per_s + 0.02) << what;
    EXPECT_GT(of.farthest_rad(), 0.05) << what << ": nothing moved";
  };
  for (const double step_s : {1e-3, 2e-3, 4e-3}) {
    const std::string at = " at " + std::to_string(step_s) + " s";
    for (const std::vector<int>& robots : {std::vector{1, 1}, {2, 1}, {1, 2, 2, 1}}) {
      int joints = 0;
      for (const int n : robots) joints += n;
      const bool alternating = robots.size() == 4;
      const LateSpeed one = run(serial_model(light_chain(joints, alternating, {})), names(joints), step_s);
      EXPECT_LT(one.rad_per_s(), 0.12) << "one robot" << at;
      const LateSpeed several = run(serial_model(light_chain(joints, alternating, robots)), names(joints), step_s);
      expect_rest(several, one.rad_per_s(), std::to_string(robots.size()) + " robots, " + std::to_string(joints) + " joints" + at);
    }
    if (!nests) continue;
    const LateSpeed one = run(serial_model(light_chain(3, false, {})), names(3), step_s);
    expect_rest(run(nested_chain(), {"j1", "j2", "hand::j3"}, step_s), one.rad_per_s(), "a nested robot" + at);
  }
}

}  // namespace vsa::test
