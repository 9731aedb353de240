// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/identify/fit.hpp"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <exception>
#include <numeric>
#include <stdexcept>

#include "vsa/errors.hpp"
#include "vsa/identify/global_search.hpp"

namespace vsa::identify {
namespace {

/// The weighted residuals as Ceres wants them, in units of the difference steps: so all unknowns are of one size.
class Cost : public ceres::CostFunction {
 public:
  Cost(const Residuals& residuals, std::vector<double> start, std::vector<std::size_t> free, std::vector<double> step)
      : residuals_(residuals), start_(std::move(start)), free_(std::move(free)), step_(std::move(step)) {
    set_num_residuals(static_cast<int>(residuals_.points().size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(free_.size()));
  }

  [[nodiscard]] std::vector<double> values(const double* u) const {
    std::vector<double> out = start_;
    for (std::size_t j = 0; j < free_.size(); ++j) {
      const Parameter& p = residuals_.task().parameters[free_[j]];
      out[free_[j]] = std::clamp(u[j] * step_[free_[j]], p.min, p.max);
    }
    return out;
  }

  bool Evaluate(double const* const* u, double* out, double** jacobians) const override {
    try {
      return evaluate(values(u[0]), out, jacobians);
    } catch (...) {  // nothing may fly through Ceres
      failure_ = std::current_exception();
      return false;
    }
  }
  void throw_failure() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  /// What was computed at one place.
  struct Known {
    std::vector<double> at, residuals;
    std::vector<std::vector<double>> jacobian;  ///< empty: not yet
  };

  /// Ceres asks for the residuals first and, where it stays, for the Jacobian.
  Known& known(const std::vector<double>& x) const {
    constexpr std::size_t kKept = 4;
    const auto it = std::find_if(known_.begin(), known_.end(), [&](const Known& k) { return k.at == x; });
    if (it != known_.end()) return *it;
    if (known_.size() == kKept) known_.pop_front();
    known_.push_back({x, residuals_.at_all({x})[0], {}});
    return known_.back();
  }

  bool evaluate(const std::vector<double>& x, double* out, double** jacobians) const {
    Known& here = known(x);
    if (here.residuals.empty()) return false;
    for (std::size_t i = 0; i < here.residuals.size(); ++i) out[i] = residuals_.weight(i) * here.residuals[i];
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    if (here.jacobian.empty()) here.jacobian = residuals_.jacobian(x, here.residuals, step_, free_);
    if (here.jacobian.empty()) return false;
    for (std::size_t j = 0; j < free_.size(); ++j) {
      const double kept = pushes_out(x, here, j) ? 0.0 : 1.0;
      for (std::size_t i = 0; i < here.residuals.size(); ++i) {
        jacobians[0][i * free_.size() + j] = kept * residuals_.weight(i) * here.jacobian[j][i] * step_[free_[j]];
      }
    }
    return true;
  }

  /// At a bound, with the cost falling beyond it: the parameter rests there while the others move.
  [[nodiscard]] bool pushes_out(const std::vector<double>& x, const Known& here, std::size_t j) const {
    const Parameter& p = residuals_.task().parameters[free_[j]];
    const double value = x[free_[j]];
    if (value > p.min && value < p.max) return false;
    double gradient = 0;
    for (std::size_t i = 0; i < here.residuals.size(); ++i) {
      gradient += residuals_.weight(i) * residuals_.weight(i) * here.residuals[i] * here.jacobian[j][i];
    }
    return value <= p.min ? gradient > 0 : gradient < 0;
  }

  const Residuals& residuals_;
  std::vector<double> start_;
  std::vector<std::size_t> free_;
  std::vector<double> step_;
  mutable std::deque<Known> known_;
  mutable std::exception_ptr failure_;
};

/// Keeps the unknowns within their bounds by ending each step there. Ceres' own bounds would search along every step, with a
/// Jacobian at each trial: many simulations, and a rough cost misleads it.
class Box : public ceres::Manifold {
 public:
  Box(std::vector<double> min, std::vector<double> max) : min_(std::move(min)), max_(std::move(max)) {}
  int AmbientSize() const override { return static_cast<int>(min_.size()); }
  int TangentSize() const override { return AmbientSize(); }
  bool Plus(const double* x, const double* delta, double* out) const override {
    for (std::size_t i = 0; i < min_.size(); ++i) out[i] = std::clamp(x[i] + delta[i], min_[i], max_[i]);
    return true;
  }
  bool Minus(const double* y, const double* x, double* out) const override {
    for (std::size_t i = 0; i < min_.size(); ++i) out[i] = y[i] - x[i];
    return true;
  }
  bool PlusJacobian(const double*, double* out) const override { return identity(out); }
  bool MinusJacobian(const double*, double* out) const override { return identity(out); }

 private:
  bool identity(double* out) const {
    for (std::size_t i = 0; i < min_.size() * min_.size(); ++i) out[i] = i % (min_.size() + 1) == 0 ? 1.0 : 0.0;
    return true;
  }

  std::vector<double> min_, max_;
};

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

/// The best of the trials about the preset's values.
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

std::vector<std::vector<double>> starting_points(const Residuals& residuals, const FitOptions& o) {
  std::vector<double> first;
  for (const Parameter& p : residuals.task().parameters) first.push_back(p.start);
  std::vector<std::vector<double>> out{first};
  if (o.starts <= 1 || first.empty()) return out;
  if (!o.global || !add_global(out, residuals, o)) add_trials(out, residuals, static_cast<std::size_t>(o.starts));
  return out;
}

ceres::Solver::Options solver_options(const FitOptions& o) {
  ceres::Solver::Options s;
  s.linear_solver_type = ceres::DENSE_QR;
  s.max_num_iterations = o.iterations;
  s.function_tolerance = o.tolerance;
  s.parameter_tolerance = std::min(1e-4, o.tolerance);  // of unknowns counted in difference steps
  s.gradient_tolerance = 0;                             // the gradient is rough: what counts is the decrease
  s.logging_type = ceres::SILENT;
  s.num_threads = 1;
  return s;
}

}  // namespace

StartResult solve(const Residuals& residuals, const std::vector<double>& from, const std::vector<bool>& fixed,
                  const FitOptions& o) {
  const Task& task = residuals.task();
  if (task.prepare) task.prepare(from);
  const std::vector<double> here = residuals.at(from);
  StartResult out{from, from, {}, rms(here), residuals.cost(here), 0, true};
  std::vector<std::size_t> free;
  for (std::size_t k = 0; k < from.size(); ++k) {
    if (!fixed[k]) free.push_back(k);
  }
  if (free.empty()) return out;
  const std::vector<double> step = residuals.steps(from, here, o.effect_rad);
  std::vector<double> u;
  for (std::size_t k : free) u.push_back(from[k] / step[k]);
  ceres::Problem::Options owning;
  owning.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  owning.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  Cost cost(residuals, from, free, step);
  std::vector<double> min, max;
  for (std::size_t k : free) {
    min.push_back(task.parameters[k].min / step[k]);
    max.push_back(task.parameters[k].max / step[k]);
  }
  Box box(min, max);
  ceres::Problem problem(owning);
  problem.AddResidualBlock(&cost, nullptr, u.data());
  problem.SetManifold(u.data(), &box);
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(o), &problem, &summary);
  cost.throw_failure();
  out.steps = step;
  out.to = cost.values(u.data());
  const std::vector<double> there = residuals.at(out.to);
  out.rms_rad = rms(there);
  out.cost = residuals.cost(there);
  out.iterations = static_cast<int>(summary.iterations.size()) - 1;
  out.converged = summary.termination_type == ceres::CONVERGENCE;
  return out;
}

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
    const double near = std::min(0.05 * fit.steps[k], 1e-6 * (p.max - p.min));
    fit.at_bound.push_back(fit.values[k] - p.min <= near || p.max - fit.values[k] <= near);
  }
}

Fit fit(const Residuals& residuals, const FitOptions& o) {
  const Task& task = residuals.task();
  const std::vector<bool> none(task.parameters.size(), false);
  std::vector<double> first;
  for (const Parameter& p : task.parameters) first.push_back(p.start);
  if (task.prepare) task.prepare(first);
  (void)residuals.at(first);  // what is wrong with the preset's own values is told before anything else
  Fit out;
  for (const std::vector<double>& from : starting_points(residuals, o)) {
    try {
      out.starts.push_back(solve(residuals, from, none, o));
    } catch (const InputError&) {
      if (out.starts.empty()) throw;  // a trial's values may make no sense together; the preset's do
      continue;
    }
    tell(o, fmt::format("start {}: RMS {:.5f} rad after {} iterations", out.starts.size(), out.starts.back().rms_rad,
                        out.starts.back().iterations));
  }
  // Costs, not RMS, decide: the recordings have weights. Each is judged with what the model held constant on its way.
  std::vector<double> costs;
  for (StartResult& s : out.starts) {
    if (task.prepare) task.prepare(s.to);
    costs.push_back(s.cost = residuals.cost(residuals.at(s.to)));
  }
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return costs[a] < costs[b]; });
  std::vector<StartResult> sorted;
  for (std::size_t i : order) sorted.push_back(out.starts[i]);
  out.starts = std::move(sorted);
  out.values = out.starts.front().to;
  out.steps = out.starts.front().steps;
  evaluate_at(out, residuals, o.effect_rad);
  return out;
}

}  // namespace vsa::identify
