// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The load tests that a validation compares with: every recording below data/, and in directories that the user names.
#pragma once

#include <filesystem>
#include <vector>

#include "vsa/study/validation.hpp"

namespace vsa::study {

/// stiffness_preset_P.PPPPrad_branches.csv, or …_samples.csv where there are no branches, or ….csv where there is neither; ordered
/// by preset. A recording is named by its preset, so two of one preset are an error, and so is a preset in another unit than the
/// actuator's: all such problems at once, as InputError.
[[nodiscard]] std::vector<Recording> read_recordings(const std::filesystem::path& data,
                                                     const std::vector<std::filesystem::path>& more,
                                                     const config::ActuatorType& actuator);

}  // namespace vsa::study
