// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Links without mass. Some robots have them between two moving joints (the two axes of a wrist), as frames at the end of fixed
// joints, as a base. libsdformat leaves out each that isn't given mass by links lumped into it, with all its children.
//
//   a frame at the end of lumped fixed joints      may go: it is a part of its parent
//   rigid with the world or with links of mass     kept, with a mass that doesn't matter
//   moved, and moving links of mass                kept likewise: the inertia that its joint feels is theirs
//   moved, with no mass behind it                  refused: nothing says how it moves
//   the root, with nothing rigid of mass           refused: it floats, and nothing says how
#include <fmt/format.h>

#include "sdf/urdf_masses.hpp"

namespace vsa::reader {
namespace {

using tinyxml2::XMLElement;

bool lumped(const UrdfJoint& j) { return j.lumped; }
bool rigid(const UrdfJoint& j) { return j.type == "fixed"; }
bool any(const UrdfJoint&) { return true; }

enum class Verdict { leave, keep, nothing_behind, floating };

Verdict judge(const Masses& masses, const Urdf& urdf, const std::string& link) {
  if (link == "world" || masses.sum(link, lumped) > kLeast_kg) return Verdict::leave;
  const UrdfJoint* above = urdf.joint_above(link);
  if (masses.leaf(link) && above != nullptr && above->lumped) return Verdict::leave;
  const std::string top = masses.rigid_top(link);
  if (top == "world" || masses.sum(top, rigid) > kLeast_kg) return Verdict::keep;
  if (urdf.joint_above(top) == nullptr) return Verdict::floating;
  return masses.sum(top, any) > kLeast_kg ? Verdict::keep : Verdict::nothing_behind;
}

void give_mass(XMLElement& link) {
  while (XMLElement* old = link.FirstChildElement("inertial")) link.DeleteChild(old);
  XMLElement* inertial = link.InsertNewChildElement("inertial");
  inertial->InsertNewChildElement("mass")->SetAttribute("value", fmt::format("{}", kDummyMass_kg).c_str());
  XMLElement* inertia = inertial->InsertNewChildElement("inertia");
  for (const char* name : {"ixx", "iyy", "izz"}) inertia->SetAttribute(name, fmt::format("{}", kDummyInertia_kgm2).c_str());
  for (const char* name : {"ixy", "ixz", "iyz"}) inertia->SetAttribute(name, "0");
}

}  // namespace

void mend_massless_links(XMLElement& robot, const Urdf& urdf, Notes& notes, Problems& problems) {
  const Masses masses(robot, urdf);
  constexpr const char* kWrite = "<inertial><mass value=\"…\"/><inertia …/></inertial> with more than 1e-6 kg";
  for (XMLElement* e = robot.FirstChildElement("link"); e != nullptr; e = e->NextSiblingElement("link")) {
    const char* name = e->Attribute("name");
    if (name == nullptr) continue;
    if (masses.own(name) < 0) {
      problems.add({urdf.file, fmt::format("link[{}]/inertial/mass", name), fmt::format("{}", masses.own(name)),
                    "isn't a positive mass", "> 0 kg, finite"});
      continue;
    }
    switch (judge(masses, urdf, name)) {
      case Verdict::leave:
        break;
      case Verdict::keep:
        give_mass(*e);
        notes.add(fmt::format("links without mass are kept with {} kg and {} kg·m²", kDummyMass_kg, kDummyInertia_kgm2), name);
        break;
      case Verdict::nothing_behind:
        problems.add({urdf.file, fmt::format("link[{}]", name), "",
                      "is moved by a joint, and neither it nor what hangs on it has mass", kWrite});
        break;
      case Verdict::floating:
        problems.add({urdf.file, fmt::format("link[{}]", name), "", "is the robot's root and has no mass",
                      std::string(kWrite) + ", or a link \"world\" with a fixed joint to it"});
        break;
    }
  }
}

}  // namespace vsa::reader
