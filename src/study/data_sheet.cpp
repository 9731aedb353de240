// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/study/data_sheet.hpp"

#include <algorithm>

namespace vsa::study {
namespace {

constexpr double kPaperPreset = 0.75;  // section IV-B and IV-C: 100 %

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
  const double full = std::min(kPaperPreset, plan.actuator.unit.preset_max);
  for (const double share : {0.0, 0.15, 0.4, 1.0}) {
    if (share == 0 || has_preset) plan.speed.emplace_back().options.preset = share * full;
  }
  for (const bool loaded : {false, true}) {
    if (!has_preset) break;
    experiment::PresetStepOptions& o = plan.preset_step.emplace_back().options;
    o.preset = full;
    o.loaded = loaded;
  }
  experiment::DataSheet computed = experiment::data_sheet(plan.actuator);
  return {std::move(computed), std::move(plan)};
}

std::optional<DataSheet> run(DataSheet plan, const OnProgress& on_progress, unsigned threads) {
  auto simulated = run(std::move(plan.simulated), on_progress, threads);
  if (!simulated) return std::nullopt;
  return DataSheet{std::move(plan.computed), std::move(*simulated)};
}

}  // namespace vsa::study
