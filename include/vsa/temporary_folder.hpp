// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace vsa {

/// A folder of its own below the system's for temporary files ($TMPDIR, else /tmp), removed with all in it.
class TemporaryFolder {
 public:
  TemporaryFolder();  ///< throws InputError where there can be none: a TMPDIR that isn't there or can't be written
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }  ///< of the folder, which is empty at first

 private:
  std::filesystem::path path_;
};

}  // namespace vsa
