// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/identify/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace vsa::identify {

std::vector<ProfilePoint> profile(const Residuals& residuals, const Fit& fit, std::size_t parameter, double low, double high,
                                  int points, const FitOptions& options) {
  const Parameter& p = residuals.task().parameters[parameter];
  low = std::clamp(low, p.min, p.max);
  high = std::clamp(high, p.min, p.max);
  std::vector<bool> fixed(fit.values.size(), false);
  fixed[parameter] = true;
  std::vector<ProfilePoint> out;
  for (int i = 0; i < points; ++i) {
    std::vector<double> from = fit.values;
    from[parameter] = points == 1 ? low : low + (high - low) * i / (points - 1);
    const StartResult found = solve(residuals, from, fixed, options);
    out.push_back({from[parameter], found.rms_rad});
    if (options.progress) options.progress(fmt::format("profile of {}: {} of {}", p.name, i + 1, points));
  }
  return out;
}

std::vector<LeftOut> leave_one_preset_out(const Task& task, const Fit& fit, const FitOptions& options, unsigned threads) {
  std::set<double> presets;
  for (const Observation& o : task.observations) presets.insert(o.preset);
  std::vector<LeftOut> out;
  if (presets.size() < 2) return out;
  for (double preset : presets) {
    std::vector<std::size_t> kept, left;
    for (std::size_t o = 0; o < task.observations.size(); ++o) (task.observations[o].preset == preset ? left : kept).push_back(o);
    const auto part = [&](const std::vector<std::size_t>& which) {
      Task t;
      t.parameters = task.parameters;
      for (std::size_t o : which) t.observations.push_back(task.observations[o]);
      t.model = [&task, which](const std::vector<double>& values, std::size_t o) { return task.model(values, which[o]); };
      if (task.surrogate)
        t.surrogate = [&task, which](const std::vector<double>& values, std::size_t o) { return task.surrogate(values, which[o]); };
      t.no_surrogate = task.no_surrogate;
      t.prepare = task.prepare;
      return t;
    };
    const Task training = part(kept), test = part(left);
    const Residuals training_residuals(training, threads), test_residuals(test, threads);
    LeftOut result{preset, {}, {}, 0, 0};
    if (task.prepare) task.prepare(fit.values);
    result.rms_rad_of_all = rms(test_residuals.at(fit.values));
    result.values = identify::fit(training_residuals, options).values;
    if (task.prepare) task.prepare(result.values);
    const std::vector<double> residuals = test_residuals.at(result.values);
    result.rms_rad = rms(residuals);
    result.misfits = misfits(test_residuals, residuals);
    out.push_back(std::move(result));
    if (options.progress) options.progress(fmt::format("without preset {:.4f}: RMS {:.5f} rad on it", preset, out.back().rms_rad));
  }
  return out;
}

}  // namespace vsa::identify
