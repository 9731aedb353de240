// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sdf/mesh_file.hpp"

namespace vsa::reader {
namespace {

constexpr std::array<std::pair<Geometry::Kind, const char*>, 8> kShapes{{{Geometry::Kind::box, "box"},
                                                                         {Geometry::Kind::sphere, "sphere"},
                                                                         {Geometry::Kind::cylinder, "cylinder"},
                                                                         {Geometry::Kind::capsule, "capsule"},
                                                                         {Geometry::Kind::ellipsoid, "ellipsoid"},
                                                                         {Geometry::Kind::plane, "plane"},
                                                                         {Geometry::Kind::heightmap, "heightmap"},
                                                                         {Geometry::Kind::mesh, "mesh"}}};

}  // namespace

std::string collidable(const Capabilities& engine) {
  std::string all;
  for (const auto& [kind, name] : kShapes) {
    if (!engine.takes(kind)) continue;
    const bool hulls = kind == Geometry::Kind::mesh && !engine.concave_meshes;
    all += (all.empty() ? "" : ", ") + std::string(hulls ? "convex " : "") + name;
  }
  return all;
}

std::string name_of(Geometry::Kind kind) {
  const auto* const it = std::find_if(kShapes.begin(), kShapes.end(), [&](const auto& shape) { return shape.first == kind; });
  return it->second;
}

std::nullopt_t ShapeReading::refuse(const std::string& name, const std::string& value, const std::string& message,
                                    const std::string& allowed) {
  if (collides) {
    reading.problems.add({file, key + "/geometry/" + name, value, message, allowed});
  } else {
    reading.notes.add("visuals that can't be shown are left out (" + message + ")", key);
  }
  return std::nullopt;
}

std::optional<Geometry> ShapeReading::sized(Geometry::Kind kind, const Vec3& size, int used, const char* name) {
  for (int i = 0; i < used; ++i) {
    const double x = size[static_cast<std::size_t>(i)];
    if (!std::isfinite(x) || x <= 0) return refuse(name, fmt::format("{}", x), "a length that isn't positive", "> 0, finite");
  }
  Geometry g;
  g.kind = kind;
  g.size = size;
  return g;
}

/// Of a collision mesh that isn't convex, `why`: what was asked for.
std::optional<Geometry> ShapeReading::make_convex(const std::string& uri, Geometry g, const std::string& why, Concave wish) {
  constexpr const char* kAllowed =
      "convex closed meshes, primitives, a heightmap; or ask for the hull or for convex parts: vsa run --concave, "
      "WorldOptions::concave";
  if (wish == Concave::refuse && reading.engine.concave_meshes) return g;
  const double size = volume(*g.mesh);
  if (wish == Concave::refuse) return refuse("mesh/uri", uri, why, kAllowed);
  if (wish == Concave::hull) {
    reading.notes.add("concave collision meshes are filled to their convex hulls", key);
    g.hull = true;
    return g;
  }
  try {
    double sum = 0;
    for (Mesh& part : decompose(*g.mesh)) {
      sum += std::abs(volume(part));
      g.parts.push_back(std::make_shared<const Mesh>(std::move(part)));
    }
    reading.notes.add("concave collision meshes are cut into convex parts",
                      fmt::format("{} into {} of {:.3g} times its volume", key, g.parts.size(), sum / std::abs(size)));
  } catch (const InputError& error) {
    return refuse("mesh/uri", uri, error.problems().front().message, kAllowed);
  }
  return g;
}

std::optional<Geometry> ShapeReading::mesh(const std::filesystem::path& found, const std::string& uri, const Vec3& scale,
                                           Concave wish) {
  if (!mesh_format_known(found)) return refuse("mesh/uri", uri, "this mesh format isn't read", kMeshFormats);
  Geometry g;
  g.kind = Geometry::Kind::mesh;
  g.size = scale;
  reading.seen.reads(found);
  try {
    g.mesh = std::make_shared<const Mesh>(read_mesh(found, scale));
  } catch (const InputError& error) {
    return refuse("mesh/uri", uri, error.what(), kMeshFormats);
  }
  if (!collides) return g;
  const std::string why = not_convex(*g.mesh);
  return why.empty() ? std::optional(g) : make_convex(uri, std::move(g), why, wish);
}

}  // namespace vsa::reader
