// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Each experiment as a page, and as a table in Markdown for the docs.
#pragma once

#include <string>
#include <vector>

#include "gripper.hpp"
#include "impact.hpp"
#include "terrain.hpp"
#include "throwing.hpp"
#include "vsa/report/report.hpp"

namespace vsa::stiffness_uses {

struct Page {
  report::Report report;
  std::string markdown;  ///< its tables
};

[[nodiscard]] Page impact_page(const std::vector<ImpactRun>& runs);
[[nodiscard]] Page gripper_page(const std::vector<GripRun>& runs);
/// sweeps: one a preset.
[[nodiscard]] Page throw_page(const std::vector<std::vector<ThrowRun>>& sweeps, const std::vector<ThrowRun>& traces);
[[nodiscard]] Page terrain_page(const std::vector<TerrainRun>& runs, double duration_s);

}  // namespace vsa::stiffness_uses
