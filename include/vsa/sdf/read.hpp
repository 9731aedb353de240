// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// SDF 1.6 … 1.12 and URDF → description::World; in a build without libsdformat URDF alone, and of an SDF what would bring its reader.
//
// What the engine that asks can't honour (its Capabilities) is a problem, and so is what no description can say but physics depends
// on; what doesn't touch the physics (sensors, foreign plugins) is a warning, once a kind. A file with a model and no world becomes
// that model in a world of SDF's defaults.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/description/capabilities.hpp"
#include "vsa/description/world.hpp"
#include "vsa/errors.hpp"
#include "vsa/sdf/concave.hpp"
#include "vsa/sdf/finder.hpp"
#include "vsa/sdf/impossible_inertia.hpp"

namespace vsa::reader {

/// For which engine a file is read, and what becomes of what it would take for something else.
struct ReadOptions {
  description::Capabilities engine;                                  ///< that the description is for
  Concave concave = Concave::refuse;                                 ///< what becomes of meshes that aren't convex
  ImpossibleInertia impossible_inertia = ImpossibleInertia::refuse;  ///< what becomes of inertias that no body can have
};

/// A file, or a text of one.
struct SdfSource {
  std::filesystem::path path;                                                                    ///< read from here; empty: `text`
  std::string_view text;                                                                         ///< counts where there is no path
  [[nodiscard]] std::string label() const { return path.empty() ? "SDF text" : path.string(); }  ///< for problems
};

/// Everything wrong goes to `problems`; the description is complete only where nothing was. What is read
/// goes to `seen`, the finder's. One call at a time in a process: libsdformat and urdfdom keep global state while they read.
[[nodiscard]] description::World read_sdf(const SdfSource& source, const ReadOptions& options, const Finder& finder,
                                          SeenFiles& seen, std::vector<std::string>& warnings, Problems& problems);

}  // namespace vsa::reader
