// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A matrix's eigenvalues with those at 0 taken out first, so that their number is right. Rounding splits k eigenvalues at 0 that share
// an eigenvector over a circle of radius (ε‖A‖)^(1/k), in which a slow pole might lie as well: by size alone they can't be told apart.
//
//   A V₂ = 0, V = [V₁ V₂] orthogonal   ⇒   VᵀAV = [B 0; C 0],  B = V₁ᵀAV₁,  C = V₂ᵀAV₁
//
// A has B's eigenvalues and as many zeros as V₂ has columns; B is treated likewise until it has full rank. Ranks are those that the
// matrix has within the error of its own rounding, n ε ‖A‖, after a scaling that makes rows and columns alike in size.
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace vsa::linear {

/// Of A: eigenvalues, and for each an eigenvector.
struct Spectrum {
  Eigen::VectorXcd values;   ///< zeros first
  Eigen::MatrixXcd vectors;  ///< of length 1; of zeros that share one the same several times
  Eigen::Index zeros = 0;
};
/// `noise`: rounding of A's entries, over the matrix's size.
[[nodiscard]] Spectrum spectrum(const Eigen::MatrixXd& a, double noise);

}  // namespace vsa::linear
