// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "identify/surrogate.hpp"

#include "vsa/identify/fit.hpp"

namespace vsa::identify {

Task surrogate_task(const Task& task) {
  Task out;
  out.parameters = task.parameters;
  out.observations = task.observations;
  out.model = task.surrogate;
  return out;
}

std::vector<double> led_by_surrogate(const Residuals& residuals, const std::vector<double>& from) {
  const Task& task = residuals.task();
  if (!task.surrogate) return from;
  const Task cheap = surrogate_task(task);
  const Residuals surrogate(cheap, 1);
  if (surrogate.at_all({from})[0].empty()) return from;
  FitOptions o;
  o.iterations = 40;
  const std::vector<double> to = solve(surrogate, from, std::vector<bool>(from.size(), false), o).to;
  const auto found = residuals.at_all({from, to});
  if (found[1].empty()) return from;
  return found[0].empty() || residuals.cost(found[1]) < residuals.cost(found[0]) ? to : from;
}

}  // namespace vsa::identify
