// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/study/bench_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "vsa/errors.hpp"
#include "vsa/experiment/workspace.hpp"
#include "vsa/units.hpp"

namespace vsa::study {
namespace {

constexpr double kPaperPreset = 0.75;  // section IV-B and IV-C: 100 %
constexpr int kPresets = 100;          // tried between 0 and the largest that the motors wind to
constexpr double kMargin = 1.1;        // of torque: no lever hangs on the verge of falling
constexpr double kReserve = 2;         // peak torque over load, at least

/// Less than a right angle under the load, to both sides.
bool law_carries(const elastic::Transmission& law, double preset, double load_Nm) {
  try {
    return experiment::law_deflection(law, preset, load_Nm) < kPi / 2 &&
           experiment::law_deflection(law, preset, -load_Nm) > -kPi / 2;
  } catch (const InputError&) {
    return false;
  }
}

/// That, and the motors can move it.
bool carries(const experiment::Workspace& workspace, const elastic::Transmission& law, double preset, double load_Nm) {
  return workspace.moves_Nm(preset) >= kMargin * load_Nm && law_carries(law, preset, load_Nm);
}

/// 1, 2 or 5 times a power of ten, at most `value`.
double round_down(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  return power * (value >= 5 * power ? 5 : value >= 2 * power ? 2 : 1);
}

struct Searched {
  const experiment::Workspace& workspace;
  const elastic::Transmission& law;
  double full;

  [[nodiscard]] double preset(int i) const { return full * i / kPresets; }
  [[nodiscard]] int last() const { return full > 0 ? kPresets : 0; }
  /// Over all presets.
  [[nodiscard]] double peak_Nm() const {
    double out = 0;
    for (int i = 0; i <= last(); i += 5) out = std::fmax(out, workspace.moves_Nm(preset(i)));
    return out;
  }
  [[nodiscard]] std::optional<double> first(double load_Nm) const {
    for (int i = 0; i <= last(); ++i)
      if (carries(workspace, law, preset(i), load_Nm)) return preset(i);
    return std::nullopt;
  }
  [[nodiscard]] double stiffest(double load_Nm) const {
    int i = last();
    while (i > 0 && !carries(workspace, law, preset(i), load_Nm)) --i;
    return preset(i);
  }
};

}  // namespace

BenchFit fit_bench(const experiment::Specimen& specimen, const config::ActuatorType& type, std::optional<double> load_share) {
  const elastic::Transmission& law = *type.unit.actuator.transmission;
  const experiment::Workspace workspace(type.unit);
  const double load = experiment::bench_load_peak_Nm(specimen);
  BenchFit fit;
  fit.load_share = load_share.value_or(1.0);
  fit.papers_law = type.law.rfind("two_sinh", 0) == 0;
  if (fit.papers_law) {
    fit.full = fit.stiffest = std::min(kPaperPreset, type.unit.preset_max);
    fit.carries = law_carries(law, 0, fit.load_share * load);
    return fit;
  }
  const Searched searched{workspace, law, workspace.attainable_preset()};
  fit.full = fit.stiffest = searched.full;
  const double most = searched.peak_Nm() / (kReserve * load);
  if (!(most > 0)) return fit;
  for (const double share : {load_share.value_or(std::max(1.0, round_down(most))), load_share.value_or(round_down(most))}) {
    const auto softest = searched.first(share * load);
    if (!softest) continue;
    fit.carries = true;
    fit.load_share = share;
    fit.softest = *softest;
    fit.stiffest = searched.stiffest(share * load);
    break;
  }
  return fit;
}

double carried_preset(const BenchFit& fit, double share) { return std::clamp(share * fit.full, fit.softest, fit.stiffest); }

}  // namespace vsa::study
