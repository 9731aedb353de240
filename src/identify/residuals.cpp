// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/identify/residuals.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>

#include "vsa/errors.hpp"
#include "vsa/experiment/bench.hpp"
#include "vsa/experiment/parallel.hpp"

namespace vsa::identify {
namespace {

constexpr double kSameTorque_Nm = 1e-9;

/// The model's branch at a torque. Where its sweep ends short of it, the line through its last two points goes on: a point more or
/// less must not be a cliff for the optimiser. NaN: the branch has fewer than two points.
double model_at(const experiment::Branches& model, bool rising, double torque) {
  const std::vector<double>& value = rising ? model.rising_rad : model.falling_rad;
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (std::isfinite(value[i])) known.push_back(i);
  }
  if (known.size() < 2) return std::nan("");
  const auto below = [&](std::size_t i, double t) { return model.torque_Nm[i] < t; };
  const auto it = std::lower_bound(known.begin(), known.end(), torque - kSameTorque_Nm, below);
  const std::size_t next = std::clamp<std::size_t>(static_cast<std::size_t>(it - known.begin()), 1, known.size() - 1);
  const std::size_t a = known[next - 1], b = known[next];
  for (const std::size_t i : {a, b})  // places at rest may have one load several times
    if (std::abs(model.torque_Nm[i] - torque) <= kSameTorque_Nm) return value[i];
  const double slope = (value[b] - value[a]) / (model.torque_Nm[b] - model.torque_Nm[a]);
  return value[b] + slope * (torque - model.torque_Nm[b]);
}

}  // namespace

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (double v : values) sum += v * v;
  return values.empty() ? std::nan("") : std::sqrt(sum / static_cast<double>(values.size()));
}

Residuals::Residuals(const Task& task, unsigned threads) : task_(task), threads_(threads) {
  Problems problems;
  for (std::size_t o = 0; o < task.observations.size(); ++o) {
    const experiment::Branches& data = task.observations[o].data;
    const std::size_t before = points_.size();
    for (bool rising : {true, false}) {
      const std::vector<double>& branch = rising ? data.rising_rad : data.falling_rad;
      for (std::size_t g = 0; g < branch.size(); ++g) {
        if (std::isfinite(branch[g])) points_.push_back({o, rising, g});
      }
    }
    if (points_.size() == before) {
      problems.add({task.observations[o].name, "", "", "holds no branch of a load cycle", "a sweep of more than half a cycle"});
    }
  }
  if (task.observations.empty()) problems.add({"", "recordings", "", "there is none", "one or more"});
  problems.throw_if_any();
}

std::vector<std::vector<double>> Residuals::at_all(const std::vector<std::vector<double>>& many) const {
  const std::size_t observations = task_.observations.size();
  std::vector<experiment::Branches> runs(many.size() * observations);
  std::vector<char> failed(runs.size(), 0);
  experiment::run_in_parallel(runs.size(), threads_, [&](std::size_t job) {
    try {
      runs[job] = task_.model(many[job / observations], job % observations);
    } catch (const experiment::Stopped&) {
      throw;
    } catch (const std::exception&) {
      failed[job] = 1;
    }
  });
  evaluations_ += runs.size();
  std::vector<std::vector<double>> out(many.size());
  for (std::size_t m = 0; m < many.size(); ++m) {
    const auto begin = failed.begin() + static_cast<std::ptrdiff_t>(m * observations);
    if (std::count(begin, begin + static_cast<std::ptrdiff_t>(observations), 1) > 0) continue;
    for (const Point& p : points_) {
      const experiment::Branches& data = task_.observations[p.observation].data;
      const double value = model_at(runs[m * observations + p.observation], p.rising, data.torque_Nm[p.grid]);
      const double measured = p.rising ? data.rising_rad[p.grid] : data.falling_rad[p.grid];
      out[m].push_back(std::isfinite(value) ? value - measured : kMissing_rad);
    }
  }
  return out;
}

std::vector<double> Residuals::at(const std::vector<double>& values) const {
  std::vector<std::vector<double>> out = at_all({values});
  if (!out[0].empty()) return out[0];
  for (std::size_t o = 0; o < task_.observations.size(); ++o) (void)task_.model(values, o);  // throws what was wrong
  throw std::runtime_error("the model failed once and then didn't");
}

std::vector<std::vector<double>> Residuals::jacobian(const std::vector<double>& values, const std::vector<double>& here,
                                                     const std::vector<double>& step, const std::vector<std::size_t>& which) const {
  std::vector<std::vector<double>> trials;
  for (const std::size_t k : which) {
    for (const double side : {1.0, -1.0}) {
      trials.push_back(values);
      const Parameter& p = task_.parameters[k];
      trials.back()[k] = p.value_at(p.coordinate(values[k]) + side * step[k]);
    }
  }
  const std::vector<std::vector<double>> found = at_all(trials);
  std::vector<std::vector<double>> columns(which.size());
  for (std::size_t j = 0; j < which.size(); ++j) {
    const std::size_t k = which[j];
    const std::vector<double>& up = found[2 * j].empty() ? here : found[2 * j];
    const std::vector<double>& down = found[2 * j + 1].empty() ? here : found[2 * j + 1];
    const Parameter& p = task_.parameters[k];
    const double x_up = p.coordinate(found[2 * j].empty() ? values[k] : trials[2 * j][k]);
    const double x_down = p.coordinate(found[2 * j + 1].empty() ? values[k] : trials[2 * j + 1][k]);
    if (x_up == x_down) return {};
    for (std::size_t i = 0; i < here.size(); ++i) columns[j].push_back((up[i] - down[i]) / (x_up - x_down));
  }
  return columns;
}

std::vector<double> Residuals::steps(const std::vector<double>& values, const std::vector<double>& here, double effect_rad,
                                     std::vector<double> first) const {
  constexpr int kRounds = 4;
  constexpr double kNear = 2.0;  // a step this close to the right one is right
  std::vector<double> step = std::move(first);
  for (std::size_t k = step.size(); k < values.size(); ++k) {
    const Parameter& p = task_.parameters[k];
    step.push_back(p.logarithmic() ? 0.02 : 0.02 * std::max(std::abs(values[k]), 1e-2 * p.span()));
  }
  std::vector<std::size_t> open(values.size());
  std::iota(open.begin(), open.end(), std::size_t{0});
  for (int round = 0; round < kRounds && !open.empty(); ++round) {
    std::vector<std::vector<double>> trials;
    for (std::size_t k : open) {
      trials.push_back(values);
      const Parameter& p = task_.parameters[k];
      const double at = p.coordinate(values[k]);
      trials.back()[k] = p.value_at(at + step[k] <= p.coordinate(p.max) ? at + step[k] : at - step[k]);
    }
    const auto found = at_all(trials);
    std::vector<std::size_t> still;
    for (std::size_t i = 0; i < open.size(); ++i) {
      std::vector<double> change;
      for (std::size_t j = 0; j < found[i].size(); ++j) change.push_back(found[i][j] - here[j]);
      const double ratio = found[i].empty() ? 0.1 : std::clamp(effect_rad / std::max(rms(change), 1e-12), 0.05, 20.0);
      const Parameter& p = task_.parameters[open[i]];
      const double next = std::clamp(step[open[i]] * ratio, 1e-9 * p.span(), 0.1 * p.span());
      if (next > kNear * step[open[i]] || next < step[open[i]] / kNear) {
        step[open[i]] = next;
        still.push_back(open[i]);
      }
    }
    open = std::move(still);
  }
  return step;
}

double Residuals::cost(const std::vector<double>& residuals) const {
  double sum = 0;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const double r = weight(i) * residuals[i];
    sum += 0.5 * r * r;
  }
  return sum;
}

std::vector<Misfit> misfits(const Residuals& residuals, const std::vector<double>& values) {
  const Task& task = residuals.task();
  std::vector<std::vector<double>> both(task.observations.size()), rising = both, falling = both;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Point& p = residuals.points()[i];
    both[p.observation].push_back(values[i]);
    (p.rising ? rising : falling)[p.observation].push_back(values[i]);
  }
  std::vector<Misfit> out;
  for (std::size_t o = 0; o < both.size(); ++o) {
    out.push_back(
        {task.observations[o].name, task.observations[o].preset, {rms(both[o]), rms(rising[o]), rms(falling[o]), both[o].size()}});
  }
  return out;
}

}  // namespace vsa::identify
