// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Laws from shared libraries of users (vsa/elastic/law_module.hpp).
#pragma once

#include <filesystem>
#include <vector>

#include "vsa/elastic/law.hpp"
#include "vsa/errors.hpp"

namespace vsa::config {

struct ForeignLaw {
  const elastic::Law* law;
  std::filesystem::path file;
};

/// Those of $VSA_LAW_PATH: directories, of which each *.so counts, and files, separated by colons. A library stays loaded for as
/// long as the process lives, and is loaded once, whoever asks; what couldn't be loaded is tried again. From any thread.
[[nodiscard]] std::vector<ForeignLaw> laws_of_path(Problems& problems);

}  // namespace vsa::config
