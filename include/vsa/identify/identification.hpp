// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// An identification with all that tells whether it may be trusted, in two generations of jobs (jobs.hpp): every start, of all
// recordings and of those without each preset; then profiles and bootstrap draws about the best. Who does the jobs, and where, changes
// nothing.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "vsa/identify/jobs.hpp"
#include "vsa/identify/uncertainty.hpp"

namespace vsa::identify {

/// One parameter held at `value`, the others fitted again.
struct ProfilePoint {
  double value = 0,  ///< of the parameter that is held
      rms_rad = 0;   ///< NaN: that fit failed
};

/// All recordings of one preset left out: fitted to the others, judged on it. Each fit is searched for as the fit to everything is, which
/// it doesn't know: begun there, it would stay near what the recording left out has fitted.
struct LeftOut {
  double preset = 0;            ///< of the recordings left out
  std::vector<double> values;   ///< fitted without them
  std::vector<Misfit> misfits;  ///< of the recordings left out
  double rms_rad = 0,           ///< of them, by this fit
      rms_rad_of_all = 0;       ///< of them, by the fit to everything
};

/// What fits to recordings with drawn errors came to.
struct Bootstrap {
  std::vector<std::vector<double>> values;  ///< of each draw
  std::vector<double> standard_error,       ///< of each parameter: scatter of the draws
      low,                                  ///< 2.5 % of the draws lie below
      high;                                 ///< 2.5 % of the draws lie above
  std::size_t failed = 0;                   ///< draws that couldn't be fitted; they aren't among the above
  std::size_t unconverged = 0;              ///< draws among the above whose iterations ran out
};

/// What an identification is to find out, beside the estimate.
struct IdentificationOptions {
  FitOptions fit;                ///< of every fit
  int digits = 0;                ///< of the estimate, which all else is about; 0: as it is
  bool cross_validation = true;  ///< where there are two presets
  int profile = 0;               ///< points of each parameter's, over three standard errors to each side
  int draws = 0;                 ///< of the bootstrap
};

/// An estimate, and what tells whether it may be trusted.
struct Identification {
  Task task;                                        ///< as it was given
  std::vector<Point> points;                        ///< where each residual is
  std::vector<double> residuals_before;             ///< at the type's values
  Fit fit;                                          ///< at the estimate
  Uncertainty uncertainty;                          ///< with the correlated residuals
  std::vector<Misfit> misfits_before,               ///< of each recording, at the type's values
      misfits;                                      ///< of each recording, at the estimate
  std::vector<LeftOut> left_out;                    ///< upwards by preset
  std::vector<std::vector<ProfilePoint>> profiles;  ///< one a parameter, or none
  std::optional<Bootstrap> bootstrap;               ///< none: it wasn't asked for
  std::size_t evaluations = 0;                      ///< simulations of a recording
};

/// A job's result; none: it failed, and `error` says why.
struct Done {
  std::optional<StartResult> result;  ///< none: it failed
  std::string error;                  ///< why; empty: it didn't
};
/// Does a generation. It may throw, which ends the identification and comes out.
using DoJobs = std::function<std::vector<Done>(const std::vector<Job>& jobs)>;

/// Throws what the model throws at the type's own values, and std::runtime_error where no start can be evaluated.
[[nodiscard]] Identification identify(const MakeTask& make, const IdentificationOptions& options, const DoJobs& do_jobs);
/// The jobs in this thread.
[[nodiscard]] DoJobs one_by_one(const MakeTask& make, const FitOptions& options);

}  // namespace vsa::identify
