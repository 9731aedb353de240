// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/temporary_folder.hpp"

#include <stdlib.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "vsa/errors.hpp"

namespace vsa {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const fs::path below = fs::temp_directory_path(error);
  std::string name = (below / "vsasim-XXXXXX").string();
  if (!error && mkdtemp(name.data()) == nullptr) error = {errno, std::generic_category()};
  if (error) {
    const char* chosen = std::getenv("TMPDIR");
    throw InputError({"", "TMPDIR", chosen == nullptr ? below.string() : chosen, "no folder can be made there: " + error.message(),
                      "a folder that can be written"});
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace vsa
