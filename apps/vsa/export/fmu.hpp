// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace vsa::app {

struct FmuOptions {
  std::string fmu;  ///< an actuator type or a world
  std::string out;  ///< empty: NAME.fmu
  int fmi = 2;
  std::string names = "vsasim";
  std::string coupling = "prescribed";
  std::optional<double> load_inertia_kgm2;
  std::vector<std::string> set;
};

/// Throws InputError: an unknown type or world, flags that don't go together, a file that can't be written there.
int export_fmu(const FmuOptions& options);

}  // namespace vsa::app
