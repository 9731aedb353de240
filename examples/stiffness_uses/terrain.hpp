// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The snake over its grounds at three presets: speed, cost of transport, contact force.
//
//   speed                path of the centre of mass, averaged over gait periods, per time
//   cost of transport    energy from the supply / (m g · net way): 1 means that it could have lifted itself by that way
//   contact force        the 99th percentile over time of the largest force at one place, and the peak
#pragma once

#include <string>
#include <vector>

namespace vsa::stiffness_uses {

struct TerrainRun {
  std::string ground, gait;
  int start = 0;
  double preset_deg = 0;  ///< of the gait's first group
  double path_m = 0, net_m = 0, speed_m_per_s = 0, net_speed_m_per_s = 0;
  double supply_J = 0, cost_of_transport = 0;
  double force_peak_N = 0, force_99_N = 0;
};

struct TerrainPlan {
  std::string ground = "flat";   ///< flat, rubble, hills
  std::string gait = "steered";  ///< a built-in gait
  int start = 0, starts = 1;     ///< start k of n differs by its yaw, −2° … +2°
  double duration_s = 30;
};

[[nodiscard]] TerrainRun run_terrain(const TerrainPlan& plan);

/// As many at a time as there are jobs; results in the plans' order.
[[nodiscard]] std::vector<TerrainRun> run_terrains(const std::vector<TerrainPlan>& plans, int jobs);

}  // namespace vsa::stiffness_uses
