// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Confidence intervals that allow for correlated residuals. What remains after a fit is mostly the model's own error, smooth along
// a branch: neighbouring points err alike and count for less than as many independent ones.
//
//   residuals of recording i along a branch: variance s_i², correlation ρ_i^|j − k| between the points j and k of the grid (AR(1));
//   branches and recordings independent
//   Σ  block-diagonal of it, J the weighted Jacobian, G = (JᵀJ)⁻¹
//   Cov(θ̂) = G (JᵀΣJ) G                                                          the sandwich; Σ = s²·1 gives the usual s²·G
//   n_eff = Σ_i n_i (1 − ρ_i)/(1 + ρ_i)                                            effective number of samples
//   interval θ̂ ± t_{0.975, ν} √Cov_kk, ν = max(1, n_eff − p)
//
// s_i and ρ_i come from the residuals' mean square and lag-one product. Both are smaller than those of the errors, as the fit has
// taken its share: with M = 1 − J G Jᵀ the residuals' covariance is M Σ Mᵀ, and s_i, ρ_i are the values for which its diagonal and
// first off-diagonal have the sums that were found. ρ is held within 0 … 0.97.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "vsa/identify/fit.hpp"

namespace vsa::identify {

/// What the data tell of the estimate, and how well.
struct Uncertainty {
  std::vector<double> standard_error;                 ///< infinite where the data don't determine it; NaN at a bound
  std::vector<double> low,                            ///< of the 95 % interval, not cut at the bounds
      high;                                           ///< likewise
  std::vector<double> white_standard_error;           ///< as if the residuals were independent: too small, for comparison
  std::vector<std::vector<double>> correlation;       ///< of the estimates, symmetric
  std::vector<double> autocorrelation,                ///< ρ_i of each recording
      sd_rad;                                         ///< s_i of each recording
  double effective_samples = 0,                       ///< n_eff
      degrees_of_freedom = 0;                         ///< ν
  double condition = 1;                               ///< largest over smallest singular value of J with columns of length one
  std::vector<std::size_t> without_effect;            ///< parameters that change nothing
  std::vector<std::vector<std::size_t>> unseparated;  ///< groups of which only a combination is determined
  /// The data don't determine all of them.
  [[nodiscard]] bool deficient() const { return !without_effect.empty() || !unseparated.empty(); }
};

/// Parameters at a bound count as fixed.
[[nodiscard]] Uncertainty uncertainty(const Residuals& residuals, const Fit& fit);

}  // namespace vsa::identify
