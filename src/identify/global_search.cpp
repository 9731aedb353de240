// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/identify/global_search.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <nlopt.hpp>

#include "vsa/experiment/bench.hpp"
#include "vsa/experiment/parallel.hpp"
#include "vsa/identify/fit.hpp"

namespace vsa::identify {
namespace {

constexpr double kHopeless = 1e12;  // a cost where the surrogate has none: finite, as the search compares
constexpr double kSame = 0.02;      // of a range: nearer than this two points are one
constexpr double kWorst = 10.0;     // times the best cost

/// A parameter's range as the search sees it: 0 … 1.
struct Axis {
  double low, high;
  bool logarithmic;
  explicit Axis(const Parameter& p) : low(p.min), high(p.max), logarithmic(p.min > 0 && p.max / p.min >= 100) {
    if (logarithmic) low = std::log(low), high = std::log(high);
  }
  [[nodiscard]] double value(double u) const {
    const double at = low + u * (high - low);
    return logarithmic ? std::exp(at) : at;
  }
  [[nodiscard]] double position(double value) const { return ((logarithmic ? std::log(value) : value) - low) / (high - low); }
};

/// The surrogate as a task of its own.
Task surrogate_task(const Task& task) {
  Task out;
  out.parameters = task.parameters;
  out.observations = task.observations;
  out.model = task.surrogate;
  return out;
}

/// Parameters that change any residual somewhere on a line through the start.
std::vector<bool> seen_by(const Residuals& residuals, const std::vector<double>& start, const std::vector<Axis>& axes) {
  constexpr double kEffect_rad = 1e-7;
  constexpr double kTrials[] = {0.2, 0.5, 0.8};
  std::vector<std::vector<double>> trials{start};
  for (std::size_t k = 0; k < start.size(); ++k) {
    for (const double u : kTrials) {
      trials.push_back(start);
      trials.back()[k] = axes[k].value(u);
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
  Search(const Residuals& residuals, const std::vector<double>& start, const std::vector<Axis>& axes, std::vector<std::size_t> free)
      : residuals_(residuals), start_(start), axes_(axes), free_(std::move(free)) {}

  std::vector<double> run(unsigned seed, int evaluations) {
    nlopt::srand(seed);  // of this thread
    const auto n = static_cast<unsigned>(free_.size());
    nlopt::opt opt(nlopt::GN_CRS2_LM, n);
    opt.set_min_objective(&Search::objective, this);
    opt.set_lower_bounds(0.0);
    opt.set_upper_bounds(1.0);
    opt.set_maxeval(evaluations);
    opt.set_ftol_rel(1e-3);
    std::vector<double> u;
    for (const std::size_t k : free_) u.push_back(std::clamp(axes_[k].position(start_[k]), 0.0, 1.0));
    double best = 0;
    try {
      opt.optimize(u, best);
    } catch (const nlopt::forced_stop&) {
      std::rethrow_exception(failure_);
    } catch (const nlopt::roundoff_limited&) {  // as far as it goes
    }
    return values(u);
  }

 private:
  static double objective(const std::vector<double>& u, std::vector<double>&, void* self) {
    return static_cast<Search*>(self)->cost(u);
  }
  [[nodiscard]] std::vector<double> values(const std::vector<double>& u) const {
    std::vector<double> out = start_;
    for (std::size_t j = 0; j < free_.size(); ++j) {
      const Parameter& p = residuals_.task().parameters[free_[j]];
      out[free_[j]] = std::clamp(axes_[free_[j]].value(u[j]), p.min, p.max);
    }
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
  const std::vector<Axis>& axes_;
  std::vector<std::size_t> free_;
  std::exception_ptr failure_;
};

bool apart(const std::vector<double>& a, const std::vector<double>& b, const std::vector<Axis>& axes) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (std::abs(axes[k].position(a[k]) - axes[k].position(b[k])) > kSame) return true;
  }
  return false;
}

/// Best first, one of each place.
std::vector<GlobalPoint> distinct(std::vector<GlobalPoint> all, const std::vector<Axis>& axes) {
  std::stable_sort(all.begin(), all.end(), [](const GlobalPoint& a, const GlobalPoint& b) { return a.cost < b.cost; });
  std::vector<GlobalPoint> out;
  for (GlobalPoint& p : all) {
    const bool worth = out.empty() || p.cost <= kWorst * out.front().cost;
    const bool other = std::all_of(out.begin(), out.end(), [&](const GlobalPoint& q) { return apart(p.values, q.values, axes); });
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
  std::vector<Axis> axes;
  std::vector<double> start;
  for (const Parameter& p : task.parameters) {
    axes.emplace_back(p);
    start.push_back(p.start);
  }
  const std::vector<bool> seen = seen_by(residuals, start, axes);
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
    const std::vector<double> rough = Search(residuals, start, axes, free).run(options.seed + static_cast<unsigned>(i), most);
    found[i] = {rough, kHopeless};
    if (residuals.at_all({rough})[0].empty()) return;
    FitOptions local;
    local.tolerance = 1e-6;
    local.iterations = 50;
    const StartResult polished = solve(residuals, rough, fixed, local);
    const double before = residuals.cost(residuals.at(rough)), after = residuals.cost(residuals.at(polished.to));
    found[i] = after < before ? GlobalPoint{polished.to, after} : GlobalPoint{rough, before};
  });
  out.points = distinct(std::move(found), axes);
  return out;
}

}  // namespace vsa::identify
