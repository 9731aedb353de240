// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A Reading of libsdformat's elements. Private to the files that know libsdformat.
#pragma once

#include <sdf/sdf_config.h>

#include <map>
#include <sdf/Element.hh>
#include <sdf/SemanticPose.hh>
#include <type_traits>
#include <utility>
#include <vector>

#include "sdf/input_files.hpp"
#include "sdf/reading.hpp"

namespace sdf {
inline namespace SDF_VERSION_NAMESPACE {
class Joint;
class Link;
class Model;
class Geometry;
class Visual;
class World;
}  // namespace SDF_VERSION_NAMESPACE
}  // namespace sdf

namespace vsa::reader {

/// What libsdformat gives and takes: ignition::math's or gz::math's, by its version.
using SdfPose3 = std::decay_t<decltype(std::declval<sdf::SemanticPose>().RawPose())>;
using SdfVec3 = std::decay_t<decltype(std::declval<SdfPose3>().Pos())>;

struct ReadContext : Reading {
  using Element = sdf::ElementPtr;

  InputFiles& files;
  bool parsed_clean = true;                    ///< false: poses may not resolve for reasons already reported
  std::map<std::string, Pose3> model_poses{};  ///< scoped name → its frame in the world

  void problem(const sdf::ElementPtr& element, std::string key, std::string value, std::string message, std::string allowed = {});
  [[nodiscard]] std::string file_of(const sdf::ElementPtr& element) const;
  /// A problem of what this engine can't honour.
  void cannot(const sdf::ElementPtr& element, std::string key, std::string value, const std::string& what, std::string allowed);
  /// The pose in the frame `to` (empty: the default one); identity and a problem where it can't be resolved.
  Pose3 resolve(const sdf::SemanticPose& pose, const std::string& to, const sdf::ElementPtr& element, const std::string& key);
  /// The number in `name` under `element`, or `fallback`; a problem where it isn't finite or outside [min, max].
  double number(const sdf::ElementPtr& element, const std::string& name, double fallback, double min, double max,
                const std::string& key);
  /// As a part's readers need it (surface_rules.hpp).
  [[nodiscard]] static sdf::ElementPtr child(const sdf::ElementPtr& element, const std::string& name);
  [[nodiscard]] static std::optional<std::string> attribute(const sdf::ElementPtr& element, const std::string& name);
  [[nodiscard]] static bool has_children(const sdf::ElementPtr& element) { return element->GetFirstElement() != nullptr; }
  [[nodiscard]] static std::vector<sdf::ElementPtr> children(const sdf::ElementPtr& element);
  [[nodiscard]] static std::string name(const sdf::ElementPtr& element) { return element->GetName(); }
  /// In the file, and not what SDF has for it anyway.
  [[nodiscard]] static bool says_something(const sdf::ElementPtr& element);
  [[nodiscard]] static bool flag(const sdf::ElementPtr& element) { return element->Get<bool>(); }
  [[nodiscard]] static std::uint32_t whole(const sdf::ElementPtr& element) { return element->Get<unsigned int>(); }
  [[nodiscard]] static std::string text(const sdf::ElementPtr& element) { return element->Get<std::string>(); }
  [[nodiscard]] static Vec3 vector(const sdf::ElementPtr& element) { return element->Get<SdfVec3>(); }
};

/// The child, or null: unlike GetElement() never adds one.
[[nodiscard]] sdf::ElementPtr child(const sdf::ElementPtr& element, const std::string& name);

void read_model(ReadContext& context, const sdf::Model& model, const ModelScope* outer);
void read_link(ReadContext& context, const sdf::Link& link, const ModelScope& scope);
void read_joint(ReadContext& context, const sdf::Joint& joint, const ModelScope& scope);
/// Compares a model that came from a URDF with it; afterwards, that each URDF was.
void check_urdf(ReadContext& context, const sdf::Model& model, const ModelScope& scope);
void check_urdfs_found(ReadContext& context);
/// What the files say twice, or not in numbers; `described`: the element <sdf>, with libsdformat's descriptions of all others.
void check_sdfs(ReadContext& context, const sdf::ElementPtr& described);
/// A world's <state>, once its models are read.
void read_state(ReadContext& context, const sdf::World& world);
[[nodiscard]] std::optional<Geometry> read_geometry(ReadContext& context, const sdf::Geometry& geometry, const std::string& key,
                                                    bool collides);
[[nodiscard]] Surface read_surface(ReadContext& context, const sdf::ElementPtr& collision, const std::string& key);
[[nodiscard]] std::vector<scene::Shape> read_visuals(ReadContext& context, const sdf::Link& link, const Link& described);

}  // namespace vsa::reader
