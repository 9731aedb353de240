// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/read_context.hpp"

#include <sdf/Types.hh>

namespace vsa::reader {

sdf::ElementPtr child(const sdf::ElementPtr& element, const std::string& name) {
  return element && element->HasElement(name) ? element->GetElement(name) : nullptr;
}

sdf::ElementPtr ReadContext::child(const sdf::ElementPtr& element, const std::string& name) { return reader::child(element, name); }

std::optional<std::string> ReadContext::attribute(const sdf::ElementPtr& element, const std::string& name) {
  const auto found = element->GetAttribute(name);
  return found ? std::optional(found->GetAsString()) : std::nullopt;
}

std::string ReadContext::file_of(const sdf::ElementPtr& element) const {
  const std::string path = element ? files.original(element->FilePath()) : std::string{};
  return path.empty() || path.front() == '<' || path == "data-string" || path == "urdf file" ? file : path;
}

void ReadContext::problem(const sdf::ElementPtr& element, std::string key, std::string value, std::string message,
                          std::string allowed) {
  problems.add({file_of(element), std::move(key), std::move(value), std::move(message), std::move(allowed)});
}

void ReadContext::cannot(const sdf::ElementPtr& element, std::string key, std::string value, const std::string& what,
                         std::string allowed) {
  engine_cannot(file_of(element), std::move(key), std::move(value), what, std::move(allowed));
}

Pose3 ReadContext::resolve(const sdf::SemanticPose& pose, const std::string& to, const sdf::ElementPtr& element,
                           const std::string& key) {
  SdfPose3 resolved;
  const sdf::Errors errors = pose.Resolve(resolved, to);
  if (!errors.empty()) {
    // A graph that libsdformat couldn't build has its cause among the parser's errors.
    if (parsed_clean) problem(element, key + "/pose", "", errors.front().Message());
    return {};
  }
  if (!resolved.IsFinite()) {
    problem(element, key + "/pose", "", "isn't finite", "finite numbers");
    return {};
  }
  return resolved;
}

double ReadContext::number(const sdf::ElementPtr& element, const std::string& name, double fallback, double min, double max,
                           const std::string& key) {
  const sdf::ElementPtr found = child(element, name);
  if (!found) return fallback;
  return in_range(found->Get<double>(), fallback, min, max, file_of(found), key + "/" + name);
}

}  // namespace vsa::reader
