// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/plugin_places.hpp"

#include <string_view>

#include "sdf/xml_place.hpp"
#include "vsa/config/plugin_xml.hpp"

namespace vsa::reader {
namespace {

using tinyxml2::XMLElement;

bool is_ours(const XMLElement& plugin) {
  const char *name = plugin.Attribute("name"), *library = plugin.Attribute("filename");
  return (name != nullptr && name == config::kPluginName) ||
         (library != nullptr && std::string_view(library).find("vsa-robot") != std::string_view::npos);
}

/// What ends in a model; of a <world> its reader speaks.
bool is_of_a_model(const XMLElement& parent) {
  return is(parent, "model") || is(parent, "include") || is(parent, "world") ||
         (is(parent, "gazebo") && parent.Attribute("reference") == nullptr);
}

void check(const XMLElement& parent, bool urdf, const std::string& file, Problems& problems) {
  for (const XMLElement* e = parent.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    if (!is(*e, "plugin")) {
      check(*e, urdf, file, problems);
    } else if (is_ours(*e) && !is_of_a_model(parent)) {
      problems.add({line_of(*e, file), path_of(*e), "", "belongs to a model, and nobody looks for it here",
                    urdf ? "in a <gazebo> without reference" : "in the <model> whose joints it drives"});
    }
  }
}

}  // namespace

void check_plugin_places(const XMLElement& root, const std::string& file, Problems& problems) {
  check(root, is(root, "robot"), file, problems);
}

}  // namespace vsa::reader
