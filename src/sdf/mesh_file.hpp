// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Triangle meshes: STL (binary and text), Wavefront OBJ (vertices and faces; polygons as fans) and COLLADA.
#pragma once

#include <filesystem>

#include "sdf/description.hpp"
#include "vsa/errors.hpp"

namespace vsa::reader {

inline constexpr const char* kMeshFormats = ".stl, .obj, .dae";

[[nodiscard]] bool mesh_format_known(const std::filesystem::path& file);
/// Throws InputError where the file can't be read or holds no triangle.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& file, const Vec3& scale);

/// Why the mesh isn't the surface of one convex body; empty where it is.
///   no vertex in front of any face (tolerance: 1e-4 of the mesh's size)
///   closed: Σ n A = 0 and Σ ∫ x nᵀ dA = V·1, which hold for every closed surface (Gauss) and fail where faces are missing
[[nodiscard]] std::string not_convex(const Mesh& mesh);

/// Convex parts that together make the mesh, but for hollows of some 1 % of its size. Throws InputError where that can't be done.
[[nodiscard]] std::vector<Mesh> decompose(const Mesh& mesh);
[[nodiscard]] double volume(const Mesh& mesh);  ///< m³, of a closed mesh

[[nodiscard]] Mesh read_collada(const std::filesystem::path& file);

}  // namespace vsa::reader
