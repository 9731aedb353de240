// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "identify/output.hpp"
#include "terminal/table.hpp"
#include "vsa/config/text.hpp"
#include "vsa/identify/type_file.hpp"
#include "vsa/report/sliding.hpp"

namespace vsa::app {
namespace {

using report::Chart;
using report::Curve;
using report::Table;

constexpr double kWeak = 0.95;  // correlation beyond which two estimates are best read together

std::string short_number(double v) { return std::isfinite(v) ? fmt::format("{:.4g}", v) : "–"; }

bool linear(const Identification& r) { return r.type.unit.actuator.linear(); }

/// What is told in rad and N·m, as the actuator has it.
template <class T>
T told(const Identification& r, T words) {
  return linear(r) ? report::sliding(std::move(words)) : words;
}

std::string preset_unit(const Identification& r) { return std::string(r.type.unit.actuator.transmission->preset_unit()); }
std::string preset_head(const Identification& r) {
  const std::string unit = preset_unit(r);
  return unit.empty() ? "preset" : "preset [" + unit + "]";
}
std::string recorded_at(const Identification& r, double preset) {
  const std::string unit = preset_unit(r);
  return unit.empty() ? "Recording" : fmt::format("Preset {:.4g} {}", preset, unit);
}

/// A deflection: a travel in m has its own size.
std::string deflection(const Identification& r, double value) {
  return !std::isfinite(value) ? "–" : linear(r) ? fmt::format("{:.3g}", value) : fmt::format("{:.5f}", value);
}

std::string interval_text(const Identification& r, std::size_t k) {
  const identify::Uncertainty& u = r.found.uncertainty;
  if (r.found.fit.at_bound[k]) return "at its bound";
  if (std::isinf(u.standard_error[k])) return "not determined";
  return fmt::format("{:.4g} … {:.4g}", u.low[k], u.high[k]);
}

std::string names(const Identification& r, const std::vector<std::size_t>& group) {
  std::vector<std::string> out;
  for (std::size_t k : group) out.push_back(r.found.task.parameters[k].name);
  return config::join(out, ", ");
}

/// The points of one branch of one recording: data and model.
struct Branch {
  std::vector<double> torque, data, model, residual;
};

Branch branch(const Identification& r, std::size_t observation, bool rising) {
  Branch out;
  const experiment::Branches& data = r.found.task.observations[observation].data;
  for (std::size_t i = 0; i < r.found.points.size(); ++i) {
    const identify::Point& p = r.found.points[i];
    if (p.observation != observation || p.rising != rising) continue;
    out.torque.push_back(data.torque_Nm[p.grid]);
    out.data.push_back(rising ? data.rising_rad[p.grid] : data.falling_rad[p.grid]);
    out.residual.push_back(r.found.fit.residuals[i]);
    out.model.push_back(out.data.back() + out.residual.back());
  }
  return out;
}

Chart loop_chart(const Identification& r, std::size_t observation) {
  Chart out;
  out.title = recorded_at(r, r.found.task.observations[observation].preset);
  out.x_label = "deflection [rad]";
  out.y_label = "load torque [N·m]";
  const bool points = r.found.task.observations[observation].points;
  for (const bool rising : {true, false}) {
    const Branch b = branch(r, observation, rising);
    if (b.torque.empty()) continue;
    const std::string way = points ? "at rest" : rising ? "rising" : "falling";
    out.curves.push_back(report::curve("recorded, " + way, b.data, b.torque, Curve::Style::markers, rising ? 0 : 1));
    out.curves.push_back(report::curve("simulated, " + way, b.model, b.torque, Curve::Style::line, rising ? 0 : 1));
  }
  out.caption = r.found.task.observations[observation].name;
  return out;
}

Chart residual_chart(const Identification& r) {
  Chart out;
  out.title = "Residuals";
  out.x_label = "load torque [N·m]";
  out.y_label = "simulated − recorded [rad]";
  for (std::size_t o = 0; o < r.found.task.observations.size(); ++o) {
    for (const bool rising : {true, false}) {
      const Branch b = branch(r, o, rising);
      if (b.torque.empty()) continue;
      const char* way = r.found.task.observations[o].points ? "at rest" : rising ? "rising" : "falling";
      out.curves.push_back(report::curve(fmt::format("{}, {}", recorded_at(r, r.found.task.observations[o].preset), way), b.torque,
                                         b.residual, rising ? Curve::Style::line : Curve::Style::dashed, static_cast<int>(o)));
    }
  }
  out.caption = "Smooth residuals are the model's own error: the intervals allow for their correlation.";
  return out;
}

Table correlation_table(const Identification& r) {
  Table out{"Correlation of the estimates", {""}, {}, ""};
  for (std::size_t k = 0; k < r.found.task.parameters.size(); ++k) {
    out.head.push_back(r.found.task.parameters[k].name);
    std::vector<std::string> row{r.found.task.parameters[k].name};
    for (double c : r.found.uncertainty.correlation[k]) row.push_back(std::isfinite(c) ? fmt::format("{:.2f}", c) : "–");
    out.rows.push_back(std::move(row));
  }
  return out;
}

Table starts_table(const Identification& r) {
  Table out{"Local solutions", {"RMS [rad]", "iterations", "converged", "from", "to"}, {}, "The first one is the estimate."};
  const auto list = [](const std::vector<double>& values) {
    std::vector<std::string> texts;
    for (double v : values) texts.push_back(short_number(v));
    return config::join(texts);
  };
  for (const identify::StartResult& s : r.found.fit.starts) {
    out.rows.push_back(
        {deflection(r, s.rms_rad), std::to_string(s.iterations), s.converged ? "yes" : "no", list(s.from), list(s.to)});
  }
  return out;
}

report::Section profiles_section(const Identification& r) {
  report::Section out{"Profiles", {}};
  for (std::size_t k = 0; k < r.found.profiles.size(); ++k) {
    std::vector<double> x, y;
    for (const identify::ProfilePoint& p : r.found.profiles[k]) {
      x.push_back(p.value);
      y.push_back(p.rms_rad);
    }
    Chart chart;
    chart.title = r.found.task.parameters[k].name;
    chart.x_label = fmt::format("{} [{}]", r.found.task.parameters[k].name, r.found.task.parameters[k].unit);
    chart.y_label = linear(r) ? "RMS [m]" : "RMS [rad]";
    chart.curves.push_back(report::curve("the others fitted again", x, y, Curve::Style::line, 0));
    out.blocks.emplace_back(std::move(chart));
  }
  return out;
}

std::string table_of(const Table& t) {
  std::vector<std::vector<std::string>> rows{t.head};
  rows.insert(rows.end(), t.rows.begin(), t.rows.end());
  return t.title + '\n' + table_text(rows, terminal_width()) + '\n';
}

}  // namespace

Table estimates_table(const Identification& r) {
  Table out{"Estimates", {"parameter", "unit", "before", "estimate", "95 % interval", "if residuals were white"}, {}, ""};
  for (std::size_t k = 0; k < r.found.task.parameters.size(); ++k) {
    const identify::Parameter& p = r.found.task.parameters[k];
    const double white = r.found.uncertainty.white_standard_error[k];
    out.rows.push_back({p.name, p.unit, short_number(p.start), short_number(r.found.fit.values[k]), interval_text(r, k),
                        std::isfinite(white) ? fmt::format("± {:.2g}", 1.96 * white) : "–"});
  }
  out.caption =
      fmt::format("{:.0f} points count as {:.0f} independent ones; condition {:.3g}.", static_cast<double>(r.found.points.size()),
                  r.found.uncertainty.effective_samples, r.found.uncertainty.condition);
  return out;
}

Table misfit_table(const Identification& r) {
  Table out{"Root mean square of simulated − recorded deflection [rad]",
            {preset_head(r), "before", "both branches", "rising", "falling", "ρ", "recording"},
            {},
            "ρ: correlation of neighbouring residuals, corrected for the fit."};
  for (std::size_t o = 0; o < r.found.misfits.size(); ++o) {
    const experiment::Difference& d = r.found.misfits[o].rms;
    out.rows.push_back({fmt::format("{:.4f}", r.found.misfits[o].preset), deflection(r, r.found.misfits_before[o].rms.both_rad),
                        deflection(r, d.both_rad), deflection(r, d.rising_rad), deflection(r, d.falling_rad),
                        fmt::format("{:.2f}", r.found.uncertainty.autocorrelation[o]), r.found.misfits[o].name});
  }
  return out;
}

Table cross_validation_table(const Identification& r) {
  Table out{"Leave one preset out", {preset_head(r), "RMS predicted [rad]", "RMS fitted [rad]"}, {}, ""};
  for (const identify::Parameter& p : r.found.task.parameters) out.head.push_back(p.name);
  for (const identify::LeftOut& l : r.found.left_out) {
    out.rows.push_back({fmt::format("{:.4f}", l.preset), deflection(r, l.rms_rad), deflection(r, l.rms_rad_of_all)});
    for (double v : l.values) out.rows.back().push_back(short_number(v));
  }
  return out;
}

Table bootstrap_table(const Identification& r) {
  const identify::Bootstrap& b = *r.found.bootstrap;
  Table out{fmt::format("Bootstrap, {} draws", b.values.size()),
            {"parameter", "unit", "standard error", "of the intervals", "2.5 … 97.5 % of the draws"},
            {},
            ""};
  for (std::size_t k = 0; k < r.found.task.parameters.size(); ++k) {
    const identify::Parameter& p = r.found.task.parameters[k];
    out.rows.push_back({p.name, p.unit, short_number(b.standard_error[k]), short_number(r.found.uncertainty.standard_error[k]),
                        fmt::format("{} … {}", short_number(b.low[k]), short_number(b.high[k]))});
  }
  out.caption = "Fits to the fitted curves with the residuals' signs drawn anew, block by block.";
  if (b.failed > 0) out.caption += fmt::format(" {} more draws couldn't be fitted.", b.failed);
  return out;
}

std::vector<std::string> warnings(const Identification& r) {
  std::vector<std::string> out;
  const identify::Uncertainty& u = r.found.uncertainty;
  for (std::size_t k : u.without_effect) out.push_back(r.found.task.parameters[k].name + " has no effect on these recordings");
  for (const auto& group : u.unseparated) {
    out.push_back("these recordings don't separate " + names(r, group) + ": only a combination of them is determined");
  }
  for (std::size_t k = 0; k < r.found.fit.values.size(); ++k) {
    if (r.found.fit.at_bound[k])
      out.push_back(r.found.task.parameters[k].name + " ends at its bound " + short_number(r.found.fit.values[k]));
    for (std::size_t i = 0; i < k; ++i) {
      if (std::abs(u.correlation[i][k]) > kWeak) {
        out.push_back(fmt::format("{} and {} are correlated by {:.3f}: read them together", r.found.task.parameters[i].name,
                                  r.found.task.parameters[k].name, u.correlation[i][k]));
      }
    }
  }
  if (!r.found.fit.starts.empty() && !r.found.fit.starts.front().converged)
    out.push_back("the iterations ran out before the solution converged");
  if (const auto& b = r.found.bootstrap; b && b->unconverged > 0)
    out.push_back(fmt::format("the iterations ran out for {} of {} draws of the bootstrap: they may scatter too little",
                              b->unconverged, b->values.size()));
  return out;
}

report::Report identification_report(const Identification& r) {
  report::Report out;
  out.title = "Identification of " + r.type.name;
  out.subtitle = fmt::format("{} parameters from {} recordings", r.found.task.parameters.size(), r.found.task.observations.size());
  report::Section estimates{"Estimates", {}};
  for (const std::string& w : warnings(r)) estimates.blocks.emplace_back(report::Text{"Warning: " + w + "."});
  estimates.blocks.emplace_back(estimates_table(r));
  estimates.blocks.emplace_back(told(r, misfit_table(r)));
  estimates.blocks.emplace_back(correlation_table(r));
  report::Section curves{"Recorded and simulated", {}};
  for (std::size_t o = 0; o < r.found.task.observations.size(); ++o) curves.blocks.emplace_back(told(r, loop_chart(r, o)));
  report::Section residuals{"Residuals", {told(r, residual_chart(r))}};
  report::Section checks{"Checks", {told(r, starts_table(r))}};
  if (r.found.left_out.empty()) {
    checks.blocks.emplace_back(report::Text{"No cross-validation: it was turned off, or there is only one preset."});
  } else {
    checks.blocks.emplace_back(told(r, cross_validation_table(r)));
  }
  if (r.found.bootstrap) checks.blocks.emplace_back(bootstrap_table(r));
  out.sections = {std::move(estimates), std::move(curves), std::move(residuals), std::move(checks)};
  if (!r.found.profiles.empty()) out.sections.push_back(profiles_section(r));
  out.footer = r.command + " · vsa " VSA_VERSION;
  return out;
}

std::string identification_text(const Identification& r) {
  std::string out = table_of(estimates_table(r)) + table_of(told(r, misfit_table(r)));
  if (!r.found.left_out.empty()) out += table_of(told(r, cross_validation_table(r)));
  if (r.found.bootstrap) out += table_of(bootstrap_table(r));
  return out;
}

std::string identified_type(const Identification& r, const config::TypeLibrary& library) {
  std::vector<identify::Identified> changes;
  for (std::size_t k = 0; k < r.found.task.parameters.size(); ++k) {
    const std::string source = fmt::format("identified, {}: {}; {}", r.found.fit.at_bound[k] ? "no interval" : "95 % interval",
                                           interval_text(r, k), r.command);
    for (const std::string& key : r.found.task.parameters[k].keys) changes.push_back({key, r.found.fit.values[k], source});
  }
  config::Evidence fitted{{}, r.command};
  std::set<std::string> named;  // two recordings of one preset are one experiment
  for (const identify::Observation& o : r.found.task.observations) {
    std::string experiment = config::experiment_name("stiffness", o.preset);
    if (named.insert(experiment).second) fitted.calibrated_on.push_back(std::move(experiment));
  }
  return identify::type_text(r.type, r.name, changes, fitted, library);
}

}  // namespace vsa::app
