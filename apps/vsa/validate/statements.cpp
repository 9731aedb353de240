// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What stands before the numbers of `vsa validate`: what the recordings are, and what was fitted to them.
#include <fmt/format.h>

#include <algorithm>

#include "validate/output.hpp"
#include "vsa/config/text.hpp"

namespace vsa::app {
namespace {

constexpr std::size_t kToldOf = 3;  // values that differ; the others are counted

std::string presets(const std::vector<const study::RecordingCheck*>& recordings) {
  std::vector<std::string> out;
  for (const study::RecordingCheck* r : recordings) out.push_back(fmt::format("{:.4f}", r->preset));
  return (recordings.size() == 1 ? "The recording (preset " : "The recordings (presets ") + config::join(out) +
         (recordings.size() == 1 ? " rad) is " : " rad) are ");
}

void add_origins(const study::Validation& v, std::vector<std::string>& out) {
  std::vector<std::string> seen;
  for (const study::RecordingCheck& r : v.recordings) {
    if (std::find(seen.begin(), seen.end(), r.origin) != seen.end()) continue;
    seen.push_back(r.origin);
    std::vector<const study::RecordingCheck*> same;
    for (const study::RecordingCheck& s : v.recordings) {
      if (s.origin == r.origin) same.push_back(&s);
    }
    out.push_back(presets(same) + (r.origin.empty() ? "of an origin that nobody states" : r.origin) + ".");
  }
}

std::string evidence_text(const study::Validation& v) {
  if (!v.overrides.empty()) {
    return "Values were replaced by --set, so what the type says of its calibration doesn't hold: nothing here counts as "
           "predicted.";
  }
  if (!v.evidence) {
    return v.actuator.name + " doesn't say what it was calibrated on (no [evidence]): nothing here counts as predicted.";
  }
  if (v.evidence->calibrated_on.empty()) return v.actuator.name + " was calibrated on none of them: " + v.evidence->source + ".";
  return fmt::format("{} was calibrated on {}: such figures tell how well a fit went, not what the model predicts. How: {}.",
                     v.actuator.name, config::join(v.evidence->calibrated_on), v.evidence->source);
}

std::string record_text(const study::Validation& v) {
  if (!v.left_out) {
    return fmt::format("There is no leave-one-out record of {}: `vsa identify` with cross-validation writes one, kept as {}.",
                       v.actuator.name, study::record_name(v.actuator.name).generic_string());
  }
  const std::vector<std::string> apart = differences(*v.left_out, v.actuator);
  std::string how =
      fmt::format("Without each recording in turn {} {} fitted again and every other value held, by the command that it holds.",
                  config::join(v.left_out->fitted), v.left_out->fitted.size() == 1 ? "was" : "were");
  if (const auto elsewhere = fitted_elsewhere(*v.left_out, v.actuator); !elsewhere.empty())
    how += fmt::format(" Its fit to all ended at other values of {} than the type's, which lie outside of its 95 % intervals.",
                       config::join(elsewhere));
  if (apart.empty()) return fmt::format("Leave-one-out figures: {}. {}", v.left_out->file, how);
  std::vector<std::string> first(apart.begin(), apart.begin() + static_cast<std::ptrdiff_t>(std::min(kToldOf, apart.size())));
  if (apart.size() > kToldOf) first.push_back(fmt::format("and {} more", apart.size() - kToldOf));
  return fmt::format("The leave-one-out figures are STALE: {} is of another parameter set ({}). {}", v.left_out->file,
                     config::join(first), how);
}

}  // namespace

std::vector<std::string> statements(const study::Validation& v) {
  std::vector<std::string> out;
  add_origins(v, out);
  out.push_back(evidence_text(v));
  out.push_back(record_text(v));
  return out;
}

std::string counts_text(const study::Validation& v) {
  const experiment::Count predictions = experiment::count(v.verdicts, experiment::Kind::predicted);
  const experiment::Count guards = experiment::count(v.verdicts, experiment::Kind::calibrated);
  return fmt::format("Predictions held: {} of {}{}; calibrated figures within their guard: {} of {}.", predictions.held,
                     predictions.all, predictions.all == 0 ? " (no bound is on a predicted figure)" : "", guards.held, guards.all);
}

}  // namespace vsa::app
