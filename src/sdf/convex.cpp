// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sdf/mesh_file.hpp"

namespace vsa::reader {
namespace {

constexpr double kFlatness = 1e-4;  // of the mesh's size
constexpr double kClosure = 1e-3;   // of area, of volume

struct Sums {
  Vec3 low, high;
  Vec3 area_vector;  // Σ n A
  Mat3 moment;       // Σ ∫ x nᵀ dA
  double area = 0;
};

Vec3 area_normal(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
  return (mesh.vertices[t[1]] - mesh.vertices[t[0]]).Cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]) * 0.5;
}

Sums add_up(const Mesh& mesh) {
  Sums s;
  s.low = s.high = mesh.vertices[mesh.triangles.front()[0]];
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t i : t) {
      s.low.Min(mesh.vertices[i]);
      s.high.Max(mesh.vertices[i]);
    }
  }
  const Vec3 middle = (s.low + s.high) * 0.5;
  for (const auto& t : mesh.triangles) {
    const Vec3 n = area_normal(mesh, t);
    const Vec3 x = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0 - middle;
    s.area_vector += n;
    s.area += n.Length();
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) s.moment(i, j) += x[i] * n[j];
    }
  }
  return s;
}

}  // namespace

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) sum += mesh.vertices[t[0]].Dot(mesh.vertices[t[1]].Cross(mesh.vertices[t[2]])) / 6;
  return sum;
}

std::string not_convex(const Mesh& mesh) {
  const Sums s = add_up(mesh);
  const double size = (s.high - s.low).Length();
  const double volume = (s.moment(0, 0) + s.moment(1, 1) + s.moment(2, 2)) / 3;
  if (std::abs(volume) < 1e-9 * size * size * size) return "the mesh encloses no volume";
  double gap = s.area_vector.Length() / s.area;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) gap = std::max(gap, std::abs(s.moment(i, j) / volume - (i == j ? 1.0 : 0.0)));
  }
  const double outward = volume > 0 ? 1 : -1;
  double front = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 n = area_normal(mesh, t) * outward;
    // Slivers have no direction to speak of; their neighbours cover the place.
    if (n.Length() < 1e-9 * s.area) continue;
    const Vec3 unit = n.Normalized();
    for (const Vec3& v : mesh.vertices) front = std::max(front, unit.Dot(v - mesh.vertices[t[0]]));
  }
  if (front > kFlatness * size)
    return fmt::format("the mesh is concave: a vertex lies {:.3g} m in front of one of its faces", front);
  if (gap > kClosure) return "the mesh isn't closed";
  return {};
}

}  // namespace vsa::reader
