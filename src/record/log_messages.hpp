// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The messages of run.mcap and their schemas, as JSON texts (vsa/record/run_log.hpp says what they are for).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/record/run_data.hpp"

namespace vsa::record {

/// A link by its index and its name as JSON.
struct LogLink {
  std::size_t index = 0;
  std::string name;
};

[[nodiscard]] std::string actuators_schema();
void actuators_message(std::string& out, std::int64_t time_ns, const RobotInfo& robot,
                       std::span<const host::ActuatorReading> readings);

[[nodiscard]] std::string energy_schema();
void energy_message(std::string& out, const Sample& sample);

[[nodiscard]] std::string transforms_schema();
void transforms_message(std::string& out, std::int64_t time_ns, const std::vector<LogLink>& links,
                        const std::vector<scene::Pose>& poses);

[[nodiscard]] std::string scene_schema();
[[nodiscard]] std::string scene_message(std::int64_t time_ns, const std::vector<scene::LinkInfo>& links);

}  // namespace vsa::record
