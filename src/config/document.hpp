// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A type's file as written: its form is checked, its meaning is not. Keeps toml++ in one source file.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vsa/config/evidence.hpp"
#include "vsa/config/stated.hpp"
#include "vsa/errors.hpp"

namespace vsa::config {

using Scalar = std::variant<std::monostate, double, std::int64_t, bool, std::string>;

/// One parameter: key = { value, unit, bounds, source }.
struct Item {
  std::string key;  ///< "drive.friction_Nm"
  int line = 0;
  std::string file;  ///< the base's, where it stands there; empty: this document's
  Scalar value;
  std::optional<std::string> unit;
  std::optional<std::array<double, 2>> bounds;
  std::string source;
};

struct Document {
  std::string file;
  std::string name, title, description, law, rank;
  std::string base;        ///< a type that has whatever this one hasn't
  std::string controller;  ///< control.kind; empty: the file doesn't say
  int law_line = 0, base_line = 0, controller_line = 0;
  std::optional<Evidence> evidence;
  std::optional<Stated> mass_kg;
  std::vector<Item> items;
  std::vector<std::string> notices;
  /// Keys whose form is wrong, so that they are not reported as missing as well.
  std::vector<std::string> broken;
  bool readable = false;  ///< false: not TOML at all; nothing else holds

  /// "file:line", or "file" for line 0.
  [[nodiscard]] std::string place(int line) const;
  [[nodiscard]] std::string place(const Item& item) const;
};

/// As the user would recognise it: 0.5, "text", true.
[[nodiscard]] std::string scalar_text(const Scalar& value);

[[nodiscard]] Document read_document(std::string_view text, std::string file, Problems& problems);

/// Gives `to` what it lacks of `base`: all keys, but of another law's neither its own nor limits.preset_max, of another controller's
/// neither control.… nor firmware.…, nor the preset of a torque servo, which is its own.
void inherit(Document& to, const Document& base);

}  // namespace vsa::config
