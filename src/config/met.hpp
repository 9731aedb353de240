// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace vsa::config {

/// Adds the notice to those of what is being read, and tells whoever listens (vsa/config/notices.hpp).
void met_old_spelling(std::string notice, std::vector<std::string>& notices);

}  // namespace vsa::config
