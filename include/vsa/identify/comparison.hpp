// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Which of several explanations of the same recordings? Hypotheses in a TOML file, each fitted to all recordings and with each of
// them left out.
//
//   [compare]
//   recordings = ["stiffness_preset_0.0000rad_branches.csv", …]     relative to the file
//   starts = 2            see FitOptions; also: seed, iterations, weights ("scatter" or "equal"), title
//   jobs = 0              fits side by side; 0: as many as the machine runs at once
//   [bench]               see SweepOptions; all optional
//   period_s = 38         also: amplitude_rad, cycles, load_kg
//   [[hypothesis]]
//   name = "no_clamp"     letters, digits, _ and -; names the files of its fits
//   title = "no clamp"
//   base = "qbmove_maker_pro"                                       a type's name, or a file NAME.toml relative to this one
//   set = { "firmware.max_stiffness_raw" = 32767, "drive.pwm_pin" = "enable" }
//   free = ["elastic.k1_Nm=elastic.k2_Nm", "tendon.friction"]       as in parse_parameters(); may be empty
//   start = { "drive.back_loss" = 0.1 }                             other starts than the base's, for keys in `free`
//
// Criterion for choosing, of a weighted least-squares fit whose errors have one unknown common scale:
//   S = Σ_i w_i² Σ_j r_ij²,  n points,  K = p + 1,  N independent residuals
//   AICc = N ln(S/n) + 2K + 2K(K + 1)/(N − K − 1),                   none where N ≤ K + 1
// N = Σ n_i (1 − ρ_i)/(1 + ρ_i), see uncertainty.hpp, of the hypothesis with the smallest S, and the same for all: what is compared
// must have the same number of samples. Only differences within a comparison mean anything.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vsa/identify/bench_model.hpp"
#include "vsa/identify/fit.hpp"

namespace vsa::identify {

/// One explanation: a type with values changed, and what is free in it.
struct Hypothesis {
  std::string name,               ///< of files
      title;                      ///< for people
  experiment::Specimen specimen;  ///< with `set` and `start`
  config::ActuatorType type;      ///< that
  std::vector<Parameter> free;    ///< empty: nothing is fitted
};

/// A question and its candidates, as the file has them.
struct Comparison {
  std::filesystem::path file;           ///< that they came from
  std::string title;                    ///< for people
  std::vector<Observation> recordings;  ///< weighted
  SweepOptions sweep;                   ///< common to all
  FitOptions fit;                       ///< of every fit
  int jobs = 0;                         ///< fits side by side; 0: as many as the machine runs at once
  std::vector<Hypothesis> hypotheses;   ///< in the file's order
};

/// `library`: where types by name are. Throws InputError with all problems at once: what can't be read, keys that are unknown,
/// missing or both set and free, names that are double, recordings that aren't there or whose preset a hypothesis can't take.
[[nodiscard]] Comparison read_comparison(const std::filesystem::path& file,
                                         const config::TypeLibrary& library = config::TypeLibrary());

/// One fit: a hypothesis to all recordings, or without one.
struct FitRequest {
  std::size_t hypothesis = 0;          ///< into Comparison::hypotheses
  std::optional<std::size_t> without;  ///< a recording that is left out
};
/// All that a comparison needs: with two recordings or more, each left out once.
[[nodiscard]] std::vector<FitRequest> requests(const Comparison& comparison);
/// "no_clamp", "no_clamp.without.stiffness_preset_0.0000rad_branches"
[[nodiscard]] std::string request_name(const Comparison& comparison, const FitRequest& request);

/// What a fit depends on, as 16 hexadecimal digits: the type's values, parameters, recordings, settings, and a short simulation
/// of each recording's bench, so that a program that simulates otherwise is noticed. `threads` side by side; 0: all.
[[nodiscard]] std::vector<std::string> request_hashes(const Comparison& comparison, const std::vector<FitRequest>& all,
                                                      unsigned threads, experiment::Watch* watch = nullptr);

/// An estimate; no interval (NaN) at a bound, infinite ones where the data don't determine it.
struct Estimate {
  std::string name,       ///< as Parameter has it
      unit;               ///< as Parameter has it
  double value = 0,       ///< θ̂_k
      low = 0,            ///< lower end of the 95 % interval
      high = 0;           ///< upper end
  bool at_bound = false;  ///< the estimate ended there
};

/// One fit, with what is asked of it and what it cost. As JSON between runs.
struct FitRecord {
  std::string asked;                                  ///< its hash
  std::vector<Estimate> estimates;                    ///< in the order of the parameters
  std::vector<double> rms_rad;                        ///< of every recording, of one that was left out by prediction
  double weighted_squares = 0;                        ///< S, of those fitted
  double points = 0,                                  ///< n
      independent = 0;                                ///< N by this fit's own ρ
  std::vector<double> autocorrelation;                ///< ρ of those fitted
  std::vector<std::string> without_effect;            ///< names of parameters that change nothing
  std::vector<std::vector<std::string>> unseparated;  ///< names of parameters of which only a combination is determined
  std::vector<double> start_rms;                      ///< √(S/n) of each local solution, the best first
  double seconds = 0;           ///< of work on this machine; the only thing here that isn't the same every time
  std::size_t evaluations = 0;  ///< simulations

  /// Parameters that the data don't determine.
  [[nodiscard]] std::size_t undetermined() const { return without_effect.size() + unseparated.size(); }
  [[nodiscard]] std::size_t at_bounds() const;  ///< estimates that ended at a bound
  /// Largest over smallest of start_rms, less 1; 0 with one.
  [[nodiscard]] double spread() const;
};

/// The same bits whatever `threads`. Throws experiment::Stopped, and what fit() throws.
[[nodiscard]] FitRecord run_fit(const Comparison& comparison, const FitRequest& request, unsigned threads,
                                experiment::Watch* watch = nullptr);

/// See the top of this file; NaN: none.
[[nodiscard]] double aicc(double weighted_squares, double points, double independent, std::size_t parameters);

/// One hypothesis's row of the table.
struct Judgement {
  std::vector<double> rms_rad,  ///< of each recording
      left_out_rms_rad;         ///< of each recording, predicted; empty with one recording
  double aicc = 0;              ///< of the fit to all; NaN: none
  double seconds = 0;           ///< of all its fits
};
/// `records` in the order of requests(comparison).
[[nodiscard]] std::vector<Judgement> judge(const Comparison& comparison, const std::vector<FitRecord>& records);

}  // namespace vsa::identify
