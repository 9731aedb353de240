// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <sdf/Geometry.hh>
#include <sdf/Link.hh>
#include <sdf/Material.hh>
#include <sdf/Visual.hh>

#include "sdf/read_context.hpp"
#include "sdf/shapes.hpp"

namespace vsa::reader {
namespace {

void colour(ReadContext& c, const sdf::Visual& visual, const std::string& key, scene::Shape& shape) {
  const sdf::Material* material = visual.Material();
  if (material != nullptr && child(material->Element(), "diffuse")) {
    const auto d = material->Diffuse();
    shape.rgba = {d.R(), d.G(), d.B(), d.A()};
  }
  shape.rgba[3] *= 1 - visual.Transparency();
  for (const char* more : {"script", "vsa:script", "vsa:pbr"}) {
    if (material != nullptr && child(material->Element(), more))
      c.notes.add("materials are shown by their diffuse colour only", key);
  }
}

}  // namespace

std::vector<scene::Shape> read_visuals(ReadContext& c, const sdf::Link& link, const Link& described) {
  std::vector<scene::Shape> out;
  for (std::uint64_t i = 0; i < link.VisualCount(); ++i) {
    const sdf::Visual& visual = *link.VisualByIndex(i);
    const std::string key = described.name + "/visual[" + visual.Name() + "]";
    const std::optional<Geometry> geometry = read_geometry(c, *visual.Geom(), key, false);
    if (!geometry) continue;
    out.push_back(to_shape(*geometry, c.resolve(visual.SemanticPose(), "", visual.Element(), key)));
    colour(c, visual, key, out.back());
  }
  if (!out.empty()) return out;
  for (const Collision& collision : described.collisions) out.push_back(to_shape(collision.geometry, collision.pose));
  return out;
}

}  // namespace vsa::reader
