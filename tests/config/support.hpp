// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the tests of this room share: preset text that is fine, files in a directory of their own, and the problems of a call.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/config/plugin_xml.hpp"

namespace vsa::test {

inline std::filesystem::path source_dir() { return VSA_SOURCE_DIR; }

inline std::string read(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The library of the presets that the project ships.
inline config::TypeLibrary shipped() { return config::TypeLibrary({source_dir() / "actuators"}); }

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "the test's text has no " << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// A directory that is gone when the test ends.
class Directory {
 public:
  explicit Directory(const std::string& name)
      : path_(std::filesystem::path(VSA_BINARY_DIR) / ("test_config_" + std::to_string(getpid())) / name) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Directory() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
    std::filesystem::remove(path_.parent_path(), error);  // once it is empty
  }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The problems that a call throws; none if it doesn't throw. Any other exception fails the test by itself.
template <class Call>
std::vector<Problem> problems_of(Call&& call) {
  try {
    std::forward<Call>(call)();
  } catch (const InputError& error) {
    return error.problems();
  }
  return {};
}

inline std::string text_of(const std::vector<Problem>& problems) {
  std::string all;
  for (const Problem& p : problems) all += p.text() + "\n";
  return all;
}

inline void expect_pieces(const std::string& text, const std::vector<std::string>& pieces) {
  for (const std::string& piece : pieces) EXPECT_NE(text.find(piece), std::string::npos) << "no “" << piece << "” in:\n" << text;
}

}  // namespace vsa::test
