// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/study/data_sheet.hpp"

#include "study/linear_shaft.hpp"
#include "study/preset_steps.hpp"

namespace vsa::study {

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
  experiment::DataSheet computed = experiment::data_sheet(plan.actuator);
  mount(plan);
  const bool has_preset = !plan.preset_unit().empty() && plan.actuator.unit.preset_max > 0;
  plan.fit = fit_bench(plan.specimen, plan.actuator);
  const bool steps = has_preset && plan.fit.full > 0;
  for (const double share : {0.0, 0.15, 0.4, 1.0}) {
    if (share == 0 || steps) plan.speed.emplace_back().options.preset = share * plan.fit.full;
  }
  if (steps) plan_preset_steps(plan, plan.fit.full);
  return {std::move(computed), std::move(plan)};
}

std::optional<DataSheet> run(DataSheet plan, const OnProgress& on_progress, unsigned threads) {
  auto simulated = run(std::move(plan.simulated), on_progress, threads);
  if (!simulated) return std::nullopt;
  return DataSheet{std::move(plan.computed), std::move(*simulated)};
}

}  // namespace vsa::study
