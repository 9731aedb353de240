// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/identify/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "vsa/config/text.hpp"
#include "vsa/experiment/parallel.hpp"
#include "vsa/hash.hpp"
#include "vsa/identify/uncertainty.hpp"

namespace vsa::identify {
namespace {

std::string list(const std::vector<double>& values) {
  std::string out;
  for (const double v : values) out += fmt::format("{} ", v);
  return out;
}

std::string text_of(const Observation& o) {
  const experiment::Branches& b = o.data;
  return fmt::format("recording {} {} {}\n{}\n{}\n{}\n", std::filesystem::path(o.name).filename().string(), o.preset, o.weight,
                     list(b.torque_Nm), list(b.rising_rad), list(b.falling_rad));
}

/// What is the same for all fits of a hypothesis.
std::string text_of(const Comparison& c, const Hypothesis& h) {
  std::string out = "fit 2\nlaw " + h.type.law + '\n';
  for (const config::Entry& e : h.type.entries) out += e.key + " = " + e.value + '\n';
  for (const Parameter& p : h.free) out += fmt::format("free {} {} {} {}\n", p.name, p.start, p.min, p.max);
  out +=
      fmt::format("sweep {} {} {} {}\n", c.sweep.period_s, c.sweep.amplitude_rad.value_or(0.0), c.sweep.cycles, c.sweep.sample_s);
  if (c.sweep.load_share != 1) out += fmt::format("load {}\n", c.sweep.load_share);
  out += fmt::format("fit {} {} {} {} {} {} {}\n", c.fit.starts, c.fit.seed, c.fit.global, c.fit.iterations, c.fit.effect_rad,
                     c.fit.interval_effect_rad, c.fit.tolerance);
  return out;
}

/// A second of the bench, to a microradian; of places at rest, which the law alone predicts, the law's.
std::string physics_of(const Hypothesis& h, const Observation& o, double load_share, experiment::Watch* watch) {
  if (o.points) {
    std::string out = "law";
    for (const double load_Nm : o.data.torque_Nm)
      out += fmt::format(" {:.6f}", experiment::law_deflection(*h.type.unit.actuator.transmission, o.preset, load_Nm));
    return out + '\n';
  }
  SweepOptions brief;
  brief.period_s = 1.0;
  brief.amplitude_rad = 1.0;
  brief.sample_s = 0.05;
  brief.load_share = load_share;
  std::string out = "bench";
  for (const double d : simulated_recording(h.specimen, o.preset, brief, watch).deflection_rad) out += fmt::format(" {:.6f}", d);
  return out + '\n';
}

Task task_of(const Comparison& c, const Hypothesis& h, const std::vector<std::size_t>& which) {
  Task task;
  task.parameters = h.free;
  for (const std::size_t o : which) task.observations.push_back(c.recordings[o]);
  return task;
}

std::vector<std::size_t> kept_of(const Comparison& c, const FitRequest& request) {
  std::vector<std::size_t> out;
  for (std::size_t o = 0; o < c.recordings.size(); ++o) {
    if (request.without != o) out.push_back(o);
  }
  return out;
}

void describe(FitRecord& record, const Task& task, const Fit& found, const Uncertainty& u) {
  for (std::size_t k = 0; k < task.parameters.size(); ++k) {
    record.estimates.push_back({task.parameters[k].name, task.parameters[k].unit, found.values[k], u.low[k], u.high[k],
                                static_cast<bool>(found.at_bound[k])});
  }
  for (const std::size_t k : u.without_effect) record.without_effect.push_back(task.parameters[k].name);
  for (const auto& group : u.unseparated) {
    record.unseparated.emplace_back();
    for (const std::size_t k : group) record.unseparated.back().push_back(task.parameters[k].name);
  }
  record.autocorrelation = u.autocorrelation;
  record.independent = u.effective_samples;
  record.points = static_cast<double>(found.residuals.size());
  record.weighted_squares = 2 * found.cost;
  for (const StartResult& s : found.starts) record.start_rms.push_back(std::sqrt(2 * s.cost / record.points));
}

}  // namespace

std::size_t FitRecord::at_bounds() const {
  return static_cast<std::size_t>(std::count_if(estimates.begin(), estimates.end(), [](const Estimate& e) { return e.at_bound; }));
}

double FitRecord::spread() const { return start_rms.size() < 2 ? 0.0 : start_rms.back() / start_rms.front() - 1; }

std::vector<FitRequest> requests(const Comparison& c) {
  std::vector<FitRequest> out;
  for (std::size_t h = 0; h < c.hypotheses.size(); ++h) {
    out.push_back({h, std::nullopt});
    for (std::size_t o = 0; c.recordings.size() > 1 && o < c.recordings.size(); ++o) out.push_back({h, o});
  }
  return out;
}

std::string request_name(const Comparison& c, const FitRequest& request) {
  const std::string& name = c.hypotheses[request.hypothesis].name;
  return request.without ? name + ".without." + std::filesystem::path(c.recordings[*request.without].name).stem().string() : name;
}

std::vector<std::string> request_hashes(const Comparison& c, const std::vector<FitRequest>& all, unsigned threads,
                                        experiment::Watch* watch) {
  const std::size_t n = c.recordings.size();
  std::vector<std::string> physics(c.hypotheses.size() * n);
  experiment::run_in_parallel(physics.size(), threads, [&](std::size_t i) {
    physics[i] = physics_of(c.hypotheses[i / n], c.recordings[i % n], c.sweep.load_share, watch);
  });
  std::vector<std::string> out;
  for (const FitRequest& request : all) {
    std::string text = text_of(c, c.hypotheses[request.hypothesis]);
    for (std::size_t o = 0; o < n; ++o) text += physics[request.hypothesis * n + o] + text_of(c.recordings[o]);
    if (request.without) text += "without " + text_of(c.recordings[*request.without]);
    out.push_back(fmt::format("{:016x}", fnv1a(text)));
  }
  return out;
}

FitRecord run_fit(const Comparison& c, const FitRequest& request, unsigned threads, experiment::Watch* watch) {
  const auto begin = std::chrono::steady_clock::now();
  const Hypothesis& h = c.hypotheses[request.hypothesis];
  const std::vector<std::size_t> kept = kept_of(c, request);
  Task task = task_of(c, h, kept);
  use_bench(task, h.specimen, c.sweep, watch, threads);
  const Residuals residuals(task, threads);
  const Fit found = fit(residuals, c.fit);
  FitRecord record;
  describe(record, task, found, uncertainty(residuals, found));
  record.rms_rad.assign(c.recordings.size(), std::numeric_limits<double>::quiet_NaN());
  const std::vector<Misfit> fitted = misfits(residuals, found.residuals);
  for (std::size_t i = 0; i < kept.size(); ++i) record.rms_rad[kept[i]] = fitted[i].rms.both_rad;
  record.evaluations = residuals.evaluations();
  if (request.without) {
    Task other = task_of(c, h, {*request.without});
    use_bench(other, h.specimen, c.sweep, watch, threads);
    const Residuals left_out(other, threads);
    other.prepare(found.values);
    record.rms_rad[*request.without] = rms(left_out.at(found.values));
    record.evaluations += left_out.evaluations();
  }
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return record;
}

double aicc(double weighted_squares, double points, double independent, std::size_t parameters) {
  const double k = static_cast<double>(parameters) + 1, left = independent - k - 1;
  if (!(left > 0)) return std::numeric_limits<double>::quiet_NaN();
  return independent * std::log(weighted_squares / points) + 2 * k + 2 * k * (k + 1) / left;
}

std::vector<Judgement> judge(const Comparison& c, const std::vector<FitRecord>& records) {
  const std::vector<FitRequest> all = requests(c);
  std::vector<Judgement> out(c.hypotheses.size());
  const FitRecord* best = nullptr;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Judgement& j = out[all[i].hypothesis];
    j.seconds += records[i].seconds;
    if (all[i].without) {
      j.left_out_rms_rad.push_back(records[i].rms_rad[*all[i].without]);
      continue;
    }
    j.rms_rad = records[i].rms_rad;
    if (best == nullptr || records[i].weighted_squares < best->weighted_squares) best = &records[i];
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::size_t h = all[i].hypothesis;
    if (!all[i].without)
      out[h].aicc = aicc(records[i].weighted_squares, records[i].points, best->independent, c.hypotheses[h].free.size());
  }
  return out;
}

}  // namespace vsa::identify
