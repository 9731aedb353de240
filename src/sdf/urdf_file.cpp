// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/urdf_file.hpp"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

#include "sdf/urdf_elements.hpp"
#include "sdf/xml_place.hpp"
#include "vsa/config/text.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::reader {
namespace {

using tinyxml2::XMLElement;

std::string attribute(const XMLElement* e, const char* name) {
  const char* text = e == nullptr ? nullptr : e->Attribute(name);
  return text == nullptr ? std::string() : std::string(text);
}

double mimic_number(const XMLElement& mimic, const char* name, double fallback, const Urdf& urdf, const std::string& joint,
                    Problems& problems) {
  const char* text = mimic.Attribute(name);
  if (text == nullptr) return fallback;
  const auto value = config::parse_number(config::trim(text));
  if (!value) problems.add({urdf.file, "joint[" + joint + "]/mimic@" + name, text, "isn't a number", "a finite number"});
  return value.value_or(fallback);
}

bool is_zero(const char* numbers) {
  std::istringstream in(numbers == nullptr ? "" : numbers);
  in.imbue(std::locale::classic());
  double number = 0;
  while (in >> number)
    if (number != 0) return false;
  return in.eof();
}

UrdfJoint read_joint(const XMLElement& e, const Urdf& urdf, Notes& notes, Problems& problems) {
  UrdfJoint joint{attribute(&e, "name"),
                  attribute(&e, "type"),
                  attribute(e.FirstChildElement("parent"), "link"),
                  attribute(e.FirstChildElement("child"), "link"),
                  false,
                  {}};
  if (joint.type == "planar" || joint.type == "floating") {
    const bool free = joint.type == "floating";
    problems.add({urdf.file, "joint[" + joint.name + "]@type", joint.type, "joint type isn't supported",
                  std::string("fixed, revolute, continuous, prismatic") +
                      (free ? "; floating between a link \"world\" that has no other joint and the root, without an <origin>"
                            : "; a plane is two prismatic joints and a revolute")});
  }
  const XMLElement* axis = e.FirstChildElement("axis");
  if (const std::string xyz = attribute(axis, "xyz"); joint.type != "fixed" && !config::trim(xyz).empty() && is_zero(xyz.c_str()))
    problems.add(
        {line_of(*axis, urdf.file), "joint[" + joint.name + "]/axis@xyz", xyz, "has no direction", "a vector other than zero"});
  const XMLElement* mimic = e.FirstChildElement("mimic");
  if (mimic == nullptr) return joint;
  if (joint.type == "fixed") {
    notes.add("<mimic> of fixed joints is left out", joint.name);
    return joint;
  }
  joint.mimic = UrdfMimic{attribute(mimic, "joint"), mimic_number(*mimic, "multiplier", 1, urdf, joint.name, problems),
                          mimic_number(*mimic, "offset", 0, urdf, joint.name, problems)};
  return joint;
}

/// libsdformat would say so with the numbers in it, a word for every joint.
void switch_limits(XMLElement& e, const UrdfJoint& joint, const std::string& robot, Notes& notes) {
  XMLElement* limit = e.FirstChildElement("limit");
  if (limit == nullptr || (joint.type != "revolute" && joint.type != "prismatic")) return;
  const auto given = [&](const char* name) { return config::parse_number(config::trim(attribute(limit, name))).value_or(0); };
  if (given("lower") <= given("upper")) return;
  const std::string lower = attribute(limit, "lower"), upper = attribute(limit, "upper");
  limit->SetAttribute("lower", upper.empty() ? "0" : upper.c_str());
  limit->SetAttribute("upper", lower.empty() ? "0" : lower.c_str());
  notes.add("lower and upper of a joint's <limit> stand the wrong way round and are switched", scoped_name(robot, joint.name));
}

/// A <limit> of 0 … 0 is what exporters write of every joint, and an <axis> of a fixed joint changes nothing: no word of those.
void tell_of_limits(const XMLElement& e, const UrdfJoint& joint, const std::string& file, Notes& notes) {
  const XMLElement* limit = e.FirstChildElement("limit");
  if (limit == nullptr || (joint.type != "continuous" && joint.type != "fixed")) return;
  const auto given = [&](const char* name) { return config::parse_number(config::trim(attribute(limit, name))).value_or(0) != 0; };
  if (!given("lower") && !given("upper")) return;
  notes.add(joint.type == "fixed"
                ? "a fixed joint doesn't move: lower and upper of its <limit> are left out, did you mean revolute?"
                : "lower and upper of a continuous joint's <limit> are left out, did you mean revolute?",
            place_of(*limit, file));
}

bool is_true(const char* text) {
  const std::string word(config::trim(text == nullptr ? "" : text));
  return word == "true" || word == "True" || word == "TRUE" || word == "yes" || word == "1";
}

/// MuJoCo's way of saying that a robot floats: a floating joint between a link "world" that is nothing else and the root. Without both
/// it does.
void let_float(XMLElement& robot) {
  XMLElement *floating = nullptr, *world = nullptr, *root = nullptr;
  for (XMLElement* e = robot.FirstChildElement("joint"); e != nullptr; e = e->NextSiblingElement("joint")) {
    if (attribute(e->FirstChildElement("parent"), "link") != "world") continue;
    if (floating != nullptr || attribute(e, "type") != "floating") return;
    floating = e;
  }
  if (floating == nullptr) return;
  for (XMLElement* e = robot.FirstChildElement("link"); e != nullptr; e = e->NextSiblingElement("link")) {
    if (attribute(e, "name") == "world") world = e;
    if (attribute(e, "name") == attribute(floating->FirstChildElement("child"), "link")) root = e;
  }
  if (world == nullptr || root == nullptr || root == world || !world->NoChildren()) return;
  const XMLElement* origin = floating->FirstChildElement("origin");
  if (origin != nullptr && !(is_zero(origin->Attribute("xyz")) && is_zero(origin->Attribute("rpy")))) return;
  robot.DeleteChild(floating);
  robot.DeleteChild(world);
}

/// libsdformat's two ways of keeping a fixed joint.
bool stays(const XMLElement& robot, const std::string& joint) {
  for (const XMLElement* g = robot.FirstChildElement("gazebo"); g != nullptr; g = g->NextSiblingElement("gazebo")) {
    if (attribute(g, "reference") != joint) continue;
    for (const char* name : {"preserveFixedJoint", "disableFixedJointLumping"}) {
      const XMLElement* e = g->FirstChildElement(name);
      if (e != nullptr && is_true(e->GetText())) return true;
    }
  }
  return false;
}

/// One <gazebo> for all that speaks of the whole robot: libsdformat lets a second one undo the <static> of the first.
void join_robot_elements(XMLElement& robot, std::size_t id) {
  XMLElement* first = nullptr;
  for (XMLElement *g = robot.FirstChildElement("gazebo"), *next = nullptr; g != nullptr; g = next) {
    next = g->NextSiblingElement("gazebo");
    if (g->Attribute("reference") != nullptr) continue;
    if (first == nullptr) {
      first = g;
      continue;
    }
    while (tinyxml2::XMLNode* child = g->FirstChild()) first->InsertEndChild(child);
    robot.DeleteChild(g);
  }
  if (first == nullptr) first = robot.InsertNewChildElement("gazebo");
  first->InsertNewChildElement("vsa:urdf")->SetAttribute("id", static_cast<unsigned>(id));
}

}  // namespace

const UrdfJoint* Urdf::joint_above(const std::string& link) const {
  const auto it = std::find_if(joints.begin(), joints.end(), [&](const UrdfJoint& j) { return j.child == link; });
  return it == joints.end() ? nullptr : &*it;
}

std::string Urdf::lumped_into(const std::string& link) const {
  std::string at = link;
  for (std::size_t i = 0; i <= links.size(); ++i) {
    const UrdfJoint* above = joint_above(at);
    if (above == nullptr || !above->lumped) break;
    at = above->parent;
  }
  return at;
}

std::optional<description::Vec3> three_numbers(const char* text) {
  std::vector<double> out;
  std::istringstream words(text == nullptr ? "" : text);
  for (std::string word; words >> word;) out.push_back(config::parse_number(word).value_or(std::nan("")));
  if (out.size() != 3 || !description::Vec3(out[0], out[1], out[2]).IsFinite()) return std::nullopt;
  return description::Vec3(out[0], out[1], out[2]);
}

Urdf mend_urdf(XMLElement& robot, const std::string& file, std::size_t id, Notes& notes, Problems& problems) {
  Urdf urdf;
  urdf.file = file;
  check_urdf_elements(robot, file, notes);
  let_float(robot);
  const XMLElement* origin = robot.FirstChildElement("origin");
  for (const char* name : {"xyz", "rpy"})
    if (const char* text = origin == nullptr ? nullptr : origin->Attribute(name); text != nullptr && !three_numbers(text))
      problems.add({line_of(*origin, file), std::string("origin@") + name, text, "isn't three numbers", "x y z, finite"});
  for (const XMLElement* e = robot.FirstChildElement("link"); e != nullptr; e = e->NextSiblingElement("link")) {
    urdf.links.push_back(attribute(e, "name"));
    if (urdf.links.back() == "world") {
      if (const XMLElement* held = e->FirstChildElement())
        notes.add("what the link \"world\" holds is left out: it is the ground", place_of(*held, file));
      continue;
    }
    for (const XMLElement* k = e->FirstChildElement("collision"); k != nullptr; k = k->NextSiblingElement("collision"))
      ++urdf.collisions;
  }
  for (XMLElement* e = robot.FirstChildElement("joint"); e != nullptr; e = e->NextSiblingElement("joint")) {
    UrdfJoint joint = read_joint(*e, urdf, notes, problems);
    joint.lumped = joint.type == "fixed" && joint.parent != "world" && !stays(robot, joint.name);
    tell_of_limits(*e, joint, file, notes);
    switch_limits(*e, joint, attribute(&robot, "name"), notes);
    if (e->FirstChildElement("safety_controller") != nullptr)
      notes.add("<safety_controller> of joints is a controller's and left out", joint.name);
    if (e->FirstChildElement("calibration") != nullptr)
      notes.add("<calibration> of joints is for the machine's own encoders and left out", joint.name);
    if (const UrdfJoint* other = urdf.joint_above(joint.child))
      problems.add({file, "link[" + joint.child + "]", other->name + ", " + joint.name, "is the child of several joints", "one"});
    urdf.joints.push_back(std::move(joint));
  }
  if (const UrdfJoint* above = urdf.joint_above("world"))
    problems.add({file, "link[world]", above->name, "is the ground, and a joint moves or holds it", "the root, or another name"});
  join_robot_elements(robot, id);
  mend_gazebo_elements(robot, urdf, notes, problems);
  rename_collisions(robot, urdf);
  keep_gravity_apart(robot, urdf, notes);
  mend_massless_links(robot, urdf, notes, problems);
  return urdf;
}

}  // namespace vsa::reader
