// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a task's cheap model is good for beside the global search.
#pragma once

#include <vector>

#include "vsa/identify/residuals.hpp"

namespace vsa::identify {

/// The task on its surrogate alone.
[[nodiscard]] Task surrogate_task(const Task& task);

/// The better, by the true model, of `from` and of where least squares on the surrogate end from there: far away the surrogate
/// leads at a hundredth of the cost. `from` where there is none or it fails. With what the model holds constant already.
[[nodiscard]] std::vector<double> led_by_surrogate(const Residuals& residuals, const std::vector<double>& from);

}  // namespace vsa::identify
