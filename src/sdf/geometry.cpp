// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Geometry.hh>
#include <sdf/Heightmap.hh>
#include <sdf/Mesh.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>

#include "sdf/heightmap_file.hpp"
#include "sdf/read_context.hpp"
#include "sdf/shapes.hpp"
#include "vsa/files.hpp"

namespace vsa::reader {
namespace {

struct Where : ShapeReading {
  Where(ReadContext& context, sdf::ElementPtr e, std::string k, bool does_collide)
      : ShapeReading{context, context.file_of(e), std::move(k), does_collide}, c(context), element(std::move(e)) {}

  ReadContext& c;
  sdf::ElementPtr element;

  [[nodiscard]] std::filesystem::path base_of(const std::string& given) const {
    const std::string from = c.files.original(given);
    const bool known = !from.empty() && from.front() != '<' && std::filesystem::exists(from);
    return known ? std::filesystem::absolute(from).parent_path() : c.base;
  }
  [[nodiscard]] std::filesystem::path locate(const std::string& uri, const std::string& from) const {
    return c.finder.find(uri, base_of(from));
  }
  std::nullopt_t not_found(const char* name, const std::string& uri, const std::string& from) {
    constexpr std::string_view kModel = "model://";
    // libsdformat reads a URDF's package:// as model://; users know what their file says.
    const bool renamed = c.files.top_is_urdf && uri.compare(0, kModel.size(), kModel) == 0;
    const std::string written = renamed ? "package://" + uri.substr(kModel.size()) : uri;
    const bool in_file = renamed && read_file(c.file).value_or("").find(written) != std::string::npos;
    return refuse(name, in_file ? written : uri, "file not found", c.finder.searched(uri, base_of(from)));
  }
};

std::optional<Geometry> read_plane(Where& w, const sdf::Plane& plane) {
  Geometry g;
  g.kind = Geometry::Kind::plane;
  g.size = {plane.Size().X(), plane.Size().Y(), 0};
  const Vec3 normal = plane.Normal();
  if (!normal.IsFinite() || normal.Length() < 1e-9)
    return w.refuse("plane/normal", "", "has no direction", "a vector other than zero");
  SdfPose3 turned;
  turned.Rot().From2Axes(SdfVec3::UnitZ, plane.Normal());
  g.offset.Rot() = turned.Rot();
  return g;
}

Concave wish_of(const Where& w, const sdf::Mesh& mesh) {
  const sdf::ElementPtr e = mesh.Element();
  const std::string text = e && e->HasAttribute("vsa:optimization") ? e->GetAttribute("vsa:optimization")->GetAsString() : "";
  return text == "convex_hull" ? Concave::hull : text == "convex_decomposition" ? Concave::decompose : w.c.concave;
}

std::optional<Geometry> read_mesh_geometry(Where& w, const sdf::Mesh& mesh) {
  const auto path = w.locate(mesh.Uri(), mesh.FilePath());
  if (path.empty()) return w.not_found("mesh/uri", mesh.Uri(), mesh.FilePath());
  if (!mesh.Submesh().empty()) return w.refuse("mesh/submesh", mesh.Submesh(), "submeshes aren't supported", "whole meshes");
  return w.mesh(path, mesh.Uri(), mesh.Scale(), wish_of(w, mesh));
}

std::optional<Geometry> read_heightmap_geometry(Where& w, const sdf::Heightmap& map) {
  const auto path = w.locate(map.Uri(), map.FilePath());
  if (path.empty()) return w.not_found("heightmap/uri", map.Uri(), map.FilePath());
  std::optional<Geometry> g = w.sized(Geometry::Kind::heightmap, map.Size(), 3, "heightmap/size");
  if (!g) return g;
  w.c.seen.reads(path);
  try {
    g->heightmap = std::make_shared<const Heightmap>(read_heightmap(path, map.Size(), map.Position()));
  } catch (const InputError& error) {
    return w.refuse("heightmap/uri", map.Uri(), error.what(), kImageFormats);
  }
  return g;
}

std::optional<Geometry> read_any(Where& w, const sdf::Geometry& geometry) {
  switch (geometry.Type()) {
    case sdf::GeometryType::BOX:
      return w.sized(Geometry::Kind::box, geometry.BoxShape()->Size(), 3, "box/size");
    case sdf::GeometryType::SPHERE:
      return w.sized(Geometry::Kind::sphere, {geometry.SphereShape()->Radius(), 0, 0}, 1, "sphere/radius");
    case sdf::GeometryType::CYLINDER:
      return w.sized(Geometry::Kind::cylinder, {geometry.CylinderShape()->Radius(), geometry.CylinderShape()->Length(), 0}, 2,
                     "cylinder");
    case sdf::GeometryType::CAPSULE:
      return w.sized(Geometry::Kind::capsule, {geometry.CapsuleShape()->Radius(), geometry.CapsuleShape()->Length(), 0}, 2,
                     "capsule");
    case sdf::GeometryType::ELLIPSOID:
      return w.sized(Geometry::Kind::ellipsoid, geometry.EllipsoidShape()->Radii(), 3, "ellipsoid/radii");
    case sdf::GeometryType::PLANE:
      return read_plane(w, *geometry.PlaneShape());
    case sdf::GeometryType::MESH:
      return read_mesh_geometry(w, *geometry.MeshShape());
    case sdf::GeometryType::HEIGHTMAP:
      return read_heightmap_geometry(w, *geometry.HeightmapShape());
    default:
      // libsdformat calls what it doesn't know empty.
      if (!geometry.Element() || child(geometry.Element(), "empty") || !geometry.Element()->GetFirstElement()) return std::nullopt;
      return w.refuse(geometry.Element()->GetFirstElement()->GetName(), "", "this kind of geometry isn't supported",
                      collidable(w.c.engine));
  }
}

/// libsdformat looks for one kind after another, and takes the first that is there.
void tell_of_others(const Where& w, Geometry::Kind kind) {
  const sdf::ElementPtr first = w.element ? w.element->GetFirstElement() : nullptr;
  if (!first || !first->GetNextElement("")) return;
  w.c.notes.add(fmt::format("of several shapes in one <geometry> one counts, its {}", name_of(kind)), w.key);
}

}  // namespace

std::optional<Geometry> read_geometry(ReadContext& c, const sdf::Geometry& geometry, const std::string& key, bool collides) {
  Where w(c, geometry.Element(), key, collides);
  std::optional<Geometry> g = read_any(w, geometry);
  if (g) tell_of_others(w, g->kind);
  if (!g || !collides || c.engine.takes(g->kind)) return g;
  const std::string name = w.element->GetFirstElement()->GetName();
  c.cannot(w.element, key + "/geometry/" + name, "", "collisions of this kind aren't", collidable(c.engine));
  return std::nullopt;
}

}  // namespace vsa::reader
