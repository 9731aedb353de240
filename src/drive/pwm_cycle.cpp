// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/drive/pwm_cycle.hpp"

#include <algorithm>
#include <cmath>

namespace vsa::drive {
namespace {

constexpr double kSmallRatio = 0.03;  // below it series of six terms reach 1e-12, and differences would lose digits

/// Σ (−1)^k x^k/c_k from k = 0, c given as reciprocals.
template <class... C>
double alternating(double x, C... reciprocal) noexcept {
  double sum = 0, power = 1;
  ((sum += power * reciprocal, power *= -x), ...);
  return sum;
}

/// 1 − (1 − e^(−x))/x ≈ x/2
double phi_deficit(double x, double phi) noexcept {
  if (x < kSmallRatio) return x * alternating(x, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 720, 1.0 / 5040);
  return 1.0 - phi;
}

/// 1 − 2φ(x) + φ(2x) ≈ x²/3
double square_deficit(double x, double phi, double phi_twice) noexcept {
  if (x < kSmallRatio) return x * x * alternating(x, 1.0 / 3, 1.0 / 4, 7.0 / 60, 1.0 / 24, 31.0 / 2520, 1.0 / 320);
  return 1.0 - 2.0 * phi + phi_twice;
}

/// ρ − ln(1 + ρ) ≈ ρ²/2
double log_deficit(double rho) noexcept {
  if (rho < kSmallRatio)
    return rho * rho * alternating(rho, 1.0 / 2, 1.0 / 3, 1.0 / 4, 1.0 / 5, 1.0 / 6, 1.0 / 7, 1.0 / 8, 1.0 / 9);
  return rho - std::log1p(rho);
}

/// ρ²/2 − ρ + ln(1 + ρ) ≈ ρ³/3, from the other
double log_deficit2(double rho, double deficit) noexcept {
  if (rho < kSmallRatio)
    return rho * rho * rho * alternating(rho, 1.0 / 3, 1.0 / 4, 1.0 / 5, 1.0 / 6, 1.0 / 7, 1.0 / 8, 1.0 / 9, 1.0 / 10);
  return 0.5 * rho * rho - deficit;
}

}  // namespace

void PwmCycle::Phase::prepare(double part, double x) noexcept {
  rise = x > 0 ? -std::expm1(-x) : 0.0;
  const double phi = x > 0 ? rise / x : 1.0, phi_twice = phi * (1.0 - 0.5 * rise);  // φ(x), φ(2x)
  decay = part * phi;
  rest = part * phi_deficit(x, phi);
  begin2 = part * phi_twice;
  mixed = decay - begin2;
  end2 = part * square_deficit(x, phi, phi_twice);
}

PwmCycle::PwmCycle(const BridgeParams& bridge, double supply_V, double resistance_Ohm, double inductance_H, double duty) noexcept
    : pin_(bridge.pin),
      duty_(duty),
      sense_(duty < 0 ? -1.0 : 1.0),
      supply_(supply_V),
      wall_(supply_V + 2.0 * bridge.diode_V),
      winding_(resistance_Ohm),
      switch_(bridge.switch_Ohm),
      diode_(bridge.diode_V) {
  const double d = std::min(std::abs(duty), 1.0), off = 1.0 - d;
  on_.resistance = winding_ + switch_;
  off_.resistance = pin_ == PwmPin::input ? winding_ + switch_ : winding_;
  const double per_Ohm = bridge.period_s > 0 && inductance_H > 0 ? bridge.period_s / inductance_H : 0.0;
  const double x_on = per_Ohm * on_.resistance * d, x_off = per_Ohm * off_.resistance * off;
  slow_ = per_Ohm * off_.resistance;
  on_.prepare(d, x_on);
  off_.prepare(off, x_off);
  // j₀ = w₁ j_on + w₂ j_off, the peak likewise; for T → 0 both are the mean, weighted with the resistances.
  if (slow_ > 0) {
    const double whole = on_.rise + off_.rise * (1.0 - on_.rise);  // 1 − e^(−both)
    begin_on_ = on_.rise * (1.0 - off_.rise) / whole;
    begin_off_ = off_.rise / whole;
    peak_on_ = on_.rise / whole;
    peak_off_ = off_.rise * (1.0 - on_.rise) / whole;
  } else {
    const double whole = on_.resistance * d + off_.resistance * off;
    begin_on_ = peak_on_ = on_.resistance * d / whole;
    begin_off_ = peak_off_ = off_.resistance * off / whole;
  }
  mean_on_ = begin_on_ * on_.decay + on_.rest + peak_on_ * off_.decay;
  mean_off_ = begin_off_ * on_.decay + peak_off_ * off_.decay + off_.rest;
}

PwmCycle::Solution PwmCycle::solve(double emf) const noexcept {
  Solution s;
  double target_off = 0;
  if (pin_ == PwmPin::input) {
    s.target_on = (supply_ - emf) / on_.resistance;
    target_off = -emf / off_.resistance;
  } else {
    s.sign = emf > supply_ ? -1.0 : 1.0;
    s.target_on = s.sign * (supply_ - emf) / on_.resistance;
    s.against = wall_ + s.sign * emf;
    target_off = -s.against / off_.resistance;
  }
  s.begin = begin_on_ * s.target_on + begin_off_ * target_off;
  s.continuous = pin_ == PwmPin::input || s.begin > 0;
  if (s.continuous) {
    s.peak = peak_on_ * s.target_on + peak_off_ * target_off;
  } else {
    s.begin = 0;
    s.peak = s.target_on * on_.rise;
  }
  return s;
}

PwmMean PwmCycle::mean(double emf_V) const noexcept {
  const double emf = sense_ * emf_V;
  const Solution s = solve(emf);
  if (s.continuous) {
    const double target_off = pin_ == PwmPin::input ? -emf / off_.resistance : -s.against / off_.resistance;
    const double current = mean_on_ * s.target_on + mean_off_ * target_off;
    return {sense_ * s.sign * current, mean_on_ / on_.resistance + mean_off_ / off_.resistance};
  }
  // j_on rises from 0 for d T, then falls to 0 in (L/R) ln(1 + ρ).
  if (!(slow_ > 0) || !(s.against > 0)) return {};
  const double rho = off_.resistance * s.peak / s.against, deficit = log_deficit(rho), per = 1.0 / (off_.resistance * slow_);
  const double current = s.target_on * on_.rest + s.against * deficit * per;
  // d/de of both parts; ρ/(1 + ρ) ≤ ln(1 + ρ), so neither is negative.
  const double share = rho / (1.0 + rho);
  const double lost = on_.rise * off_.resistance / on_.resistance * share + (rho * share - deficit);
  return {sense_ * s.sign * current, on_.rest / on_.resistance + lost * per};
}

PwmPower PwmCycle::power(double emf_V) const noexcept {
  const Solution s = solve(sense_ * emf_V);
  // Charge and ∫j² of the two phases, as means over the period.
  double q_on = on_.decay * s.begin + on_.rest * s.target_on, q_off = 0;
  const double jj_on =
      on_.begin2 * s.begin * s.begin + 2.0 * on_.mixed * s.begin * s.target_on + on_.end2 * s.target_on * s.target_on;
  double jj_off = 0;
  if (s.continuous) {
    const double target = (pin_ == PwmPin::input ? s.target_on * on_.resistance - supply_ : -s.against) / off_.resistance;
    q_off = off_.decay * s.peak + off_.rest * target;
    jj_off = off_.begin2 * s.peak * s.peak + 2.0 * off_.mixed * s.peak * target + off_.end2 * target * target;
  } else if (slow_ > 0 && s.against > 0) {
    const double rho = off_.resistance * s.peak / s.against, unit = s.against / (off_.resistance * slow_);
    const double deficit = log_deficit(rho);
    q_off = unit * deficit;
    jj_off = unit * s.against / off_.resistance * log_deficit2(rho, deficit);
  }
  if (pin_ == PwmPin::input) return {supply_ * q_on, winding_ * (jj_on + jj_off), switch_ * (jj_on + jj_off)};
  return {supply_ * (s.sign * q_on - q_off), winding_ * (jj_on + jj_off), switch_ * jj_on + 2.0 * diode_ * q_off};
}

}  // namespace vsa::drive
