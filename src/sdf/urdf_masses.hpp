// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the links of a URDF weigh.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sdf/urdf_file.hpp"
#include "vsa/config/text.hpp"

namespace vsa::reader {

inline constexpr double kLeast_kg = 1e-6;  // libsdformat takes this for zero

/// Its links' own, and sums of those that hang together.
class Masses {
 public:
  Masses(const tinyxml2::XMLElement& robot, const Urdf& urdf) : urdf_(urdf) {
    for (const tinyxml2::XMLElement* e = robot.FirstChildElement("link"); e != nullptr; e = e->NextSiblingElement("link")) {
      const char* name = e->Attribute("name");
      const tinyxml2::XMLElement* inertial = e->FirstChildElement("inertial");
      const tinyxml2::XMLElement* mass = inertial == nullptr ? nullptr : inertial->FirstChildElement("mass");
      const char* value = mass == nullptr ? nullptr : mass->Attribute("value");
      // A mass that is no number, or an <inertial> without one, is urdfdom's to report.
      const double unread = inertial == nullptr ? 0.0 : 1.0;
      if (name != nullptr) own_[name] = value == nullptr ? unread : config::parse_number(config::trim(value)).value_or(1.0);
    }
    for (const UrdfJoint& j : urdf.joints) children_[j.parent].push_back(&j);
  }

  [[nodiscard]] double own(const std::string& link) const {
    const auto it = own_.find(link);
    return it == own_.end() ? 0.0 : it->second;
  }
  [[nodiscard]] bool weighs(const std::string& link) const { return own(link) > kLeast_kg; }
  [[nodiscard]] bool leaf(const std::string& link) const { return children_.find(link) == children_.end(); }

  /// Of the link and of what hangs on it by joints that `through` lets pass.
  template <typename Pass>
  [[nodiscard]] double sum(const std::string& link, Pass through) const {
    double total = 0;
    std::vector<std::string> open{link};
    for (std::size_t i = 0; i < open.size() && i <= urdf_.links.size(); ++i) {
      total += own(open[i]);
      const auto it = children_.find(open[i]);
      if (it == children_.end()) continue;
      for (const UrdfJoint* j : it->second) {
        if (through(*j)) open.push_back(j->child);
      }
    }
    return total;
  }

  /// The link at the top of those rigid with this one; "world" counts as one.
  [[nodiscard]] std::string rigid_top(const std::string& link) const {
    std::string at = link;
    for (std::size_t i = 0; i <= urdf_.links.size(); ++i) {
      const UrdfJoint* above = urdf_.joint_above(at);
      if (above == nullptr || above->type != "fixed") break;
      at = above->parent;
    }
    return at;
  }

 private:
  const Urdf& urdf_;
  std::map<std::string, double> own_;
  std::map<std::string, std::vector<const UrdfJoint*>> children_;
};

}  // namespace vsa::reader
