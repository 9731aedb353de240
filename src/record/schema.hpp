// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// JSON schemas put together from smaller ones.
#pragma once

#include <string_view>

#include "vsa/page/json.hpp"

namespace vsa::record::schema {

using page::Json;

[[nodiscard]] inline Json described(Json schema, std::string_view description) {
  if (!description.empty()) schema["description"] = description;
  return schema;
}

[[nodiscard]] inline Json of_type(std::string_view type, std::string_view description = {}) {
  return described({{"type", type}}, description);
}

[[nodiscard]] inline Json object(std::string_view title, const Json& fields) {
  return {{"title", title}, {"type", "object"}, {"properties", fields}};
}

[[nodiscard]] inline Json array_of(const Json& items, std::string_view description = {}) {
  return described({{"type", "array"}, {"items", items}}, description);
}

}  // namespace vsa::record::schema
