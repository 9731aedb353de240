// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "vsa/config/older_plugin.hpp"
#include "vsa/config/plugin_xml.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::reader {
namespace {

constexpr std::array<std::pair<Joint::Kind, const char*>, 5> kTypes{{{Joint::Kind::fixed, "fixed"},
                                                                     {Joint::Kind::hinge, "revolute, continuous"},
                                                                     {Joint::Kind::slide, "prismatic"},
                                                                     {Joint::Kind::ball, "ball"},
                                                                     {Joint::Kind::universal, "universal"}}};

enum class Looks { like_xml, empty, otherwise };

/// Like XML: there is a '<', whatever the encoding. So does a file that can't be read: its reader says why.
Looks look_of(std::istream& in) {
  Looks out = Looks::empty;
  if (!in) return Looks::like_xml;
  for (int c = in.get(); c != EOF; c = in.get()) {
    if (c == '<') return Looks::like_xml;
    if (c != ' ' && c != '\t' && c != '\r' && c != '\n') out = Looks::otherwise;
  }
  return out;
}

Looks look_of(const SdfSource& source) {
  if (source.path.empty()) {
    std::istringstream text{std::string(source.text)};
    return look_of(text);
  }
  std::ifstream file(source.path, std::ios::binary);
  return look_of(file);
}

}  // namespace

void Reading::engine_cannot(const std::string& in, std::string key, std::string value, const std::string& what,
                            std::string allowed) {
  problems.add({in, std::move(key), std::move(value), fmt::format("{} supported by {}", what, engine.engine), std::move(allowed)});
}

double Reading::in_range(double value, double fallback, double min, double max, const std::string& in, const std::string& key) {
  if (std::isfinite(value) && value >= min && value <= max) return value;
  const std::string allowed = max == kInfinite ? fmt::format("finite, ≥ {}", min) : fmt::format("{} … {}", min, max);
  problems.add({in, key, fmt::format("{}", value), "out of range", allowed});
  return fallback;
}

bool is_there(const SdfSource& source, Problems& problems) {
  std::error_code ignored;
  if (!source.path.empty() && !std::filesystem::is_regular_file(source.path, ignored)) {
    problems.add({source.path.string(), "", "", "no such file", "an SDF or URDF file"});
    return false;
  }
  const Looks looks = look_of(source);
  if (looks == Looks::like_xml) return true;
  problems.add({source.label(), "", "", looks == Looks::empty ? "is empty" : "isn't XML", "an SDF or URDF file"});
  return false;
}

void take_plugin(Reading& r, const PluginElement& plugin, const ModelScope& scope) {
  const std::string key = scope.name + "/plugin[" + plugin.name + "]";
  if (plugin.name != config::kPluginName) {
    const bool older = config::is_older_plugin(plugin.text);
    if (!older && plugin.library.find("vsa-robot") != std::string::npos)
      return r.notes.add(
          fmt::format("a plugin of our library has another name and is left out: did you mean {}?", config::kPluginName), key);
    r.notes.add(older ? "plugins of older actuator toolboxes are left out (vsa doctor WORLD writes them anew)"
                      : "foreign plugins are left out",
                key);
  } else if (scope.is_static) {
    r.problems.add({plugin.file, key, "", "its model is static, so its joints can't move", "a model that isn't static"});
  } else {
    r.out.plugins.push_back({scope.name, scope.top, plugin.text});
    for (const std::string& joint : plugin.joints) r.driven.insert(scoped_name(scope.name, joint));
  }
}

std::string movable(const Capabilities& engine) {
  std::string all;
  for (const auto& [kind, name] : kTypes) all += !engine.takes(kind) ? "" : (all.empty() ? "" : ", ") + std::string(name);
  return all;
}

bool take_range(Reading& r, double lower, double upper, const std::string& in, const std::string& key, Axis& out) {
  if (std::isnan(lower) || std::isnan(upper) || lower > upper) {
    r.problems.add({in, key + "/limit", fmt::format("{} … {}", lower, upper), "isn't a range", "lower ≤ upper"});
    return false;
  }
  if (lower > -kNoLimit || upper < kNoLimit) out.range = {{std::max(lower, -kOpenSide), std::min(upper, kOpenSide)}};
  return true;
}

void tell_of_limit(Reading& r, const char* name, double value, const std::string& key) {
  if (value >= 0 && value < kNoLimit)
    r.notes.add(fmt::format("{} limits of joints aren't enforced (an actuator's physics sets its own)", name), key);
}

void take_collision(Reading& r, const std::string& in, Collision shape, const Geometry& geometry, Link& link) {
  using Kind = Geometry::Kind;
  const bool terrain = geometry.kind == Kind::plane || geometry.kind == Kind::heightmap;
  if (terrain && !link.is_static && !r.engine.moving_terrain) {
    r.problems.add(
        {in, shape.name, geometry.kind == Kind::plane ? "plane" : "heightmap", "can't move", "a model with <static>true</static>"});
    return;
  }
  shape.geometry = geometry;
  if (geometry.parts.empty()) {
    link.collisions.push_back(std::move(shape));
    return;
  }
  shape.geometry.parts.clear();
  for (const auto& part : geometry.parts) {
    shape.geometry.mesh = part;
    link.collisions.push_back(shape);
  }
}

/// As gz-sim has it: a link of the same model.
void find_direction_frames(Reading& r) {
  for (const DirectionFrame& d : r.direction_frames) {
    for (Link& link : r.out.links) {
      for (Collision& shape : link.collisions) {
        if (shape.name != d.collision) continue;
        const std::string name = scoped_name(scope_of(link.name), d.frame);
        const auto it = std::find_if(r.out.links.begin(), r.out.links.end(), [&](const Link& l) { return l.name == name; });
        if (it == r.out.links.end())
          return r.problems.add({d.file, d.key + "/fdir1@expressed_in", d.frame, "no such link in its model", "a link's name"});
        shape.surface.first_of = static_cast<std::size_t>(it - r.out.links.begin());
      }
    }
  }
}

}  // namespace vsa::reader
