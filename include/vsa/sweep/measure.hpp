// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A run's numbers: a signal of the world, sampled after every step, and a statistic of it.
//
//   [[measure]]
//   name = "peak_torque_Nm"           # the column
//   signal = "torque_Nm"              # of actuators, a joint, a link, or the world; signal_names()
//   statistic = "peak"                # docs/reference/sweep-files.md
//   actuator = "joint_1"              # none: all of the world's; or joint = "…", link = "…"
//   from_s = 1.0                      # only what lies in from_s < t ≤ to_s counts
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "vsa/engine/world.hpp"
#include "vsa/motion/travel.hpp"

namespace vsa::sweep {

/// One column of a sweep's table: a signal of the world, and a statistic of it.
struct Measure {
  std::string name;                ///< the column's name, with its unit
  std::string value;               ///< of a study, in place of all below: a place in its results.json, or a quantity's name
  std::string signal;              ///< one of signal_names()
  std::string statistic = "last";  ///< one of statistic_names()
  std::string actuator,            ///< whose signal, by name; at most one of the three, and none: of all actuators, or the world
      joint,                       ///< likewise
      link;                        ///< likewise
  double from_s = 0,               ///< only from_s < t counts
      to_s = std::numeric_limits<double>::infinity();  ///< only t ≤ to_s counts
  double band = 0;                                     ///< of settle_s: ± about the mean of the window's last tenth
  double order = 0;                                    ///< of quantile, 0 … 1
};

/// Of a measure with actuator or with nothing: "actuator"; else "joint", "link", "world".
[[nodiscard]] std::vector<std::string> signal_names(const std::string& of);
[[nodiscard]] const std::vector<std::string>& statistic_names();  ///< in the order of the documentation

/// One number of many. A NaN among them makes a NaN of all but the first and the last.
class Statistic {
 public:
  /// `measure`: its statistic, band and order.
  explicit Statistic(const Measure& measure);
  void add(double time_s, double value);  ///< in order of time
  /// NaN: nothing was added; settle_s of what never settles.
  [[nodiscard]] double value() const;

 private:
  enum class Kind { last, first, mean, min, max, peak, range, rms, std, integral, quantile, settle };
  [[nodiscard]] double settled() const;

  Kind kind_;
  double band_, order_;
  std::size_t count_ = 0;
  bool whole_ = true;  // no NaN among them
  double first_ = 0, last_ = 0, first_s_ = 0, last_s_ = 0, sum_ = 0, squares_ = 0, integral_ = 0, mean_ = 0;
  double min_ = std::numeric_limits<double>::infinity(), max_ = -std::numeric_limits<double>::infinity();
  std::vector<double> times_, values_;  // where the statistic needs all of them
};

/// Takes all measures of a run, sample by sample.
class Observer {
 public:
  /// Throws InputError with every measure that this world hasn't. `window_s`: of travel (vsa/motion/travel.hpp).
  Observer(const std::vector<Measure>& measures, const engine::World& world, double window_s);
  ~Observer();
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;

  void sample(const engine::World& world);           ///< after every step
  [[nodiscard]] std::vector<double> values() const;  ///< one a measure, in their order

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsa::sweep
