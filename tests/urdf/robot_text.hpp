// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Texts of URDFs, of pieces.
#pragma once

#include <map>
#include <stdexcept>
#include <string>

namespace vsa::reader::testing {

using Text = std::string;

inline const Text kOdd = "0.01 0.001 -0.0005 0.012 0.0007 0.008", kPlain = "0.001 0 0 0.001 0 0.001";
inline const Text kLimit = R"(<limit lower="-1" upper="1" effort="10" velocity="5"/>)";
inline const Text kSphere = R"(<collision><geometry><sphere radius="0.02"/></geometry></collision>)";
inline const Text kNamed = R"(<collision name="hull"><geometry><sphere radius="0.02"/></geometry></collision>)";
inline const Text kShapes =
    R"(<collision><origin xyz="0.01 0.02 0.03" rpy="0.3 -0.4 0.5"/><geometry><box size="0.1 0.2 0.3"/></geometry></collision>)"
    R"(<visual><origin xyz="0.01 0 0" rpy="1 0.5 0.2"/><geometry><cylinder radius="0.02" length="0.3"/></geometry></visual>)";

/// `i`: ixx ixy ixz iyy iyz izz.
inline Text inertial(const Text& mass = "1", const Text& xyz = "0 0 0", const Text& rpy = "0 0 0", const Text& i = kPlain) {
  Text moments;
  std::size_t at = 0;
  for (const char* name : {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}) {
    const std::size_t end = i.find(' ', at);
    moments += Text(" ") + name + "=\"" + i.substr(at, end - at) + "\"";
    at = end + 1;
  }
  return "<inertial><origin xyz=\"" + xyz + "\" rpy=\"" + rpy + "\"/><mass value=\"" + mass + "\"/><inertia" + moments +
         "/></inertial>";
}
inline Text link(const Text& name, const Text& content) { return "<link name=\"" + name + "\">" + content + "</link>\n"; }
inline Text at(const Text& xyz, const Text& rpy = "0 0 0") { return "<origin xyz=\"" + xyz + "\" rpy=\"" + rpy + "\"/>"; }
inline Text about(const Text& xyz) { return "<axis xyz=\"" + xyz + "\"/>"; }
inline Text joint(const Text& name, const Text& type, const Text& parent, const Text& child, const Text& content = "") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent + "\"/><child link=\"" + child + "\"/>" +
         content + "</joint>\n";
}
inline Text robot(const Text& content, const Text& attributes = "name=\"r\"") {
  return "<?xml version=\"1.0\"?>\n<robot " + attributes + ">\n" + content + "</robot>\n";
}
inline Text gazebo(const Text& reference, const Text& content) {
  return (reference.empty() ? Text("<gazebo>") : "<gazebo reference=\"" + reference + "\">") + content + "</gazebo>\n";
}

inline const Text kBase = "<link name=\"world\"/>\n" + link("base", inertial()) + joint("fix", "fixed", "world", "base");
inline const Text kHinge = joint("j1", "revolute", "base", "a", about("0 1 0") + kLimit);
inline const Text kArm = kBase + link("a", inertial("1", "0.1 0 0")) + kHinge;
inline const Text kTool = kArm + link("tool", inertial("0.5", "0.02 0 0.01", "0.2 0.3 0.4", kOdd) + kShapes) +
                          joint("t", "fixed", "a", "tool", at("0.1 0 0", "0.4 0 0.2"));
inline const Text kPlugin =
    R"(<plugin name="vsa::Robot" filename="libvsa-robot.so"><actuator><joint>j1</joint><type>qbmove_maker_pro_6_1</type></actuator></plugin>)";

/// The arm with link a's or joint j1's first `old` as `now`.
inline Text changed(const Text& part, const Text& old, const Text& now) {
  const std::size_t start = kArm.find("\"" + part + "\""), found = kArm.find(old, start);
  if (start == Text::npos || found == Text::npos) throw std::logic_error("nothing to change: " + old);
  Text out = kArm;
  return robot(out.replace(found, old.size(), now));
}
inline Text with_link(const Text& content) { return robot(kBase + link("a", inertial() + content) + kHinge); }
inline Text with_joint(const Text& content) {
  return robot(kBase + link("a", inertial("1", "0.1 0 0")) +
               joint("j1", "revolute", "base", "a", about("0 1 0") + kLimit + content));
}
inline Text with_gazebo(const Text& reference, const Text& content) {
  return robot(
      kBase +
      link("a",
           inertial("1", "0.1 0 0") + kSphere +
               R"(<collision><origin xyz="0.1 0 0"/><geometry><cylinder radius="0.02" length="0.1"/></geometry></collision>)") +
      kHinge + gazebo(reference, content));
}
inline Text mesh(const Text& file, const Text& scale, const Text& as = "collision") {
  return "<" + as + "><geometry><mesh filename=\"" + file + "\" scale=\"" + scale + "\"/></geometry></" + as + ">";
}
inline Text parts(const Text& file) { return Text(VSA_SOURCE_DIR) + "/tests/sdf/robot_files/parts/" + file; }

using Robots = std::map<std::string, Text>;

void add_shapes(Robots& out);
void add_gazebos(Robots& out);

}  // namespace vsa::reader::testing
