// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Links without gravity. Of links that libsdformat lumps into one the last <turnGravityOff> or <gravity> counts for all: a camera
// without weight would take an arm's. So a fixed joint between a link with and one without gravity is kept. Links without mass are
// on either side; what is rigid with the world has no weight to lose.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "sdf/urdf_masses.hpp"

namespace vsa::reader {
namespace {

using tinyxml2::XMLElement;

std::string lower_text(const XMLElement& e) {
  const char* value = e.Attribute("value");
  std::string text(config::trim(value != nullptr ? value : e.GetText() != nullptr ? e.GetText() : ""));
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// As the file says it of each link; true: it has gravity.
std::map<std::string, bool> told_gravity(const XMLElement& robot) {
  std::map<std::string, bool> out;
  for (const XMLElement* g = robot.FirstChildElement("gazebo"); g != nullptr; g = g->NextSiblingElement("gazebo")) {
    const char* reference = g->Attribute("reference");
    if (reference == nullptr) continue;
    for (const XMLElement* e = g->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const std::string name = e->Name(), text = lower_text(*e);
      if (name == "turnGravityOff") out[reference] = text != "true" && text != "yes" && text != "1";
      if (name == "gravity") out[reference] = text != "false" && text != "0";
    }
  }
  return out;
}

class Gravity {
 public:
  Gravity(const XMLElement& robot, const Urdf& urdf) : urdf_(urdf), masses_(robot, urdf), told_(told_gravity(robot)) {}

  [[nodiscard]] bool any_without() const {
    return std::any_of(told_.begin(), told_.end(), [](const auto& t) { return !t.second; });
  }
  [[nodiscard]] bool differs_across(const UrdfJoint& j) const {
    return j.lumped && masses_.rigid_top(j.parent) != "world" && has(j.parent) != has(j.child);
  }
  /// "t (5 kg) without", with all that is lumped with it.
  [[nodiscard]] std::string text(const std::string& link) const {
    const std::string top = urdf_.lumped_into(link);
    const double mass = masses_.sum(top, [](const UrdfJoint& j) { return j.lumped; });
    return fmt::format("{} ({} kg) {}", top, mass, has(link) ? "with" : "without");
  }

 private:
  /// Nothing said of it, and nothing to weigh: it is as what it is lumped with.
  [[nodiscard]] bool neutral(const std::string& link) const { return !masses_.weighs(link) && !told_.contains(link); }

  [[nodiscard]] bool has(const std::string& link) const {
    std::string at = link;
    for (std::size_t i = 0; i <= urdf_.links.size() && neutral(at); ++i) {
      const UrdfJoint* above = urdf_.joint_above(at);
      if (above == nullptr || !above->lumped) break;
      at = above->parent;
    }
    if (neutral(at)) at = first_below(at);
    const auto it = told_.find(at);
    return it == told_.end() || it->second;
  }

  [[nodiscard]] std::string first_below(const std::string& top) const {
    std::vector<std::string> open{top};
    for (std::size_t i = 0; i < open.size() && i <= urdf_.links.size(); ++i) {
      if (!neutral(open[i])) return open[i];
      for (const UrdfJoint& j : urdf_.joints)
        if (j.lumped && j.parent == open[i]) open.push_back(j.child);
    }
    return top;
  }

  const Urdf& urdf_;
  Masses masses_;
  std::map<std::string, bool> told_;
};

}  // namespace

void keep_gravity_apart(XMLElement& robot, Urdf& urdf, Notes& notes) {
  const Gravity gravity(robot, urdf);
  if (!gravity.any_without()) return;
  std::vector<UrdfJoint*> kept;
  for (UrdfJoint& j : urdf.joints)
    if (gravity.differs_across(j)) kept.push_back(&j);
  for (UrdfJoint* j : kept) j->lumped = false;
  for (const UrdfJoint* j : kept) {
    XMLElement* gazebo = robot.InsertNewChildElement("gazebo");
    gazebo->SetAttribute("reference", j->name.c_str());
    gazebo->InsertNewChildElement("preserveFixedJoint")->SetText("true");
    notes.add("fixed joints between links with and without gravity are kept",
              fmt::format("{}, {} and {}", j->name, gravity.text(j->parent), gravity.text(j->child)));
  }
}

}  // namespace vsa::reader
