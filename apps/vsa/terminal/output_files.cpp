// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "terminal/output_files.hpp"

#include <cerrno>
#include <fstream>
#include <stdexcept>
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

void write_whole(const fs::path& file, std::string_view text) {
  const fs::path beside = file.string() + ".part";
  std::error_code error;
  errno = 0;
  std::ofstream out(beside, std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) {
    error.assign(errno != 0 ? errno : EIO, std::generic_category());
  } else {
    fs::rename(beside, file, error);
  }
  if (!error) return;
  std::error_code ignored;
  fs::remove(beside, ignored);
  throw std::runtime_error(file.string() + ": can't be written: " + error.message());
}

}  // namespace vsa::app
