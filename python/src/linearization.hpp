// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "actuator_type.hpp"
#include "vsa/study/linearization.hpp"

namespace vsa::python {

/// `firmware`, `friction`: the command's words.
[[nodiscard]] study::Linearization linearized(const PyActuatorType& type, const linear::OperatingPoint& point,
                                              const std::string& firmware, const std::string& friction);
[[nodiscard]] study::WorldLinearization linearized(const engine::World& world, const linear_world::WorldPoint& point,
                                                   const std::string& firmware, const std::string& friction);

}  // namespace vsa::python
