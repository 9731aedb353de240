// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "terminal/table.hpp"
#include "validate/output.hpp"

namespace vsa::app {
namespace {

using report::Table;

constexpr std::size_t kMarkdownWidth = 120;  // as the documents' own lines
constexpr const char* kRmsTitle = "Simulated − recorded over |τ| ≤ 1.4 N·m, root mean square";

std::string number(double value, int decimals) {
  if (!std::isfinite(value)) return "–";
  const std::string out = fmt::format("{:.{}f}", value, decimals);
  return out.find_first_not_of("-0.") == std::string::npos && out[0] == '-' ? out.substr(1) : out;  // no −0.000
}

std::string preset(double value) { return fmt::format("{:.4f}", value); }

/// A guard on a type that doesn't say what it was fitted to is one too: it may have been.
Table bounds_table(const study::Validation& v, experiment::Kind kind) {
  const bool predicted = kind == experiment::Kind::predicted;
  Table out{predicted ? "Predictions held to a bound: nothing was fitted or set to meet them"
                      : "Guards on calibrated figures: no evidence, a broken one is a regression",
            {"quantity", "value", "bound", predicted ? "held" : "within", "why"},
            {},
            ""};
  for (const experiment::Verdict& d : v.verdicts) {
    if (d.kind != kind) continue;
    out.rows.push_back(
        {d.bound.quantity, fmt::format("{:.4g}", d.value), experiment::bound_text(d.bound), d.held ? "yes" : "NO", d.bound.why});
  }
  return out;
}

Table left_out_table(const study::Validation& v) {
  Table out{"Leave one recording out: fitted to the others, root mean square of deflection on it [rad]",
            {"left out, preset [rad]", "predicted", "fitted to all", "this run"},
            {},
            ""};
  if (!v.left_out) return out;
  for (const study::LeaveOneOut::Row& row : v.left_out->rows) {
    const auto same = [&](const study::RecordingCheck& r) { return preset(r.preset) == preset(row.preset); };
    const auto now = std::find_if(v.recordings.begin(), v.recordings.end(), same);
    out.rows.push_back({preset(row.preset), number(row.predicted_rad, 4), number(row.fitted_rad, 4),
                        now == v.recordings.end() ? "–" : number(now->rms.both_rad, 4)});
  }
  return out;
}

std::string extrapolated_text(const experiment::TorqueDifference& d) {
  return d.extrapolated == 0 ? "none" : fmt::format("{} of {}", d.extrapolated, d.points);
}

Table rms_table(const study::Validation& v) {
  Table out{kRmsTitle,
            {"preset [rad]", "", "deflection [rad]", "rising", "falling", "hardware repeats to", "torque [N·m]", "rising",
             "falling", "extrapolated"},
            {},
            "Torque: at each recorded deflection, the simulated branch's torque less the recorded one; extrapolated: recorded "
            "deflections "
            "that the simulation doesn't reach."};
  for (const study::RecordingCheck& r : v.recordings) {
    out.rows.push_back({preset(r.preset), recording_kind(v, r), number(r.rms.both_rad, 4), number(r.rms.rising_rad, 4),
                        number(r.rms.falling_rad, 4), r.published ? number(r.published->repeatability_rad, 4) : "–",
                        number(r.torque.both_Nm, 3), number(r.torque.rising_Nm, 3), number(r.torque.falling_Nm, 3),
                        extrapolated_text(r.torque)});
  }
  return out;
}

Table rms_2015_table(const study::Validation& v) {
  Table out{
      "The same by the authors' plug-in of 2015, deflection [rad]", {"preset [rad]", "point by point", "branch means"}, {}, ""};
  for (const study::RecordingCheck& r : v.recordings) {
    if (!r.published) continue;
    out.rows.push_back({preset(r.preset), number(r.published->rms_2015_rad, 4), number(r.published->rms_2015_branches_rad, 4)});
  }
  return out;
}

/// The torques at which the falling branch lies below the rising one, against the loop's usual sense: "−0.2 … 0.05"; "none".
std::string reversed_text(const experiment::Branches& b) {
  std::string out;
  for (std::size_t i = 0; i < b.torque_Nm.size(); ++i) {
    if (!(b.falling_rad[i] < b.rising_rad[i])) continue;
    std::size_t last = i;
    while (last + 1 < b.torque_Nm.size() && b.falling_rad[last + 1] < b.rising_rad[last + 1]) ++last;
    out += out.empty() ? "" : ", ";
    out += last == i ? fmt::format("{:.2f}", b.torque_Nm[i]) : fmt::format("{:.2f} … {:.2f}", b.torque_Nm[i], b.torque_Nm[last]);
    i = last;
  }
  return out.empty() ? "none" : out;
}

Table loop_table(const study::Validation& v) {
  Table out{
      "Hysteresis, recorded and simulated",
      {"preset [rad]", "", "area [N·m·rad]", "mean width [rad]", "mean |width|", "largest", "smallest", "reversed at τ [N·m]"},
      {},
      ""};
  for (const study::RecordingCheck& r : v.recordings) {
    const auto row = [&](const char* who, const experiment::Loop& l, const experiment::Branches& b) {
      out.rows.push_back({preset(r.preset), who, number(l.area_Nm_rad, 4), number(l.mean_width_rad, 4),
                          number(l.mean_abs_width_rad, 4), number(l.largest_width_rad, 4), number(l.smallest_width_rad, 4),
                          reversed_text(b)});
    };
    row("recorded", r.data_loop, r.data);
    row("simulated", r.our_loop, r.ours);
  }
  out.caption = "Width: falling − rising branch. Reversed: where it is negative.";
  return out;
}

Table period_table(const study::Validation& v) {
  Table out{
      "Effect of the sweep's period", {"preset [rad]", "period [s]", "RMS [rad]", "area [N·m·rad]", "mean width [rad]"}, {}, ""};
  for (const study::PeriodCheck& p : v.periods) {
    out.rows.push_back({preset(p.preset), number(p.period_s, 0), number(p.rms.both_rad, 4), number(p.loop.area_Nm_rad, 4),
                        number(p.loop.mean_width_rad, 4)});
  }
  return out;
}

Table speed_table(const study::Validation& v) {
  Table out{
      "Step of the equilibrium, 1.57 rad, no load",
      {"preset [%]", "", "mean pulley speed [rad/s]", "mean shaft speed [rad/s]", "rise 10–90 % [s]", "overshoot [%]",
       "ringing [Hz]"},
      {},
      "Ringing: of the shaft, one period or more beyond two encoder counts; –: none. 2015: the authors' program (figure 4), which "
      "carries defects; shapes, no truth."};
  for (const study::SpeedCheck& s : v.speeds) {
    const bool fitted = v.evidence && config::covers(*v.evidence, config::experiment_name("speed", s.preset));
    const auto row = [&](const char* who, const std::string& pulley, const experiment::StepMeasures& m) {
      out.rows.push_back({std::to_string(s.percent), who, pulley, number(m.mean_speed, 2), number(m.rise_s, 3),
                          number(m.overshoot_pct, 1), number(m.ringing_Hz, 1)});
    };
    row(fitted ? "simulated, calibrated" : "simulated", number(s.pulleys.mean_speed, 2), s.shaft);
    row("2015", "–", s.shaft_2015);
  }
  return out;
}

Table preset_step_table(const study::Validation& v) {
  Table out{"Step of the preset, 0 → 0.75 → 0 rad",
            {"load", "", "rise 10–90 % [s]", "attained [rad]", "fall 10–90 % [s]", "resting [rad]"},
            {},
            "2015: the authors' program (figure 5)."};
  for (const study::PresetStepCheck& p : v.preset_steps) {
    const auto row = [&](const char* who, const experiment::StepMeasures& up, const experiment::StepMeasures& down) {
      out.rows.push_back({p.loaded ? "1.47 N·m" : "none", who, number(up.rise_s, 3), number(up.final_value, 3),
                          number(down.rise_s, 3), number(down.final_value, 3)});
    };
    row("simulated", p.up, p.down);
    row("2015", p.up_2015, p.down_2015);
  }
  return out;
}

/// Lines of a Markdown document.
std::string paragraph(const std::string& text) {
  std::string out;
  for (const std::string& line : wrap(text, kMarkdownWidth)) out += line + '\n';
  return out;
}

}  // namespace

ValidationTables validation_tables(const study::Validation& v) {
  return {left_out_table(v),   bounds_table(v, experiment::Kind::predicted),  rms_table(v),    loop_table(v),
          rms_2015_table(v),   bounds_table(v, experiment::Kind::calibrated), period_table(v), speed_table(v),
          preset_step_table(v)};
}

std::vector<Table> ValidationTables::shown() const {
  std::vector<Table> out;
  for (const Table* t : {&left_out, &predictions, &rms, &loops, &rms_2015, &guards, &periods, &speeds, &preset_steps}) {
    if (!t->rows.empty()) out.push_back(*t);
  }
  return out;
}

std::string validation_text(const study::Validation& v) {
  std::string out;
  for (const std::string& s : statements(v)) {
    for (const std::string& line : wrap(s, terminal_width())) out += line + '\n';
  }
  out += '\n';
  for (const Table& t : validation_tables(v).shown()) {
    std::vector<std::vector<std::string>> rows{t.head};
    rows.insert(rows.end(), t.rows.begin(), t.rows.end());
    out += t.title + '\n' + table_text(rows, terminal_width()) + '\n';
  }
  return out + counts_text(v) + '\n';
}

std::string markdown_tables(const study::Validation& v, const std::vector<Picture>& pictures, const std::string& command) {
  std::string out;
  for (const std::string& s : statements(v)) out += paragraph(s) + '\n';
  for (Table t : validation_tables(v).shown()) {
    if (!t.caption.empty()) t.caption = paragraph(t.caption);
    out += "**" + t.title + "**\n\n" + report::to_markdown(t);
    if (t.title != kRmsTitle) continue;
    for (const Picture& p : pictures) out += fmt::format("![{}]({})\n\n", p.title, p.file);
  }
  return out + paragraph(counts_text(v) + " Written by `" + command + "`.") + '\n';
}

}  // namespace vsa::app
