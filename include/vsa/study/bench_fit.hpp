// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What of the paper's benches an actuator can bear: their mass and their presets are a qbmove's.
#pragma once

#include <optional>

#include "vsa/config/actuator_type.hpp"
#include "vsa/experiment/bench.hpp"

namespace vsa::study {

/// What of the paper's benches an actuator can bear: their mass, and presets in its law's unit.
struct BenchFit {
  bool papers_law = false;  ///< two_sinh, or a law whose name begins so
  double full = 0;  ///< the preset that counts as stiff: the paper's for its own law, else the largest that the motors wind to
  double load_share = 1;  ///< of the load bench's mass: 1, 2, 5, 10 … or 0.5, 0.2 …
  bool carries = false;   ///< some preset carries that
  double softest = 0,     ///< the first preset that carries; without `carries` 0
      stiffest = 0;       ///< the last; without `carries` `full`
};

/// The paper's law keeps the paper's mass. Any other has more where its strongest preset still moves twice as much, and less, by the
/// same rule, where no preset carries the paper's. "Carries": the motors move 1.1 times the load, under which the joint gives way by
/// less than a right angle.
/// `load_share`: it has that.
[[nodiscard]] BenchFit fit_bench(const experiment::Specimen& specimen, const config::ActuatorType& type,
                                 std::optional<double> load_share = std::nullopt);

/// The preset `share` of the way to full, moved to where the bench is carried.
[[nodiscard]] double carried_preset(const BenchFit& fit, double share);

}  // namespace vsa::study
