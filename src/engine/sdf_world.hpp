// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// SDF 1.6 … 1.12 and URDF → WorldDescription.
//
// What the engine can't honour is a problem; what doesn't touch the physics (sensors, foreign plugins) is
// a warning, once a kind. A file with a model and no world becomes that model in a world of SDF's defaults.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "description.hpp"
#include "finder.hpp"

namespace vsa::engine {

struct SdfSource {
  std::filesystem::path path;  ///< read from here; empty: `text`
  std::string_view text;
  [[nodiscard]] std::string label() const { return path.empty() ? "SDF text" : path.string(); }
};

/// Everything wrong goes to `problems`; the description is complete only where nothing was. Of the options only `concave` counts.
/// What is read goes to `seen`, the finder's. One call at a time: world_cache.hpp sees to that.
[[nodiscard]] WorldDescription read_sdf(const SdfSource& source, const WorldOptions& options, const Finder& finder, SeenFiles& seen,
                                        std::vector<std::string>& warnings, Problems& problems);

}  // namespace vsa::engine
