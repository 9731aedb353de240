// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Data sheets beside each other: one table, one page.
#pragma once

#include <string>
#include <vector>

#include "vsa/report/report.hpp"
#include "vsa/study/data_sheet.hpp"

namespace vsa::app {

/// A row a type, upwards by name: what a user chooses by, after Grioli et al., "Variable Stiffness Actuators: the User's Point of View"
/// (IJRR 2015). Mass and size aren't there: no parameter tells them.
[[nodiscard]] report::Table comparison_table(const std::vector<study::DataSheet>& sheets);
[[nodiscard]] report::Report comparison_page(const std::vector<study::DataSheet>& sheets, const std::string& command);

/// What full voltage's driver gives out as heat to hold the unloaded joint at a preset: Σ I² R with the currents that the springs ask for
/// beyond what friction holds, W.
[[nodiscard]] double holding_power_W(const device::UnitConfig& unit, double preset);

}  // namespace vsa::app
