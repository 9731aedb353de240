// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "terminal/output_files.hpp"

#include <system_error>

#include "vsa/errors.hpp"

namespace vsa::app {
namespace fs = std::filesystem;

void make_directory(const fs::path& directory, const std::string& flag) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (!error && fs::is_directory(directory, error)) return;
  const std::string reason = error ? error.message() : "is not a directory";
  throw InputError({"", flag, directory.string(), "can't be made: " + reason, "a directory that can be written to"});
}

}  // namespace vsa::app
