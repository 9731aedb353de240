// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Heightmap images, read as Gazebo reads them: the picture lies as seen from above with its top row at the largest y, and the
// brightest pixel has the full height: h = size.z · pixel/brightest.
// Formats: PGM and PNG (8 or 16 bits; a colour's red counts).
#pragma once

#include <filesystem>

#include "sdf/description.hpp"
#include "vsa/errors.hpp"

namespace vsa::reader {

inline constexpr const char* kImageFormats = "PGM, PNG (8 or 16 bits)";

struct GreyImage {
  std::size_t width = 0, height = 0;
  std::vector<unsigned> pixels;  ///< top row first
};

/// Throws InputError.
[[nodiscard]] GreyImage read_grey_image(const std::filesystem::path& file);
[[nodiscard]] Heightmap read_heightmap(const std::filesystem::path& file, const Vec3& size, const Vec3& centre);

}  // namespace vsa::reader
