// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The table of robot files: what each of tests/sdf/robot_files must come to.
#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace vsa::engine::testing {

struct Place {
  std::string link;
  double x = 0, y = 0, z = 0;
};

/// A robot file and its outcome: refused with a phrase, or loaded with exactly these links, these joints with one axis at these
/// positions, and these warnings and no others but that effort and velocity aren't enforced.
struct RobotFile {
  std::string file;
  std::optional<std::string> refused{};
  std::vector<std::string> links{};
  std::vector<std::pair<std::string, double>> joints{};
  std::vector<std::string> warnings{};
  std::vector<std::pair<std::string, double>> set{};  ///< joints, before the look at places
  std::vector<Place> places{};
};

// NOLINTNEXTLINE(readability-identifier-naming): GoogleTest calls it so
inline void PrintTo(const RobotFile& row, std::ostream* out) { *out << row.file; }

[[nodiscard]] std::vector<RobotFile> refused_files();
[[nodiscard]] std::vector<RobotFile> sdf_files();
[[nodiscard]] std::vector<RobotFile> urdf_files();

}  // namespace vsa::engine::testing
