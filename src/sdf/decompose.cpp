// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Convex parts of a concave mesh, by Khaled Mamou's HACD (hierarchical approximate convex decomposition) as Bullet packages it:
// triangles are joined to clusters until a cluster's convex hull would lie more than kConcavity of the mesh's size in front of it.
#include <fmt/format.h>
#include <hacdHACD.h>

#include <cmath>

#include "sdf/mesh_file.hpp"

namespace vsa::reader {
namespace {

constexpr double kScale = 1000, kConcavity = 0.01;  // HACD measures a mesh scaled to this size
constexpr double kConnect = 0.03;                   // parts of a mesh nearer than this, of its size, are one body
constexpr std::size_t kMostTriangles = 3000;        // the time grows with their square: some seconds
constexpr std::size_t kMostVertices = 64;           // of a part

using Points = std::vector<HACD::Vec3<HACD::Real>>;
using Triangles = std::vector<HACD::Vec3<long>>;

Mesh part_of(HACD::HACD& hacd, std::size_t cluster) {
  Points points(hacd.GetNPointsCH(cluster));
  Triangles triangles(hacd.GetNTrianglesCH(cluster));
  hacd.GetCH(cluster, points.data(), triangles.data());
  Mesh mesh;
  for (const auto& p : points) mesh.vertices.emplace_back(p.X(), p.Y(), p.Z());
  for (const auto& t : triangles) {
    mesh.triangles.push_back(
        {static_cast<std::uint32_t>(t.X()), static_cast<std::uint32_t>(t.Y()), static_cast<std::uint32_t>(t.Z())});
  }
  return mesh;
}

}  // namespace

std::vector<Mesh> decompose(const Mesh& mesh) {
  const auto fail = [](const std::string& why) { throw InputError(Problem{"", "", "", "can't be decomposed: " + why, ""}); };
  if (mesh.triangles.size() > kMostTriangles)
    fail(fmt::format("{} triangles, and at most {} are practical; simplify it", mesh.triangles.size(), kMostTriangles));
  Points points;
  Triangles triangles;
  for (const Vec3& v : mesh.vertices) points.emplace_back(v.X(), v.Y(), v.Z());
  for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  HACD::HACD hacd;
  hacd.SetPoints(points.data());
  hacd.SetNPoints(points.size());
  hacd.SetTriangles(triangles.data());
  hacd.SetNTriangles(triangles.size());
  hacd.SetScaleFactor(kScale);
  hacd.SetConcavity(kConcavity * kScale);
  hacd.SetConnectDist(kConnect * kScale);
  hacd.SetCompacityWeight(1e-4);
  hacd.SetVolumeWeight(0);
  hacd.SetNClusters(1);
  hacd.SetNVerticesPerCH(kMostVertices);
  hacd.SetAddExtraDistPoints(true);
  hacd.SetAddNeighboursDistPoints(true);
  hacd.SetAddFacesPoints(true);
  if (!hacd.Compute() || hacd.GetNClusters() == 0) fail("no parts were found");
  std::vector<Mesh> parts;
  for (std::size_t c = 0; c < hacd.GetNClusters(); ++c) {
    parts.push_back(part_of(hacd, c));
    if (const std::string why = not_convex(parts.back()); !why.empty()) fail("of a part, " + why);
  }
  return parts;
}

}  // namespace vsa::reader
