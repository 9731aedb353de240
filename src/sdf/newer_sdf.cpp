// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/newer_sdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

#include "sdf/xml_place.hpp"
#include "vsa/config/text.hpp"

namespace vsa::reader {
namespace {

using tinyxml2::XMLAttribute;
using tinyxml2::XMLElement;

class Mender {
 public:
  Mender(const std::string& file, bool newer, Notes& notes, Problems& problems)
      : file_(file), newer_(newer), notes_(notes), problems_(problems) {}

  void children(XMLElement& parent) {
    for (XMLElement *e = parent.FirstChildElement(), *next = nullptr; e != nullptr; e = next) {
      next = e->NextSiblingElement();
      if (is(*e, "plugin")) continue;
      if (is(parent, "joint") && lacks_direction(*e)) refuse_or_turn_axis(parent, *e);
      if (hollow(parent, *e) || (newer_ ? drop(parent, *e) : !plain_colour(*e) && drop_colour(parent, *e))) {
        changed_ = true;
        continue;
      }
      rename(parent, *e);
      if (newer_) refuse(parent, *e);
      children(*e);
    }
  }

  [[nodiscard]] bool changed() const { return changed_; }

 private:
  /// What is left out anyway, but with a word that libsdformat's reading gives rise to, stays as an empty element of our name: it may
  /// hold what libsdformat refuses.
  static bool hollow(const XMLElement& parent, XMLElement& e) {
    const bool sensor = is(e, "sensor") && (is(parent, "link") || is(parent, "joint"));
    if (!sensor && !(is(parent, "material") && (is(e, "script") || is(e, "pbr")))) return false;
    e.SetName((std::string("vsa:") + e.Name()).c_str());
    e.DeleteChildren();
    while (const XMLAttribute* a = e.FirstAttribute()) e.DeleteAttribute(a->Name());
    return true;
  }

  /// Four numbers of 0 … 1: libsdformat takes them, and taking them out would cost a copy of the file.
  static bool plain_colour(const XMLElement& e) {
    if (!is(e, "ambient") && !is(e, "specular") && !is(e, "emissive")) return false;
    std::istringstream text(e.GetText() == nullptr ? "" : e.GetText());
    int count = 0;
    for (double value = 0; text >> value; ++count)
      if (!(value >= 0 && value <= 1)) return false;
    return text.eof() && count == 4;
  }

  static bool drop_colour(XMLElement& parent, XMLElement& e) {
    if (!is(parent, "material") || is(e, "diffuse")) return false;
    parent.DeleteChild(&e);
    return true;
  }

  /// What is left out anyway may hold what 1.9 doesn't know.
  bool drop(XMLElement& parent, XMLElement& e) {
    if (drop_colour(parent, e)) return true;
    if (is(e, "sensor")) {
      notes_.add("sensors are left out", path_of(e));
    } else if (is(e, "visual") && holds_cone(e)) {
      notes_.add("visuals that can't be shown are left out (a cone)", path_of(e));
    } else if (!is(e, "light") && !is(e, "gui") && !is(e, "scene") && !is(e, "density") && !is(e, "auto_inertia_params") &&
               !is(e, "convex_decomposition")) {
      return false;
    }
    parent.DeleteChild(&e);
    return true;
  }

  static bool holds_cone(const XMLElement& e) {
    const XMLElement* geometry = e.FirstChildElement("geometry");
    return geometry != nullptr && geometry->FirstChildElement("cone") != nullptr;
  }

  /// <axis> with an <xyz> of three zeros: libsdformat tells of it without the joint.
  static bool lacks_direction(const XMLElement& e) {
    const XMLElement* xyz = is(e, "axis") || is(e, "axis2") ? e.FirstChildElement("xyz") : nullptr;
    if (xyz == nullptr) return false;
    std::istringstream in(texts_of(*xyz));
    std::size_t zeros = 0;
    for (std::string word; in >> word; ++zeros)
      if (config::parse_number(word) != 0.0) return false;
    return zeros == 3;
  }

  /// On a joint that turns about no axis of its own it means nothing, and any direction does; whatever else it holds is told of.
  void refuse_or_turn_axis(const XMLElement& joint, XMLElement& axis) {
    const char* type = joint.Attribute("type");
    XMLElement& xyz = *axis.FirstChildElement("xyz");
    if (type == nullptr || (std::string_view(type) != "fixed" && std::string_view(type) != "ball")) {
      problems_.add({line_of(xyz, file_), path_of(xyz), std::string(config::trim(texts_of(xyz))), "has no direction",
                     "a vector other than zero"});
      return;
    }
    xyz.DeleteChildren();  // comments among the numbers, too
    xyz.SetText("0 0 1");
    changed_ = true;
  }

  /// Elements of our own name pass libsdformat.
  void rename(XMLElement& parent, XMLElement& e) {
    const bool of_axis = is(parent, "axis") || is(parent, "axis2");
    if (of_axis && (is(e, "mimic") || is(e, "initial_position"))) {
      e.SetName((std::string("vsa:") + e.Name()).c_str());
      changed_ = true;
    }
    const char* optimization = is(e, "mesh") ? e.Attribute("optimization") : nullptr;
    if (optimization == nullptr) return;
    e.SetAttribute("vsa:optimization", optimization);
    e.DeleteAttribute("optimization");
    changed_ = true;
  }

  void refuse(const XMLElement& parent, XMLElement& e) {
    if (is(e, "joint") && is(parent, "world")) {
      problems_.add(
          {file_, path_of(e), "", "a joint outside a model isn't supported", "a model with a joint whose parent is world"});
    } else if (is(e, "cone") && is(parent, "geometry")) {
      problems_.add({file_, path_of(e), "", "this kind of geometry isn't supported",
                     "box, sphere, cylinder, capsule, ellipsoid, plane, heightmap, convex mesh"});
    } else if (const char* automatic = is(e, "inertial") ? e.Attribute("auto") : nullptr; automatic != nullptr) {
      const std::string value = automatic;
      e.DeleteAttribute("auto");
      if (value != "false" && value != "0")
        problems_.add({file_, path_of(e) + "@auto", value, "inertia worked out from the shapes isn't supported",
                       "<mass> and <inertia>, or auto=\"false\""});
    }
  }

  const std::string& file_;
  bool newer_;
  Notes& notes_;
  Problems& problems_;
  bool changed_ = false;
};

bool known(std::string_view version) {
  return version.size() == 3 && version.substr(0, 2) == "1." && version[2] >= '0' && version[2] <= '9';
}

bool placeholder(const char* text) {
  return text != nullptr && (std::string_view(text).find("${") != std::string_view::npos ||
                             std::string_view(text).find("$(") != std::string_view::npos);
}

/// The first element that xacro should have replaced; plug-ins may hold such text for themselves.
const XMLElement* find_unexpanded(const XMLElement& e) {
  if (std::string_view(e.Name()).substr(0, 6) == "xacro:") return &e;
  const bool foreign = is(e, "plugin") || is(e, "ros2_control") || is(e, "param");
  bool found = !foreign && placeholder(e.GetText());
  for (const XMLAttribute* a = e.FirstAttribute(); a != nullptr && !foreign; a = a->Next())
    found = found || placeholder(a->Value());
  if (found) return &e;
  for (const XMLElement* c = e.FirstChildElement(); c != nullptr; c = c->NextSiblingElement()) {
    if (foreign && std::string_view(c->Name()).substr(0, 6) != "xacro:") continue;
    if (const XMLElement* inside = find_unexpanded(*c)) return inside;
  }
  return nullptr;
}

}  // namespace

bool is_newer(const XMLElement& sdf) {
  constexpr std::array<std::string_view, 3> kNewer{"1.10", "1.11", "1.12"};
  const char* version = sdf.Attribute("version");
  return version != nullptr && std::find(kNewer.begin(), kNewer.end(), version) != kNewer.end();
}

bool mend_sdf(XMLElement& sdf, const std::string& file, Notes& notes, Problems& problems) {
  const char* version = sdf.Attribute("version");
  const bool newer = is_newer(sdf);
  if (version == nullptr) {
    problems.add({line_of(sdf, file), "sdf@version", "", "is missing",
                  "<sdf version=\"1.9\">, or what the file is written for: " + std::string(kVersions)});
    return false;
  }
  if (!newer && !known(version)) {
    problems.add({file, "sdf@version", version, "isn't a version that can be read", kVersions});
    return false;
  }
  Mender mender(file, newer, notes, problems);
  mender.children(sdf);
  if (newer) sdf.SetAttribute("version", "1.9");
  return newer || mender.changed();
}

bool has_more_than_root(const XMLElement& root, const std::string& file, Problems& problems) {
  bool doctype = false;  // tinyxml2 ends one at its first >: the rest is a text before the root
  for (const tinyxml2::XMLNode* n = root.GetDocument()->FirstChild(); n != nullptr; n = n->NextSibling()) {
    doctype = n != &root && (doctype || n->ToUnknown() != nullptr);
    const bool element = n->ToElement() != nullptr;
    if (n == &root || !(element || (n->ToText() != nullptr && !doctype))) continue;
    problems.add({line_of(*n, file), element ? fmt::format("<{}>", n->Value()) : "",
                  element ? "" : std::string(config::trim(n->Value())), "stands outside the file's first element",
                  fmt::format("one <{}> a file", root.Name())});
    return true;
  }
  return false;
}

bool is_unexpanded(const XMLElement& root, const std::string& file, Problems& problems) {
  const XMLElement* e = find_unexpanded(root);
  if (e == nullptr) return false;
  problems.add({fmt::format("{}:{}", file, e->GetLineNum()), fmt::format("<{}>", e->Name()), "",
                "isn't expanded: the file is written for xacro", "its output, of: xacro FILE > robot.urdf"});
  return true;
}

}  // namespace vsa::reader
