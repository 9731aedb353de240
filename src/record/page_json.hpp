// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "vsa/page/json.hpp"
#include "vsa/record/page.hpp"

namespace vsa::record {

/// The members of the page's JSON object that aren't frames. `first`: poses of the links that don't move (all links' first sample).
[[nodiscard]] page::Json page_header(const RunInfo& info, const PageText& text, const std::vector<scene::Pose>& first);

}  // namespace vsa::record
