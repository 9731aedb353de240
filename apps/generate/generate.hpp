// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Everything below models/ that is generated: relative path → content.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "description.hpp"
#include "xml.hpp"

namespace vsa::generate {

using Files = std::map<std::string, std::string>;

[[nodiscard]] Files generate(const Description& description);

/// What lies below ros2/ for the robots among generate()'s files: one ros_gz_bridge configuration each.
[[nodiscard]] Files bridges(const Files& models);

// One a kind of file; generate() calls them all.
void add_robots(Files& files, const Description& description);
void add_frank(Files& files, const Description& description);
void add_manipulator(Files& files, const Description& description);
void add_props(Files& files, const Description& description);
void add_terrain(Files& files, const Description& description);
void add_worlds(Files& files, const Description& description);

/// Begins an SDF document: version 1.7 is what Gazebo Classic 11, gz-sim and libsdformat 12 all read.
[[nodiscard]] Xml begin_sdf();
void add_model(Files& files, const std::string& name, const std::string& title, const std::string& sdf);

/// From the hanging arm's plane through its axes to the foremost face of a hand, m.
[[nodiscard]] double hand_front_m(const Description& description);

/// A box of the rubble: centre on the ground, yaw, size.
struct Block {
  double x, y, yaw, length, width, height;
};
[[nodiscard]] std::vector<Block> rubble(const RubbleSpec& spec);

/// The hills' ground above the lowest point, m, rows from +y to −y as in the picture.
struct Hills {
  std::vector<std::uint8_t> pixels;
  double height_m = 0;      ///< of the brightest pixel
  double start_m = 0;       ///< at the centre
  double steepest_rad = 0;  ///< largest slope of the exact ground
};
[[nodiscard]] Hills hills(const HillsSpec& spec);

}  // namespace vsa::generate
