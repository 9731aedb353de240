// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/page/json.hpp"
#include "vsa/study/validation.hpp"

namespace vsa::study {
namespace {

using page::Json;
using page::real;
using page::reals;

Json branches_json(const experiment::Branches& b) {
  return {{"load_torque_Nm", reals(b.torque_Nm)},
          {"deflection_rising_rad", reals(b.rising_rad)},
          {"deflection_falling_rad", reals(b.falling_rad)}};
}

Json evidence_json(const Validation& v) {
  if (!v.evidence) return nullptr;
  return {{"calibrated_on", v.evidence->calibrated_on}, {"source", v.evidence->source}};
}

Json left_out_json(const Validation& v) {
  if (!v.left_out) return nullptr;
  Json rows = Json::array();
  for (const LeaveOneOut::Row& r : v.left_out->rows) {
    rows.push_back(
        {{"preset", r.preset}, {"rms_predicted_rad", real(r.predicted_rad)}, {"rms_fitted_to_all_rad", real(r.fitted_rad)}});
  }
  return {{"file", v.left_out->file},
          {"command", v.left_out->command},
          {"stale", differences(*v.left_out, v.actuator)},
          {"fitted_elsewhere", fitted_elsewhere(*v.left_out, v.actuator)},
          {"presets", std::move(rows)}};
}

Json count_json(const Validation& v, experiment::Kind kind) {
  const experiment::Count c = experiment::count(v.verdicts, kind);
  return {{"held", c.held}, {"all", c.all}};
}

}  // namespace

std::string to_json(const Validation& v, const std::string& command) {
  Json out = page::results_head(command);
  out["type"] = v.actuator.name;
  Json& overrides = out["overrides"] = Json::object();
  for (const config::Override& o : v.overrides) overrides[o.key] = o.value;
  out["evidence"] = evidence_json(v);
  out["leave_one_out"] = left_out_json(v);
  out["passed"] = experiment::all_held(v.verdicts);
  out["predictions"] = count_json(v, experiment::Kind::predicted);
  out["guards"] = count_json(v, experiment::Kind::calibrated);
  Json& bounds = out["bounds"] = Json::array();
  for (const experiment::Verdict& d : v.verdicts) {
    bounds.push_back({{"quantity", d.bound.quantity},
                      {"value", real(d.value)},
                      {"min", d.bound.min ? Json(*d.bound.min) : Json(nullptr)},
                      {"max", d.bound.max ? Json(*d.bound.max) : Json(nullptr)},
                      {"kind", experiment::kind_text(d.kind)},
                      {"held", d.held},
                      {"why", d.bound.why}});
  }
  Json& all = out["quantities"] = Json::object();
  for (const auto& [name, value] : quantities(v)) all[name] = real(value);
  Json& periods = out["periods"] = Json::array();
  for (const PeriodCheck& p : v.periods) {
    periods.push_back({{"preset_rad", p.preset},
                       {"period_s", p.period_s},
                       {"rms_rad", real(p.rms.both_rad)},
                       {"loop_area_Nm_rad", real(p.loop.area_Nm_rad)},
                       {"mean_width_rad", real(p.loop.mean_width_rad)}});
  }
  Json& recordings = out["recordings"] = Json::array();
  for (const RecordingCheck& r : v.recordings) {
    recordings.push_back({{"file", r.file},
                          {"preset_rad", r.preset},
                          {"kind", recording_kind(v, r)},
                          {"origin", r.origin.empty() ? Json(nullptr) : Json(r.origin)},
                          {"rms_rad", real(r.rms.both_rad)},
                          {"rms_Nm", real(r.torque.both_Nm)},
                          {"extrapolated_points", r.torque.extrapolated},
                          {"recorded_loop_area_Nm_rad", real(r.data_loop.area_Nm_rad)},
                          {"recorded_mean_width_rad", real(r.data_loop.mean_width_rad)},
                          {"recorded", branches_json(r.data)},
                          {"simulated", branches_json(r.ours)}});
  }
  out["wall_s"] = v.wall_s;
  return page::results_text(out);
}

}  // namespace vsa::study
