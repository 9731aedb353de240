// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/files.hpp"

#include <cerrno>
#include <fstream>
#include <iterator>

namespace vsa {

std::optional<std::string> read_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  const bool absent = status.type() == std::filesystem::file_type::not_found;
  errno = absent ? ENOENT : error ? error.value() : std::filesystem::is_directory(status) ? EISDIR : EINVAL;
  if (!std::filesystem::is_regular_file(status)) return std::nullopt;
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) return std::nullopt;
  return text;
}

}  // namespace vsa
