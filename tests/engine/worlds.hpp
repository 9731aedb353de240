// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Small SDF worlds for tests.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "vsa/engine/world.hpp"

namespace vsa::engine::testing {

inline constexpr double kGravity = 9.81;

inline std::string world(const std::string& content, const std::string& gravity = "0 0 -9.81") {
  return "<?xml version='1.0'?><sdf version='1.9'><world name='test'><gravity>" + gravity + "</gravity>" + content +
         "</world></sdf>";
}

inline std::string inertial(double mass, double moment, const std::string& pose = "0 0 0 0 0 0") {
  const std::string i = std::to_string(moment);
  return "<inertial><pose>" + pose + "</pose><mass>" + std::to_string(mass) + "</mass><inertia><ixx>" + i + "</ixx><iyy>" + i +
         "</iyy><izz>" + i + "</izz></inertia></inertial>";
}

inline std::string friction(double mu) {
  const std::string m = std::to_string(mu);
  return "<surface><friction><ode><mu>" + m + "</mu><mu2>" + m + "</mu2></ode></friction></surface>";
}

inline std::string ground(double mu = 1.0) {
  return "<model name='ground'><static>true</static><link name='l'><collision name='c'><geometry><plane><normal>0 0 1</normal>"
         "<size>10 10</size></plane></geometry>" +
         friction(mu) + "</collision></link></model>";
}

/// Everything wrong with a world, as one text.
inline std::string problems_of(const std::string& sdf, WorldOptions options = {}) {
  try {
    static_cast<void>(World::load_string(sdf, std::move(options)));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

inline Pose pose_of(const World& w, const std::string& link) {
  std::vector<Pose> poses(w.links().size());
  w.poses(poses);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (w.links()[i].name == link) return poses[i];
  }
  ADD_FAILURE() << "no link " << link;
  return {};
}

/// A directory of its own, gone afterwards.
class TempDir {
 public:
  explicit TempDir(const std::string& name) {
    std::string made = (std::filesystem::temp_directory_path() / ("vsa_engine_" + name + "_XXXXXX")).string();
    if (::mkdtemp(made.data()) == nullptr) throw std::runtime_error("no temporary directory");
    path_ = made;
  }
  ~TempDir() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempDir(const TempDir&) = delete;
  TempDir& operator=(const TempDir&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace vsa::engine::testing
