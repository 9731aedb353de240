// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/identify/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "identify/surrogate.hpp"
#include "vsa/errors.hpp"
#include "vsa/identify/global_search.hpp"

namespace vsa::identify {
namespace {

double radical_inverse(unsigned index, unsigned base) {
  double out = 0, digit = 1.0 / base;
  for (; index > 0; index /= base, digit /= base) out += digit * (index % base);
  return out;
}

/// Halton points: within a factor of three of a positive start, within a fifth of the bounds about others.
std::vector<std::vector<double>> candidates(const Task& task, int count) {
  constexpr unsigned kPrimes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53};
  constexpr double kFactor = 3.0, kShare = 0.2;
  std::vector<std::vector<double>> out;
  for (int i = 1; i <= count; ++i) {
    std::vector<double> x;
    for (std::size_t k = 0; k < task.parameters.size(); ++k) {
      const Parameter& p = task.parameters[k];
      const double u = 2 * radical_inverse(static_cast<unsigned>(i), kPrimes[k % std::size(kPrimes)]) - 1;
      const double about = p.start > 0 && p.min >= 0 ? p.start * std::pow(kFactor, u) : p.start + u * kShare * (p.max - p.min);
      x.push_back(std::clamp(about, p.min, p.max));
    }
    out.push_back(std::move(x));
  }
  return out;
}

void tell(const FitOptions& o, const std::string& text) {
  if (o.progress) o.progress(text);
}

/// The best of the trials about the type's values.
void add_trials(std::vector<std::vector<double>>& to, const Residuals& residuals, std::size_t starts) {
  const auto trials = candidates(residuals.task(), 4 * (static_cast<int>(starts) - 1));
  const auto found = residuals.at_all(trials);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (!found[i].empty()) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return residuals.cost(found[a]) < residuals.cost(found[b]); });
  for (std::size_t i : order) {
    if (to.size() < starts) to.push_back(trials[i]);
  }
}

/// False: the surrogate sees nothing, or there is none.
bool add_global(std::vector<std::vector<double>>& to, const Residuals& residuals, const FitOptions& o) {
  const Task& task = residuals.task();
  if (!task.surrogate) {
    if (!task.no_surrogate.empty()) tell(o, "no global search: " + task.no_surrogate);
    return false;
  }
  GlobalOptions options;
  options.searches = o.starts - 1;
  options.seed = o.seed;
  options.threads = residuals.threads();
  const GlobalSearch search = search_globally(task, options);
  for (const GlobalPoint& p : search.points) to.push_back(p.values);
  tell(o, fmt::format("global search: {} place{}", search.points.size(), search.points.size() == 1 ? "" : "s"));
  return !search.points.empty();
}

}  // namespace

void evaluate_at(Fit& fit, const Residuals& residuals, double effect_rad) {
  const Task& task = residuals.task();
  if (task.prepare) task.prepare(fit.values);
  fit.residuals = residuals.at(fit.values);
  fit.cost = residuals.cost(fit.residuals);
  fit.rms_rad = rms(fit.residuals);
  fit.steps = residuals.steps(fit.values, fit.residuals, effect_rad, fit.steps);
  std::vector<std::size_t> all(fit.values.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  fit.jacobian = residuals.jacobian(fit.values, fit.residuals, fit.steps, all);
  if (fit.jacobian.empty() && !all.empty()) throw std::runtime_error("the model can't be evaluated beside the solution");
  fit.at_bound.clear();
  for (std::size_t k = 0; k < fit.values.size(); ++k) {
    const Parameter& p = task.parameters[k];
    const double near = std::min(0.05 * fit.steps[k], 1e-6 * p.span()), at = p.coordinate(fit.values[k]);
    fit.at_bound.push_back(at - p.coordinate(p.min) <= near || p.coordinate(p.max) - at <= near);
  }
}

std::vector<std::vector<double>> starting_points(const Residuals& residuals, const FitOptions& o) {
  const Task& task = residuals.task();
  std::vector<double> first;
  for (const Parameter& p : task.parameters) first.push_back(p.start);
  if (task.prepare) task.prepare(first);
  (void)residuals.at(first);  // what is wrong with the type's own values is told before anything else
  std::vector<std::vector<double>> out{first};
  if (o.starts <= 1 || first.empty()) return out;
  if (!o.global || !add_global(out, residuals, o)) add_trials(out, residuals, static_cast<std::size_t>(o.starts));
  return out;
}

Fit best_of(const Residuals& residuals, std::vector<StartResult> starts, const FitOptions& o) {
  // Costs, not RMS, decide: the recordings have weights. Each is judged with what the model held constant on its way.
  std::stable_sort(starts.begin(), starts.end(), [](const StartResult& a, const StartResult& b) { return a.cost < b.cost; });
  Fit out;
  out.starts = std::move(starts);
  out.values = out.starts.front().to;
  out.steps = out.starts.front().steps;
  evaluate_at(out, residuals, o.interval_effect_rad);
  return out;
}

Fit fit(const Residuals& residuals, const FitOptions& o) {
  const Task& task = residuals.task();
  const std::vector<bool> none(task.parameters.size(), false);
  std::vector<StartResult> found;
  for (const std::vector<double>& from : starting_points(residuals, o)) {
    try {
      if (task.prepare) task.prepare(from);
      const std::vector<double> near = o.global ? led_by_surrogate(residuals, from) : from;
      found.push_back(solve(residuals, near, none, o));
      StartResult& s = found.back();
      s.from = from;
      if (task.prepare) task.prepare(s.to);
      s.cost = residuals.cost(residuals.at(s.to));
    } catch (const InputError&) {
      if (found.empty()) throw;  // a trial's values may make no sense together; the type's do
      continue;
    }
    tell(o,
         fmt::format("start {}: RMS {:.5f} rad after {} iterations", found.size(), found.back().rms_rad, found.back().iterations));
  }
  return best_of(residuals, std::move(found), o);
}

}  // namespace vsa::identify
