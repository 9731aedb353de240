// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// AR(1) errors along the branches, found from the residuals of a fit; see vsa/identify/uncertainty.hpp.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "vsa/identify/residuals.hpp"

namespace vsa::identify {

/// Points first … last − 1 are one branch of one recording.
struct Segment {
  std::size_t first, last, observation;
};
[[nodiscard]] std::vector<Segment> segments(const std::vector<Point>& points);

struct ErrorModel {
  std::vector<double> sd, rho;  ///< of each recording
  std::vector<double> samples;  ///< points of each recording

  /// Σ X, X with one row a point.
  [[nodiscard]] Eigen::MatrixXd apply(const std::vector<Point>& points, const Eigen::MatrixXd& x) const;
  [[nodiscard]] double effective_samples() const;
};

/// `residuals` and `jacobian` are weighted; `inverse` is (JᵀJ)⁻¹ or its pseudo-inverse.
[[nodiscard]] ErrorModel error_model(const std::vector<Point>& points, std::size_t observations, const Eigen::VectorXd& residuals,
                                     const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& inverse);

}  // namespace vsa::identify
