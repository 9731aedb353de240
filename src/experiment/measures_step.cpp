// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Step responses. Everything is measured on the normalised response u(t) = (y − from)/(final − from): 0 before, 1 at rest.
// Swings are differences of successive extrema, so that a shaft that friction stops beside its target doesn't bias them:
//   swing_k = |e_k − e_{k+1}|,   ln swing_k = c − k·d,   ζ = d/√(π² + d²),   f = half swings / (2·time between the extrema)
//
// Ringing is what swings after the response has reached 90 %: at least one whole period, so two swings. A swing counts from twice
// an encoder's count up, peak to peak, which a reading that flickers by one count doesn't reach; and from a twentieth of the
// largest up, so that the frequency is the dominant one's and not that of a ripple on it. Extrema against such a floor are a filter
// that shifts nothing in time.
#include <algorithm>
#include <cmath>

#include "vsa/errors.hpp"
#include "vsa/experiment/measures.hpp"
#include "vsa/not_a_number.hpp"
#include "vsa/units.hpp"

namespace vsa::experiment {
namespace {

constexpr std::size_t kLeastSamples = 20;  // so that the last tenth is a mean

struct Series {
  const std::vector<double>& t;
  std::vector<double> u;
};

struct Extremum {
  double time_s, value;
};

/// First crossing of `level` upwards, interpolated; NaN: never.
double crossing(const Series& s, double level) {
  if (s.u.front() >= level) return s.t.front();
  for (std::size_t i = 1; i < s.u.size(); ++i) {
    if (s.u[i] < level) continue;
    return s.t[i - 1] + (s.t[i] - s.t[i - 1]) * (level - s.u[i - 1]) / (s.u[i] - s.u[i - 1]);
  }
  return kNaN;
}

/// The parabola's top through three neighbouring samples; the sample itself at the ends or where they aren't evenly spaced.
Extremum refined(const Series& s, std::size_t i) {
  if (i == 0 || i + 1 >= s.u.size()) return {s.t[i], s.u[i]};
  const double before = s.t[i] - s.t[i - 1], after = s.t[i + 1] - s.t[i];
  const double curvature = s.u[i - 1] - 2 * s.u[i] + s.u[i + 1];
  if (curvature == 0 || std::abs(after - before) > 1e-6 * before) return {s.t[i], s.u[i]};
  const double offset = 0.5 * (s.u[i - 1] - s.u[i + 1]) / curvature;
  return {s.t[i] + offset * before, s.u[i] - 0.25 * (s.u[i - 1] - s.u[i + 1]) * offset};
}

/// Extrema after `from_s` that are further than `floor` from their neighbours: maximum first, then alternating.
std::vector<Extremum> extrema(const Series& s, double from_s, double floor) {
  std::vector<Extremum> out;
  const auto begin = std::lower_bound(s.t.begin(), s.t.end(), from_s);
  if (begin == s.t.end()) return out;
  std::size_t best = static_cast<std::size_t>(begin - s.t.begin());
  double sign = 1;  // looking for a maximum
  for (std::size_t i = best; i < s.u.size(); ++i) {
    if (sign * (s.u[i] - s.u[best]) > 0) best = i;
    if (sign * (s.u[best] - s.u[i]) <= floor) continue;
    out.push_back(refined(s, best));
    best = i;
    sign = -sign;
  }
  return out;
}

void measure_ringing(const Series& s, double from_s, double floor, StepMeasures& out) {
  out.ringing_Hz = out.damping_ratio = kNaN;
  constexpr double kDominant = 0.05;  // of the largest swing
  std::vector<Extremum> e = extrema(s, from_s, floor);
  double largest = 0;
  for (std::size_t k = 0; k + 1 < e.size(); ++k) largest = std::max(largest, std::abs(e[k].value - e[k + 1].value));
  if (kDominant * largest > floor) e = extrema(s, from_s, kDominant * largest);
  if (e.size() < 3) return;
  const auto swings = static_cast<double>(e.size() - 1);
  out.ringing_Hz = swings / (2 * (e.back().time_s - e.front().time_s));
  double mean_log = 0, covariance = 0, variance = 0;
  for (std::size_t k = 0; k + 1 < e.size(); ++k) mean_log += std::log(std::abs(e[k].value - e[k + 1].value)) / swings;
  for (std::size_t k = 0; k + 1 < e.size(); ++k) {
    const double x = static_cast<double>(k) - 0.5 * (swings - 1);
    covariance += x * (std::log(std::abs(e[k].value - e[k + 1].value)) - mean_log);
    variance += x * x;
  }
  const double decrement = -covariance / variance;
  out.damping_ratio = decrement / std::hypot(kPi, decrement);
}

void check(const std::vector<double>& time_s, const std::vector<double>& y) {
  const auto finite = [](const std::vector<double>& v) {
    return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
  };
  Problems problems;
  if (time_s.size() != y.size() || y.size() < kLeastSamples) {
    problems.add({"", "step response", std::to_string(time_s.size()) + " times, " + std::to_string(y.size()) + " values",
                  "can't be measured", "as many times as values, at least " + std::to_string(kLeastSamples)});
  }
  if (!finite(time_s) || !finite(y)) problems.add({"", "step response", "", "holds a number that isn't finite", "finite numbers"});
  if (std::adjacent_find(time_s.begin(), time_s.end(), std::greater_equal<>()) != time_s.end()) {
    problems.add({"", "step response", "", "its time doesn't increase", "increasing times"});
  }
  problems.throw_if_any();
}

}  // namespace

StepMeasures step_measures(const std::vector<double>& time_s, const std::vector<double>& y, double from, double to,
                           double ringing_floor) {
  check(time_s, y);
  StepMeasures out;
  const std::size_t tail = y.size() - y.size() / 10;
  for (std::size_t i = tail; i < y.size(); ++i) out.final_value += y[i] / static_cast<double>(y.size() - tail);
  out.steady_error = out.final_value - to;
  const double change = out.final_value - from;
  // A part in a million of the step is no response.
  if (std::abs(change) <= 1e-6 * std::abs(to - from) || change == 0) {
    out.rise_s = out.rise_start_s = out.mean_speed = out.peak_slope = out.overshoot_pct = out.ringing_Hz = out.damping_ratio = kNaN;
    return out;
  }
  Series s{time_s, {}};
  for (const double v : y) s.u.push_back((v - from) / change);
  out.rise_start_s = crossing(s, 0.1);
  const double end = crossing(s, 0.9);
  out.rise_s = end - out.rise_start_s;
  out.mean_speed = 0.8 * std::abs(change) / out.rise_s;
  for (std::size_t i = 1; i < s.u.size(); ++i) {
    out.peak_slope = std::max(out.peak_slope, std::abs(change) * (s.u[i] - s.u[i - 1]) / (s.t[i] - s.t[i - 1]));
  }
  out.overshoot_pct = 100 * std::max(0.0, *std::max_element(s.u.begin(), s.u.end()) - 1);
  measure_ringing(s, end, ringing_floor / std::abs(change), out);
  return out;
}

}  // namespace vsa::experiment
