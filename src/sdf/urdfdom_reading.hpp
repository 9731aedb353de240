// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A URDF read with urdfdom, where there is no libsdformat: a Reading of XML elements, and what one file comes to. Private to the
// files that know urdfdom.
//
// It comes to what libsdformat makes of the file (parser_urdf.cc of its version 12): links, joints, their names and their order are
// the same, and so are the numbers but for their last digits.
#pragma once

#include <tinyxml2.h>
#include <urdf_model/model.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sdf/reading.hpp"
#include "sdf/urdf_file.hpp"

namespace vsa::reader {

struct UrdfReading : Reading {
  using Element = const tinyxml2::XMLElement*;

  Urdf urdf{};
  std::map<std::string, std::vector<Element>> extensions{};  ///< <gazebo> by reference, in the file's order

  void problem(Element element, std::string key, std::string value, std::string message, std::string allowed = {});
  void cannot(Element element, std::string key, std::string value, const std::string& what, std::string allowed);
  [[nodiscard]] std::string file_of(Element) const { return file; }
  double number(Element element, const char* name, double fallback, double min, double max, const std::string& key);
  [[nodiscard]] static Element child(Element element, const char* name);
  [[nodiscard]] static std::optional<std::string> attribute(Element element, const char* name);
  [[nodiscard]] static bool has_children(Element element) { return element->FirstChildElement() != nullptr; }
  [[nodiscard]] static std::vector<Element> children(Element element);
  [[nodiscard]] static std::string name(Element element) { return element->Name(); }
  [[nodiscard]] static bool says_something(Element element) { return has_children(element) || !text(element).empty(); }
  /// true, yes, 1.
  [[nodiscard]] static bool flag(Element element);
  [[nodiscard]] std::uint32_t whole(Element element);
  /// "value", or the element's text.
  [[nodiscard]] static std::string text(Element element);
  [[nodiscard]] Vec3 vector(Element element);
};

/// A link of the URDF within the one that it is lumped into.
struct UrdfPart {
  urdf::LinkConstSharedPtr link;
  Pose3 at;  ///< in the link that it is a part of
};

/// What becomes a link: it, and what fixed joints lump into it.
struct UrdfLump {
  std::vector<UrdfPart> parts;        ///< itself first
  std::optional<std::size_t> parent;  ///< the lump that its joint hangs it on; none: the world, or no joint
  Pose3 pose;                         ///< in the world
};

/// All, each after the one that it hangs on.
[[nodiscard]] std::vector<UrdfLump> lump_links(UrdfReading& reading, const urdf::ModelInterface& model, const Pose3& at);

void read_urdf_link(UrdfReading& reading, const UrdfLump& lump, const ModelScope& scope);
/// The joint that the lump hangs on; `lumps` are in the order of the world's links.
void read_urdf_joint(UrdfReading& reading, const UrdfLump& lump, const ModelScope& scope, std::size_t link);

/// <collision> with all that <gazebo reference="LINK"> says of the link's, in a document of its own.
[[nodiscard]] std::unique_ptr<tinyxml2::XMLDocument> gazebo_collision(UrdfReading& reading, const std::string& link);
/// <link>, likewise, of a lump's parts; what can't be honoured is refused by name.
[[nodiscard]] std::unique_ptr<tinyxml2::XMLDocument> gazebo_link(UrdfReading& reading, const UrdfLump& lump);
/// The same of the robot: its plugins, and whether it is static.
void read_gazebo_robot(UrdfReading& reading, ModelScope& scope);
/// Of a joint; what its <gazebo reference> says of its spring goes to `axis`.
void read_gazebo_joint(UrdfReading& reading, const std::string& joint, const std::string& key, Axis* axis);

[[nodiscard]] inline Pose3 pose_of(const urdf::Pose& p) {
  return {{p.position.x, p.position.y, p.position.z}, {p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z}};
}

}  // namespace vsa::reader
