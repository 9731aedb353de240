// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Faults as a person writes them, for command lines and services:
//
//   none                  nothing is broken
//   off                   powered off
//   lost_byte=P           probability that a byte to or from the unit is lost, 0 … 1
//   flipped_byte=P        probability that a bit of a byte is flipped, 0 … 1
//   late_s=T              answers come so much later, 0 … 60 s
//   stuck=WHICH           an encoder stands still: motor_1, motor_2 or shaft; may be said again
//   noise_rad=A           all encoders are noisy, uniform within ± A, 0 … π
//   supply_V=U            another supply voltage, 0 … 100
//   unplugged=N           motor 1 or 2 hangs open; may be said again
//   seed=N                of what happens by chance, ≥ 0
//
// Words are separated by white space. What isn't said is whole.
#pragma once

#include <string>
#include <string_view>

#include "vsa/device/faults.hpp"

namespace vsa::config {

/// Throws InputError with every word that is wrong; `source` is named in it ("--fault").
[[nodiscard]] device::Faults read_faults(std::string_view words, std::string_view source);

/// The inverse; noise as far as all encoders share it.
[[nodiscard]] std::string faults_text(const device::Faults& faults);

}  // namespace vsa::config
