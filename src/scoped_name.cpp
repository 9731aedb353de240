// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/scoped_name.hpp"

namespace vsa {
namespace {

constexpr std::string_view kSeparator = "::";

}  // namespace

std::string scoped_name(std::string_view scope, std::string_view name) {
  std::string out(scope);
  if (!scope.empty()) out += kSeparator;
  return out += name;
}

std::string_view scope_of(std::string_view scoped) {
  const std::size_t at = scoped.rfind(kSeparator);
  return at == std::string_view::npos ? std::string_view{} : scoped.substr(0, at);
}

std::string_view name_within(std::string_view scoped) {
  const std::size_t at = scoped.rfind(kSeparator);
  return at == std::string_view::npos ? scoped : scoped.substr(at + kSeparator.size());
}

std::string_view outermost(std::string_view scoped) { return scoped.substr(0, scoped.find(kSeparator)); }

std::optional<std::string_view> relative_to(std::string_view scope, std::string_view scoped) {
  for (const std::string_view part : {scope, kSeparator}) {
    if (scoped.substr(0, part.size()) != part) return std::nullopt;
    scoped.remove_prefix(part.size());
  }
  return scoped;
}

std::string joined_by(std::string_view scoped, std::string_view separator) {
  std::string out;
  for (std::size_t at = scoped.find(kSeparator); at != std::string_view::npos; at = scoped.find(kSeparator)) {
    out.append(scoped.substr(0, at)).append(separator);
    scoped.remove_prefix(at + kSeparator.size());
  }
  return out.append(scoped);
}

}  // namespace vsa
