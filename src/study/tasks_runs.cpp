// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "study/watched_runs.hpp"
#include "vsa/device/lever_batch.hpp"
#include "vsa/not_a_number.hpp"
#include "vsa/study/tasks.hpp"
#include "vsa/units.hpp"

namespace vsa::study {
namespace {

constexpr double kSample_s = 1e-3;  // commands and samples
constexpr double kRest_s = 2;       // before each task
constexpr double kSwing_rad = 1, kSwingStep_s = 0.05, kAfter_s = 1.5;
constexpr int kSwings = 25;
constexpr double kSettleWithin_s = 20, kBand = 0.05, kTail = 0.1;
constexpr double kGrow_s = 1, kWait_s = 4, kHold_s = 10, kMean_s = 1, kCreep_rad = 0.01;
constexpr double kThrow_s = kRest_s + (kSwings - 1) * kSwingStep_s + kAfter_s;
constexpr double kSettle_s = kRest_s + kSettleWithin_s;
constexpr double kHoldAll_s = kRest_s + kGrow_s + kWait_s + kHold_s;

/// Links of one type, alike, each with a preset and a command of its own.
class Links {
 public:
  Links(const TaskResults& of, std::size_t count, double step_s, experiment::Watch& watch)
      : batch_(of.actuator.unit, count, {.inertia_kgm2 = of.inertia_kgm2}),
        steps_(std::max(1, static_cast<int>(std::lround(kSample_s / step_s)))),
        step_ns_(std::llround(kSample_s * 1e9 / steps_)),
        watch_(watch) {}

  device::LeverBatch& batch() noexcept { return batch_; }
  [[nodiscard]] double step_s() const noexcept { return 1e-9 * static_cast<double>(step_ns_); }
  /// At rest, on for long.
  void rest(std::size_t i, double preset) {
    batch_.reset(i, 0, preset, 0);
    batch_.equilibrium()[i] = 0;
    batch_.preset()[i] = preset;
  }
  void step(int steps) {
    if (watch_.stop) throw experiment::Stopped();
    batch_.step(steps, step_ns_);
    watch_.simulated_ns += steps * step_ns_ * static_cast<std::int64_t>(batch_.size());
  }
  /// `each(k)` before the k-th millisecond.
  void run(double duration_s, const std::function<void(long)>& each = {}) {
    const long samples = std::lround(duration_s / kSample_s);
    for (long k = 0; k < samples; ++k) {
      if (each) each(k);
      step(steps_);
    }
  }
  [[nodiscard]] double supplied_J(std::size_t i) const { return batch_.units().state(i).actuator.ledger.supply; }

 private:
  device::LeverBatch batch_;
  int steps_;
  std::int64_t step_ns_;
  experiment::Watch& watch_;
};

std::vector<ThrowResult> run_throw(const TaskResults& of, double step_s, experiment::Watch& watch) {
  const std::size_t count = of.presets.size() * kSwings;
  Links links(of, count, step_s, watch);
  const auto swing = [](std::size_t i) { return std::lround(static_cast<double>(i % kSwings) * kSwingStep_s / kSample_s); };
  for (std::size_t i = 0; i < count; ++i) links.rest(i, of.presets[i / kSwings]);
  links.run(kRest_s);
  std::vector<double> fastest(count, 0.0);
  const auto look = [&](long k) {
    for (std::size_t i = 0; i < count; ++i) {
      const bool forward = k >= swing(i);
      links.batch().equilibrium()[i] = forward ? kSwing_rad : -kSwing_rad;
      if (forward) fastest[i] = std::max(fastest[i], links.batch().shaft_speed_rad_per_s()[i]);
    }
  };
  links.run(kThrow_s - kRest_s, look);
  std::vector<ThrowResult> out;
  for (std::size_t p = 0; p < of.presets.size(); ++p) {
    const auto first = fastest.begin() + static_cast<std::ptrdiff_t>(p * kSwings);
    const auto best = std::max_element(first, first + kSwings);
    out.push_back({of.presets[p], static_cast<double>(best - first) * kSwingStep_s, *best});
  }
  return out;
}

std::vector<SettleResult> run_settle(const TaskResults& of, double step_s, experiment::Watch& watch) {
  Links links(of, of.presets.size(), step_s, watch);
  for (std::size_t i = 0; i < of.presets.size(); ++i) links.rest(i, of.presets[i]);
  links.run(kRest_s);
  const auto push = [&](double torque_Nm) { std::fill(links.batch().push().begin(), links.batch().push().end(), torque_Nm); };
  push(of.inertia_kgm2 * kBlow_rad_per_s / links.step_s());
  links.step(1);
  push(0);
  std::vector<std::vector<double>> angle(of.presets.size());
  links.run(kSettleWithin_s, [&](long) {
    for (std::size_t i = 0; i < angle.size(); ++i) angle[i].push_back(links.batch().shaft_rad()[i]);
  });
  std::vector<SettleResult> out;
  for (std::size_t i = 0; i < angle.size(); ++i) {
    const double start = angle[i].front();
    const auto [low, high] = std::minmax_element(angle[i].begin(), angle[i].end());
    out.push_back({of.presets[i], settling_time_s(angle[i], kSample_s), std::max(*high - start, start - *low)});
  }
  return out;
}

std::vector<HoldResult> run_hold(const TaskResults& of, double step_s, experiment::Watch& watch) {
  const std::size_t count = of.presets.size();
  Links links(of, count, step_s, watch);
  for (std::size_t i = 0; i < count; ++i) links.rest(i, of.presets[i]);
  links.run(kRest_s);
  const auto angles = [&] { return std::vector<double>(links.batch().shaft_rad().begin(), links.batch().shaft_rad().end()); };
  // A small swing may go on for long, where the shaft's friction is elastic.
  const auto mean_angles = [&] {
    std::vector<double> sum(count, 0.0);
    links.run(kMean_s, [&](long) {
      for (std::size_t i = 0; i < count; ++i) sum[i] += links.batch().shaft_rad()[i];
    });
    for (double& angle : sum) angle *= kSample_s / kMean_s;
    return sum;
  };
  const auto supplied = [&] {
    std::vector<double> out;
    for (std::size_t i = 0; i < count; ++i) out.push_back(links.supplied_J(i));
    return out;
  };
  const std::vector<double> start = angles();
  links.run(kGrow_s + kWait_s - kMean_s, [&](long k) {
    const double share = std::min(1.0, static_cast<double>(k + 1) * kSample_s / kGrow_s);
    std::fill(links.batch().push().begin(), links.batch().push().end(), share * of.load_Nm);
  });
  const std::vector<double> before = mean_angles(), before_J = supplied();
  links.run(kHold_s - kMean_s);
  const std::vector<double> after = mean_angles(), after_J = supplied();
  std::vector<HoldResult> out;
  for (std::size_t i = 0; i < count; ++i) {
    const double sag = after[i] - start[i];
    const bool held = std::abs(after[i] - before[i]) < kCreep_rad && std::abs(sag) < kPi / 2;
    out.push_back({of.presets[i], held ? after_J[i] - before_J[i] : kNaN, sag});
  }
  return out;
}

}  // namespace

double settling_time_s(std::span<const double> angle, double sample_s) {
  const auto tail = static_cast<std::size_t>(kTail * static_cast<double>(angle.size()));
  if (tail == 0) return kNaN;
  const double rest =
      std::accumulate(angle.end() - static_cast<std::ptrdiff_t>(tail), angle.end(), 0.0) / static_cast<double>(tail);
  double way = 0;
  for (const double q : angle) way = std::max(way, std::abs(q - rest));
  std::size_t settled = angle.size();
  while (settled > 0 && std::abs(angle[settled - 1] - rest) <= kBand * way) --settled;
  if (way == 0 || settled > angle.size() - tail) return kNaN;
  return static_cast<double>(settled) * sample_s;
}

std::optional<Tasks> run(Tasks plan, const OnProgress& on_progress, unsigned threads) {
  experiment::Watch watch;
  std::vector<std::function<void()>> jobs;
  double total_s = 0;
  // The longest first, so that the threads end together.
  const auto add = [&](double per_preset_s, auto TaskResults::*results, auto task) {
    for (TaskResults& r : plan.each) {
      if (!std::isfinite(r.inertia_kgm2)) continue;
      total_s += per_preset_s * static_cast<double>(r.presets.size());
      jobs.emplace_back([&r, &watch, results, task, step_s = plan.step_s] { r.*results = task(r, step_s, watch); });
    }
  };
  add(kSwings * kThrow_s, &TaskResults::throws, run_throw);
  add(kSettle_s, &TaskResults::settles, run_settle);
  add(kHoldAll_s, &TaskResults::holds, run_hold);
  return run_watched(jobs, watch, total_s, on_progress, threads) ? std::optional(std::move(plan)) : std::nullopt;
}

}  // namespace vsa::study
