// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sweep/optimize.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vsa/errors.hpp"
#include "vsa/not_a_number.hpp"

#ifdef VSA_PAGMO
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/gaco.hpp>
#include <pagmo/algorithms/maco.hpp>
#include <pagmo/algorithms/nsga2.hpp>
#include <pagmo/algorithms/nspso.hpp>
#include <pagmo/algorithms/pso_gen.hpp>
#include <pagmo/batch_evaluators/member_bfe.hpp>
#include <pagmo/bfe.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#endif

namespace vsa::sweep {

std::vector<double> objectives_of(const Plan& plan, const std::vector<Outcome>& outcomes, std::size_t candidate) {
  const Search& search = *plan.search();
  const std::size_t each = plan.runs() / plan.candidates();
  std::vector<double> out;
  for (const Objective& o : search.objectives) {
    std::vector<double> values;
    for (std::size_t r = candidate * each; r < (candidate + 1) * each; ++r)
      values.push_back(outcomes[r].values.empty() ? kNaN : outcomes[r].values[o.measure]);
    if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) {
      out.push_back(kNaN);
      continue;
    }
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    double sum = 0;
    for (const double v : values) sum += v;
    out.push_back(o.over == Objective::Over::mean    ? sum / static_cast<double>(n)
                  : o.over == Objective::Over::worst ? (o.maximize ? values.front() : values.back())
                                                     : 0.5 * (values[(n - 1) / 2] + values[n / 2]));
  }
  return out;
}

std::vector<std::size_t> not_beaten(const std::vector<std::vector<double>>& objectives, const Search& search) {
  const auto cost = [&](std::size_t c, std::size_t o) {
    return search.objectives[o].maximize ? -objectives[c][o] : objectives[c][o];
  };
  const auto whole = [&](std::size_t c) {
    return std::all_of(objectives[c].begin(), objectives[c].end(), [](double v) { return std::isfinite(v); });
  };
  const auto beats = [&](std::size_t a, std::size_t b) {
    bool better = false;
    for (std::size_t o = 0; o < search.objectives.size(); ++o) {
      if (cost(a, o) > cost(b, o)) return false;
      better = better || cost(a, o) < cost(b, o);
    }
    return better;
  };
  std::vector<std::size_t> out;
  for (std::size_t c = 0; c < objectives.size(); ++c) {
    if (!whole(c)) continue;
    bool beaten = false;
    for (std::size_t other = 0; other < objectives.size() && !beaten; ++other)
      beaten = whole(other) && (beats(other, c) || (other < c && objectives[other] == objectives[c]));
    if (!beaten) out.push_back(c);
  }
  std::stable_sort(out.begin(), out.end(), [&](std::size_t a, std::size_t b) { return cost(a, 0) < cost(b, 0); });
  return out;
}

#ifdef VSA_PAGMO
bool has_optimizer() noexcept { return true; }

namespace {

/// What pagmo minimises: copies of it share the search.
struct PlanProblem {
  struct State {
    const Plan* plan = nullptr;
    const Evaluate* evaluate = nullptr;
    std::vector<std::vector<double>> candidates, objectives;
  };
  State* state = nullptr;

  [[nodiscard]] std::size_t dimensions() const {
    const auto& axes = state->plan->axes();
    return static_cast<std::size_t>(
        std::count_if(axes.begin(), axes.end(), [](const Axis& a) { return a.kind == Axis::Kind::searched; }));
  }
  // NOLINTBEGIN(readability-identifier-naming): pagmo asks by these names
  [[nodiscard]] std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(dimensions(), 0.0), pagmo::vector_double(dimensions(), 1.0)};
  }
  [[nodiscard]] pagmo::vector_double::size_type get_nobj() const { return state->plan->search()->objectives.size(); }
  [[nodiscard]] pagmo::vector_double fitness(const pagmo::vector_double& one) const { return batch_fitness(one); }
  [[nodiscard]] pagmo::vector_double batch_fitness(const pagmo::vector_double& all) const {
    constexpr double kWorst = 1e30;  // where runs failed; pagmo knows no NaN
    const std::size_t n = dimensions(), before = state->candidates.size();
    for (std::size_t at = 0; at < all.size(); at += n)
      state->candidates.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(at),
                                     all.begin() + static_cast<std::ptrdiff_t>(at + n));
    const Plan plan = state->plan->with(state->candidates);
    const std::size_t each = plan.runs() / plan.candidates();
    const std::vector<Outcome> outcomes = (*state->evaluate)(plan, before * each);
    pagmo::vector_double out;
    for (std::size_t c = before; c < state->candidates.size(); ++c) {
      state->objectives.push_back(objectives_of(plan, outcomes, c));
      for (std::size_t o = 0; o < state->objectives.back().size(); ++o) {
        const double value = state->objectives.back()[o];
        out.push_back(!std::isfinite(value) ? kWorst : plan.search()->objectives[o].maximize ? -value : value);
      }
    }
    return out;
  }
  // NOLINTEND(readability-identifier-naming)
};

template <class Algorithm>
pagmo::algorithm by_generations(Algorithm algorithm) {
  algorithm.set_bfe(pagmo::bfe{pagmo::member_bfe{}});
  return pagmo::algorithm{std::move(algorithm)};
}

pagmo::algorithm algorithm_of(const Search& s, unsigned seed) {
  const unsigned gen = s.generations, ker = std::min(63U, s.population);
  if (s.algorithm == "gaco")
    return by_generations(pagmo::gaco(gen, ker, 1.0, 0.0, 0.01, 1U, 7U, 100000U, 100000U, 0.0, false, seed));
  if (s.algorithm == "nsga2") return by_generations(pagmo::nsga2(gen, 0.95, 10.0, 0.01, 50.0, seed));
  if (s.algorithm == "nspso")
    return by_generations(
        pagmo::nspso(gen, 0.6, 2.0, 2.0, 1.0, 0.5, std::min(60U, s.population), "crowding distance", false, seed));
  if (s.algorithm == "maco") return by_generations(pagmo::maco(gen, ker, 1.0, 1U, 7U, 100000U, 0.0, false, seed));
  return by_generations(pagmo::pso_gen(gen, 0.7298, 2.05, 2.05, 0.5, 5U, 2U, 4U, false, seed));
}

}  // namespace

Optimum optimize(const Plan& plan, const Evaluate& evaluate) {
  if (!plan.search()) throw InputError({"", "vary", "", "nothing is searched", "an axis with search = [from, to]"});
  PlanProblem::State state{&plan, &evaluate, {}, {}};
  const auto seed = static_cast<unsigned>(plan.seed() % 4294967291U);
  const pagmo::problem problem{PlanProblem{&state}};
  const pagmo::population first{problem, pagmo::bfe{pagmo::member_bfe{}}, plan.search()->population, seed};
  static_cast<void>(algorithm_of(*plan.search(), seed).evolve(first));
  Optimum out{plan.with(state.candidates), state.objectives, {}};
  out.best = not_beaten(out.objectives, *plan.search());
  return out;
}
#else
bool has_optimizer() noexcept { return false; }

Optimum optimize(const Plan&, const Evaluate&) {
  throw InputError({"", "", "", "this build has no optimiser", "one that was configured where pagmo is (libpagmo-dev)"});
}
#endif

}  // namespace vsa::sweep
