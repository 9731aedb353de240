// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/identify/type_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::identify {
namespace {

/// A basic TOML string. What isn't allowed in one is written as an escape.
std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string entry_text(const config::Entry& e, const Identified* change) {
  const bool word = e.kind == config::Kind::word || e.kind == config::Kind::file;
  const std::string value = change != nullptr ? config::number_text(change->value) : word ? toml_string(e.value) : e.value;
  const std::string source = toml_string(change != nullptr ? change->source : e.source);
  const std::string name = e.key.substr(e.key.find('.') + 1);
  if (e.unit.empty()) return fmt::format("{} = {{ value = {}, source = {} }}\n", name, value, source);
  return fmt::format("{} = {{ value = {}, unit = {}, bounds = [{}, {}], source = {} }}\n", name, value, toml_string(e.unit),
                     config::number_text(e.min), config::number_text(e.max), source);
}

std::string evidence_text(const config::Evidence& e) {
  std::vector<std::string> names;
  for (const std::string& n : e.calibrated_on) names.push_back(toml_string(n));
  return fmt::format("\n[evidence]\ncalibrated_on = {{ value = [{}], source = {} }}\n", config::join(names), toml_string(e.source));
}

}  // namespace

config::Evidence evidence_with(const std::optional<config::Evidence>& before, const config::Evidence& fitted) {
  if (!before) return {fitted.calibrated_on, fitted.source + "; the type that it began from doesn't say what it was calibrated on"};
  if (before->calibrated_on.empty()) return fitted;
  config::Evidence out = *before;
  if (out.source.find(fitted.source) == std::string::npos) out.source += "; " + fitted.source;
  for (const std::string& name : fitted.calibrated_on) {
    if (std::find(out.calibrated_on.begin(), out.calibrated_on.end(), name) == out.calibrated_on.end())
      out.calibrated_on.push_back(name);
  }
  return out;
}

std::string type_text(const config::ActuatorType& type, const std::string& name, const std::vector<Identified>& changes,
                      const config::Evidence& fitted, const config::TypeLibrary& library) {
  std::vector<std::string> groups{"elastic"};
  if (type.controller != "qbmove") groups.emplace_back("control");
  std::map<std::string, std::string> body;
  for (const config::Entry& e : type.entries) {
    const std::string group = e.key.substr(0, e.key.find('.'));
    if (std::find(groups.begin(), groups.end(), group) == groups.end()) groups.push_back(group);
    const auto it = std::find_if(changes.begin(), changes.end(), [&](const Identified& c) { return c.key == e.key; });
    body[group] += entry_text(e, it == changes.end() ? nullptr : &*it);
  }
  std::string out = "# Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0\n\n[type]\n";
  out += fmt::format("name = {}\ntitle = {}\n", toml_string(name), toml_string(name + ", identified from " + type.name));
  if (!type.description.empty()) out += fmt::format("description = {}\n", toml_string(type.description));
  out += evidence_text(evidence_with(type.evidence, fitted));
  for (const std::string& group : groups) {
    out += fmt::format("\n[{}]\n", group);
    if (group == "elastic") out += fmt::format("law = {}\n", toml_string(type.law));
    if (group == "control") out += fmt::format("kind = {}\n", toml_string(type.controller));
    out += body[group];
  }
  (void)library.load_text(out, name + ".toml");
  return out;
}

}  // namespace vsa::identify
