// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "table.hpp"
#include "validate_output.hpp"

namespace vsa::app {
namespace {

using report::Table;

std::string number(double value, int decimals) {
  if (!std::isfinite(value)) return "–";
  const std::string out = fmt::format("{:.{}f}", value, decimals);
  return out.find_first_not_of("-0.") == std::string::npos && out[0] == '-' ? out.substr(1) : out;  // no −0.000
}

std::string preset(double value) { return fmt::format("{:.4f}", value); }

Table bounds_table(const Validation& v) {
  Table out{"Stated bounds", {"quantity", "value", "bound", "held", "why"}, {}, ""};
  for (const experiment::Verdict& d : v.verdicts) {
    out.rows.push_back(
        {d.bound.quantity, fmt::format("{:.4g}", d.value), experiment::bound_text(d.bound), d.held ? "yes" : "NO", d.bound.why});
  }
  return out;
}

Table rms_table(const Validation& v) {
  Table out{"Deflection, simulated − recorded: root mean square over |τ| ≤ 1.4 N·m [rad]",
            {"preset [rad]", "both branches", "rising", "falling", "2015, point-wise", "2015, branch means", "hardware repeats to"},
            {},
            ""};
  for (const RecordingCheck& r : v.recordings) {
    out.rows.push_back({preset(r.preset), number(r.rms.both_rad, 4), number(r.rms.rising_rad, 4), number(r.rms.falling_rad, 4)});
    const bool known = r.published.has_value();
    out.rows.back().push_back(known ? number(r.published->rms_2015_rad, 4) : "–");
    out.rows.back().push_back(known ? number(r.published->rms_2015_branches_rad, 4) : "–");
    out.rows.back().push_back(known ? number(r.published->repeatability_rad, 4) : "–");
  }
  return out;
}

Table loop_table(const Validation& v) {
  Table out{
      "Hysteresis, recorded and simulated",
      {"preset [rad]", "", "area [N·m·rad]", "mean width [rad]", "mean |width|", "largest", "smallest", "reversed at τ [N·m]"},
      {},
      ""};
  for (const RecordingCheck& r : v.recordings) {
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

Table period_table(const Validation& v) {
  Table out{
      "Effect of the sweep's period", {"preset [rad]", "period [s]", "RMS [rad]", "area [N·m·rad]", "mean width [rad]"}, {}, ""};
  for (const PeriodCheck& p : v.periods) {
    out.rows.push_back({preset(p.preset), number(p.period_s, 0), number(p.rms.both_rad, 4), number(p.loop.area_Nm_rad, 4),
                        number(p.loop.mean_width_rad, 4)});
  }
  return out;
}

Table speed_table(const Validation& v) {
  Table out{"Step of the equilibrium, 1.57 rad, no load",
            {"preset [%]", "", "mean pulley speed [rad/s]", "mean shaft speed [rad/s]", "rise 10–90 % [s]", "overshoot [%]",
             "ringing [Hz]"},
            {},
            "2015: the authors' program (figure 4), which carries defects; shapes, no truth."};
  for (const SpeedCheck& s : v.speeds) {
    const auto row = [&](const char* who, const std::string& pulley, const experiment::StepMeasures& m) {
      out.rows.push_back({std::to_string(s.percent), who, pulley, number(m.mean_speed, 2), number(m.rise_s, 3),
                          number(m.overshoot_pct, 1), number(m.ringing_Hz, 1)});
    };
    row("simulated", number(s.pulleys.mean_speed, 2), s.shaft);
    row("2015", "–", s.shaft_2015);
  }
  return out;
}

Table preset_step_table(const Validation& v) {
  Table out{"Step of the preset, 0 → 0.75 → 0 rad",
            {"load", "", "rise 10–90 % [s]", "attained [rad]", "fall 10–90 % [s]", "resting [rad]"},
            {},
            "2015: the authors' program (figure 5)."};
  for (const PresetStepCheck& p : v.preset_steps) {
    const auto row = [&](const char* who, const experiment::StepMeasures& up, const experiment::StepMeasures& down) {
      out.rows.push_back({p.loaded ? "1.47 N·m" : "none", who, number(up.rise_s, 3), number(up.final_value, 3),
                          number(down.rise_s, 3), number(down.final_value, 3)});
    };
    row("simulated", p.up, p.down);
    row("2015", p.up_2015, p.down_2015);
  }
  return out;
}

std::string markdown(const Table& t) {
  std::string out = "**" + t.title + "**\n\n|", rule = "\n|";
  for (const std::string& cell : t.head) {
    out += ' ' + cell + " |";
    rule += "---|";
  }
  out += rule + '\n';
  for (const auto& row : t.rows) {
    out += '|';
    for (const std::string& cell : row) out += ' ' + cell + " |";
    out += '\n';
  }
  if (!t.caption.empty()) out += '\n' + t.caption + '\n';
  return out + '\n';
}

}  // namespace

std::vector<Table> validation_tables(const Validation& v) {
  return {bounds_table(v), rms_table(v), loop_table(v), period_table(v), speed_table(v), preset_step_table(v)};
}

std::string validation_text(const Validation& v) {
  std::string out;
  for (const Table& t : validation_tables(v)) {
    std::vector<std::vector<std::string>> rows{t.head};
    rows.insert(rows.end(), t.rows.begin(), t.rows.end());
    out += t.title + '\n' + table_text(rows, terminal_width()) + '\n';
  }
  return out;
}

std::string markdown_tables(const Validation& v) {
  std::string out = "Written by `" + v.command + "`.\n\n";
  for (const Table& t : validation_tables(v)) out += markdown(t);
  return out;
}

}  // namespace vsa::app
