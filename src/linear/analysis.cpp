// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/MatrixFunctions>

#include "linear/deflate.hpp"
#include "vsa/checks.hpp"
#include "vsa/errors.hpp"
#include "vsa/linear/linear.hpp"

namespace vsa::linear {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;

constexpr double kTwins = 1e-7;  // of a pole: two real ones that are alike come out as a pair so little off the axis
constexpr double kOver = 1e-9;   // of a sampled system: what of a motion is left after a loop that is over then

Pole pole_of(Complex s) {
  const double size = std::abs(s);
  return {s, size / (2 * kPi), size > 0 ? -s.real() / size : 1.0};
}

struct Found {
  Pole pole;
  Eigen::Index at = 0;  // among the eigenvalues
};

/// Sampled: eigenvalues of A − 1, whose zeros stay where they are; entries of e^{AT} are known to some tens of roundings.
Spectrum spectrum_of(const System& m) {
  const double rounding = static_cast<double>(m.a.rows()) * std::numeric_limits<double>::epsilon();
  if (m.period_s == 0) return spectrum(m.a, 8 * rounding);
  return spectrum(m.a - Eigen::MatrixXd::Identity(m.a.rows(), m.a.rows()), 64 * rounding);
}

std::vector<Found> find(const System& m, const Spectrum& of) {
  std::vector<Found> out;
  for (Eigen::Index i = 0; i < of.values.size(); ++i) {
    Complex v = of.values[i];
    if (std::abs(v.imag()) <= kTwins * std::abs(v)) v = v.real();
    if (v.imag() < 0 || (m.period_s > 0 && std::abs(v + 1.0) <= kOver)) continue;
    out.push_back({pole_of(m.period_s > 0 && v != 0.0 ? std::log(v + 1.0) / m.period_s : v), i});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Found& a, const Found& b) { return a.pole.frequency_Hz < b.pole.frequency_Hz; });
  return out;
}

}  // namespace

std::vector<Pole> poles(const System& m) {
  std::vector<Pole> out;
  for (const Found& f : find(m, spectrum_of(m))) out.push_back(f.pole);
  return out;
}

MatrixXcd shapes(const System& m) {
  const Spectrum of = spectrum_of(m);
  const std::vector<Found> found = find(m, of);
  MatrixXcd out(m.a.rows(), static_cast<Eigen::Index>(found.size()));
  for (std::size_t i = 0; i < found.size(); ++i) out.col(static_cast<Eigen::Index>(i)) = of.vectors.col(found[i].at);
  return out;
}

MatrixXcd answers(const System& m, double frequency_Hz) {
  const double highest = m.period_s > 0 ? 0.5 / m.period_s : HUGE_VAL;
  if (!(frequency_Hz > 0 && frequency_Hz < highest)) {
    throw InputError({"", "frequency_Hz", Checks::text(frequency_Hz), "is out of range",
                      m.period_s > 0 ? "above 0, below half the loop's rate" : "above 0"});
  }
  const Complex jw(0, 2 * kPi * frequency_Hz);
  const Eigen::Index n = m.a.rows();
  MatrixXcd right = m.b.leftCols(m.torques).cast<Complex>();
  if (m.period_s == 0) return (jw * MatrixXcd::Identity(n, n) - m.a.cast<Complex>()).partialPivLu().solve(right);
  // What a torque e^{jωt} adds from loop to loop: ∫ e^{A(T−t)} b e^{jωt} dt over a period.
  const Eigen::Index held = m.held_a.rows();
  const Complex turn = std::exp(jw * m.period_s);
  const MatrixXcd identity = MatrixXcd::Identity(held, held), a = m.held_a.cast<Complex>();
  const MatrixXcd over = (m.held_a * m.period_s).exp().cast<Complex>();
  const MatrixXcd pushed = (turn * identity - over) * m.held_b.leftCols(m.torques).cast<Complex>();
  right.topRows(held) = (jw * identity - a).partialPivLu().solve(pushed);
  return (turn * MatrixXcd::Identity(n, n) - m.a.cast<Complex>()).partialPivLu().solve(right);
}

Response response(const Model& m, double frequency_Hz) {
  const MatrixXcd x = answers(m, frequency_Hz);
  const Complex jw(0, 2 * kPi * frequency_Hz);
  Response out;
  out.frequency_Hz = frequency_Hz;
  out.impedance = 1.0 / x(1, 0);
  out.compliance = x(0, 0);
  const Complex own = out.impedance - jw * m.inertia_kgm2 - m.damping_Nms_per_rad;
  out.stiffness_Nm_per_rad = (jw * own).real();
  out.damping_Nms_per_rad = own.real();
  return out;
}

std::vector<double> logarithmic(double from, double to, int per_decade) {
  const int steps = std::max(1, static_cast<int>(std::ceil(std::log10(to / from) * per_decade - 1e-9)));
  std::vector<double> out;
  for (int i = 0; i <= steps; ++i) out.push_back(from * std::pow(to / from, static_cast<double>(i) / steps));
  return out;
}

}  // namespace vsa::linear
