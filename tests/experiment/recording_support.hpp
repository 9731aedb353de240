// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Files in a directory that is gone when the test ends, and the problems that a call throws.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "vsa/errors.hpp"

namespace vsa::test {

inline std::filesystem::path recordings() { return std::filesystem::path(VSA_SOURCE_DIR) / "data" / "qbmove_maker_pro"; }

class Files {
 public:
  explicit Files(const std::string& name)
      : path_(std::filesystem::path(VSA_BINARY_DIR) / ("test_recording_" + std::to_string(getpid())) / name) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Files() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
    std::filesystem::remove(path_.parent_path(), error);  // once it is empty
  }
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// What a call throws as InputError, as text; empty if it doesn't throw.
template <typename Call>
std::vector<std::string> problems(Call&& call) {
  std::vector<std::string> out;
  try {
    call();
  } catch (const InputError& error) {
    for (const Problem& p : error.problems()) out.push_back(p.text());
  }
  return out;
}

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace vsa::test
