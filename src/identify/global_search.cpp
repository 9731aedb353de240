// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/identify/global_search.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <nlopt.hpp>

#include "identify/surrogate.hpp"
#include "vsa/experiment/bench.hpp"
#include "vsa/experiment/parallel.hpp"
#include "vsa/identify/fit.hpp"

namespace vsa::identify {
namespace {

constexpr double kHopeless = 1e12;  // a cost where the surrogate has none: finite, as the search compares
constexpr double kSame = 0.02;      // of a range: nearer than this two points are one
constexpr double kWorst = 10.0;     // times the best cost
constexpr int kPatience = 100;      // evaluations a parameter in which the best cost must fall
constexpr double kFall = 1e-3;      // by this part of it

/// A value for a position of 0 … 1 within the bounds, and back.
double value_at(const Parameter& p, double u) { return p.value_at(p.coordinate(p.min) + u * p.span()); }
double position(const Parameter& p, double value) { return (p.coordinate(value) - p.coordinate(p.min)) / p.span(); }

/// Parameters that change any residual somewhere on a line through the start.
std::vector<bool> seen_by(const Residuals& residuals, const std::vector<double>& start) {
  constexpr double kEffect_rad = 1e-7;
  constexpr double kTrials[] = {0.2, 0.5, 0.8};
  std::vector<std::vector<double>> trials{start};
  for (std::size_t k = 0; k < start.size(); ++k) {
    for (const double u : kTrials) {
      trials.push_back(start);
      trials.back()[k] = value_at(residuals.task().parameters[k], u);
    }
  }
  const auto found = residuals.at_all(trials);
  std::vector<bool> out(start.size(), false);
  for (std::size_t i = 1; i < found.size(); ++i) {
    const std::size_t k = (i - 1) / std::size(kTrials);
    if (found[0].empty() || found[i].empty()) {
      out[k] = out[k] || found[0].empty() != found[i].empty();
      continue;
    }
    for (std::size_t j = 0; j < found[i].size(); ++j) out[k] = out[k] || std::abs(found[i][j] - found[0][j]) > kEffect_rad;
  }
  return out;
}

/// One search; exceptions mustn't fly through NLopt.
class Search {
 public:
  Search(const Residuals& residuals, const std::vector<double>& start, std::vector<std::size_t> free)
      : residuals_(residuals), start_(start), free_(std::move(free)) {}

  std::vector<double> run(unsigned seed, int evaluations) {
    nlopt::srand(seed);  // of this thread
    const auto n = static_cast<unsigned>(free_.size());
    nlopt::opt opt(nlopt::GN_CRS2_LM, n);
    opt.set_min_objective(&Search::objective, this);
    opt.set_lower_bounds(0.0);
    opt.set_upper_bounds(1.0);
    // No ftol: NLopt compares a new best with the one before, and of a random search that tells nothing.
    opt.set_maxeval(evaluations);
    optimizer_ = &opt;
    std::vector<double> u;
    for (const std::size_t k : free_) u.push_back(std::clamp(position(residuals_.task().parameters[k], start_[k]), 0.0, 1.0));
    double best = 0;
    try {
      opt.optimize(u, best);
    } catch (const nlopt::forced_stop&) {
      if (failure_) std::rethrow_exception(failure_);
    } catch (const nlopt::roundoff_limited&) {  // as far as it goes
    }
    return values(u);
  }

 private:
  static double objective(const std::vector<double>& u, std::vector<double>&, void* self) {
    Search& search = *static_cast<Search*>(self);
    const double cost = search.cost(u);
    if (!search.gets_on(cost)) search.optimizer_->force_stop();
    return cost;
  }
  /// Whether the best cost still falls.
  bool gets_on(double cost) {
    ++count_;
    if (cost < (1 - kFall) * best_) {
      best_ = cost;
      best_at_ = count_;
    }
    return count_ - best_at_ < kPatience * static_cast<int>(free_.size());
  }
  [[nodiscard]] std::vector<double> values(const std::vector<double>& u) const {
    std::vector<double> out = start_;
    for (std::size_t j = 0; j < free_.size(); ++j) out[free_[j]] = value_at(residuals_.task().parameters[free_[j]], u[j]);
    return out;
  }
  double cost(const std::vector<double>& u) {
    try {
      const std::vector<double> r = residuals_.at_all({values(u)})[0];
      const double cost = r.empty() ? kHopeless : residuals_.cost(r);
      return std::isfinite(cost) ? std::min(cost, kHopeless) : kHopeless;
    } catch (...) {
      failure_ = std::current_exception();
      throw nlopt::forced_stop();
    }
  }

  const Residuals& residuals_;
  const std::vector<double>& start_;
  std::vector<std::size_t> free_;
  nlopt::opt* optimizer_ = nullptr;
  int count_ = 0, best_at_ = 0;
  double best_ = std::numeric_limits<double>::infinity();
  std::exception_ptr failure_;
};

bool apart(const std::vector<double>& a, const std::vector<double>& b, const std::vector<Parameter>& parameters) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (std::abs(position(parameters[k], a[k]) - position(parameters[k], b[k])) > kSame) return true;
  }
  return false;
}

/// Best first, one of each place.
std::vector<GlobalPoint> distinct(std::vector<GlobalPoint> all, const std::vector<Parameter>& parameters) {
  std::stable_sort(all.begin(), all.end(), [](const GlobalPoint& a, const GlobalPoint& b) { return a.cost < b.cost; });
  std::vector<GlobalPoint> out;
  for (GlobalPoint& p : all) {
    const bool worth = out.empty() || p.cost <= kWorst * out.front().cost;
    const bool other =
        std::all_of(out.begin(), out.end(), [&](const GlobalPoint& q) { return apart(p.values, q.values, parameters); });
    if (worth && other && p.cost < kHopeless) out.push_back(std::move(p));
  }
  return out;
}

}  // namespace

GlobalSearch search_globally(const Task& task, const GlobalOptions& options) {
  GlobalSearch out;
  if (!task.surrogate) return out;
  const Task cheap = surrogate_task(task);
  const Residuals residuals(cheap, 1);
  std::vector<double> start;
  for (const Parameter& p : task.parameters) start.push_back(p.start);
  const std::vector<bool> seen = seen_by(residuals, start);
  std::vector<std::size_t> free;
  std::vector<bool> fixed;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    (seen[k] ? free : out.unseen).push_back(k);
    fixed.push_back(!seen[k]);
  }
  if (free.empty()) return out;
  const int most = options.evaluations_per_parameter * static_cast<int>(free.size());
  std::vector<GlobalPoint> found(static_cast<std::size_t>(std::max(options.searches, 0)));
  experiment::run_in_parallel(found.size(), options.threads, [&](std::size_t i) {
    const std::vector<double> rough = Search(residuals, start, free).run(options.seed + static_cast<unsigned>(i), most);
    found[i] = {rough, kHopeless};
    if (residuals.at_all({rough})[0].empty()) return;
    FitOptions local;
    local.tolerance = 1e-6;
    local.iterations = 50;
    const StartResult polished = solve(residuals, rough, fixed, local);
    const double before = residuals.cost(residuals.at(rough)), after = residuals.cost(residuals.at(polished.to));
    found[i] = after < before ? GlobalPoint{polished.to, after} : GlobalPoint{rough, before};
  });
  out.points = distinct(std::move(found), task.parameters);
  return out;
}

}  // namespace vsa::identify
