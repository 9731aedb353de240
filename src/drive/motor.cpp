// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/drive/motor.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::drive {
namespace {

// z = (ω, I, V, T); V and T are constant over a step, so their rows of F are zero.
using Vector = std::array<double, 4>;
using Matrix = std::array<Vector, 4>;

double dot(const Vector& a, const Vector& b) noexcept { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

Vector row_times(const Vector& row, const Matrix& m) noexcept {
  Vector out{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) out[j] += row[i] * m[i][j];
  return out;
}

Matrix product(const Matrix& a, const Matrix& b) noexcept {
  Matrix out{};
  for (int i = 0; i < 4; ++i) out[i] = row_times(a[i], b);
  return out;
}

Matrix transposed(const Matrix& m) noexcept {
  Matrix out{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) out[j][i] = m[i][j];
  return out;
}

/// exp(F s) by its Taylor series; the caller keeps ‖F s‖ below 1/4, where 14 terms reach 1e-19.
Matrix exponential(const Matrix& f, double s) noexcept {
  Matrix sum{}, term{};
  for (int i = 0; i < 4; ++i) sum[i][i] = term[i][i] = 1.0;
  for (int n = 1; n <= 14; ++n) {
    term = product(term, f);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        term[i][j] *= s / n;
        sum[i][j] += term[i][j];
      }
  }
  return sum;
}

double norm(const Matrix& f) noexcept {
  double largest = 0;
  for (const Vector& row : f) {
    double sum = 0;
    for (double v : row) sum += std::abs(v);
    largest = std::max(largest, sum);
  }
  return largest;
}

struct Plant {
  Matrix f{};        // ż = F z
  Vector speed{};    // ω = speed·z
  Vector current{};  // I = current·z
};

Plant plant(const MotorParams& m, Terminal terminal) noexcept {
  Plant p;
  p.speed[0] = 1.0;
  p.f[0][0] = -m.viscous_Nms_per_rad / m.inertia_kgm2;
  p.f[0][3] = 1.0 / m.inertia_kgm2;
  if (terminal == Terminal::open) return p;
  const double drive = m.torque_constant_Nm_per_A / m.inertia_kgm2;
  if (m.inductance_H) {
    p.current[1] = 1.0;
    p.f[1] = {-m.back_emf_Vs_per_rad / *m.inductance_H, -m.resistance_Ohm / *m.inductance_H, 1.0 / *m.inductance_H, 0.0};
  } else {
    p.current = {-m.back_emf_Vs_per_rad / m.resistance_Ohm, 0.0, 1.0 / m.resistance_Ohm, 0.0};
  }
  for (int j = 0; j < 4; ++j) p.f[0][j] += drive * p.current[j];
  return p;
}

/// Integrals over a step that doubling carries from h/2^k to h.
struct Integrals {
  Matrix phi{};               // z at the end
  Vector speed{}, current{};  // ∫ω, ∫I as rows
  Matrix ii{}, ww{}, iw{};    // ∫I², ∫ω², ∫Iω as forms
};

void add_outer(Matrix& sum, const Vector& a, const Vector& b, double w) noexcept {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) sum[i][j] += w * a[i] * b[j];
}

Integrals short_step(const Plant& p, double h) noexcept {
  // Gauss–Legendre, five nodes: exact to order 9, far below rounding for ‖F h‖ < 1/16.
  constexpr std::array<double, 5> x{-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 5> w{0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                                    0.2369268850561891};
  Integrals out;
  out.phi = exponential(p.f, h);
  for (int n = 0; n < 5; ++n) {
    const Matrix phi = exponential(p.f, 0.5 * h * (1.0 + x[n]));
    const Vector speed = row_times(p.speed, phi);
    const Vector current = row_times(p.current, phi);
    const double weight = 0.5 * h * w[n];
    for (int j = 0; j < 4; ++j) {
      out.speed[j] += weight * speed[j];
      out.current[j] += weight * current[j];
    }
    add_outer(out.ww, speed, speed, weight);
    add_outer(out.ii, current, current, weight);
    add_outer(out.iw, current, speed, weight);
  }
  return out;
}

void add_carried(Matrix& form, const Matrix& phi) noexcept {
  const Matrix carried = product(product(transposed(phi), form), phi);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) form[i][j] += carried[i][j];
}

void double_step(Integrals& s) noexcept {
  const Vector speed = row_times(s.speed, s.phi);
  const Vector current = row_times(s.current, s.phi);
  for (int j = 0; j < 4; ++j) {
    s.speed[j] += speed[j];
    s.current[j] += current[j];
  }
  add_carried(s.ww, s.phi);
  add_carried(s.ii, s.phi);
  add_carried(s.iw, s.phi);
  s.phi = product(s.phi, s.phi);
}

/// Symmetric part, packed so that value() needs one pass.
std::array<double, 10> packed(const Matrix& m) noexcept {
  std::array<double, 10> out{};
  int n = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = i; j < 4; ++j) out[n++] = i == j ? m[i][i] : m[i][j] + m[j][i];
  return out;
}

double value(const std::array<double, 10>& form, const Vector& z) noexcept {
  return z[0] * (form[0] * z[0] + form[1] * z[1] + form[2] * z[2] + form[3] * z[3]) +
         z[1] * (form[4] * z[1] + form[5] * z[2] + form[6] * z[3]) + z[2] * (form[7] * z[2] + form[8] * z[3]) +
         form[9] * z[3] * z[3];
}

}  // namespace

MotorParams at_pulley(const MotorParams& motor, double ratio) noexcept {
  MotorParams p = motor;
  p.inertia_kgm2 *= ratio * ratio;
  p.viscous_Nms_per_rad *= ratio * ratio;
  p.torque_constant_Nm_per_A *= ratio;
  p.back_emf_Vs_per_rad *= ratio;
  return p;
}

FrictionParams at_pulley(const FrictionParams& loss, double ratio) noexcept {
  return {loss.coulomb_Nm * ratio, loss.presliding_rad};
}

MotorStepper::MotorStepper(const MotorParams& pulley_side, Terminal terminal, double h_s) noexcept
    : h_(h_s), inductance_(pulley_side.inductance_H.has_value()), back_emf_(pulley_side.back_emf_Vs_per_rad) {
  if (terminal == Terminal::driven && !inductance_) conductance_ = 1.0 / pulley_side.resistance_Ohm;
  const Plant p = plant(pulley_side, terminal);
  int doublings = 0;
  for (double n = norm(p.f) * h_s; n > 1.0 / 16 && doublings < 60; n *= 0.5) ++doublings;
  Integrals s = short_step(p, std::ldexp(h_s, -doublings));
  for (int i = 0; i < doublings; ++i) double_step(s);
  displacement_ = s.speed;
  charge_ = s.current;
  speed_ = s.phi[0];
  current_ = row_times(p.current, s.phi);
  ii_ = packed(s.ii);
  ww_ = packed(s.ww);
  iw_ = packed(s.iw);
}

MotorStep MotorStepper::with_inductance(const MotorState& s, double voltage, double torque) const noexcept {
  const Vector z{s.speed, s.current, voltage, torque};
  MotorStep out;
  out.displacement = dot(displacement_, z);
  out.speed = dot(speed_, z);
  out.current = dot(current_, z);
  out.charge = dot(charge_, z);
  out.int_II = value(ii_, z);
  out.int_ww = value(ww_, z);
  out.int_Iw = value(iw_, z);
  return out;
}

double current(const MotorParams& m, Terminal terminal, const MotorState& s, double voltage) noexcept {
  if (terminal == Terminal::open) return 0.0;
  if (m.inductance_H) return s.current;
  return (voltage - m.back_emf_Vs_per_rad * s.speed) / m.resistance_Ohm;
}

}  // namespace vsa::drive
