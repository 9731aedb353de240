// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A plan of many runs (TOML, docs/reference/sweep-files.md): a scenario, what varies in it, how often each is repeated from another
// start, and what is measured.
//
//   points = (product of all lists, ranges, logs) × samples        samples: of random and Sobol' axes, taken together
//   run r  = repetition r mod R of point r div R
//
// A run follows from the plan and its number alone: not from who runs it, when, or what else ran.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "vsa/sweep/measure.hpp"
#include "vsa/sweep/series.hpp"

namespace vsa::sweep {

using Value = std::variant<double, std::int64_t, bool, std::string>;  ///< as a plan has it
[[nodiscard]] std::string value_text(const Value& value);             ///< as it stands in a scenario's file
/// A switch: 0 or 1. Not for texts (std::bad_variant_access).
[[nodiscard]] double number_of(const Value& value);

/// One thing that varies from point to point.
struct Axis {
  /// Where its values come from.
  enum class Kind { listed, random, sobol, searched } kind = Kind::listed;  ///< of all its values
  /// How random and searched ones are spread.
  enum class Law { uniform, log_uniform, normal } law = Law::uniform;  ///< of random and searched
  std::string name;                                                    ///< the column; else the first key
  std::vector<std::string>
      keys;                ///< in the scenario's file, "motion.group.vertical.preset_deg"; or of its parameters. All have its value
  std::string of;          ///< of parameters: actuator or link; empty: all that have the key
  bool parameter = false;  ///< key is a parameter of actuators or links (batch::Batch::set), not of the scenario
  bool factor = false;     ///< of parameters: times what the world has
  std::vector<Value> values;  ///< of listed ones, ranges and logs written out
  bool spaced = false;        ///< listed ones that are a range or a log
  /// Of the others: bounds, or mean and standard deviation (cut off at three).
  double a = 0, b = 0;  ///< of the others: bounds, or mean and standard deviation (cut off at three)
};

/// Where a repetition begins: the first robot's model, if it flies free, is turned and moved by up to so much, each by chance.
struct Start {
  double yaw_deg = 0,  ///< turned by so much at most, each way
      xy_m = 0;        ///< moved by so much at most
};

/// A number that an optimiser is to make small or large.
struct Objective {
  /// Over a candidate's repetitions.
  enum class Over { mean, median, worst } over = Over::median;  ///< of all runs of a candidate
  std::size_t measure = 0;                                      ///< into Plan::measures()
  bool maximize = false;                                        ///< false: the smallest is best
};
/// What an optimiser is to make of a plan's searched axes (vsa/sweep/optimize.hpp).
struct Search {
  std::string algorithm;              ///< pso, gaco, nsga2, nspso or maco
  unsigned population = 24,           ///< candidates of a generation
      generations = 20;               ///< how many there are
  std::vector<Objective> objectives;  ///< one: pso, gaco; several: the others
};

/// A plan of many runs: a scenario, what varies in it, how often each is repeated, and what is measured. A run follows from the
/// plan and its number alone. Immutable and cheap to copy.
class Plan {
 public:
  /// Throws InputError with every problem that can be seen without a world.
  [[nodiscard]] static Plan load(const std::filesystem::path& file);
  static constexpr double kMostRuns = 1e7;  ///< points times repetitions

  /// Also what a world shows: each value of each list, and the ends of each range, beside the first value of all others. Loads a world
  /// for each. Throws InputError with every problem.
  void check() const;

  [[nodiscard]] const std::string& title() const;              ///< for people
  [[nodiscard]] const std::vector<Axis>& axes() const;         ///< in the plan's order
  [[nodiscard]] const std::vector<Measure>& measures() const;  ///< in the plan's order, columns
  [[nodiscard]] std::size_t points() const;                    ///< the product of all lists, times the samples
  [[nodiscard]] std::size_t repetitions() const;               ///< of each point, from another start
  /// None: nothing is searched.
  [[nodiscard]] const std::optional<Search>& search() const;
  /// The plan with candidates for its searched axes: as many numbers each, 0 … 1 from end to end. Its points are those of the first
  /// candidate, then those of the next.
  [[nodiscard]] Plan with(std::vector<std::vector<double>> candidates) const;
  [[nodiscard]] std::size_t candidates() const;  ///< 1 where nothing is searched
  /// The candidates that it was made with; empty: none.
  [[nodiscard]] const std::vector<std::vector<double>>& candidate_list() const;
  [[nodiscard]] std::size_t most_runs() const;                                 ///< that a search comes to; else runs()
  [[nodiscard]] std::size_t runs() const { return points() * repetitions(); }  ///< points() times repetitions()
  [[nodiscard]] std::uint64_t seed() const;  ///< of starts, samples and faults without one of their own
  [[nodiscard]] double limit_s() const;      ///< of a run, by the wall clock
  /// One an axis.
  [[nodiscard]] std::vector<Value> values(std::size_t point) const;
  /// Of its text and of the files that it names: equal plans give equal tables.
  [[nodiscard]] std::uint64_t fingerprint() const;
  [[nodiscard]] const std::string& text() const;  ///< the file
  /// The scenario of a run as a file, with a comment on what it hasn't: start and parameters.
  [[nodiscard]] std::string scenario_text(std::size_t run) const;

  /// Its runs, a column a measure.
  operator Series() const;  // NOLINT(google-explicit-constructor): a plan is one

  /// Opaque.
  struct Impl;

 private:
  friend class Runner;
  explicit Plan(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// Runs of a plan, one after the other, in one thread. What it keeps between them (a world that was read) changes no bit.
class Runner {
 public:
  explicit Runner(const Plan& plan);  ///< keeps a copy of the plan
  ~Runner();
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  /// What goes wrong in the run is its outcome's error. `wanted`: asked now and then; false ends it, and there is no outcome.
  [[nodiscard]] std::optional<Outcome> run(std::size_t number, const std::function<bool()>& wanted = {});
  /// How long that run takes, by running at most `probe_s` of it.
  [[nodiscard]] double estimate_s(std::size_t number, double probe_s, const std::function<bool()>& wanted = {});

 private:
  friend class Plan;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsa::sweep
