// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/owner.hpp"

#include <cstdio>
#include <cstdlib>

namespace vsa {

void broken_promise(const char* where, const char* what) noexcept {
  std::fprintf(stderr, "%s: %s\n", where, what);
  std::abort();
}

}  // namespace vsa
