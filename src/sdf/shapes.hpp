// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A shape while it is read, whoever reads it. Visuals that can't be shown are only left out; collisions are refused.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "sdf/reading.hpp"

namespace vsa::reader {

struct ShapeReading {
  Reading& reading;
  std::string file, key;  ///< for problems; the key is the collision's or visual's
  bool collides = false;

  std::nullopt_t refuse(const std::string& name, const std::string& value, const std::string& message, const std::string& allowed);
  /// Whose first `used` lengths are to be positive.
  std::optional<Geometry> sized(Geometry::Kind kind, const Vec3& size, int used, const char* name);
  /// Of the file `found`, which the description calls `uri`; `wish`: where it collides and isn't convex.
  std::optional<Geometry> mesh(const std::filesystem::path& found, const std::string& uri, const Vec3& scale, Concave wish);

 private:
  std::optional<Geometry> make_convex(const std::string& uri, Geometry g, const std::string& why, Concave wish);
};

/// The kinds that the engine takes, in words.
[[nodiscard]] std::string collidable(const Capabilities& engine);
/// "box"
[[nodiscard]] std::string name_of(Geometry::Kind kind);
/// How it is shown: `at` in its link.
[[nodiscard]] scene::Shape to_shape(const Geometry& geometry, const Pose3& at);

}  // namespace vsa::reader
