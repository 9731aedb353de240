// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The report's page, and its charts as pictures.
#include <fmt/format.h>

#include "validate/output.hpp"

namespace vsa::app {
namespace {

using report::Chart;
using report::Curve;

std::vector<double> width(const experiment::Branches& b) {
  std::vector<double> out;
  for (std::size_t i = 0; i < b.torque_Nm.size(); ++i) out.push_back(b.falling_rad[i] - b.rising_rad[i]);
  return out;
}

Chart width_chart(const study::RecordingCheck& r) {
  Chart out;
  out.title = fmt::format("Width of the loop, preset {:.4f} rad", r.preset);
  out.x_label = "load torque [N·m]";
  out.y_label = "falling − rising [rad]";
  out.curves = {report::curve("recorded", r.data.torque_Nm, width(r.data), Curve::Style::markers, 0),
                report::curve("simulated", r.ours.torque_Nm, width(r.ours), Curve::Style::line, 0)};
  return out;
}

Chart torque_chart(const study::RecordingCheck& r) {
  Chart out;
  out.title = fmt::format("Residuals in torque, preset {:.4f} rad", r.preset);
  out.x_label = "recorded deflection [rad]";
  out.y_label = "simulated − recorded [N·m]";
  for (const bool rising : {true, false}) {
    const std::vector<double>& at = rising ? r.data.rising_rad : r.data.falling_rad;
    const experiment::BranchInverse inverse(r.ours.torque_Nm, rising ? r.ours.rising_rad : r.ours.falling_rad);
    std::vector<double> residual;
    for (std::size_t i = 0; i < at.size(); ++i) residual.push_back(inverse.at(at[i]).torque_Nm - r.data.torque_Nm[i]);
    out.curves.push_back(report::curve(rising ? "rising" : "falling", at, residual, Curve::Style::line, rising ? 0 : 1));
  }
  return out;
}

Chart time_chart(std::string title, std::string y_label, const experiment::TimeSeries& ours, const experiment::TimeSeries& theirs) {
  Chart out;
  out.title = std::move(title);
  out.x_label = "time from the command [s]";
  out.y_label = std::move(y_label);
  out.curves = {report::curve("simulated", ours.time_s, ours.value, Curve::Style::line, 0),
                report::curve("2015", theirs.time_s, theirs.value, Curve::Style::dashed, 1)};
  return out;
}

/// The predictions' bounds as tiles; those of the fit are no result.
report::Figures figures(const study::Validation& v) {
  report::Figures out;
  for (const experiment::Verdict& d : v.verdicts) {
    if (d.kind != experiment::Kind::predicted) continue;
    out.figures.push_back({d.bound.quantity, fmt::format("{:.4g}", d.value), experiment::bound_text(d.bound),
                           d.held ? report::Figure::Verdict::good : report::Figure::Verdict::bad});
  }
  return out;
}

void add(report::Section& section, const report::Table& table) {
  if (!table.rows.empty()) section.blocks.emplace_back(table);
}

}  // namespace

Chart loop_chart(const study::RecordingCheck& r, const std::string& kind) {
  Chart out;
  out.title = fmt::format("Preset {:.4f} rad ({})", r.preset, kind);
  out.x_label = "deflection [rad]";
  out.y_label = "load torque [N·m]";
  out.curves = {report::curve("recorded, rising", r.data.rising_rad, r.data.torque_Nm, Curve::Style::markers, 0),
                report::curve("recorded, falling", r.data.falling_rad, r.data.torque_Nm, Curve::Style::markers, 1),
                report::curve("simulated, rising", r.ours.rising_rad, r.ours.torque_Nm, Curve::Style::line, 0),
                report::curve("simulated, falling", r.ours.falling_rad, r.ours.torque_Nm, Curve::Style::line, 1)};
  out.caption = r.file;
  return out;
}

Chart residual_chart(const study::RecordingCheck& r) {
  Chart out;
  out.title = fmt::format("Residuals in deflection, preset {:.4f} rad", r.preset);
  out.x_label = "load torque [N·m]";
  out.y_label = "simulated − recorded [rad]";
  const experiment::Branches apart = experiment::subtract(r.ours, r.data);
  out.curves = {report::curve("rising", apart.torque_Nm, apart.rising_rad, Curve::Style::line, 0),
                report::curve("falling", apart.torque_Nm, apart.falling_rad, Curve::Style::line, 1)};
  return out;
}

report::Report validation_report(const study::Validation& v, const std::string& command) {
  report::Report out;
  out.title = "Validation of " + v.actuator.name;
  out.subtitle = counts_text(v);
  const ValidationTables t = validation_tables(v);
  report::Section predictions{"Predictions", {}};
  for (const std::string& s : statements(v)) predictions.blocks.emplace_back(report::Text{s});
  add(predictions, t.left_out);
  if (!t.predictions.rows.empty()) predictions.blocks.emplace_back(figures(v));
  add(predictions, t.predictions);
  report::Section load{"Load test: recordings and simulation", {}};
  for (const study::RecordingCheck& r : v.recordings) {
    for (Chart chart : {loop_chart(r, recording_kind(v, r)), residual_chart(r), width_chart(r), torque_chart(r)})
      load.blocks.emplace_back(std::move(chart));
  }
  for (const report::Table* table : {&t.rms, &t.loops, &t.rms_2015, &t.periods}) add(load, *table);
  report::Section guards{"Guards on calibrated figures", {}};
  add(guards, t.guards);
  report::Section speed{"Figure 4: step of the equilibrium", {t.speeds}};
  for (const study::SpeedCheck& s : v.speeds) {
    speed.blocks.emplace_back(time_chart(fmt::format("Preset {} %", s.percent), "shaft [rad]", s.ours, s.theirs));
  }
  report::Section preset{"Figure 5: step of the preset", {t.preset_steps}};
  for (const study::PresetStepCheck& p : v.preset_steps) {
    preset.blocks.emplace_back(time_chart(p.loaded ? "With load" : "No load", "attained preset [rad]", p.ours, p.theirs));
  }
  out.sections = {std::move(predictions), std::move(load)};
  if (!guards.blocks.empty()) out.sections.push_back(std::move(guards));
  out.sections.push_back(std::move(speed));
  out.sections.push_back(std::move(preset));
  out.footer = command + " · vsa " VSA_VERSION;
  return out;
}

std::vector<Picture> pictures(const study::Validation& v, const std::filesystem::path& markdown) {
  std::vector<Picture> out;
  for (const study::RecordingCheck& r : v.recordings) {
    const auto add_picture = [&](const char* what, const Chart& chart) {
      out.push_back(
          {chart.title, fmt::format("figures/{}-{}-{:.4f}.svg", markdown.stem().string(), what, r.preset), report::to_svg(chart)});
    };
    add_picture("stiffness", loop_chart(r, recording_kind(v, r)));
    add_picture("residuals", residual_chart(r));
  }
  return out;
}

}  // namespace vsa::app
