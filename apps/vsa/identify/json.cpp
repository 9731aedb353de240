// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/page/json.hpp"

#include "identify/output.hpp"
#include "vsa/config/text.hpp"
#include "vsa/page/sliding_keys.hpp"

namespace vsa::app {
namespace {

using page::Json;
using page::real;
using page::reals;

Json parameters_json(const Identification& r) {
  Json out = Json::array();
  const identify::Uncertainty& u = r.found.uncertainty;
  for (std::size_t k = 0; k < r.found.task.parameters.size(); ++k) {
    const identify::Parameter& p = r.found.task.parameters[k];
    out.push_back({{"name", p.name},
                   {"keys", p.keys},
                   {"unit", p.unit},
                   {"start", p.start},
                   {"bounds", {p.min, p.max}},
                   {"value", r.found.fit.values[k]},
                   {"standard_error", real(u.standard_error[k])},
                   {"interval_95", {real(u.low[k]), real(u.high[k])}},
                   {"standard_error_if_white", real(u.white_standard_error[k])},
                   {"at_bound", static_cast<bool>(r.found.fit.at_bound[k])}});
  }
  return out;
}

Json difference_json(const experiment::Difference& d) {
  return {{"rms_rad", real(d.both_rad)}, {"rms_rising_rad", real(d.rising_rad)}, {"rms_falling_rad", real(d.falling_rad)}};
}

Json recordings_json(const Identification& r) {
  Json out = Json::array();
  for (std::size_t o = 0; o < r.found.task.observations.size(); ++o) {
    out.push_back({{"file", r.found.task.observations[o].name},
                   {"preset", r.found.task.observations[o].preset},
                   {"weight_per_rad", r.found.task.observations[o].weight},
                   {"points", r.found.misfits[o].rms.points},
                   {"before", difference_json(r.found.misfits_before[o].rms)},
                   {"after", difference_json(r.found.misfits[o].rms)},
                   {"residual_autocorrelation", real(r.found.uncertainty.autocorrelation[o])},
                   {"residual_sd_rad", real(r.found.uncertainty.sd_rad[o])}});
  }
  return out;
}

Json groups_json(const Identification& r) {
  Json out = Json::array();
  for (const auto& group : r.found.uncertainty.unseparated) {
    Json names = Json::array();
    for (std::size_t k : group) names.push_back(r.found.task.parameters[k].name);
    out.push_back(names);
  }
  return out;
}

Json starts_json(const Identification& r) {
  Json out = Json::array();
  for (const identify::StartResult& s : r.found.fit.starts) {
    out.push_back(
        {{"from", s.from}, {"to", s.to}, {"rms_rad", s.rms_rad}, {"iterations", s.iterations}, {"converged", s.converged}});
  }
  return out;
}

Json left_out_json(const Identification& r) {
  Json out = Json::array();
  for (const identify::LeftOut& l : r.found.left_out) {
    out.push_back(
        {{"preset", l.preset}, {"values", l.values}, {"rms_rad", l.rms_rad}, {"rms_rad_fitted_to_all", l.rms_rad_of_all}});
  }
  return out;
}

Json profiles_json(const Identification& r) {
  Json out = Json::array();
  for (std::size_t k = 0; k < r.found.profiles.size(); ++k) {
    Json values = Json::array(), rms = Json::array();
    for (const identify::ProfilePoint& p : r.found.profiles[k]) {
      values.push_back(p.value);
      rms.push_back(p.rms_rad);
    }
    out.push_back({{"name", r.found.task.parameters[k].name}, {"value", values}, {"rms_rad", rms}});
  }
  return out;
}

/// Null: none was asked for.
Json bootstrap_json(const Identification& r) {
  if (!r.found.bootstrap) return nullptr;
  const identify::Bootstrap& b = *r.found.bootstrap;
  Json parameters = Json::array();
  for (std::size_t k = 0; k < r.found.task.parameters.size(); ++k) {
    parameters.push_back({{"name", r.found.task.parameters[k].name},
                          {"standard_error", real(b.standard_error[k])},
                          {"interval_95", {real(b.low[k]), real(b.high[k])}}});
  }
  return {{"draws", b.values.size()},
          {"failed", b.failed},
          {"unconverged", b.unconverged},
          {"parameters", parameters},
          {"values", b.values}};
}

Json residuals_json(const Identification& r) {
  Json out = Json::array();
  for (std::size_t i = 0; i < r.found.points.size(); ++i) {
    const identify::Point& p = r.found.points[i];
    out.push_back({{"recording", p.observation},
                   {"branch", p.rising ? "rising" : "falling"},
                   {"load_torque_Nm", r.found.task.observations[p.observation].data.torque_Nm[p.grid]},
                   {"residual_rad", r.found.fit.residuals[i]}});
  }
  return out;
}

/// Every value of the identified type: by these `vsa validate` knows which type a record belongs to.
Json values_json(const Identification& r) {
  Json out = Json::object();
  for (const config::Entry& e : r.type.entries) out[e.key] = e.value;
  for (std::size_t k = 0; k < r.found.task.parameters.size(); ++k) {
    for (const std::string& key : r.found.task.parameters[k].keys) out[key] = config::number_text(r.found.fit.values[k]);
  }
  return out;
}

}  // namespace

std::string results_json(const Identification& r) {
  const identify::Uncertainty& u = r.found.uncertainty;
  const bool linear = r.type.unit.actuator.linear();
  const auto told = [linear](const Json& values) { return linear ? page::sliding_keys(values) : values; };
  Json out = page::results_head(r.command);
  out["type"] = r.type.name;
  out["sweep_period_s"] = r.period_s;
  out[linear ? "rms_m" : "rms_rad"] = {{"before", identify::rms(r.found.residuals_before)}, {"after", r.found.fit.rms_rad}};
  out["determined"] = !u.deficient();
  out["warnings"] = warnings(r);
  out["parameters"] = parameters_json(r);
  out["identified_values"] = values_json(r);
  Json& correlation = out["correlation"] = Json::array();
  for (const auto& row : u.correlation) correlation.push_back(reals(row));
  out["condition"] = real(u.condition);
  out["unseparated"] = groups_json(r);
  out["effective_samples"] = u.effective_samples;
  out["degrees_of_freedom"] = u.degrees_of_freedom;
  out["recordings"] = told(recordings_json(r));
  out["starts"] = told(starts_json(r));
  out["leave_one_preset_out"] = told(left_out_json(r));
  out["profiles"] = told(profiles_json(r));
  out["bootstrap"] = bootstrap_json(r);
  out["residuals"] = told(residuals_json(r));
  out["simulations"] = r.found.evaluations;
  return page::results_text(out);
}

}  // namespace vsa::app
