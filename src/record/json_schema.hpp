// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// JSON schemas put together from smaller ones, as texts.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vsa/record/page.hpp"

namespace vsa::record::schema {

using Fields = std::vector<std::pair<std::string_view, std::string>>;  // name, schema

[[nodiscard]] inline std::string of_type(std::string_view type, std::string_view description = {}) {
  std::string out = "{\"type\":" + json_string(type);
  if (!description.empty()) out += ",\"description\":" + json_string(description);
  return out + '}';
}

[[nodiscard]] inline std::string object(std::string_view title, const Fields& fields) {
  std::string out = "{\"title\":" + json_string(title) + ",\"type\":\"object\",\"properties\":{";
  for (const auto& [name, text] : fields) {
    if (out.back() != '{') out += ',';
    out += json_string(name) + ':' + text;
  }
  return out + "}}";
}

[[nodiscard]] inline std::string array_of(const std::string& items, std::string_view description = {}) {
  std::string out = "{\"type\":\"array\",\"items\":" + items;
  if (!description.empty()) out += ",\"description\":" + json_string(description);
  return out + '}';
}

}  // namespace vsa::record::schema
