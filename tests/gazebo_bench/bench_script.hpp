// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One bench run for every host: models/worlds/bench_load.sdf (1 kg on a 0.15 m lever that hangs down at 0) is stepped to 0.5 rad
// and back and swept slowly through ±1.3 rad, at a soft and at a stiff preset. The sweep's gravity torque, ±1.5 N·m, draws the
// torque–deflection curve.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <stdexcept>
#include <string>
#include <vector>

#include "vsa/host/robot.hpp"

namespace vsa::test {

inline constexpr double kBenchDuration_s = 23.0, kStepTo_rad = 0.5;
inline constexpr std::array<double, 4> kStepTimes_s{1.0, 2.0, 12.5, 13.5};
inline const std::string kBenchModel = "qbmove_bench_load";

struct BenchSample {
  double time_s = 0, shaft_rad = 0, deflection_rad = 0, torque_Nm = 0;
};

/// The whole run as trajectories, taken at the first step.
inline void command_bench(host::Robot& robot) {
  using Knots = std::vector<host::Robot::Knot>;
  Knots equilibrium{{0.0, 0.0}};
  for (const double start : {0.0, 11.5}) {
    for (const auto& [t, q] :
         Knots{{1, 0}, {1.001, kStepTo_rad}, {2, kStepTo_rad}, {2.001, 0}, {3, 0}, {5, 1.3}, {9, -1.3}, {11, 0}}) {
      equilibrium.push_back({start + t, q});
    }
  }
  const Knots preset{{0.0, 0.2}, {11.0, 0.2}, {11.5, 0.6}, {23.0, 0.6}};
  using Channel = host::Robot::Channel;
  if (!robot.follow(0, Channel::equilibrium, equilibrium) || !robot.follow(0, Channel::preset, preset)) {
    throw std::runtime_error("the bench's trajectory is refused");
  }
}

[[nodiscard]] inline BenchSample sample_bench(const host::Robot& robot, double time_s) {
  const host::ActuatorReading now = robot.read(0);
  return {time_s, now.shaft_rad, now.deflection_rad, now.torque_Nm};
}

inline void write_bench(const std::string& file, const std::vector<BenchSample>& samples) {
  std::ofstream out(file);
  out << "time_s,shaft_rad,deflection_rad,torque_Nm\n" << std::setprecision(12);
  for (const BenchSample& s : samples)
    out << s.time_s << ',' << s.shaft_rad << ',' << s.deflection_rad << ',' << s.torque_Nm << '\n';
  if (!out) throw std::runtime_error("can't write " + file);
}

[[nodiscard]] inline std::vector<BenchSample> read_bench(const std::string& file) {
  std::ifstream in(file);
  std::string header;
  if (!std::getline(in, header)) throw std::runtime_error("can't read " + file);
  std::vector<BenchSample> samples;
  BenchSample s;
  for (char comma; in >> s.time_s >> comma >> s.shaft_rad >> comma >> s.deflection_rad >> comma >> s.torque_Nm;)
    samples.push_back(s);
  return samples;
}

/// 10 to 90 % of a step, from the samples with linear interpolation; NaN where it never gets there.
[[nodiscard]] inline double rise_time_s(const std::vector<BenchSample>& samples, double step_at_s) {
  const auto at = [&](double t) {
    return std::find_if(samples.begin(), samples.end(), [&](const BenchSample& s) { return s.time_s >= t - 1e-9; });
  };
  const auto begin = at(step_at_s), end = at(step_at_s + 0.99);
  const double from = begin->shaft_rad, to = (end - 1)->shaft_rad;
  const auto crossing = [&](double share) {
    const double level = from + share * (to - from);
    const auto over = std::find_if(begin, end, [&](const BenchSample& s) { return (s.shaft_rad - level) * (to - from) >= 0; });
    if (over == end || over == begin) return std::nan("");
    const auto before = over - 1;
    return before->time_s + (over->time_s - before->time_s) * (level - before->shaft_rad) / (over->shaft_rad - before->shaft_rad);
  };
  return crossing(0.9) - crossing(0.1);
}

struct BenchDifference {
  double deflection_rms_rad = 0, deflection_max_rad = 0, torque_rms_Nm = 0;
  double rise_time_max = 0;  ///< the largest of the four steps' relative differences
};

[[nodiscard]] inline BenchDifference compare_bench(const std::vector<BenchSample>& reference,
                                                   const std::vector<BenchSample>& other) {
  if (reference.empty() || reference.size() != other.size()) throw std::runtime_error("two bench runs of different length");
  BenchDifference d;
  double delta2 = 0, torque2 = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const double delta = other[i].deflection_rad - reference[i].deflection_rad;
    const double torque = other[i].torque_Nm - reference[i].torque_Nm;
    delta2 += delta * delta;
    torque2 += torque * torque;
    d.deflection_max_rad = std::max(d.deflection_max_rad, std::abs(delta));
  }
  d.deflection_rms_rad = std::sqrt(delta2 / static_cast<double>(reference.size()));
  d.torque_rms_Nm = std::sqrt(torque2 / static_cast<double>(reference.size()));
  for (const double step : kStepTimes_s) {
    const double expected = rise_time_s(reference, step);
    const double difference = std::abs(rise_time_s(other, step) / expected - 1);
    d.rise_time_max = std::isnan(difference) ? difference : std::max(d.rise_time_max, difference);
  }
  return d;
}

}  // namespace vsa::test
