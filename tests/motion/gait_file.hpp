// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Gait files made up by tests, what is wrong with them, and what they hold.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "../record/scratch.hpp"
#include "vsa/errors.hpp"
#include "vsa/motion/gait.hpp"

namespace vsa::motion {

inline const record::Scratch kOwnDirectory;

/// Keyframes of one actuator.
inline constexpr const char* kGoodMotion = R"(title = "test"
interpolation = "linear"
[[keyframe]]
time_s = 1.0
equilibrium_deg = { shaft = 0.0 }
preset_deg = { shaft = 10.0 }
[[keyframe]]
time_s = 2.0
preset_deg = { shaft = 20.0 }
[[keyframe]]
time_s = 3.0
equilibrium_deg = { shaft = 90.0 }
)";

inline std::filesystem::path written(const std::string& text) {
  std::filesystem::path file = kOwnDirectory.path() / "vsa_gait_test.toml";
  std::ofstream(file) << text;
  return file;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

inline std::string problems_of(const std::filesystem::path& file) {
  try {
    (void)Gait::load(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline const GaitGroup& group(const Gait& gait, const char* name) {
  for (const GaitGroup& g : gait.params().groups) {
    if (g.name == name) return g;
  }
  throw std::runtime_error(std::string("no group ") + name);
}

}  // namespace vsa::motion
