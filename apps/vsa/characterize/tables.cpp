// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "characterize/output.hpp"
#include "terminal/table.hpp"
#include "vsa/report/sliding.hpp"
#include "vsa/units.hpp"

namespace vsa::app {
namespace {

using Row = std::vector<std::string>;

constexpr const char* kStiffness = "Stiffness";

std::string text(double value, const char* format) {
  if (std::abs(value) < 1e-9) value = 0;  // a ratio fitted to what doesn't decay may come out as −1e-15
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "–";
}

/// σ ± standard error at the point whose torque is nearest.
std::string stiffness_at(const study::StiffnessResult& r, double torque_Nm, double scale) {
  const auto distance = [torque_Nm](const auto& p) { return std::abs(p.torque_Nm - torque_Nm); };
  const auto at =
      std::min_element(r.curve.begin(), r.curve.end(), [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  const double near_Nm = 0.026 * r.options.load_share * scale;  // half the branches' grid
  if (at == r.curve.end() || distance(*at) > near_Nm) return "–";
  return fmt::format("{:.3g} ± {:.1g}", at->stiffness_Nm_per_rad, at->standard_error_Nm_per_rad);
}

/// The preset's cells, left out where there is none.
void put_preset(Row& row, const study::Characterization& c, const std::string& cell) {
  if (!c.preset_unit().empty()) row.push_back(cell);
}

Row head(const study::Characterization& c, const std::vector<std::string>& rest, bool attained) {
  Row out;
  put_preset(out, c, "preset [" + c.preset_unit() + "]");
  if (attained) put_preset(out, c, "attained");
  out.insert(out.end(), rest.begin(), rest.end());
  return out;
}

/// "0.327 … 0.405"; one number where both read the same.
std::string range_text(double least, double most) {
  const std::string from = text(least, "{:.3f}"), to = text(most, "{:.3f}");
  return from == to ? from : from + " … " + to;
}

/// "0.327", up to where a range goes to both sides; "-0.44 … 0.3" where the sides differ, as of unequal springs.
template <class Text>
std::string both_ways(const study::Range& r, const Text& text) {
  constexpr double kAlike = 0.05;
  const bool alike = std::abs(r.most + r.least) <= kAlike * std::max(std::abs(r.most), std::abs(r.least));
  return alike ? text(r.most) : text(r.least) + " … " + text(r.most);
}

/// Up to where the branches go.
double most_Nm(const study::Characterization& c) {
  return experiment::BranchOptions{}.max_Nm * c.stiffness.front().options.load_share;
}

/// Deflection is the difference of two readings, each short of the truth by up to a count: a branch errs by a count, a width by two.
std::string resolution_text(const study::Characterization& c) {
  const actuator::ActuatorParams& a = c.actuator.unit.actuator;
  const int coarsest = std::min({a.side[0].encoder.bits, a.side[a.sides() - 1].encoder.bits, a.shaft_encoder.bits});
  const double count_rad = 2 * kPi / std::pow(2.0, coarsest);
  if (c.linear()) return "";  // its encoders' counts are of different sizes
  return fmt::format("The encoders resolve the loop to ±{:.4f} N·m·rad; a smaller area may be none.\n",
                     2 * count_rad * 2 * most_Nm(c));
}

}  // namespace

std::vector<std::string> fit_notes(const study::Characterization& c) {
  std::vector<std::string> out;
  if (c.linear())
    out.push_back(
        fmt::format("The output turns the benches as a rack on a pinion of {:g} m; the results are the output's own, in m and N.",
                    1 / c.load_scale));
  const bool loaded = !c.stiffness.empty() || c.preset_step.size() > 1;
  if (!loaded) return out;
  if (c.fit.load_share != 1) out.push_back(fmt::format("The load bench carries {:g} kg in place of 1 kg.", c.fit.load_share));
  if (c.fit.softest > 0)
    out.push_back(fmt::format("Below preset {:.3g} {} the joint is too soft for that load: its runs begin there.", c.fit.softest,
                              c.preset_unit()));
  return out;
}

report::Table stiffness_table(const study::Characterization& c) {
  report::Table out;
  out.title = kStiffness;
  const double share = c.load_scale * (c.stiffness.empty() ? 1 : c.stiffness.front().options.load_share);
  out.head = head(c,
                  {c.linear() ? "shaft to [m]" : "shaft to [°]", "load to [N·m]", "δ to [rad]", "σ at 0 [N·m/rad]",
                   fmt::format("σ at {:g} N·m", share), "loop [N·m·rad]", "mean |width|", "A [rad]"},
                  true);
  // Of an angle, as many decimals as an encoder tells; a travel in m has its own size.
  const auto rad = [&](double value, int decimals) {
    return !std::isfinite(value) ? "–" : c.linear() ? fmt::format("{:.3g}", value) : fmt::format("{:.{}f}", value, decimals);
  };
  for (const study::StiffnessResult& r : c.stiffness) {
    Row row;
    put_preset(row, c, fmt::format("{:.4g}", r.options.preset));
    put_preset(row, c, range_text(r.preset.least, r.preset.most));
    row.push_back(both_ways(
        r.shaft_rad, [&](double q) { return c.linear() ? fmt::format("{:.4f}", q) : fmt::format("{:.1f}", q * 180 / kPi); }));
    row.push_back(both_ways(r.load_Nm, [](double load) { return fmt::format("{:.3f}", load); }));
    row.push_back(both_ways(r.deflection_rad, [&](double d) { return rad(d, 3); }));
    row.push_back(stiffness_at(r, 0, c.load_scale));
    row.push_back(stiffness_at(r, share, c.load_scale));
    row.push_back(text(r.loop.area_Nm_rad, "{:.4f}"));
    row.push_back(rad(r.loop.mean_abs_width_rad, 4));
    row.push_back(fmt::format("{:.4f}", r.run.amplitude_rad));
    out.rows.push_back(row);
  }
  out.caption = fmt::format(
      "Torque and deflection δ as the unit's encoders read them, mean of both branches; ± one standard error. Loop: "
      "∫(falling − rising) dτ over |τ| ≤ {:g} N·m, positive where energy is lost. Mean |width|: of |falling − rising|, "
      "rad. A: amplitude of the sweep.",
      1.4 * share);
  return c.linear() ? report::sliding(std::move(out)) : out;
}

report::Table speed_table(const study::Characterization& c) {
  report::Table out;
  out.title = "Speed";
  out.head = head(c,
                  {"rise [s]", "ω shaft [rad/s]", "ω pulleys [rad/s]", "peak [rad/s]", "overshoot [%]", "ringing [Hz]",
                   "damping [1]", "steady error [rad]"},
                  false);
  for (const study::SpeedResult& r : c.speed) {
    const experiment::StepMeasures &s = r.mean.shaft, &p = r.mean.pulleys;
    Row row;
    put_preset(row, c, fmt::format("{:.4g}", r.options.preset));
    row.push_back(text(s.rise_s, "{:.3f}"));
    row.push_back(text(s.mean_speed, "{:.3f}"));
    row.push_back(text(p.mean_speed, "{:.3f}"));
    row.push_back(text(s.peak_slope, "{:.2f}"));
    row.push_back(text(s.overshoot_pct, "{:.2f}"));
    row.push_back(text(s.ringing_Hz, "{:.1f}"));
    row.push_back(text(s.damping_ratio, "{:.3f}"));
    row.push_back(c.linear() ? text(s.steady_error, "{:+.3g}") : text(s.steady_error, "{:+.4f}"));
    out.rows.push_back(row);
  }
  out.caption =
      "Means over the square wave's edges. Rise: 10–90 % of the attained change; ω: Δθ/Δt over it, of the shaft and of the mean of "
      "the pulleys. Steady error: of the way commanded, negative where the shaft falls short; what stays at both ends, as unequal "
      "springs' rest beside the command, isn't in it. –: nothing to measure.";
  return c.linear() ? report::sliding(std::move(out)) : out;
}

report::Table preset_step_table(const study::Characterization& c) {
  report::Table out;
  out.title = "Preset step";
  const std::string unit = " [" + c.preset_unit() + "]";
  out.head = {"load", "load torque [N·m]", "commanded" + unit, "attained" + unit, "rise [s]", "resting" + unit, "fall [s]"};
  for (const study::PresetStepResult& r : c.preset_step) {
    out.rows.push_back({r.options.loaded ? "lever" : "none",
                        r.options.loaded ? fmt::format("{:.2f} … {:.2f}", r.load_Nm.least, r.load_Nm.most) : "0",
                        fmt::format("{0:.4g} → {1:.4g} → {0:.4g}", r.options.from, r.options.preset),
                        text(r.up.final_value, "{:.4f}"), text(r.up.rise_s, "{:.3f}"), text(r.down.final_value, "{:.4f}"),
                        text(r.down.rise_s, "{:.3f}")});
  }
  out.caption = "Attained preset, from the pulleys; times are 10–90 % of the attained change.";
  return c.linear() ? report::sliding(std::move(out)) : out;
}

std::string characterization_text(const study::Characterization& c) {
  std::string out = c.actuator.title + '\n';
  for (const report::Table& t : {stiffness_table(c), speed_table(c), preset_step_table(c)}) {
    if (t.rows.empty()) continue;
    std::vector<Row> rows{t.head};
    rows.insert(rows.end(), t.rows.begin(), t.rows.end());
    out += '\n' + t.title + '\n' + table_text(rows, 0);
    if (t.title == kStiffness) out += resolution_text(c);
  }
  for (const std::string& note : fit_notes(c)) out += '\n' + note + '\n';
  return out + '\n';
}

}  // namespace vsa::app
