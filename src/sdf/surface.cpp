// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/read_context.hpp"
#include "sdf/surface_rules.hpp"

namespace vsa::reader {

Surface read_surface(ReadContext& c, const sdf::ElementPtr& collision, const std::string& key) {
  return SurfaceRules<ReadContext>(c).read(collision, key);
}

}  // namespace vsa::reader
