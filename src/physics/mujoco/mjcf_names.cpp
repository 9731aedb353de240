// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "physics/mujoco/mjcf.hpp"

namespace vsa::physics {

std::string MjcfNames::body(std::size_t link) const { return own ? world.links[link].name : fmt::format("b{}", link); }

std::string MjcfNames::joint(std::size_t joint, std::size_t axis) const {
  if (!own) return fmt::format("j{}_{}", joint, axis);
  return world.joints[joint].name + (axis == 0 ? "" : "/2");
}

std::string MjcfNames::free_joint(std::size_t link) const {
  return own ? world.links[link].name + "/free" : fmt::format("f{}", link);
}

std::string MjcfNames::geom(std::size_t link, std::size_t collision) const {
  if (!own) return fmt::format("g{}_{}", link, collision);
  // Convex parts of one mesh share their collision's name.
  const std::vector<Collision>& all = world.links[link].collisions;
  const bool again = collision > 0 && all[collision - 1].name == all[collision].name;
  return all[collision].name + (again ? fmt::format("/{}", collision) : "");
}

std::string MjcfNames::part(std::size_t link, std::size_t collision) const {
  return own ? geom(link, collision) : fmt::format("b{}_{}", link, collision);
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\n':
        out += "&#10;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace vsa::physics
