// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Robots, each with one thing that a reader can get wrong.
#include <initializer_list>

#include "urdf/outcome.hpp"
#include "urdf/robot_text.hpp"

namespace vsa::reader::testing {
namespace {

void add_bodies(Robots& out) {
  out["rotated_chain"] = robot(
      "<link name=\"world\"/>\n" + link("base", inertial("2", "0.1 -0.2 0.3", "0.3 0.4 -0.5", kOdd) + kShapes) +
      joint("fix", "fixed", "world", "base", at("1 2 3", "0.1 0.2 0.3")) +
      link("b", inertial("0.7", "0.05 0.06 -0.07", "-0.3 0.9 1.2", kOdd) + kShapes) +
      joint("f1", "fixed", "base", "b", at("0.2 0.1 -0.3", "0.7 -0.6 0.5")) +
      link("c", inertial("0.3", "-0.05 0.02 0.01", "2 0.1 -1", kOdd) + kShapes) +
      joint("f2", "fixed", "b", "c", at("-0.1 0.3 0.2", "-1.1 0.4 0.3")) +
      link("d", inertial("0.5", "0.2 0 0.1", "0.5 0.6 0.7", kOdd) + kShapes) +
      joint("j1", "revolute", "c", "d", at("0.3 0.2 0.1", "0.4 0.5 -0.6") + about("0.6 0 0.8") + kLimit) +
      link("e", inertial("0.25", "0.1 0.1 0", "0 1 0", kOdd) + kShapes) + joint("f3", "fixed", "d", "e", at("0.1 0 0.2", "1 1 1")) +
      link("f", inertial("0.25", "0 0.1 0.05", "0 0 0", kOdd)) +
      joint("j2", "continuous", "e", "f", at("0 0.2 0.1", "-0.2 0.3 0.9") + about("1 2 -3") + "<dynamics damping=\"0.01\"/>"));
  out["moving_arm"] =
      robot("<link name=\"world\"/>\n" + link("base", inertial()) + joint("fix", "fixed", "world", "base", at("0 0 1")) +
            link("a", inertial("1.5", "0.1 0 0.05", "0 0 0", "0.01 0 0 0.012 0 0.008")) +
            joint("j1", "revolute", "base", "a",
                  at("0 0 0.1", "0.5 0 0") + about("0 1 0") +
                      R"(<limit lower="-3" upper="3" effort="10" velocity="5"/><dynamics damping="0.02" friction="0.01"/>)") +
            link("b", inertial("0.5", "0 0.1 0", "0.25 0.5 0", "0.004 0.001 0 0.004 0 0.003")) +
            joint("j2", "prismatic", "a", "b",
                  at("0.2 0 0") + about("1 0 0") +
                      R"(<limit lower="-0.2" upper="0.1" effort="10" velocity="5"/><dynamics damping="0.5"/>)") +
            link("c", inertial("0.25", "0.05 0 0")) +
            joint("j3", "continuous", "b", "c", at("0.1 0 0") + about("0 0.6 0.8") + "<dynamics damping=\"0.001\"/>") +
            gazebo("j3", "<springStiffness>0.4</springStiffness><springReference>0.3</springReference>"));
  out["falling_box"] =
      robot(link("body", inertial("2", "0.01 0.02 0", "0 0 0", "0.01 0 0 0.02 0 0.03") + kShapes) + link("wheel", inertial("0.5")) +
            joint("axle", "continuous", "body", "wheel", at("0.1 0 0") + about("0 1 0") + "<dynamics friction=\"0.001\"/>"));
  out["gimbal"] = robot(
      kBase +
      link(
          "a",
          inertial("1", "0.1 0 0", "0.3 1.5707963267948966 0.2", kOdd) +
              R"(<collision><origin xyz="0 0 0" rpy="0.1 1.5707963267948966 0.7"/><geometry><box size="0.1 0.2 0.3"/></geometry></collision>)") +
      joint("j1", "revolute", "base", "a", at("0 0 0", "0.5 -1.5707963267948966 0.25") + about("0 0 1") + kLimit));
  out["default_axis"] = robot(kBase + link("a", inertial("1", "0.1 0 0")) + joint("j1", "revolute", "base", "a", kLimit));
  out["robot_origin"] = robot(at("1 2 3", "0.1 0.2 0.3") + link("base", inertial()) + link("a", inertial("1", "0.1 0 0")) +
                              joint("j1", "revolute", "base", "a", at("0.1 0.2 0.3") + about("0 0 1") + kLimit));
  out["robot_origin_in_world"] = robot(at("1 2 3", "0.1 0.2 0.3") + kArm);
  out["robot_origin_broken"] = robot("<origin xyz=\"1 2\"/>" + kArm);
  out["one_link"] = robot(link("a", inertial()));
  out["massless_all"] =
      robot("<link name=\"world\"/><link name=\"base\"/><link name=\"a\"/>" + joint("fix", "fixed", "world", "base") + kHinge);
  out["massless_between"] = robot(
      kArm + link("m", "") + joint("j2", "revolute", "a", "m", at("0.1 0 0") + about("1 0 0") + kLimit) +
      link("b", inertial("1", "0.1 0 0")) + joint("j3", "revolute", "m", "b", at("0 0 0", "0.3 0 0") + about("0 0 1") + kLimit));
  out["impossible"] = robot(kBase + link("a", inertial("1", "0.1 0 0", "0.4 0.3 0.2", "0.001 0 0 0.001 0 0.003")) + kHinge);
  out["transmission"] = robot(kArm + "<transmission name=\"t\"><joint name=\"j1\"/><actuator name=\"m\"/></transmission>");
}

void add_lumps(Robots& out) {
  const auto kept = [](const Text& how) { return robot(kTool + gazebo("t", how)); };
  out["lump_kept"] = kept("<preserveFixedJoint>yes</preserveFixedJoint>");
  out["lump_kept_old"] = kept("<disableFixedJointLumping>1</disableFixedJointLumping>");
  out["lump_kept_both"] =
      kept("<disableFixedJointLumping>1</disableFixedJointLumping><preserveFixedJoint>true</preserveFixedJoint>");
  out["lump_not_kept"] = kept("<preserveFixedJoint>false</preserveFixedJoint>");
  out["lump_kept_perhaps"] = kept("<preserveFixedJoint>perhaps</preserveFixedJoint>");
  out["lump_mu"] = robot(kTool + gazebo("tool", "<mu1>0.3</mu1><mu2>0.3</mu2>"));
  out["lump_self_collide"] = robot(kTool + gazebo("tool", "<selfCollide>true</selfCollide>"));
  out["lump_no_parent_mass"] = robot(kBase + link("a", "") + kHinge + link("b", inertial("1", "0.1 0 0")) +
                                     joint("f", "fixed", "a", "b", at("0.2 0 0", "0 0.5 0")));
  out["lump_order"] = robot(kArm + link("z", inertial("1", "0.1 0 0")) + joint("b_z", "fixed", "a", "z", at("0.1 0 0")) +
                            link("y", inertial("1", "0.1 0 0")) + joint("a_y", "continuous", "z", "y", at("0.1 0 0")) +
                            link("x", inertial("1", "0 0 0.1")) + joint("c_x", "continuous", "a", "x", at("0.1 0 0")) +
                            link("w", inertial() + kShapes) + joint("a_w", "fixed", "a", "w"));
  const Text rubs = "<mu1>0.3</mu1><mu2>0.3</mu2>";
  out["named_collision"] = robot(kBase + link("a", inertial() + kNamed) + kHinge);
  out["named_collision_mu"] = robot(kBase + link("a", inertial() + kNamed) + kHinge + gazebo("a", rubs));
  const Text prefix = kBase + link("a", inertial() + kSphere) + kHinge + link("a_tool", inertial() + kSphere) +
                      joint("t", "fixed", "a", "a_tool", at("0.1 0 0"));
  out["prefix_mu"] = robot(prefix + gazebo("a", rubs));
  out["prefix_mu_of_the_tool"] = robot(prefix + gazebo("a_tool", rubs));
}

void add_trees(Robots& out) {
  const Text free = inertial();
  out["moving_from_world"] = robot("<link name=\"world\"/>" + link("a", inertial("1", "0.1 0 0")) +
                                   joint("j1", "revolute", "world", "a", at("0 0 1", "0.3 0 0") + about("0 1 0") + kLimit));
  out["world_with_shapes"] = robot(link("world", kSphere) + kArm.substr(kArm.find('\n')));
  out["world_not_root"] = robot(link("top", free) + "<link name=\"world\"/>" + joint("j0", "fixed", "top", "world") +
                                link("a", free) + joint("j1", "revolute", "world", "a", kLimit));
  out["world_alone"] = robot("<link name=\"world\"/>");
  out["no_links"] = robot("");
  out["two_roots"] = robot(link("a", free) + link("b", free));
  out["cycle_apart"] =
      robot(kArm + link("x", free) + link("y", free) + joint("jx", "fixed", "x", "y") + joint("jy", "revolute", "y", "x", kLimit));
  out["cycle_whole"] = robot(link("x", free) + link("y", free) + joint("jx", "fixed", "x", "y") + joint("jy", "fixed", "y", "x"));
  out["own_parent"] = robot(kArm + link("x", free) + joint("jx", "revolute", "x", "x", kLimit));
  out["two_robots"] = robot(kArm) + "<robot name=\"lost\"/>\n";
  out["words_before"] = "lost words <robot name=\"r\">" + kArm + "</robot>";
  out["words_behind"] = robot(kArm) + "lost words <!-- -->";
  out["two_parents"] =
      robot(kArm + link("b", free) + joint("j2", "revolute", "base", "b", kLimit) + joint("j3", "revolute", "a", "b", kLimit));
  out["two_parents_fixed"] = robot(kArm + link("b", free) + joint("j2", "fixed", "base", "b") + joint("j3", "fixed", "a", "b"));
  out["parent_missing"] = robot(kArm + link("b", free) + joint("j2", "fixed", "ghost", "b"));
  out["child_missing"] = robot(kArm + joint("j2", "fixed", "a", "ghost"));
  out["duplicate_link"] = robot(kArm + link("a", free));
  out["duplicate_joint"] = robot(kArm + link("b", free) + joint("j1", "fixed", "a", "b"));
  out["link_as_joint"] = robot(kBase + link("j1", inertial("1", "0.1 0 0")) + joint("j1", "revolute", "base", "j1", kLimit));
  out["empty_names"] = robot(kBase + link("", free) + joint("j1", "fixed", "base", ""));
  out["reserved_name"] = robot(kBase + link("__model__", free) + joint("j1", "revolute", "base", "__model__", kLimit));
  out["colons"] = robot(kBase + link("a::b", free) + joint("j1", "revolute", "base", "a::b", kLimit));
  out["robot_nameless"] = robot(kArm, "");
  out["robot_empty_name"] = robot(kArm, "name=\"\"");
  out["version_1"] = robot(kArm, "name=\"r\" version=\"1.0\"");
  out["version_2"] = robot(kArm, "name=\"r\" version=\"2.0\"");
}

void add_numbers(Robots& out) {
  for (const auto& [name, now] : std::initializer_list<std::pair<const char*, const char*>>{{"comma", "1,5"},
                                                                                            {"nan", "nan"},
                                                                                            {"infinite", "inf"},
                                                                                            {"with_unit", "1kg"},
                                                                                            {"empty", ""},
                                                                                            {"negative", "-1"},
                                                                                            {"huge", "1e400"},
                                                                                            {"blank_around", " 1 "},
                                                                                            {"hexadecimal", "0x10"},
                                                                                            {"plus", "+1"}})
    out[Text("mass_") + name] = changed("a", "value=\"1\"", Text("value=\"") + now + "\"");
  for (const auto& [name, now] : std::initializer_list<std::pair<const char*, const char*>>{
           {"two", "0.1 0"}, {"four", "0.1 0 0 5"}, {"words", "here"}, {"nan", "nan 0 0"}, {"comma", "0,1 0 0"}})
    out[Text("origin_") + name] = changed("a", "xyz=\"0.1 0 0\"", Text("xyz=\"") + now + "\"");
  for (const auto& [name, now] : std::initializer_list<std::pair<const char*, const char*>>{
           {"negative", "-0.001"}, {"nan", "nan"}, {"zero", "0"}, {"comma", "0,001"}})
    out[Text("moment_") + name] = changed("a", "ixx=\"0.001\"", Text("ixx=\"") + now + "\"");
  out["moment_missing"] = changed("a", " ixx=\"0.001\"", "");
  for (const auto& [name, now] : std::initializer_list<std::pair<const char*, const char*>>{
           {"words", R"(lower="low" upper="1" effort="10" velocity="5")"},
           {"no_effort", R"(lower="-1" upper="1" velocity="5")"},
           {"no_range", R"(effort="10" velocity="5")"},
           {"no_room", R"(lower="0.5" upper="0.5" effort="10" velocity="5")"},
           {"infinite", R"(lower="-inf" upper="inf" effort="10" velocity="5")"},
           {"wide", R"(lower="-1e16" upper="1e16" effort="10" velocity="5")"},
           {"one_side", R"(lower="0" upper="1e17" effort="10" velocity="5")"},
           {"swapped", R"(lower="1" upper="-1" effort="10" velocity="5")"},
           {"excluding_0", R"(lower="0.2" upper="1" effort="10" velocity="5")"},
           {"effort_negative", R"(lower="-1" upper="1" effort="-1" velocity="5")"},
           {"effort_huge", R"(lower="-1" upper="1" effort="1e16" velocity="1e20")"},
           {"comma", R"(lower="-0,5" upper="1" effort="10" velocity="5")"}})
    out[Text("limit_") + name] = changed("j1", R"(lower="-1" upper="1" effort="10" velocity="5")", now);
  out["axis_zero"] = changed("j1", "axis xyz=\"0 1 0\"", "axis xyz=\"0 0 0\"");
  out["axis_words"] = changed("j1", "axis xyz=\"0 1 0\"", "axis xyz=\"y\"");
  out["axis_long"] = changed("j1", "axis xyz=\"0 1 0\"", "axis xyz=\"0 1e3 1e3\"");
  out["type_unknown"] = changed("j1", "type=\"revolute\"", "type=\"ball\"");
  out["type_missing"] = changed("j1", " type=\"revolute\"", "");
  out["parent_unsaid"] = changed("j1", "<parent link=\"base\"/>", "");
  out["name_unsaid"] = robot(kBase + link("a", inertial()) + kHinge.substr(0, 6) + kHinge.substr(kHinge.find(" type")));
}

void add_joints(Robots& out) {
  out["damping_negative"] = with_joint("<dynamics damping=\"-1\"/>");
  out["friction_negative"] = with_joint("<dynamics friction=\"-1\"/>");
  out["damping_nan"] = with_joint("<dynamics damping=\"nan\"/>");
  out["dynamics"] = with_joint("<dynamics damping=\"0.3\" friction=\"0.2\"/>");
  out["dynamics_empty"] = with_joint("<dynamics/>");
  out["safety"] = with_joint(
      R"(<safety_controller k_velocity="10" k_position="5" soft_lower_limit="-0.5" soft_upper_limit="0.5"/><calibration rising="0.1"/>)");
  out["safety_broken"] = with_joint("<safety_controller k_position=\"5\"/>");
  out["mimic_self"] = with_joint("<mimic joint=\"j1\"/>");
  out["mimic_of_nobody"] = with_joint("<mimic/>");
  out["mimic_words"] = with_joint("<mimic joint=\"j1\" multiplier=\"two\"/>");
  const auto follower = [](const Text& type, const Text& mimic) {
    return link("b", inertial("1", "0 0.1 0")) +
           joint("j2", type, "a", "b",
                 at("0.2 0 0") + about("0 0.6 0.8") + R"(<limit lower="-9" upper="9" effort="1" velocity="1"/>)" + mimic);
  };
  out["moving_mimic"] = robot(kArm + follower("revolute", R"(<mimic joint="j1" multiplier="-1.5" offset="0.25"/>)"));
  out["mimic_of_prismatic"] = robot(kArm + follower("prismatic", R"(<mimic joint="j1" multiplier="0.05" offset="0.01"/>)"));
  out["mimic_chain"] = robot(
      kArm + follower("continuous", R"(<mimic joint="j1" multiplier="2" offset="0.1"/>)") + link("c", inertial("1", "0 0.1 0")) +
      joint("j3", "continuous", "b", "c", at("0.2 0 0") + R"(<mimic joint="j2" multiplier="-1" offset="0.2"/>)"));
}

}  // namespace

Robots robots() {
  Robots out;
  add_bodies(out);
  add_lumps(out);
  add_trees(out);
  add_numbers(out);
  add_joints(out);
  add_shapes(out);
  add_gazebos(out);
  return out;
}

}  // namespace vsa::reader::testing
