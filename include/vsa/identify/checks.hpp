// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What tells whether an identification may be trusted: profiles and leave-one-preset-out cross-validation.
#pragma once

#include <vector>

#include "vsa/identify/fit.hpp"

namespace vsa::identify {

/// One parameter held at `value`, the others fitted again.
struct ProfilePoint {
  double value = 0, rms_rad = 0;
};
/// `points` values from `low` to `high`, cut at the bounds.
[[nodiscard]] std::vector<ProfilePoint> profile(const Residuals& residuals, const Fit& fit, std::size_t parameter, double low,
                                                double high, int points, const FitOptions& options);

/// All recordings of one preset left out: fitted to the others, judged on it.
struct LeftOut {
  double preset = 0;
  std::vector<double> values;
  std::vector<Misfit> misfits;             ///< of the recordings left out
  double rms_rad = 0, rms_rad_of_all = 0;  ///< of them, by this fit and by the fit to everything
};
/// Empty where there is only one preset. Each fit is searched for as the fit to everything was, which it doesn't know: begun there, it
/// would stay near what the recording left out has fitted.
[[nodiscard]] std::vector<LeftOut> leave_one_preset_out(const Task& task, const Fit& fit, const FitOptions& options,
                                                        unsigned threads);

}  // namespace vsa::identify
