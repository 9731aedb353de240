// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/read_context.hpp"

#include <algorithm>
#include <sdf/Types.hh>
#include <sstream>

#include "vsa/config/text.hpp"

namespace vsa::reader {
namespace {

/// "0.0" for "0", too.
bool same_value(const std::string& a, const std::string& b) {
  std::istringstream in_a(a), in_b(b);
  for (std::string x, y;;) {
    const bool more = static_cast<bool>(in_a >> x);
    if (more != static_cast<bool>(in_b >> y)) return false;
    if (!more) return true;
    const auto value = config::parse_number(x);
    if (value ? value != config::parse_number(y) : x != y) return false;
  }
}

}  // namespace

sdf::ElementPtr child(const sdf::ElementPtr& element, const std::string& name) {
  return element && element->HasElement(name) ? element->GetElement(name) : nullptr;
}

sdf::ElementPtr ReadContext::child(const sdf::ElementPtr& element, const std::string& name) { return reader::child(element, name); }

std::optional<std::string> ReadContext::attribute(const sdf::ElementPtr& element, const std::string& name) {
  const auto found = element->GetAttribute(name);
  return found ? std::optional(found->GetAsString()) : std::nullopt;
}

std::vector<sdf::ElementPtr> ReadContext::children(const sdf::ElementPtr& element) {
  std::vector<sdf::ElementPtr> out;
  for (sdf::ElementPtr e = element->GetFirstElement(); e; e = e->GetNextElement()) out.push_back(e);
  return out;
}

bool ReadContext::says_something(const sdf::ElementPtr& element) {
  if (const sdf::ParamPtr value = element->GetValue())  // libsdformat adds what it thinks a <limit> needs
    return element->GetExplicitlySetInFile() && !same_value(value->GetAsString(), value->GetDefaultAsString());
  const std::vector<sdf::ElementPtr> all = children(element);
  return std::any_of(all.begin(), all.end(), says_something);
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
