// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/identify/jobs.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>

#include "identify/error_model.hpp"
#include "identify/surrogate.hpp"

namespace vsa::identify {
namespace {

/// Correlation of neighbours, of one recording's residuals.
double neighbours(const std::vector<Segment>& branches, std::size_t observation, const std::vector<double>& residuals) {
  double products = 0, squares = 0;
  for (const Segment& s : branches) {
    if (s.observation != observation) continue;
    for (std::size_t i = s.first; i < s.last; ++i) {
      squares += residuals[i] * residuals[i];
      if (i + 1 < s.last) products += residuals[i] * residuals[i + 1];
    }
  }
  return squares > 0 ? products / squares : 0.0;
}

std::size_t block_length(double rho, std::size_t points) {
  constexpr double kLargestRho = 0.95;
  const double r = std::clamp(rho, 0.0, kLargestRho);
  const auto length = static_cast<std::size_t>(std::ceil(3 * (1 + r) / (1 - r)));
  return std::clamp<std::size_t>(length, 1, std::max<std::size_t>(1, points / 2));
}

}  // namespace

std::vector<double> presets_of(const Task& task) {
  std::set<double> out;
  for (const Observation& o : task.observations) out.insert(o.preset);
  return {out.begin(), out.end()};
}

Task part_of(const Task& task, double preset, bool in) {
  std::vector<std::size_t> which;
  for (std::size_t o = 0; o < task.observations.size(); ++o)
    if ((task.observations[o].preset == preset) == in) which.push_back(o);
  const auto picked = [&which](const Model& model) -> Model {
    if (!model) return nullptr;
    return [model, which](const std::vector<double>& values, std::size_t o) { return model(values, which[o]); };
  };
  Task out;
  out.parameters = task.parameters;
  for (const std::size_t o : which) out.observations.push_back(task.observations[o]);
  out.model = picked(task.model);
  out.surrogate = picked(task.surrogate);
  out.no_surrogate = task.no_surrogate;
  out.prepare = task.prepare;
  return out;
}

std::vector<Observation> drawn(const Residuals& residuals, const std::vector<double>& at, unsigned seed, unsigned draw) {
  std::seed_seq mixed{seed, draw};
  std::mt19937_64 random(mixed);
  std::vector<Observation> out = residuals.task().observations;
  const std::vector<Segment> branches = segments(residuals.points());
  for (const Segment& s : branches) {
    const std::size_t length = block_length(neighbours(branches, s.observation, at), s.last - s.first);
    const std::size_t cut = random() % length;
    bool kept = true;
    for (std::size_t i = s.first; i < s.last; ++i) {
      if (i == s.first || (i - s.first + cut) % length == 0) kept = random() >> 63 == 0;
      const Point& p = residuals.points()[i];
      experiment::Branches& data = out[p.observation].data;
      if (!kept) (p.rising ? data.rising_rad : data.falling_rad)[p.grid] += 2 * at[i];
    }
  }
  return out;
}

StartResult Worker::solve(const Job& job) {
  Task task = job.without ? part_of(task_, presets_of(task_).at(*job.without), false) : task_;
  if (task.prepare) task.prepare(job.from);
  std::size_t before = 0;
  if (job.draw > 0) {
    const Residuals fitted(task, 1);
    task.observations = drawn(fitted, fitted.at(job.from), options_.seed, job.draw);
    before = fitted.evaluations();
  }
  const Residuals residuals(task, 1);
  const std::vector<bool> fixed = job.fixed.empty() ? std::vector<bool>(job.from.size(), false) : job.fixed;
  StartResult out = identify::solve(residuals, job.led ? led_by_surrogate(residuals, job.from) : job.from, fixed, options_);
  out.from = job.from;
  if (task.prepare) task.prepare(out.to);
  const std::vector<double> left = residuals.at(out.to);
  out.cost = residuals.cost(left);
  out.rms_rad = rms(left);
  out.evaluations = before + residuals.evaluations();
  return out;
}

std::size_t job_size(std::size_t parameters) { return 3 + 2 * parameters; }

std::vector<double> numbers_of(const Job& job) {
  std::vector<double> out{job.without ? static_cast<double>(*job.without) : -1.0, job.led ? 1.0 : 0.0,
                          static_cast<double>(job.draw)};
  out.insert(out.end(), job.from.begin(), job.from.end());
  for (std::size_t k = 0; k < job.from.size(); ++k) out.push_back(!job.fixed.empty() && job.fixed[k] ? 1.0 : 0.0);
  return out;
}

Job job_of(const std::vector<double>& numbers) {
  const std::size_t parameters = (numbers.size() - 3) / 2;
  Job out;
  if (numbers[0] >= 0) out.without = static_cast<std::size_t>(numbers[0]);
  out.led = numbers[1] != 0;
  out.draw = static_cast<unsigned>(numbers[2]);
  const auto from = numbers.begin() + 3, fixed = from + static_cast<std::ptrdiff_t>(parameters);
  out.from.assign(from, fixed);
  for (auto at = fixed; at != numbers.end(); ++at) out.fixed.push_back(*at != 0);
  return out;
}

std::size_t result_size(std::size_t parameters) { return 5 + 2 * parameters; }

std::vector<double> numbers_of(const StartResult& r) {
  std::vector<double> out{r.rms_rad, r.cost, static_cast<double>(r.iterations), r.converged ? 1.0 : 0.0,
                          static_cast<double>(r.evaluations)};
  out.insert(out.end(), r.to.begin(), r.to.end());
  std::vector<double> steps = r.steps;
  steps.resize(r.to.size(), 0.0);  // nothing was free
  out.insert(out.end(), steps.begin(), steps.end());
  return out;
}

StartResult result_of(const std::vector<double>& numbers) {
  const auto to = numbers.begin() + 5, steps = to + static_cast<std::ptrdiff_t>((numbers.size() - 5) / 2);
  StartResult out;
  out.rms_rad = numbers[0];
  out.cost = numbers[1];
  out.iterations = static_cast<int>(numbers[2]);
  out.converged = numbers[3] != 0;
  out.evaluations = static_cast<std::size_t>(numbers[4]);
  out.to.assign(to, steps);
  out.steps.assign(steps, numbers.end());
  return out;
}

}  // namespace vsa::identify
