// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "sdf/shapes.hpp"

namespace vsa::reader {
namespace {

scene::Pose plain(const Pose3& pose) {
  const auto& p = pose.Pos();
  const auto& q = pose.Rot();
  return {{p.X(), p.Y(), p.Z()}, {q.W(), q.X(), q.Y(), q.Z()}};
}

/// Heightmaps and meshes come as triangles in the link's frame, so their own pose stays the identity.
void add_triangles(scene::Shape& shape, const Mesh& mesh, const Pose3& pose) {
  for (const Vec3& v : mesh.vertices) {
    const Vec3 p = pose.Rot() * v + pose.Pos();
    for (const double x : {p.X(), p.Y(), p.Z()}) shape.vertices.push_back(static_cast<float>(x));
  }
  for (const auto& t : mesh.triangles) shape.indices.insert(shape.indices.end(), t.begin(), t.end());
}

/// Two triangles for each quad of a rows × columns grid of vertices.
void add_grid(Mesh& mesh, std::size_t rows, std::size_t columns) {
  for (std::size_t r = 0; r + 1 < rows; ++r) {
    for (std::size_t c = 0; c + 1 < columns; ++c) {
      const auto a = static_cast<std::uint32_t>(r * columns + c), b = a + 1;
      const auto d = static_cast<std::uint32_t>((r + 1) * columns + c), e = d + 1;
      mesh.triangles.push_back({a, b, e});
      mesh.triangles.push_back({a, e, d});
    }
  }
}

Mesh heightmap_mesh(const Heightmap& map) {
  Mesh mesh;
  for (std::size_t r = 0; r < map.rows; ++r) {
    for (std::size_t c = 0; c < map.columns; ++c) {
      const double x = map.extent_x * (static_cast<double>(c) / static_cast<double>(map.columns - 1) - 0.5);
      const double y = map.extent_y * (static_cast<double>(r) / static_cast<double>(map.rows - 1) - 0.5);
      mesh.vertices.push_back(map.centre + Vec3(x, y, map.heights[r * map.columns + c]));
    }
  }
  add_grid(mesh, map.rows, map.columns);
  return mesh;
}

Mesh ellipsoid_mesh(const Vec3& radii) {
  constexpr std::size_t kRows = 13, kColumns = 25;
  constexpr double kPi = std::numbers::pi;
  Mesh mesh;
  for (std::size_t r = 0; r < kRows; ++r) {
    const double polar = kPi * (1 - static_cast<double>(r) / (kRows - 1));
    for (std::size_t c = 0; c < kColumns; ++c) {
      const double turn = 2 * kPi * static_cast<double>(c) / (kColumns - 1);
      mesh.vertices.push_back(radii * Vec3(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)));
    }
  }
  add_grid(mesh, kRows, kColumns);
  return mesh;
}

}  // namespace

scene::Shape to_shape(const Geometry& g, const Pose3& at) {
  using scene::Shape;
  Shape shape;
  const Pose3 pose = at * g.offset;
  shape.pose = plain(pose);
  shape.size = {g.size.X(), g.size.Y(), g.size.Z()};
  using Kind = Geometry::Kind;
  switch (g.kind) {
    case Kind::box:
      shape.kind = Shape::Kind::box;
      break;
    case Kind::sphere:
      shape.kind = Shape::Kind::sphere;
      break;
    case Kind::cylinder:
      shape.kind = Shape::Kind::cylinder;
      break;
    case Kind::capsule:
      shape.kind = Shape::Kind::capsule;
      break;
    case Kind::plane:
      shape.kind = Shape::Kind::plane;
      break;
    case Kind::mesh:
    case Kind::ellipsoid:
      shape.kind = Shape::Kind::mesh;
      if (g.kind == Kind::ellipsoid) shape.size = {1, 1, 1};
      shape.pose = {};
      add_triangles(shape, g.mesh ? *g.mesh : ellipsoid_mesh(g.size), pose);
      break;
    case Kind::heightmap:
      shape.kind = Shape::Kind::heightmap;
      shape.pose = {};
      add_triangles(shape, heightmap_mesh(*g.heightmap), pose);
      break;
  }
  return shape;
}

}  // namespace vsa::reader
