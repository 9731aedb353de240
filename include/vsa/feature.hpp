// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a build may lack because the system that it was made on lacks the library (cmake/features.cmake).
#pragma once

#include <string>
#include <string_view>

namespace vsa {

/// A part of vsasim that needs a library of the system.
struct Feature {
  std::string_view name;      ///< "reader of SDF", "topics"
  std::string_view found_as;  ///< the library with its version; empty: the feature is left out
  std::string_view remedy;    ///< what would bring it, a line

  [[nodiscard]] bool is_in() const { return !found_as.empty(); }  ///< whether the library was there
  /// "this build has no topics: install …"
  [[nodiscard]] std::string missing() const { return "this build has no " + std::string(name) + ": " + std::string(remedy); }
};

}  // namespace vsa
