// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Runs that are studies: a table [study] in the place of a scenario's, its measures by where they stand in the results.
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "sweep/fit_run.hpp"
#include "sweep/plan_impl.hpp"
#include "sweep/plan_parts.hpp"
#include "vsa/config/text.hpp"
#include "vsa/config/toml_section.hpp"
#include "vsa/errors.hpp"
#include "vsa/not_a_number.hpp"
#include "vsa/study/characterization.hpp"
#include "vsa/study/validation.hpp"

namespace vsa::sweep {
namespace {

using config::TomlSection;
using Json = nlohmann::json;
using Task = std::variant<study::CharacterizationOptions, study::ValidationOptions, FitTask>;

void read_characterization(TomlSection& s, study::CharacterizationOptions& out) {
  const auto all = {study::Experiment::stiffness, study::Experiment::speed, study::Experiment::preset_step};
  std::vector<std::string> known;
  for (const auto e : all) known.emplace_back(study::word(e));
  for (const std::string& given : s.texts("experiments")) {
    const auto at = std::find(known.begin(), known.end(), given);
    if (at == known.end()) {
      s.add("experiments", given, "there is none of that name", config::join(known));
    } else {
      out.experiments.push_back(*(all.begin() + (at - known.begin())));
    }
  }
  out.preset = s.numbers("preset_rad", -kAny, kAny);
  out.period_s = s.number("period_s", 1, 3600);
  out.amplitude_rad = s.number("amplitude_rad", 0.01, 3);
  if (const auto cycles = s.whole("cycles", 1, 1000)) out.cycles = static_cast<int>(*cycles);
}

Task task_of(const Plan::Impl& plan, const std::vector<Value>& values) {
  toml::table root = plan.base;
  for (std::size_t k = 0; k < values.size(); ++k)
    for (const std::string& key : plan.axes[k].keys) put(root, key, values[k]);
  Problems problems;
  TomlSection top(&root, plan.base_file.string(), "", problems);
  TomlSection s(top.table("study"), plan.base_file.string(), "study.", problems);
  const std::string kind =
      s.need("kind", "characterize, validate, fit").word("kind", {"characterize", "validate", "fit"}).value_or("validate");
  experiment::Specimen specimen;
  specimen.type = s.need("type", "an actuator type's name").text("type").value_or("qbmove_maker_pro");
  for (const config::Override& o : top.overrides("set")) specimen.overrides.push_back(o);
  specimen.step_s = s.number("step_s", engine::kShortestStep_s, engine::kLongestStep_s);
  Task out;
  if (kind == "characterize") {
    study::CharacterizationOptions options;
    options.specimen = std::move(specimen);
    read_characterization(s, options);
    out = std::move(options);
  } else if (kind == "fit") {
    out = read_fit(s, plan.base_file, std::move(specimen), problems);
  } else {
    study::ValidationOptions options;
    options.specimen = std::move(specimen);
    for (const std::string& folder : s.texts("recordings")) options.recordings.push_back(plan.base_file.parent_path() / folder);
    out = std::move(options);
  }
  s.refuse_others();
  top.refuse_others();
  problems.throw_if_any();
  return out;
}

/// The number at a place; null, what couldn't be measured: NaN. None: there is no such place, or no number there.
std::optional<double> number_at(const Json& results, const std::string& place) {
  try {
    const Json& found = results.at(Json::json_pointer(place));
    if (found.is_null()) return kNaN;
    return found.is_number() ? std::optional(found.get<double>()) : std::nullopt;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

/// Every place with a number, for those who asked for another.
void places(const Json& at, const std::string& path, std::vector<std::string>& out) {
  if (at.is_structured()) {
    for (const auto& [key, value] : at.items()) places(value, path + '/' + key, out);
  } else if (at.is_number() || at.is_null()) {
    out.push_back(path);
  }
}

void refuse_place(const Measure& m, const Plan::Impl& plan, std::vector<std::string> known) {
  constexpr std::size_t kShown = 100;
  const std::string meant = config::did_you_mean(m.value, known);
  if (known.size() > kShown) {
    known.resize(kShown);
    known.emplace_back("…");
  }
  throw InputError({plan.file.string(), "measure.value", m.value, "the study has no such number" + meant, config::join(known)});
}

/// All quantities that a validation of this plan will have.
std::vector<std::string> quantity_names(const study::ValidationPlan& plan) {
  study::Validation shape;
  for (const auto& r : plan.recordings) {
    study::RecordingCheck check;
    check.preset = r.preset;
    shape.recordings.push_back(std::move(check));
  }
  for (const auto& s : plan.runs.speed) {
    study::SpeedCheck check;
    check.preset = s.options.preset;
    shape.speeds.push_back(std::move(check));
  }
  for (const bool loaded : {false, true}) {
    study::PresetStepCheck check;
    check.loaded = loaded;
    if (!plan.runs.preset_step.empty()) shape.preset_steps.push_back(std::move(check));
  }
  std::vector<std::string> out;
  for (const auto& [name, value] : study::quantities(shape)) out.push_back(name);
  return out;
}

}  // namespace

void check_study(const Plan::Impl& plan, const std::vector<Value>& values) {
  const Task task = task_of(plan, values);
  if (const auto* options = std::get_if<study::CharacterizationOptions>(&task)) {
    const Json shape = Json::parse(study::to_json(study::plan_characterization(*options), ""));
    for (const Measure& m : plan.measures) {
      if (number_at(shape, m.value)) continue;
      std::vector<std::string> known;
      places(shape, "", known);
      refuse_place(m, plan, known);
    }
    return;
  }
  const auto* fit = std::get_if<FitTask>(&task);
  const std::vector<std::string> known =
      fit != nullptr ? fit_numbers(*fit) : quantity_names(study::plan_validation(std::get<study::ValidationOptions>(task)));
  for (const Measure& m : plan.measures)
    if (std::find(known.begin(), known.end(), m.value) == known.end()) refuse_place(m, plan, known);
}

std::optional<std::vector<double>> run_study(const Plan::Impl& plan, const std::vector<Value>& values,
                                             const std::function<bool()>& wanted) {
  const Task task = task_of(plan, values);
  const study::OnProgress on_progress = [&](const study::Progress&) { return wanted(); };
  std::vector<double> out;
  if (const auto* options = std::get_if<study::CharacterizationOptions>(&task)) {
    const auto done = study::run(study::plan_characterization(*options), on_progress, 1);
    if (!done) return std::nullopt;
    const Json results = Json::parse(study::to_json(*done, ""));
    for (const Measure& m : plan.measures) out.push_back(number_at(results, m.value).value_or(kNaN));
    return out;
  }
  std::map<std::string, double> quantities;
  if (const auto* fit = std::get_if<FitTask>(&task)) {
    auto done = run_fit(*fit, wanted);
    if (!done) return std::nullopt;
    quantities = std::move(*done);
  } else {
    const auto done = study::run(study::plan_validation(std::get<study::ValidationOptions>(task)), on_progress, 1);
    if (!done) return std::nullopt;
    quantities = study::quantities(*done);
  }
  for (const Measure& m : plan.measures) {
    const auto at = quantities.find(m.value);
    out.push_back(at == quantities.end() ? kNaN : at->second);
  }
  return out;
}

}  // namespace vsa::sweep
