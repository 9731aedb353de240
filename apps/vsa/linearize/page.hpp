// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The page and the tables of a linearisation.
#pragma once

#include <string>

#include "vsa/report/report.hpp"
#include "vsa/study/linearization.hpp"

namespace vsa::app {

[[nodiscard]] report::Report linearization_report(const study::Linearization& l, const std::string& command);
/// The point and the poles as text.
[[nodiscard]] std::string linearization_text(const study::Linearization& l);

[[nodiscard]] report::Report linearization_report(const study::WorldLinearization& l, const std::string& command);
/// Joints, actuators and poles as text.
[[nodiscard]] std::string linearization_text(const study::WorldLinearization& l);

}  // namespace vsa::app
