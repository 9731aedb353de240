// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Where files named in an SDF lie. model://NAME/… is searched in $SDF_PATH, $IGN_GAZEBO_RESOURCE_PATH, the built-in models and the
// caller's directories, in this order; file:// and plain paths are taken from the naming file's directory.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vsa::engine {

class Finder {
 public:
  explicit Finder(const std::vector<std::filesystem::path>& more);
  /// Empty where nothing is found.
  [[nodiscard]] std::filesystem::path find(std::string_view uri, const std::filesystem::path& base) const;
  [[nodiscard]] std::string searched() const;  ///< for error messages

 private:
  std::vector<std::filesystem::path> directories_;
};

}  // namespace vsa::engine
