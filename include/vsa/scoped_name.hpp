// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Names of things in things, outermost first: "lab::arm::shaft". A part's own name may be anything but holds no "::".
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vsa {

/// ("lab::arm", "shaft") → "lab::arm::shaft"; ("", "shaft") → "shaft".
[[nodiscard]] std::string scoped_name(std::string_view scope, std::string_view name);
/// "lab::arm::shaft" → "lab::arm"; "shaft" → "".
[[nodiscard]] std::string_view scope_of(std::string_view scoped);
/// "lab::arm::shaft" → "shaft".
[[nodiscard]] std::string_view name_within(std::string_view scoped);
/// "lab::arm::shaft" → "lab".
[[nodiscard]] std::string_view outermost(std::string_view scoped);
/// ("lab", "lab::arm::shaft") → "arm::shaft"; none where it isn't below: ("lab", "lab"), ("la", "lab::arm").
[[nodiscard]] std::optional<std::string_view> relative_to(std::string_view scope, std::string_view scoped);
/// Whether relative_to() finds it.
[[nodiscard]] inline bool is_below(std::string_view scoped, std::string_view scope) {
  return relative_to(scope, scoped).has_value();
}
/// ("lab::arm", "/") → "lab/arm", whatever else it holds: as topics spell it.
[[nodiscard]] std::string joined_by(std::string_view scoped, std::string_view separator);

}  // namespace vsa
