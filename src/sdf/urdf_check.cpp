// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A model that came from a URDF, compared with it: nothing of the file may be missing but what fixed joints lump together.
#include <algorithm>
#include <sdf/Model.hh>
#include <string>

#include "sdf/read_context.hpp"
#include "vsa/config/text.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::reader {
namespace {

bool has_link(const ReadContext& c, const std::string& name) {
  return std::any_of(c.out.links.begin(), c.out.links.end(), [&](const Link& l) { return l.name == name; });
}

bool has_joint(const ReadContext& c, const std::string& name) {
  return std::any_of(c.out.joints.begin(), c.out.joints.end(), [&](const Joint& j) { return j.name == name; });
}

}  // namespace

void check_urdf(ReadContext& c, const sdf::Model& model, const ModelScope& scope) {
  const sdf::ElementPtr mark = child(model.Element(), "vsa:urdf");
  if (!mark) return;
  const auto id = config::parse_integer(mark->GetAttribute("id")->GetAsString());
  if (!id || *id < 0 || static_cast<std::size_t>(*id) >= c.files.urdfs.size()) return;
  Urdf& urdf = c.files.urdfs[static_cast<std::size_t>(*id)];
  urdf.found = true;
  for (const std::string& link : urdf.links) {
    if (link == "world" || has_link(c, scoped_name(scope.name, urdf.lumped_into(link)))) continue;
    c.problems.add({urdf.file, "link[" + link + "]", "", "got lost in libsdformat's conversion", "<inertial> with a mass"});
  }
  std::size_t collisions = 0;
  for (const Link& l : c.out.links) collisions += is_below(l.name, scope.name) ? l.collisions.size() : 0;
  if (c.problems.empty() && collisions < urdf.collisions)
    c.problems.add({urdf.file, "collision", std::to_string(urdf.collisions),
                    "got lost in libsdformat's conversion, but for " + std::to_string(collisions), ""});
  for (const UrdfJoint& joint : urdf.joints) {
    const std::string name = scoped_name(scope.name, joint.name);
    if (!joint.lumped && !scope.is_static && !has_joint(c, name) && c.problems.empty())
      c.problems.add(
          {urdf.file, "joint[" + joint.name + "]", "", "got lost in libsdformat's conversion", "links with mass on both sides"});
    if (joint.mimic && !scope.is_static)
      c.mimics.push_back(
          {urdf.file, name, scoped_name(scope.name, joint.mimic->leader), joint.mimic->multiplier, joint.mimic->offset});
  }
}

void check_urdfs_found(ReadContext& c) {
  if (!c.problems.empty()) return;
  for (const Urdf& urdf : c.files.urdfs) {
    if (!urdf.found)
      c.problems.add({urdf.file, "", "", "this URDF's model can't be found in the world", "an <include> without merge"});
  }
}

}  // namespace vsa::reader
