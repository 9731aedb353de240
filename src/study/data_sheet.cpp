// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/study/data_sheet.hpp"

#include <algorithm>

#include "vsa/errors.hpp"
#include "vsa/units.hpp"

namespace vsa::study {
namespace {

constexpr double kPaperPreset = 0.75;  // section IV-B and IV-C: 100 %

/// The preset that counts as stiff: the paper's for the law that it is about, else the largest that the motors wind to.
double full_preset(const experiment::DataSheet& computed) {
  const bool papers = computed.type.law.rfind("two_sinh", 0) == 0;
  return papers ? std::min(kPaperPreset, computed.type.unit.preset_max) : computed.attainable_preset;
}

/// Whether the softest joint holds what hangs on the bench.
bool carries_the_bench(const experiment::Specimen& specimen, const elastic::Transmission& law) {
  try {
    return experiment::law_deflection(law, 0, experiment::bench_load_peak_Nm(specimen)) < kPi / 2;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

std::optional<double> DataSheet::nominal_load_Nm() const {
  for (const PresetStepResult& r : simulated.preset_step) {
    if (r.options.loaded) return r.run.load_peak_Nm;
  }
  return std::nullopt;
}

DataSheet plan_data_sheet(const experiment::Specimen& specimen) {
  Characterization plan;
  plan.specimen = specimen;
  plan.actuator = specimen.library.load(specimen.type, specimen.overrides);
  const bool has_preset = !plan.preset_unit().empty() && plan.actuator.unit.preset_max > 0;
  experiment::DataSheet computed = experiment::data_sheet(plan.actuator);
  const double full = full_preset(computed);
  const bool steps = has_preset && full > 0;
  for (const double share : {0.0, 0.15, 0.4, 1.0}) {
    if (share == 0 || steps) plan.speed.emplace_back().options.preset = share * full;
  }
  for (const bool loaded : {false, true}) {
    if (!steps || (loaded && !carries_the_bench(specimen, *plan.actuator.unit.actuator.transmission))) break;
    experiment::PresetStepOptions& o = plan.preset_step.emplace_back().options;
    o.preset = full;
    o.loaded = loaded;
  }
  return {std::move(computed), std::move(plan)};
}

std::optional<DataSheet> run(DataSheet plan, const OnProgress& on_progress, unsigned threads) {
  auto simulated = run(std::move(plan.simulated), on_progress, threads);
  if (!simulated) return std::nullopt;
  return DataSheet{std::move(plan.computed), std::move(*simulated)};
}

}  // namespace vsa::study
