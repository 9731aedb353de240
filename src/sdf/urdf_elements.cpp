// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/urdf_elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "sdf/xml_place.hpp"
#include "vsa/config/text.hpp"

namespace vsa::reader {
namespace {

using tinyxml2::XMLAttribute;
using tinyxml2::XMLElement;

struct UrdfElement {
  std::string_view name, attributes;
  std::string_view once;   // elements in it, of which urdfdom takes the first
  std::string_view often;  // elements in it, of which all count
};

// By the specification (https://wiki.ros.org/urdf/XML) and its schema; the <origin> of a <robot>, its place, is Gazebo's. What isn't in the first column holds what others read. A
// <material> in a <collision> is none of URDF's, but colours are for renderers and need no word.
constexpr std::array<UrdfElement, 24> kUrdf{
    {{"robot", "name version", "origin", "link joint material transmission gazebo ros2_control"},
     {"link", "name type", "inertial", "visual collision"},
     {"inertial", "", "origin mass inertia", ""},
     {"mass", "value", "", ""},
     {"inertia", "ixx ixy ixz iyy iyz izz", "", ""},
     {"visual", "name", "origin geometry material", ""},
     {"collision", "name", "origin geometry verbose material", ""},
     {"origin", "xyz rpy", "", ""},
     {"geometry", "", "box cylinder sphere mesh", ""},
     {"box", "size", "", ""},
     {"cylinder", "radius length", "", ""},
     {"sphere", "radius", "", ""},
     {"mesh", "filename scale", "", ""},
     {"material", "name", "color texture", ""},
     {"color", "rgba", "", ""},
     {"texture", "filename", "", ""},
     {"joint", "name type", "origin parent child axis calibration dynamics limit mimic safety_controller", ""},
     {"parent", "link", "", ""},
     {"child", "link", "", ""},
     {"axis", "xyz", "", ""},
     {"calibration", "rising falling reference_position", "", ""},
     {"dynamics", "damping friction", "", ""},
     {"limit", "lower upper effort velocity", "", ""},
     {"mimic", "joint multiplier offset", "", ""}}};

std::vector<std::string> words(std::string_view text) {
  return text.empty() ? std::vector<std::string>() : config::split(text, ' ');
}

bool has(const std::vector<std::string>& all, std::string_view word) {
  return std::find(all.begin(), all.end(), word) != all.end();
}

/// Others' extensions of URDF stand in namespaces of their own, as XML has it.
bool of_others(std::string_view name) { return name.find(':') != std::string_view::npos; }

class UrdfElements {
 public:
  UrdfElements(const std::string& file, Notes& notes) : file_(file), notes_(notes) {}

  void check(const XMLElement& e) {
    const auto* const known = std::find_if(kUrdf.begin(), kUrdf.end(), [&](const UrdfElement& u) { return is(e, u.name); });
    if (known == kUrdf.end()) return;
    attributes(e, words(known->attributes));
    if (!config::trim(texts_of(e)).empty()) notes_.add("text where a file has none is left out", place_of(e, file_));
    const std::vector<std::string> once = words(known->once), often = words(known->often);
    std::vector<std::string> seen;
    for (const XMLElement* c = e.FirstChildElement(); c != nullptr; c = c->NextSiblingElement()) {
      const std::string name = c->Name();
      if (of_others(name)) continue;
      if (!has(once, name) && !has(often, name)) {
        unknown(e, *c, once, often);
        continue;
      }
      // Of a <geometry> one shape counts, whichever it is.
      const bool again = is(e, "geometry") ? !seen.empty() : has(once, name) && has(seen, name);
      seen.push_back(name);
      if (again) {
        const std::string of = is(e, "geometry") ? "shapes" : fmt::format("<{}>", name);
        notes_.add(fmt::format("of several {} in one <{}> the first counts", of, e.Name()), place_of(*c, file_));
      } else {
        check(*c);
      }
    }
  }

 private:
  void attributes(const XMLElement& e, const std::vector<std::string>& known) {
    for (const XMLAttribute* a = e.FirstAttribute(); a != nullptr; a = a->Next()) {
      const std::string name = a->Name();
      if (has(known, name) || of_others(name) || name == "xmlns") continue;
      notes_.add(fmt::format("{}=\"…\" is no attribute of a URDF's <{}> and is left out{}", name, e.Name(),
                             config::did_you_mean(name, known)),
                 place_of(e, file_));
    }
  }

  void unknown(const XMLElement& parent, const XMLElement& e, const std::vector<std::string>& once,
               std::vector<std::string> often) {
    if (is(e, "sensor")) return notes_.add("sensors are left out", place_of(e, file_));
    // Of URDF before ROS 1, and still in many files.
    if (is(e, "contact_coefficients"))
      return notes_.add("<contact_coefficients> are left out: <gazebo reference=\"LINK\"> has <mu1>, <mu2>, <kp> and <kd>",
                        place_of(e, file_));
    often.insert(often.end(), once.begin(), once.end());
    notes_.add(fmt::format("<{}> is no element of a URDF's <{}> and is left out{}", e.Name(), parent.Name(),
                           config::did_you_mean(e.Name(), often)),
               place_of(e, file_));
  }

  const std::string& file_;
  Notes& notes_;
};

}  // namespace

void check_urdf_elements(const XMLElement& robot, const std::string& file, Notes& notes) { UrdfElements(file, notes).check(robot); }

}  // namespace vsa::reader
