// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What is to be identified: parameters with bounds, recordings with their branches, and a model that predicts those branches.
//
//   residual r_ij = model_i(θ)_j − data_i,j   [rad], recording i, point j (torque grid × rising, falling)
//   θ̂ = argmin Σ_i w_i² Σ_j r_ij²  within the bounds
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/experiment/recording.hpp"

namespace vsa::identify {

/// One unknown: one key of the actuator type, or several that are to be equal.
struct Parameter {
  std::string name;               ///< as the user wrote it: "elastic.k1_Nm=elastic.k2_Nm"
  std::vector<std::string> keys;  ///< "elastic.k1_Nm", "elastic.k2_Nm"
  std::string unit;               ///< of the keys; empty for a plain number
  double start = 0,               ///< the type's value
      min = 0,                    ///< lower bound
      max = 0;                    ///< upper bound

  /// Counted in its logarithm: its bounds are positive and two decades apart or more, so that what is asked for is its order of
  /// magnitude first. Searches, steps, Jacobians and intervals are then in ln(value).
  [[nodiscard]] bool logarithmic() const { return min > 0 && max / min >= 100; }
  [[nodiscard]] double coordinate(double value) const;  ///< ln(value) where it is counted so, else the value
  /// Within the bounds; at a bound exactly that.
  [[nodiscard]] double value_at(double coordinate) const;
  [[nodiscard]] double span() const { return coordinate(max) - coordinate(min); }  ///< of the coordinates, bound to bound
};

/// A recording that is to be explained.
struct Observation {
  std::string name;           ///< the recording's file
  double preset = 0;          ///< that was commanded
  experiment::Branches data;  ///< its branch means
  double weight = 1;          ///< w, 1/rad; see scatter_weight()
  bool points = false;        ///< places at rest (experiment::read_points), which the law alone predicts, not the bench
  double beyond = 0;          ///< part of its samples whose torque lies beyond the grid and counts for nothing
};

/// The branches that observation number i would show. Called from several threads at once; may throw where the values make no
/// sense. `values` are in the order of Task::parameters.
using Model = std::function<experiment::Branches(const std::vector<double>& values, std::size_t observation)>;

/// What is to be identified: parameters, recordings, and the model that predicts them.
struct Task {
  std::vector<Parameter> parameters;      ///< in the order of every vector of values
  std::vector<Observation> observations;  ///< in the order of every index of them
  Model model;                            ///< called for residuals
  /// Called, from one thread, before each local solution with its start: what the model holds constant on the way (the sweep's
  /// amplitude). May be empty.
  std::function<void(const std::vector<double>& values)> prepare;
  /// A cheap model of the same kind for the global search, called from several threads; its branches may lie on another grid.
  /// Empty: there is none, and `no_surrogate` says why.
  Model surrogate;
  std::string no_surrogate;  ///< why there is no surrogate; empty: there is one
};

/// "a.x,b.y=c.z" → parameters with unit, start and bounds of the type. Tied keys: the bounds' intersection, the first key's
/// start. Throws InputError for every key that is unknown, twice, no real number, or tied to one of another unit.
[[nodiscard]] std::vector<Parameter> parse_parameters(const std::string& text, const config::ActuatorType& type);

/// The overrides that give a type these values, after those of `also` that are about other keys.
[[nodiscard]] std::vector<config::Override> overrides(const std::vector<Parameter>& parameters, const std::vector<double>& values,
                                                      const std::vector<config::Override>& also = {});

/// A recording for a preset: branch means (…_branches.csv), places at rest (…_points.csv) or samples, the commanded preset in its name;
/// weight 1. Places of an actuator without a preset need none. Throws InputError where it can't be read, or where that preset isn't in
/// the unit of this actuator's.
[[nodiscard]] Observation read_observation(const std::filesystem::path& file, const config::ActuatorType& type);
/// Of a bench that carries another mass, 1 for its own 1 kg: samples' torque grid, 0.05 N·m within ±1.4 N·m, is as many times as wide.
[[nodiscard]] Observation read_observation(const std::filesystem::path& file, const config::ActuatorType& type, double load_share);
/// Adds each recording that is one before it again, which would count twice: the same file, another of a measurement's three (X.csv,
/// X_samples.csv, X_branches.csv), or the same data.
void check_each_once(const std::vector<Observation>& recordings, Problems& problems);

/// 1 / root mean square of the recording's own scatter about its branches, so that a curve counts as much as it is known.
[[nodiscard]] double scatter_weight(const experiment::Branches& data);
/// Weighs recordings that are fitted together by that. One that tells no scatter (points read by hand, say) counts as the others do: the
/// root mean square of their weights.
void weigh_by_scatter(std::span<Observation> observations);

/// Rounded to `digits` significant decimal digits.
[[nodiscard]] double rounded(double value, int digits);

}  // namespace vsa::identify
