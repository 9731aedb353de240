// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A linear actuator on benches that turn: its output is a rack on a pinion of kBenchPinion_m (shaft.pinion_m), which turns the bench.
// What the runs show is told of the output itself: angles times the radius in m, torques over it in N.
#pragma once

#include "vsa/study/characterization.hpp"

namespace vsa::study {

/// Puts the plan's specimen on the benches: with a pinion where its output slides.
void mount(Characterization& plan);

/// Results of such a bench as the output's own.
void tell_of_output(Characterization& c);

}  // namespace vsa::study
