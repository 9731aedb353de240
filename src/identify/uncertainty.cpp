// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/identify/uncertainty.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "identify/error_model.hpp"
#include "vsa/not_a_number.hpp"

namespace vsa::identify {
namespace {

constexpr double kNoEffect_rad = 1e-5;  // over the parameter's whole range
constexpr double kSingular = 0.02;      // of unit columns: two parameters are then correlated by 0.9992 or more
constexpr double kMember = 0.1;         // component of a direction that isn't determined
constexpr double kInfinite = std::numeric_limits<double>::infinity();

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

/// The weighted Jacobian of the free parameters with columns of length one, and what divided them.
struct Scaled {
  std::vector<std::size_t> free;
  Eigen::MatrixXd columns;
  Eigen::VectorXd length;
};

Scaled scaled(const Residuals& residuals, const Fit& fit, Uncertainty& out) {
  Scaled s;
  const std::size_t n = fit.residuals.size();
  for (std::size_t k = 0; k < fit.values.size(); ++k) {
    const Parameter& p = residuals.task().parameters[k];
    const bool effect = rms(fit.jacobian[k]) * p.span() > kNoEffect_rad;
    if (!effect) out.without_effect.push_back(k);
    if (effect && !fit.at_bound[k]) s.free.push_back(k);
  }
  s.columns.resize(index(n), index(s.free.size()));
  s.length.resize(index(s.free.size()));
  for (std::size_t j = 0; j < s.free.size(); ++j) {
    for (std::size_t i = 0; i < n; ++i) s.columns(index(i), index(j)) = residuals.weight(i) * fit.jacobian[s.free[j]][i];
    s.length[index(j)] = s.columns.col(index(j)).norm();
    s.columns.col(index(j)) /= s.length[index(j)];
  }
  return s;
}

/// (JᵀJ)⁻¹ without the directions that the data don't determine; those are noted in `out`.
Eigen::MatrixXd inverse(const Scaled& s, Uncertainty& out) {
  if (s.columns.rows() <= s.columns.cols()) {  // as many numbers as points fit them all and tell nothing of their scatter
    out.condition = kInfinite;
    out.unseparated.push_back(s.free);
    return Eigen::MatrixXd::Zero(s.columns.cols(), s.columns.cols());
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(s.columns, Eigen::ComputeThinV | Eigen::ComputeThinU);
  const Eigen::VectorXd& value = svd.singularValues();
  out.condition = value[value.size() - 1] > 0 ? value[0] / value[value.size() - 1] : kInfinite;
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(value.size());
  for (Eigen::Index d = 0; d < value.size(); ++d) {
    if (value[d] >= kSingular) {
      weight[d] = 1 / (value[d] * value[d]);
      continue;
    }
    std::vector<std::size_t> group;
    for (Eigen::Index j = 0; j < svd.matrixV().rows(); ++j) {
      if (std::abs(svd.matrixV()(j, d)) > kMember) group.push_back(s.free[static_cast<std::size_t>(j)]);
    }
    out.unseparated.push_back(std::move(group));
  }
  return svd.matrixV() * weight.asDiagonal() * svd.matrixV().transpose();
}

bool undetermined(const Uncertainty& u, std::size_t parameter) {
  return std::any_of(u.unseparated.begin(), u.unseparated.end(), [&](const std::vector<std::size_t>& group) {
    return std::find(group.begin(), group.end(), parameter) != group.end();
  });
}

void fill(Uncertainty& out, const Scaled& s, const Eigen::MatrixXd& covariance, const Eigen::MatrixXd& white, const Fit& fit,
          const std::vector<Parameter>& parameters) {
  const double t = boost::math::quantile(boost::math::students_t(out.degrees_of_freedom), 0.975);
  for (std::size_t j = 0; j < s.free.size(); ++j) {
    const std::size_t k = s.free[j];
    const bool none = undetermined(out, k);
    const double error = none ? kInfinite : std::sqrt(covariance(index(j), index(j))) / s.length[index(j)];
    const double white_error = none ? kInfinite : std::sqrt(white(index(j), index(j))) / s.length[index(j)];
    const bool logarithmic = parameters[k].logarithmic();
    const double value = fit.values[k], unit = logarithmic ? value : 1.0;  // dθ of dln θ
    out.standard_error[k] = unit * error;
    out.white_standard_error[k] = unit * white_error;
    out.low[k] = logarithmic ? value * std::exp(-t * error) : value - t * error;
    out.high[k] = logarithmic ? value * std::exp(t * error) : value + t * error;
    for (std::size_t i = 0; i < s.free.size(); ++i) {
      const double scale = std::sqrt(covariance(index(i), index(i)) * covariance(index(j), index(j)));
      out.correlation[s.free[i]][k] = none || undetermined(out, s.free[i]) ? kNaN : covariance(index(i), index(j)) / scale;
    }
  }
}

}  // namespace

Uncertainty uncertainty(const Residuals& residuals, const Fit& fit) {
  Uncertainty out;
  const std::size_t p = fit.values.size();
  out.standard_error = out.white_standard_error = out.low = out.high = std::vector<double>(p, kNaN);
  out.correlation.assign(p, std::vector<double>(p, kNaN));
  const Scaled s = scaled(residuals, fit, out);
  for (std::size_t k : out.without_effect) {
    out.standard_error[k] = out.white_standard_error[k] = out.high[k] = kInfinite;
    out.low[k] = -kInfinite;
  }
  Eigen::VectorXd r(index(fit.residuals.size()));
  for (std::size_t i = 0; i < fit.residuals.size(); ++i) r[index(i)] = residuals.weight(i) * fit.residuals[i];
  const bool any = !s.free.empty();
  const Eigen::MatrixXd g = any ? inverse(s, out) : Eigen::MatrixXd(0, 0);
  const std::vector<Observation>& observations = residuals.task().observations;
  const ErrorModel e = error_model(residuals.points(), observations.size(), r, s.columns, g);
  out.autocorrelation = e.rho;
  for (std::size_t o = 0; o < observations.size(); ++o) out.sd_rad.push_back(e.sd[o] / observations[o].weight);
  out.effective_samples = e.effective_samples();
  out.degrees_of_freedom = std::max(1.0, out.effective_samples - static_cast<double>(s.free.size()));
  if (!any) return out;
  const Eigen::MatrixXd covariance = g * (s.columns.transpose() * e.apply(residuals.points(), s.columns)) * g;
  const double freedom = std::max(1.0, static_cast<double>(r.size()) - static_cast<double>(s.free.size()));
  fill(out, s, covariance, g * (r.squaredNorm() / freedom), fit, residuals.task().parameters);
  return out;
}

}  // namespace vsa::identify
