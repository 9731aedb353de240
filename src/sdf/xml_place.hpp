// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Where an element of a file is, as messages say it: "arm.urdf:12", "link[a]/inertial".
#pragma once

#include <fmt/format.h>
#include <tinyxml2.h>

#include <string>
#include <string_view>

namespace vsa::reader {

[[nodiscard]] inline bool is(const tinyxml2::XMLElement& e, std::string_view name) { return e.Name() == name; }

/// "m/link[a]/sensor[s]", as far as names go, below the root.
[[nodiscard]] inline std::string path_of(const tinyxml2::XMLElement& e) {
  std::string path;
  for (const tinyxml2::XMLElement* at = &e; at != nullptr && !is(*at, "sdf") && !is(*at, "robot");
       at = at->Parent() == nullptr ? nullptr : at->Parent()->ToElement()) {
    const char* name = at->Attribute("name");
    const std::string part = name == nullptr ? at->Name() : fmt::format("{}[{}]", at->Name(), name);
    path = path.empty() ? part : part + "/" + path;
  }
  return path;
}

/// "arm.urdf:12"
[[nodiscard]] inline std::string line_of(const tinyxml2::XMLNode& node, const std::string& file) {
  return fmt::format("{}:{}", file, node.GetLineNum());
}

/// "arm.urdf:12: link[a]/inertial"
[[nodiscard]] inline std::string place_of(const tinyxml2::XMLElement& e, const std::string& file) {
  const std::string path = path_of(e);
  return path.empty() ? line_of(e, file) : line_of(e, file) + ": " + path;
}

/// The texts among an element's children, comments and elements between them passed over: "0.3", or "0.3 5" of 0.3<!-- kg -->5.
[[nodiscard]] inline std::string texts_of(const tinyxml2::XMLElement& e) {
  std::string all;
  for (const tinyxml2::XMLNode* n = e.FirstChild(); n != nullptr; n = n->NextSibling()) {
    if (n->ToText() == nullptr) continue;
    if (!all.empty()) all += ' ';
    all += n->Value();
  }
  return all;
}

}  // namespace vsa::reader
