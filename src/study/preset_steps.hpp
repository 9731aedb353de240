// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vsa/study/characterization.hpp"

namespace vsa::study {

/// Adds the step to `preset` and back, without load and, between presets that carry the load bench, with the lever; none for 0.
void plan_preset_steps(Characterization& plan, double preset);

}  // namespace vsa::study
