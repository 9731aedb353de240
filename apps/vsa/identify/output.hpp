// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What `vsa identify` found, and what it leaves behind:
//   results.json   everything below, units in the keys; what isn't determined is null
//   report.html    estimates, curves, residuals, correlations, cross-validation, profiles
//   NAME.toml      the whole type with the identified values, ready for use
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vsa/identify/identification.hpp"
#include "vsa/report/report.hpp"

namespace vsa::app {

struct Identification {
  std::string command, name;
  config::ActuatorType type;  ///< with --set, before
  identify::Identification found;
  double period_s = 0;
};

/// One table each, units in the heads.
[[nodiscard]] report::Table estimates_table(const Identification& r);
[[nodiscard]] report::Table misfit_table(const Identification& r);
[[nodiscard]] report::Table cross_validation_table(const Identification& r);
[[nodiscard]] report::Table bootstrap_table(const Identification& r);

/// Plain words for everything that the data don't tell, and for estimates at their bounds.
[[nodiscard]] std::vector<std::string> warnings(const Identification& r);

[[nodiscard]] std::string results_json(const Identification& r);
[[nodiscard]] report::Report identification_report(const Identification& r);
[[nodiscard]] std::string identification_text(const Identification& r);
/// Throws InputError where the values don't make a type.
[[nodiscard]] std::string identified_type(const Identification& r, const config::TypeLibrary& library);

}  // namespace vsa::app
