// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The CMake package adds this file to programs that link vsa::config, so that they find the data of the installation they were
// built with: the library itself can't know where it will be installed.
#include "vsa/config/installed.hpp"

namespace {

[[maybe_unused]] const bool told = [] {
  vsa::config::installed_in(VSA_INSTALLED_DATA_DIR);
  return true;
}();

}  // namespace
