// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/identify/identification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "vsa/experiment/bench.hpp"
#include "vsa/not_a_number.hpp"
#include "vsa/quantile.hpp"

namespace vsa::identify {
namespace {

std::vector<double> type_values(const Task& task) {
  std::vector<double> out;
  for (const Parameter& p : task.parameters) out.push_back(p.start);
  return out;
}

/// The first generation's jobs for all recordings, or for those without a preset.
std::vector<Job> starts_of(const Residuals& residuals, const FitOptions& o, std::optional<std::size_t> without) {
  std::vector<Job> out;
  for (std::vector<double>& from : starting_points(residuals, o)) out.push_back({without, std::move(from), o.global, {}, 0});
  return out;
}

/// Those that were found, of jobs first … first + count − 1.
std::vector<StartResult> found_of(const std::vector<Done>& done, std::size_t first, std::size_t count) {
  std::vector<StartResult> out;
  for (std::size_t i = first; i < first + count; ++i)
    if (done[i].result) out.push_back(*done[i].result);
  if (!out.empty()) return out;
  throw std::runtime_error("no start could be fitted: " + done[first].error);
}

std::vector<Done> made(const std::vector<Job>& jobs, const DoJobs& do_jobs, Identification& r) {
  std::vector<Done> out = do_jobs(jobs);
  for (const Done& d : out) r.evaluations += d.result ? d.result->evaluations : 0;
  return out;
}

LeftOut judged(const Task& task, double preset, const std::vector<double>& values, const std::vector<double>& of_all,
               std::size_t& evaluations) {
  const Task test = part_of(task, preset, true);
  const Residuals residuals(test, 0);
  LeftOut out{preset, values, {}, 0, 0};
  if (task.prepare) task.prepare(of_all);
  out.rms_rad_of_all = rms(residuals.at(of_all));
  if (task.prepare) task.prepare(values);
  const std::vector<double> at = residuals.at(values);
  out.rms_rad = rms(at);
  out.misfits = misfits(residuals, at);
  evaluations += residuals.evaluations();
  return out;
}

/// A parameter's profile as jobs.
std::vector<Job> profile_jobs(const Identification& r, std::size_t k, int points) {
  const Parameter& p = r.task.parameters[k];
  const double se = r.uncertainty.standard_error[k], half = std::isfinite(se) ? 3 * se : 0.1 * (p.max - p.min);
  const double low = std::clamp(r.fit.values[k] - half, p.min, p.max), high = std::clamp(r.fit.values[k] + half, p.min, p.max);
  std::vector<Job> out;
  for (int i = 0; i < points; ++i) {
    Job job{std::nullopt, r.fit.values, false, std::vector<bool>(r.fit.values.size(), false), 0};
    job.from[k] = points == 1 ? low : low + (high - low) * i / (points - 1);
    job.fixed[k] = true;
    out.push_back(std::move(job));
  }
  return out;
}

void summarize(Bootstrap& b, std::size_t parameters) {
  b.standard_error = b.low = b.high = std::vector<double>(parameters, kNaN);
  const auto n = static_cast<double>(b.values.size());
  if (b.values.size() < 2) return;
  for (std::size_t k = 0; k < parameters; ++k) {
    std::vector<double> all;
    double mean = 0, squares = 0;
    for (const auto& values : b.values) all.push_back(values[k]);
    for (const double v : all) mean += v / n;
    for (const double v : all) squares += (v - mean) * (v - mean);
    std::sort(all.begin(), all.end());
    b.standard_error[k] = std::sqrt(squares / (n - 1));
    b.low[k] = quantile(all, 0.025);
    b.high[k] = quantile(all, 0.975);
  }
}

void fit_starts(Identification& r, const Residuals& residuals, const IdentificationOptions& o, const DoJobs& do_jobs) {
  const std::vector<double> presets = presets_of(r.task);
  std::vector<Job> jobs = starts_of(residuals, o.fit, std::nullopt);
  const std::size_t of_all = jobs.size();
  std::vector<std::size_t> of_each;  // jobs without each preset
  if (o.cross_validation && presets.size() > 1) {
    for (std::size_t p = 0; p < presets.size(); ++p) {
      const Task kept = part_of(r.task, presets[p], false);
      const Residuals training(kept, 0);
      const std::vector<Job> more = starts_of(training, o.fit, p);
      r.evaluations += training.evaluations();
      of_each.push_back(more.size());
      jobs.insert(jobs.end(), more.begin(), more.end());
    }
  }
  const std::vector<Done> done = made(jobs, do_jobs, r);
  r.fit = best_of(residuals, found_of(done, 0, of_all), o.fit);
  if (o.digits > 0) {
    for (std::size_t k = 0; k < r.fit.values.size(); ++k) {
      const Parameter& p = r.task.parameters[k];
      r.fit.values[k] = std::clamp(rounded(r.fit.values[k], o.digits), p.min, p.max);
    }
    evaluate_at(r.fit, residuals, o.fit.interval_effect_rad);
  }
  std::size_t first = of_all;
  for (std::size_t p = 0; p < of_each.size(); first += of_each[p++]) {
    const std::vector<StartResult> found = found_of(done, first, of_each[p]);
    const auto least = [](const StartResult& a, const StartResult& b) { return a.cost < b.cost; };
    r.left_out.push_back(
        judged(r.task, presets[p], std::min_element(found.begin(), found.end(), least)->to, r.fit.values, r.evaluations));
  }
}

void fit_about(Identification& r, const IdentificationOptions& o, const DoJobs& do_jobs) {
  const std::size_t parameters = r.fit.values.size();
  std::vector<Job> jobs;
  for (std::size_t k = 0; o.profile > 0 && k < parameters; ++k) {
    const std::vector<Job> more = profile_jobs(r, k, o.profile);
    jobs.insert(jobs.end(), more.begin(), more.end());
  }
  const std::size_t profiles = jobs.size();
  for (int d = 1; d <= o.draws; ++d) jobs.push_back({std::nullopt, r.fit.values, false, {}, static_cast<unsigned>(d)});
  if (jobs.empty()) return;
  const std::vector<Done> done = made(jobs, do_jobs, r);
  for (std::size_t i = 0; i < profiles; ++i) {
    const std::size_t k = i / static_cast<std::size_t>(o.profile);
    if (r.profiles.size() == k) r.profiles.emplace_back();
    r.profiles.back().push_back({jobs[i].from[k], done[i].result ? done[i].result->rms_rad : kNaN});
  }
  if (o.draws == 0) return;
  Bootstrap& b = r.bootstrap.emplace();
  for (std::size_t i = profiles; i < done.size(); ++i) {
    if (done[i].result) {
      b.values.push_back(done[i].result->to);
      b.unconverged += done[i].result->converged ? 0 : 1;
    } else {
      ++b.failed;
    }
  }
  summarize(b, parameters);
}

}  // namespace

Identification identify(const MakeTask& make, const IdentificationOptions& o, const DoJobs& do_jobs) {
  Identification r;
  r.task = make(0);
  const Residuals residuals(r.task, 0);
  r.points = residuals.points();
  const std::vector<double> start = type_values(r.task);
  if (r.task.prepare) r.task.prepare(start);
  r.residuals_before = residuals.at(start);
  r.misfits_before = misfits(residuals, r.residuals_before);
  fit_starts(r, residuals, o, do_jobs);
  r.misfits = misfits(residuals, r.fit.residuals);
  r.uncertainty = uncertainty(residuals, r.fit);
  fit_about(r, o, do_jobs);
  r.evaluations += residuals.evaluations();
  return r;
}

DoJobs one_by_one(const MakeTask& make, const FitOptions& options) {
  return [worker = std::make_shared<Worker>(make(1), options)](const std::vector<Job>& jobs) {
    std::vector<Done> out;
    for (const Job& job : jobs) {
      try {
        out.push_back({worker->solve(job), ""});
      } catch (const experiment::Stopped&) {
        throw;
      } catch (const std::exception& error) {
        out.push_back({std::nullopt, error.what()});
      }
    }
    return out;
  };
}

}  // namespace vsa::identify
