// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A two-link arm in the x–z plane with an actuator at the shoulder, and a ball that flies free beside it.
//
// Joints turn about +y; at zero both links lie along +x from the shoulder at (0, 0, 1). Upper arm: 0.3 kg, 0.2 m, centre at 0.1 m;
// forearm: 0.2 kg, 0.15 m, centre at 0.08 m.
#pragma once

#include <string>

#include "worlds.hpp"

namespace vsa::engine::testing {

struct ArmParams {
  static constexpr double m1 = 0.3, l1 = 0.2, c1 = 0.1, i1 = 1.5e-3;
  static constexpr double m2 = 0.2, c2 = 0.08, i2 = 6e-4;
};

inline std::string hinge(const std::string& name, const std::string& parent, const std::string& child, const std::string& more = {},
                         const std::string& axis = "0 1 0") {
  return "<joint name='" + name + "' type='revolute'><parent>" + parent + "</parent><child>" + child + "</child><axis><xyz>" +
         axis + "</xyz>" + more + "</axis></joint>";
}

inline std::string arm_links() {
  using P = ArmParams;
  return "<pose>0 0 1 0 0 0</pose><link name='base'>" + inertial(1, 1e-3) + "</link><link name='upper'>" +
         inertial(P::m1, P::i1, "0.1 0 0 0 0 0") + "</link><link name='fore'><pose>0.2 0 0 0 0 0</pose>" +
         inertial(P::m2, P::i2, "0.08 0 0 0 0 0") +
         "</link><joint name='mount' type='fixed'><parent>world</parent><child>base</child></joint>" +
         hinge("shoulder", "base", "upper", "<limit><lower>-3</lower><upper>2.5</upper></limit>") + hinge("elbow", "upper", "fore");
}

inline std::string actuator(const std::string& joint, const std::string& type = "qbmove_maker_pro_6_1", int id = 1) {
  return "<actuator name='" + joint + "'><joint>" + joint + "</joint><type>" + type + "</type><bus id='" + std::to_string(id) +
         "'>arm</bus></actuator>";
}

inline std::string plugin(const std::string& actuators) {
  return "<plugin name='vsa::Robot' filename='libvsa-robot.so'>" + actuators + "<bus name='arm' baud='2000000'/></plugin>";
}

inline std::string ball() {
  return "<model name='ball'><pose>3 0 5 0 0 0</pose><link name='l'>" + inertial(0.5, 0.01, "0 0.1 0 0 0 0") + "</link></model>";
}

inline std::string floor_model() {
  return "<model name='floor'><static>true</static><link name='l'><collision name='c'><geometry><plane><normal>0 0 1</normal>"
         "<size>9 9</size></plane></geometry></collision></link></model>";
}

inline std::string arm(const std::string& type = "qbmove_maker_pro_6_1", const std::string& gravity = "0 0 -9.81") {
  return world(floor_model() + "<model name='arm'>" + arm_links() + plugin(actuator("shoulder", type)) + "</model>" + ball(),
               gravity);
}

/// The same without its actuator.
inline std::string passive_arm(const std::string& gravity = "0 0 -9.81") {
  return world(floor_model() + "<model name='arm'>" + arm_links() + "</model>" + ball(), gravity);
}

/// One more joint than arm(), driven.
inline std::string other_arm() {
  return world(floor_model() + "<model name='arm'>" + arm_links() + "<link name='hand'><pose>0.35 0 0 0 0 0</pose>" +
               inertial(0.1, 1e-4) + "</link>" + hinge("wrist", "fore", "hand") + plugin(actuator("wrist")) + "</model>" + ball());
}

}  // namespace vsa::engine::testing
