// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a body of an MJCF looks like: its geoms that don't collide, where it has such, else all. Ellipsoids aren't shown.
#include <algorithm>

#include "physics/mujoco/mjcf_file.hpp"

namespace vsa::physics {
namespace {

using scene::Shape;

constexpr double kEndless_m = 100;  // shown of a plane without a size

void add_corner(Shape& shape, const mjtNum* place, const mjtNum* quat, const std::array<mjtNum, 3>& corner) {
  mjtNum turned[3];
  mju_rotVecQuat(turned, corner.data(), quat);
  for (std::size_t i = 0; i < 3; ++i) shape.vertices.push_back(static_cast<float>(turned[i] + place[i]));
}

/// Triangles in the link's frame, so the shape's own pose stays the identity.
void add_mesh(Shape& shape, const mjModel& m, int mesh, const mjtNum* place, const mjtNum* quat) {
  const float* vertices = m.mesh_vert + 3 * m.mesh_vertadr[mesh];
  for (int v = 0; v < m.mesh_vertnum[mesh]; ++v)
    add_corner(shape, place, quat, {vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]});
  const int* faces = m.mesh_face + 3 * m.mesh_faceadr[mesh];
  for (int i = 0; i < 3 * m.mesh_facenum[mesh]; ++i) shape.indices.push_back(static_cast<std::uint32_t>(faces[i]));
}

void add_heightmap(Shape& shape, const mjModel& m, int map, const mjtNum* place, const mjtNum* quat) {
  const int rows = m.hfield_nrow[map], columns = m.hfield_ncol[map];
  const mjtNum* size = m.hfield_size + 4 * map;
  const float* data = m.hfield_data + m.hfield_adr[map];
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      add_corner(shape, place, quat,
                 {size[0] * (2.0 * c / (columns - 1) - 1), size[1] * (2.0 * r / (rows - 1) - 1), size[2] * data[r * columns + c]});
      if (r + 1 == rows || c + 1 == columns) continue;
      const auto a = static_cast<std::uint32_t>(r * columns + c), d = a + static_cast<std::uint32_t>(columns);
      for (const std::uint32_t i : {a, a + 1, d + 1, a, d + 1, d}) shape.indices.push_back(i);
    }
  }
}

}  // namespace

bool show(const mjModel& m, int geom, Shape& shape) {
  const mjtNum *size = m.geom_size + 3 * geom, *place = m.geom_pos + 3 * geom, *quat = m.geom_quat + 4 * geom;
  std::copy_n(place, 3, shape.pose.position.begin());
  std::copy_n(quat, 4, shape.pose.quaternion.begin());
  switch (m.geom_type[geom]) {
    case mjGEOM_PLANE:
      shape.kind = Shape::Kind::plane;
      shape.size = {size[0] > 0 ? 2 * size[0] : kEndless_m, size[1] > 0 ? 2 * size[1] : kEndless_m, 0};
      return true;
    case mjGEOM_SPHERE:
      shape.kind = Shape::Kind::sphere;
      shape.size = {size[0], 0, 0};
      return true;
    case mjGEOM_CAPSULE:
    case mjGEOM_CYLINDER:
      shape.kind = m.geom_type[geom] == mjGEOM_CAPSULE ? Shape::Kind::capsule : Shape::Kind::cylinder;
      shape.size = {size[0], 2 * size[1], 0};
      return true;
    case mjGEOM_BOX:
      shape.kind = Shape::Kind::box;
      shape.size = {2 * size[0], 2 * size[1], 2 * size[2]};
      return true;
    case mjGEOM_MESH:
      shape.kind = Shape::Kind::mesh;
      shape.size = {1, 1, 1};
      shape.pose = {};
      add_mesh(shape, m, m.geom_dataid[geom], place, quat);
      return !shape.indices.empty();
    case mjGEOM_HFIELD:
      shape.kind = Shape::Kind::heightmap;
      shape.pose = {};
      add_heightmap(shape, m, m.geom_dataid[geom], place, quat);
      return true;
    default:
      return false;
  }
}

std::vector<scene::Shape> visuals_of(const mjModel& m, int body) {
  const int begin = m.body_geomadr[body], end = begin + m.body_geomnum[body];
  const auto collides = [&](int g) { return m.geom_contype[g] != 0 || m.geom_conaffinity[g] != 0; };
  bool some_only_show = false;
  for (int g = begin; g < end; ++g) some_only_show = some_only_show || !collides(g);
  std::vector<Shape> out;
  for (int g = begin; g < end; ++g) {
    if (some_only_show && collides(g)) continue;
    Shape shape;
    if (!show(m, g, shape)) continue;
    const int material = m.geom_matid[g];
    std::copy_n(material >= 0 ? m.mat_rgba + 4 * material : m.geom_rgba + 4 * g, 4, shape.rgba.begin());
    out.push_back(std::move(shape));
  }
  return out;
}

}  // namespace vsa::physics
