// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Where files named in an SDF or URDF lie. model://NAME/… and package://NAME/… are searched for in this order, the first that has
// it:
//   $SDF_PATH, $GZ_SIM_RESOURCE_PATH, $IGN_GAZEBO_RESOURCE_PATH, $GAZEBO_MODEL_PATH, $GAZEBO_RESOURCE_PATH    DIR/NAME
//   the built-in models, the caller's directories                                                            DIR/NAME
//   $AMENT_PREFIX_PATH, $COLCON_PREFIX_PATH, $CMAKE_PREFIX_PATH      PREFIX/share/NAME, PREFIX/NAME/share/NAME
//   $ROS_PACKAGE_PATH                                                DIR/NAME, DIR itself, or a package NAME up to 3 folders below
//   model://sun and model://ground_plane of our own
// file://… and plain paths are taken from the naming file's directory, then from $GAZEBO_RESOURCE_PATH, then, as Gazebo does, from
// the places of the first two lines.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/sdf/seen_files.hpp"

namespace vsa::reader {

/// Where files are looked for, as the environment gives it now.
struct SearchPath {
  /// Read of the environment once, here; `more`: the caller's own.
  explicit SearchPath(const std::vector<std::filesystem::path>& more);
  [[nodiscard]] bool operator==(const SearchPath&) const = default;

  std::vector<std::filesystem::path> directories,  ///< DIR/NAME is looked for
      prefixes,                                    ///< PREFIX/share/NAME and the like
      packages,                                    ///< $ROS_PACKAGE_PATH
      resources,                                   ///< of plain paths, before `directories`
      last;                                        ///< our own, after all others
};

/// Finds what a description names.
class Finder {
 public:
  /// Where it looks is noted in `seen`, which tells later whether anything has changed.
  Finder(SearchPath path, SeenFiles& seen) : path_(std::move(path)), seen_(seen) {}
  /// Empty where nothing is found.
  [[nodiscard]] std::filesystem::path find(std::string_view uri, const std::filesystem::path& base) const;
  /// For error messages: where it looked.
  [[nodiscard]] std::string searched(std::string_view uri, const std::filesystem::path& base) const;

 private:
  [[nodiscard]] std::filesystem::path in_package(std::string_view name_and_rest) const;
  [[nodiscard]] std::filesystem::path package_below(const std::filesystem::path& root, const std::filesystem::path& name,
                                                    int depth) const;

  SearchPath path_;
  SeenFiles& seen_;
};

}  // namespace vsa::reader
