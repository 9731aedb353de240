// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The load tests that `vsa validate` compares with: every recording below data/, and in directories that the user names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vsa/config/preset.hpp"
#include "vsa/experiment/recording.hpp"

namespace vsa::app {

struct Recording {
  std::string file;  ///< relative to the data directory, or as the user's directory leads to it
  double preset = 0;
  experiment::Branches data;
  std::string origin;  ///< where it comes from, by origin.txt beside it: "digitised from …"; empty: nobody says
};

/// stiffness_preset_P.PPPPrad_branches.csv, or …_samples.csv where there are no branches, or ….csv where there is neither; ordered
/// by preset. A recording is named by its preset, so two of one preset are an error, and so is a preset in another unit than the
/// actuator's: all such problems at once, as InputError.
[[nodiscard]] std::vector<Recording> read_recordings(const std::filesystem::path& data, const std::vector<std::string>& more,
                                                     const config::Preset& actuator);

}  // namespace vsa::app
