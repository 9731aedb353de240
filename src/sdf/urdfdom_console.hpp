// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <urdf_model/model.h>

#include <memory>
#include <string>
#include <vector>

namespace vsa::reader {

/// What urdfdom says while it reads.
struct UrdfMessage {
  bool error = false;
  std::string text;
};

/// Null where urdfdom can't read it. Nothing reaches the console.
[[nodiscard]] std::shared_ptr<urdf::ModelInterface> parse_urdf(const std::string& xml, std::vector<UrdfMessage>& said);

}  // namespace vsa::reader
