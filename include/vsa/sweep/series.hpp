// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Runs that belong together, by number: what pools make and folders hold. A plan's are one such series, an identification's fits
// another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vsa::sweep {

/// What came of a run.
struct Outcome {
  std::size_t run = 0;         ///< its number
  std::vector<double> values;  ///< one a column; none where it failed
  std::string error;           ///< why it failed; empty: it didn't
  std::string notice;          ///< what the robots had to tell, a command that was clamped; the first of it
  double wall_s = 0,           ///< that it took
      cpu_s = 0;               ///< that it used; NaN where nobody knows
};

/// Makes runs, one after the other, in one thread. What goes wrong in a run is its outcome's error. `wanted`: asked now and then; false
/// ends it, and there is no outcome.
using MakeRun = std::function<std::optional<Outcome>(std::size_t run, const std::function<bool()>& wanted)>;

/// Runs that one process or many make, each by its number alone.
struct Series {
  std::uint64_t fingerprint = 0;   ///< of all that its numbers follow from: equal ones give equal outcomes
  std::string text;                ///< for people: the plan; a folder has it as plan.toml
  std::size_t most_runs = 0;       ///< numbers are below that
  std::size_t columns = 0;         ///< numbers of an outcome
  std::function<MakeRun()> maker;  ///< called once in each thread
};

}  // namespace vsa::sweep
