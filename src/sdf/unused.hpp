// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What of a <joint> or <collision> no reader has a use for, of whatever element tree: told of, but where it says what SDF has anyway.
// The readers know what they use, so that is listed, and all else is told.
//
// The context C is a Reading that knows its elements: C::Element, and children(e), name(e), says_something(e).
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "sdf/reading.hpp"
#include "vsa/config/text.hpp"

namespace vsa::reader {

struct Used {
  std::string_view path, children;  ///< what is used of it, refused, or has a word of its own
  bool springs = false;             ///< without an engine that has such there is one word for all of it
};

/// Of what isn't here all is used.
inline constexpr std::array<Used, 7> kUsed{
    {{"joint", "parent child pose axis axis2 sensor physics"},
     {"collision", "pose geometry surface"},
     {"collision/surface/bounce", "restitution_coefficient"},
     {"collision/surface/friction/torsional", "coefficient patch_radius use_patch_radius ode"},
     {"collision/surface/contact", "collide_without_contact collide_bitmask category_bitmask ode bullet"},
     {"collision/surface/contact/ode", "kp kd", true},
     {"collision/surface/contact/bullet", "kp kd", true}}};

/// `path`: from the <joint> or <collision> on.
template <class C>
void tell_unused(C& c, const typename C::Element& e, const std::string& key, const std::string& path) {
  const auto* const used = std::find_if(kUsed.begin(), kUsed.end(), [&](const Used& u) { return u.path == path; });
  const bool all = used == kUsed.end();
  if (!all && used->springs && !c.engine.contact_springs) return;
  const std::vector<std::string> known = all ? std::vector<std::string>() : config::split(used->children, ' ');
  for (const auto& k : c.children(e)) {
    const std::string name = c.name(k);
    if (name.find(':') != std::string::npos) continue;  // others' extensions, and our own marks
    if (all || std::find(known.begin(), known.end(), name) != known.end()) {
      tell_unused(c, k, key + "/" + name, path + "/" + name);
    } else if (c.says_something(k)) {
      c.notes.add(fmt::format("<{}> of a <{}> is left out", name, c.name(e)), key);
    }
  }
}

}  // namespace vsa::reader
