// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vsa::reader {

/// Collision meshes that aren't convex, where the engine would fill them to their hulls without a word. A `<mesh>` that says
/// optimization="convex_hull" or "convex_decomposition" has its own way.
enum class Concave {
  refuse,    ///< the world can't be loaded
  hull,      ///< filled to the convex hull, and warned of
  decompose  ///< cut into convex parts (at most 3000 triangles), and warned of
};

}  // namespace vsa::reader
