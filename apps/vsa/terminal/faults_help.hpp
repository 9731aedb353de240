// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vsa::app {

/// The words of config/faults_text.hpp, for --help.
inline constexpr const char* kFaultsHelp =
    R"(Faults, the last said of a unit holds: off lost_byte=P flipped_byte=P late_s=T stuck=motor_1|motor_2|shaft
noise_rad=A supply_V=U unplugged=1|2 seed=N (the next unit gets the next seed))";

}  // namespace vsa::app
