// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Local solutions that know nothing of each other, so that each may be made anywhere: an identification's starts, those without a
// preset's recordings, points of profiles, bootstrap draws.
//
// A draw is a fit to recordings with other errors, by the wild bootstrap over blocks (C. F. J. Wu, Ann. Statist. 14 (1986) 1261;
// X. Shao, JASA 105 (2010) 218): with the residuals r̂ = model(θ̂) − data of a fit,
//   data* = model(θ̂) − s r̂,   s = ±1 with equal chance, one a block of L neighbouring points of a branch, the first one cut at random
//   L = ⌈3 (1 + ρ)/(1 − ρ)⌉, at most half a branch;  ρ: correlation of the recording's neighbouring residuals, 0 … 0.95
// so that errors keep their place, their size and, within a block, their neighbours: θ*'s scatter is θ̂'s, whatever the law of the errors.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "vsa/identify/fit.hpp"

namespace vsa::identify {

/// One local solution to be made, anywhere.
struct Job {
  std::optional<std::size_t> without;  ///< which preset's recordings are left out, counted upwards from the lowest
  std::vector<double> from;            ///< values, in the order of Task::parameters
  bool led = false;                    ///< by the surrogate first, if the task has one
  std::vector<bool> fixed;             ///< parameters that keep their value; empty: none
  unsigned draw = 0;                   ///< number of a bootstrap draw about `from`; 0: the recordings as they are
};

/// A task for one thread, with `threads` for itself; nothing in it may be shared with another one's.
using MakeTask = std::function<Task(unsigned threads)>;

/// The presets of a task's recordings, upwards.
[[nodiscard]] std::vector<double> presets_of(const Task& task);
/// The task with only those recordings whose preset is in question (`in`), or with all others.
[[nodiscard]] Task part_of(const Task& task, double preset, bool in);
/// Recordings as draw `draw` has them. `at`: the fit's residuals there.
[[nodiscard]] std::vector<Observation> drawn(const Residuals& residuals, const std::vector<double>& at, unsigned seed,
                                             unsigned draw);

/// Does jobs, one after the other.
class Worker {
 public:
  /// One task, and the options of its fits.
  Worker(Task task, FitOptions options) : task_(std::move(task)), options_(std::move(options)) {}
  /// `cost`: with what the model holds constant at the end. Throws InputError where the values make no sense together, and what the
  /// model throws.
  [[nodiscard]] StartResult solve(const Job& job);

 private:
  Task task_;
  FitOptions options_;
};

/// As numbers, exactly: for messages and logs. A job has job_size(parameters) of them, a result result_size(parameters).
[[nodiscard]] std::size_t job_size(std::size_t parameters);
/// Of a job, job_size() of them.
[[nodiscard]] std::vector<double> numbers_of(const Job& job);
/// The job of those numbers; `task` and options are the caller's.
[[nodiscard]] Job job_of(const std::vector<double>& numbers);
[[nodiscard]] std::size_t result_size(std::size_t parameters);  ///< of a result
/// Of a result, result_size() of them.
[[nodiscard]] std::vector<double> numbers_of(const StartResult& result);
/// `from` isn't among them.
[[nodiscard]] StartResult result_of(const std::vector<double>& numbers);

}  // namespace vsa::identify
