// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// <gazebo reference="…"> of a URDF, as ROS 1's robots have them. libsdformat makes SDF of most; what it makes elements of that SDF
// doesn't have, or reads with std::stod, is dealt with here. kp, kd, maxVel, minDepth become contact settings, mu1 and mu2
// friction, selfCollide, turnGravityOff, springReference and springStiffness the SDF elements: their readers judge them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
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

constexpr std::array<std::string_view, 5> kWords{"selfCollide", "turnGravityOff", "preserveFixedJoint", "disableFixedJointLumping",
                                                 "static"};

/// libsdformat takes any other word for the one or the other.
void check_word(const XMLElement& e, const std::string& reference, const std::string& file, Problems& problems) {
  if (!holds(kWords, e.Name())) return;
  const char* value = e.Attribute("value");
  const std::string text(config::trim(value != nullptr ? value : e.GetText() != nullptr ? e.GetText() : ""));
  std::string word = text;
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<std::string_view, 6> kAllowed{"true", "false", "yes", "no", "1", "0"};
  if (!holds(kAllowed, word))
    problems.add({file, (reference.empty() ? "gazebo/" : "gazebo[" + reference + "]/") + std::string(e.Name()), text,
                  "isn't true or false", "true, yes, 1, false, no, 0"});
}

constexpr std::array<std::string_view, 3> kOnceBesideNumbers{"selfCollide", "turnGravityOff", "fdir1"};
constexpr std::array<std::string_view, 8> kOfJoints{"preserveFixedJoint",
                                                    "disableFixedJointLumping",
                                                    "provideFeedback",
                                                    "implicitSpringDamper",
                                                    "cfmDamping",
                                                    "fudgeFactor",
                                                    "stopCfm",
                                                    "stopErp"};
constexpr std::array<std::string_view, 2> kSprings{"springReference", "springStiffness"};
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

/// What a <gazebo> of a joint says of links, or the other way round.
bool is_of_the_other(std::string_view name, bool link, bool joint) {
  const bool of_joints = holds(kOfJoints, name) || holds(kSprings, name);
  const bool of_links = !of_joints && (holds(kNumbers, name) || holds(kOnceBesideNumbers, name));
  return (of_links && joint && !link) || (of_joints && link && !joint);
}

void mend(XMLElement& gazebo, const std::string& reference, bool link, bool joint, const std::string& file, Notes& notes,
          Problems& problems) {
  for (XMLElement *e = gazebo.FirstChildElement(), *next = nullptr; e != nullptr; e = next) {
    next = e->NextSiblingElement();
    const std::string_view name = e->Name();
    if (is_of_the_other(name, link, joint) || name == "static") {
      notes.add(name == "static" ? "<static> in a <gazebo reference> is left out: it belongs to the whole robot"
                                 : fmt::format("<{}> in the <gazebo reference> of a {} is left out", name, link ? "link" : "joint"),
                place_of(*e, file));
      gazebo.DeleteChild(e);
      continue;
    }
    const auto* left = std::find_if(kLeftOut.begin(), kLeftOut.end(), [&](const LeftOut& l) { return l.name == name; });
    if (left == kLeftOut.end()) {
      check_number(*e, reference, file, problems);
      check_word(*e, reference, file, problems);
      tell_of_doubles(*e, file, notes);
      continue;
    }
    if (left->note != nullptr) notes.add(left->note, reference);
    gazebo.DeleteChild(e);
  }
}

/// Of the whole robot: what belongs to one link or joint.
void leave_out_misplaced(XMLElement& gazebo, const std::string& file, Notes& notes, Problems& problems) {
  for (XMLElement *e = gazebo.FirstChildElement(), *next = nullptr; e != nullptr; e = next) {
    next = e->NextSiblingElement();
    if (is(*e, "static")) check_word(*e, "", file, problems);
    const std::string_view name = e->Name();
    if (!holds(kNumbers, name) && !holds(kOnceBesideNumbers, name) && !holds(kOfJoints, name) && name != "collision" &&
        name != "visual")
      continue;
    notes.add(fmt::format("<{}> in a <gazebo> without reference is left out: reference=\"LINK OR JOINT\" says whose", name),
              place_of(*e, file));
    gazebo.DeleteChild(e);
  }
}

}  // namespace

void mend_gazebo_elements(XMLElement& robot, const Urdf& urdf, Notes& notes, Problems& problems) {
  for (XMLElement* g = robot.FirstChildElement("gazebo"); g != nullptr; g = g->NextSiblingElement("gazebo")) {
    const char* reference = g->Attribute("reference");
    if (reference == nullptr) {
      leave_out_misplaced(*g, urdf.file, notes, problems);
      continue;
    }
    const bool link = std::find(urdf.links.begin(), urdf.links.end(), reference) != urdf.links.end();
    const bool joint = std::any_of(urdf.joints.begin(), urdf.joints.end(), [&](const UrdfJoint& j) { return j.name == reference; });
    if (!link && !joint) notes.add("<gazebo reference> names no link or joint and is left out", reference);
    mend(*g, reference, link, joint, urdf.file, notes, problems);
  }
}

void rename_collisions(XMLElement& robot, const Urdf& urdf) {
  constexpr std::array<std::string_view, 10> kOfSurfaces{"mu1",    "mu2",      "fdir1",       "kp",         "kd",
                                                         "maxVel", "minDepth", "maxContacts", "laserRetro", "collision"};
  std::set<std::string> told;  // links
  for (const XMLElement* g = robot.FirstChildElement("gazebo"); g != nullptr; g = g->NextSiblingElement("gazebo")) {
    const char* reference = g->Attribute("reference");
    for (const XMLElement* e = g->FirstChildElement(); e != nullptr && reference != nullptr; e = e->NextSiblingElement())
      if (holds(kOfSurfaces, e->Name())) told.insert(reference);
  }
  for (XMLElement* link = robot.FirstChildElement("link"); link != nullptr; link = link->NextSiblingElement("link")) {
    const std::string name = link->Attribute("name") == nullptr ? "" : link->Attribute("name"), top = urdf.lumped_into(name);
    if (!told.contains(name) && !told.contains(top)) continue;
    for (XMLElement* c = link->FirstChildElement("collision"); c != nullptr; c = c->NextSiblingElement("collision")) {
      c->DeleteAttribute("name");
      // The way in which it marks what it lumps, where it would take this for the upper link's own.
      if (name != top && name.compare(0, top.size(), top) == 0) c->SetAttribute("name", ("_fixed_joint_lump__" + name).c_str());
    }
  }
}

}  // namespace vsa::reader
