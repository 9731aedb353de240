// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A local solution with Ceres; see vsa/identify/fit.hpp.
#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <exception>

#include "vsa/identify/fit.hpp"

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
      out[free_[j]] = p.value_at(u[j] * step_[free_[j]]);
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

/// One descent, with difference steps for where it begins and what the model holds constant there.
StartResult descend(const Residuals& residuals, const std::vector<double>& from, const std::vector<std::size_t>& free,
                    const FitOptions& o) {
  const Task& task = residuals.task();
  if (task.prepare) task.prepare(from);
  const std::vector<double> here = residuals.at(from);
  StartResult out{from, from, {}, rms(here), residuals.cost(here), 0, true};
  if (free.empty()) return out;
  const std::vector<double> step = residuals.steps(from, here, o.effect_rad);
  std::vector<double> u, min, max;
  for (std::size_t k : free) {
    const Parameter& p = task.parameters[k];
    u.push_back(p.coordinate(from[k]) / step[k]);
    min.push_back(p.coordinate(p.min) / step[k]);
    max.push_back(p.coordinate(p.max) / step[k]);
  }
  ceres::Problem::Options owning;
  owning.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  owning.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  Cost cost(residuals, from, free, step);
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

}  // namespace

StartResult solve(const Residuals& residuals, const std::vector<double>& from, const std::vector<bool>& fixed,
                  const FitOptions& o) {
  constexpr double kWorth = 0.01;  // of the cost: with less from a descent, another one isn't tried
  std::vector<std::size_t> free;
  for (std::size_t k = 0; k < from.size(); ++k) {
    if (!fixed[k]) free.push_back(k);
  }
  StartResult out = descend(residuals, from, free, o);
  // Far from where they were found the steps are wrong, and so is what the model holds: so it begins again from where it came to.
  FitOptions left = o;
  for (double gained = kWorth; out.converged && gained >= kWorth && out.iterations < o.iterations;) {
    left.iterations = o.iterations - out.iterations;
    StartResult next = descend(residuals, out.to, free, left);
    next.iterations += out.iterations;
    gained = 1 - next.cost / out.cost;
    next.from = from;
    if (!(gained > 0)) break;
    out = std::move(next);
  }
  return out;
}

}  // namespace vsa::identify
