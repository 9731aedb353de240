// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the tests of a batch tell its copies, and the same told to a world.
#pragma once

#include <cmath>
#include <vector>

#include "vsa/batch/batch.hpp"
#include "vsa/errors.hpp"

namespace vsa::batch {

using Numbers = std::vector<double>;

inline Numbers numbers_of(const engine::World& w) {
  Numbers out(w.state_size());
  w.save(out);
  return out;
}

/// What copy `c` is told before step call `k`; NaN now and then.
inline double told(std::size_t c, std::size_t a, int k) {
  return (c + a + static_cast<std::size_t>(k)) % 3 == 0 ? std::nan("") : 0.1 * std::sin(static_cast<double>(c + 2 * a) + k);
}

inline void command(Batch& batch, int k) {
  for (std::size_t c = 0; c < batch.size(); ++c)
    for (std::size_t a = 0; a < batch.actuators(); ++a) {
      batch.equilibrium()[c * batch.actuators() + a] = told(c, a, k);
      batch.preset()[c * batch.actuators() + a] = 0.3 + told(c + 1, a, k);
    }
}

inline void command(engine::World& w, std::size_t c, int k) {
  const auto given = [](double v) { return std::isnan(v) ? std::nullopt : std::optional(v); };
  for (std::size_t a = 0; a < w.actuators().size(); ++a) {
    const engine::ActuatorRef& ref = w.actuators()[a];
    w.robot(ref.robot).command(ref.index, given(told(c, a, k)), given(0.3 + told(c + 1, a, k)));
  }
}

}  // namespace vsa::batch
