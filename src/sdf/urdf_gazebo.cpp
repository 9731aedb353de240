// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// <gazebo reference="…"> of a URDF, as ROS 1's robots have them. libsdformat makes SDF of most; what it makes elements of that SDF
// doesn't have, or reads with std::stod, is dealt with here. kp, kd, maxVel, minDepth become contact settings, mu1 and mu2
// friction, selfCollide, turnGravityOff, springReference and springStiffness the SDF elements: their readers judge them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "sdf/urdf_file.hpp"
#include "sdf/xml_place.hpp"
#include "vsa/config/text.hpp"

namespace vsa::reader {
namespace {

using tinyxml2::XMLElement;

struct LeftOut {
  std::string_view name;
  const char* note;  // none: not worth a word
};

constexpr const char* kSolver = "ODE's settings of joints are left out";
constexpr std::array<LeftOut, 12> kLeftOut{{{"provideFeedback", "force sensors of joints (provideFeedback) are left out"},
                                            {"implicitSpringDamper", kSolver},
                                            {"cfmDamping", kSolver},
                                            {"fudgeFactor", kSolver},
                                            {"stopCfm", kSolver},
                                            {"stopErp", kSolver},
                                            {"stopKd", kSolver},
                                            {"stopKp", kSolver},
                                            {"initial_joint_position", "<initial_joint_position> of joints is left out"},
                                            {"sensor", "sensors are left out"},
                                            {"material", nullptr},
                                            {"canonicalBody", nullptr}}};

constexpr std::array<std::string_view, 11> kNumbers{"kp",
                                                    "kd",
                                                    "mu1",
                                                    "mu2",
                                                    "maxVel",
                                                    "minDepth",
                                                    "dampingFactor",
                                                    "maxContacts",
                                                    "laserRetro",
                                                    "springReference",
                                                    "springStiffness"};

template <class Names>
bool holds(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void check_number(const XMLElement& e, const std::string& reference, const std::string& file, Problems& problems) {
  if (!holds(kNumbers, e.Name())) return;
  const char* value = e.Attribute("value");
  const std::string text(config::trim(value != nullptr ? value : e.GetText() != nullptr ? e.GetText() : ""));
  if (!config::parse_number(text))
    problems.add({file, "gazebo[" + reference + "]/" + e.Name(), text, "isn't a number", "a finite number"});
}

constexpr std::array<std::string_view, 3> kOnceBesideNumbers{"selfCollide", "turnGravityOff", "fdir1"};
/// What every link or joint has from the URDF: one beside it is never read.
constexpr std::array<std::string_view, 5> kOfUrdf{"inertial", "pose", "axis", "parent", "child"};

/// Of what libsdformat takes as a value the last counts; across several <gazebo> of one link it tells by itself.
void tell_of_doubles(const XMLElement& e, const std::string& file, Notes& notes) {
  const std::string_view name = e.Name();
  if (holds(kOfUrdf, name))
    notes.add(fmt::format("<{}> in a <gazebo reference> is left out: the URDF's own counts", name), place_of(e, file));
  if ((holds(kNumbers, name) || holds(kOnceBesideNumbers, name)) && e.NextSiblingElement(e.Name()) != nullptr)
    notes.add(fmt::format("of several <{}> in one <gazebo> the last counts", name), place_of(e, file));
}

void mend(XMLElement& gazebo, const std::string& reference, const std::string& file, Notes& notes, Problems& problems) {
  for (XMLElement *e = gazebo.FirstChildElement(), *next = nullptr; e != nullptr; e = next) {
    next = e->NextSiblingElement();
    const std::string_view name = e->Name();
    const auto* left = std::find_if(kLeftOut.begin(), kLeftOut.end(), [&](const LeftOut& l) { return l.name == name; });
    if (left == kLeftOut.end()) {
      check_number(*e, reference, file, problems);
      tell_of_doubles(*e, file, notes);
      continue;
    }
    if (left->note != nullptr) notes.add(left->note, reference);
    gazebo.DeleteChild(e);
  }
}

}  // namespace

void mend_gazebo_elements(XMLElement& robot, const Urdf& urdf, Notes& notes, Problems& problems) {
  for (XMLElement* g = robot.FirstChildElement("gazebo"); g != nullptr; g = g->NextSiblingElement("gazebo")) {
    const char* reference = g->Attribute("reference");
    if (reference == nullptr) continue;
    const bool known = std::find(urdf.links.begin(), urdf.links.end(), reference) != urdf.links.end() ||
                       std::any_of(urdf.joints.begin(), urdf.joints.end(), [&](const UrdfJoint& j) { return j.name == reference; });
    if (!known) notes.add("<gazebo reference> names no link or joint and is left out", reference);
    mend(*g, reference, urdf.file, notes, problems);
  }
}

}  // namespace vsa::reader
