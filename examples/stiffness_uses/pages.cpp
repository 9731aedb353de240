// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "pages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "vsa/units.hpp"

namespace vsa::stiffness_uses {
namespace {

using report::Chart;
using report::Curve;
using report::Table;

double degrees(double rad) { return rad * 180 / kPi; }
std::string preset_name(double rad) { return fmt::format("preset {:.3g}°", degrees(rad)); }

std::string line(const std::vector<std::string>& cells) { return fmt::format("| {} |\n", fmt::join(cells, " | ")); }

std::string markdown(const Table& table) {
  std::string out = line(table.head) + line(std::vector<std::string>(table.head.size(), "---"));
  for (const auto& row : table.rows) out += line(row);
  return out;
}

Page page(std::string title, std::string subtitle, std::string text, const Table& table, std::vector<Chart> charts) {
  Page out;
  out.report.title = std::move(title);
  out.report.subtitle = std::move(subtitle);
  report::Section section{"", {report::Text{std::move(text)}}};
  for (Chart& chart : charts) section.blocks.emplace_back(std::move(chart));
  section.blocks.emplace_back(table);
  out.report.sections.push_back(std::move(section));
  out.markdown = markdown(table);
  return out;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

/// A text of the runs, each once, in the order of the runs.
std::vector<std::string> distinct(const std::vector<TerrainRun>& runs, std::string TerrainRun::*what) {
  std::vector<std::string> out;
  for (const TerrainRun& r : runs) {
    if (std::find(out.begin(), out.end(), r.*what) == out.end()) out.push_back(r.*what);
  }
  return out;
}

/// Force as means over 5 ms, and the shoulder's angle, from the hit on.
std::pair<Curve, Curve> impact_curves(const ImpactRun& r, int color) {
  const auto& t = r.trace;
  const auto hit = static_cast<std::size_t>(std::find_if(t.force_N.begin(), t.force_N.end(), [](double f) { return f > 0; }) -
                                            t.force_N.begin());
  Curve f{preset_name(r.preset_rad), {}, {}, {}, Curve::Style::line, color, ""};
  Curve s{preset_name(r.preset_rad), {}, {}, {}, Curve::Style::line, color, ""};
  constexpr std::size_t kMean = 5;
  for (std::size_t i = hit; i + kMean < t.time_s.size() && t.time_s[i] < t.time_s[hit] + 0.35; i += kMean) {
    double sum = 0;
    for (std::size_t k = 0; k < kMean; ++k) sum += t.force_N[i + k];
    f.x.push_back((t.time_s[i] - t.time_s[hit]) * 1e3);
    f.y.push_back(std::max(sum / kMean, 0.1));
  }
  for (std::size_t i = hit; i < t.time_s.size() && t.time_s[i] < t.time_s[hit] + 2.0; i += 10) {
    s.x.push_back(t.time_s[i] - t.time_s[hit]);
    s.y.push_back(t.shoulder_deg[i]);
  }
  return {std::move(f), std::move(s)};
}

}  // namespace

Page impact_page(const std::vector<ImpactRun>& runs) {
  Table table{"What the ball does to the arm",
              {"preset", "stiffness N·m/rad", "peak N", "push (50 ms mean) N", "contact ms", "impulse N·s", "absorbed J",
               "shoulder gives way °", "settled after s"},
              {},
              "The ball: 1 kg on a cord of 0.6 m, raised by 24°."};
  Chart force{"The blow",
              "time since the hit [ms]",
              "contact force [N]",
              {},
              "Means over 5 ms, so that the longer push shows beside the first blow.",
              true};
  Chart shoulder{"What the shoulder does", "time since the hit [s]", "shoulder [°]", {}, ""};
  int color = 0;
  for (const ImpactRun& r : runs) {
    table.rows.push_back({fmt::format("{:.3g}°", degrees(r.preset_rad)), fmt::format("{:.2f}", r.stiffness_Nm_per_rad),
                          fmt::format("{:.0f}", r.peak_N), fmt::format("{:.1f}", r.push_N),
                          fmt::format("{:.0f}", r.contact_s * 1e3), fmt::format("{:.3f}", r.impulse_Ns),
                          fmt::format("{:.3f}", r.absorbed_J), fmt::format("{:.1f}", r.shoulder_deg),
                          fmt::format("{:.2f}", r.settle_s)});
    auto [f, s] = impact_curves(r, color++);
    force.curves.push_back(std::move(f));
    shoulder.curves.push_back(std::move(s));
  }
  return page("Frank's arm hit by a ball", "World frank_ball: 1 kg at 1 m/s against the hanging hand",
              "A ball on a cord hits Frank's right hand. Shoulder and elbow hold the arm at one stiffness preset; the rest of "
              "Frank doesn't change.",
              table, {std::move(force), std::move(shoulder)});
}

Page gripper_page(const std::vector<GripRun>& runs) {
  Table table{"Force against closing command",
              {"object", "preset", "N per ° of command", "force at 10° N", "force at 30° N", "finger at 30° °"},
              {},
              "The pads touch at 0°. The soft object's face rests on a spring of 600 N/m."};
  std::vector<Chart> charts;
  for (const char* object : {"hard", "soft"}) {
    Chart chart{fmt::format("{} object", object), "closing command [°]", "force on the object [N]", {}, ""};
    int color = 0;
    for (const GripRun& r : runs) {
      if (r.object != object) continue;
      Curve c{preset_name(r.preset_rad), {}, {}, {}, Curve::Style::line, color++, ""};
      const auto at = [&](double command) {
        return *std::find_if(r.points.begin(), r.points.end(),
                             [&](const GripPoint& p) { return std::abs(p.command_deg - command) < 1e-9; });
      };
      for (const GripPoint& p : r.points) c.x.push_back(p.command_deg), c.y.push_back(p.force_N);
      table.rows.push_back({object, fmt::format("{:.3g}°", degrees(r.preset_rad)), fmt::format("{:.2f}", r.slope_N_per_deg()),
                            fmt::format("{:.2f}", at(10).force_N), fmt::format("{:.2f}", at(30).force_N),
                            fmt::format("{:.1f}", at(30).finger_deg)});
      chart.curves.push_back(std::move(c));
    }
    charts.push_back(std::move(chart));
  }
  return page("A gripper on a hard and a soft object", "Worlds gripper_hard and gripper_soft: one module, a finger on its flange",
              "The same closing command at several presets. What the object feels is the spring: command times stiffness.", table,
              std::move(charts));
}

Page throw_page(const std::vector<std::vector<ThrowRun>>& sweeps, const std::vector<ThrowRun>& traces) {
  Table table{"Best timing",
              {"preset", "best back swing s", "link rad/s", "motor rad/s", "link / motor", "forward only: link / motor",
               "springs hold J", "ball's energy J"},
              {},
              "Lever 0.2 m, ball 0.2 kg, axis upright; equilibrium from −57° to +57°."};
  Chart sweep{"When to swing forward", "back swing [s]", "fastest link / fastest motor [1]", {}, "0: no back swing."};
  Chart speed{"The best throw", "time [s]", "speed [rad/s]", {}, "Lines: lever. Dashed: motors (mean of the two pulleys)."};
  int color = 0;
  for (const auto& runs : sweeps) {
    const ThrowRun& best = best_of(runs);
    const auto forward = std::find_if(runs.begin(), runs.end(), [](const ThrowRun& r) { return r.swing_back_s == 0; });
    table.rows.push_back({fmt::format("{:.3g}°", degrees(best.preset_rad)), fmt::format("{:.2f}", best.swing_back_s),
                          fmt::format("{:.2f}", best.link_rad_per_s), fmt::format("{:.2f}", best.motor_rad_per_s),
                          fmt::format("{:.2f}", best.ratio()),
                          forward == runs.end() ? "–" : fmt::format("{:.2f}", forward->ratio()),
                          fmt::format("{:.3f}", best.spring_J), fmt::format("{:.3f}", best.kinetic_J)});
    Curve c{preset_name(best.preset_rad), {}, {}, {}, Curve::Style::line, color++, ""};
    for (const ThrowRun& r : runs) c.x.push_back(r.swing_back_s), c.y.push_back(r.ratio());
    sweep.curves.push_back(std::move(c));
  }
  color = 0;
  for (const ThrowRun& r : traces) {
    const std::string name = preset_name(r.preset_rad);
    Curve link{name, {}, {}, {}, Curve::Style::line, color, name},
        motor{name + ", motors", {}, {}, {}, Curve::Style::dashed, color++, name};
    for (std::size_t i = 0; i < r.trace.time_s.size(); i += 5) {
      link.x.push_back(r.trace.time_s[i]), link.y.push_back(r.trace.link_rad_per_s[i]);
      motor.x.push_back(r.trace.time_s[i]), motor.y.push_back(r.trace.motor_rad_per_s[i]);
    }
    speed.curves.push_back(std::move(link));
    speed.curves.push_back(std::move(motor));
  }
  return page("Throwing with a spring", "World bench_throw: how much faster than its motors can a link be?",
              "The equilibrium swings back and then forward. With the right timing the spring gives back what it took up.", table,
              {std::move(sweep), std::move(speed)});
}

Page terrain_page(const std::vector<TerrainRun>& runs, double duration_s) {
  Table table{
      "Speed, cost, contact",
      {"ground", "gait", "starts", "speed m/s", "net speed m/s", "cost of transport", "contact force, 99th percentile N", "peak N"},
      {},
      fmt::format("Medians; {:.0f} s each.", duration_s)};
  Chart cost{"Cost of transport", "stiffness preset [°]", "supply / (m g way) [1]", {}, "", true};
  Chart speed{"Speed", "stiffness preset [°]", "net speed [m/s]", {}, ""};
  const auto grounds = distinct(runs, &TerrainRun::ground);
  const auto gaits = distinct(runs, &TerrainRun::gait);
  int color = 0;
  for (const auto& ground : grounds) {
    Curve c{ground, {}, {}, {}, Curve::Style::line, color, ""}, v{ground, {}, {}, {}, Curve::Style::line, color++, ""};
    for (const auto& gait : gaits) {
      std::vector<TerrainRun> mine;
      std::copy_if(runs.begin(), runs.end(), std::back_inserter(mine),
                   [&](const TerrainRun& r) { return r.gait == gait && r.ground == ground; });
      if (mine.empty()) continue;
      const auto middle = [&](double TerrainRun::*what) {
        std::vector<double> values;
        for (const TerrainRun& r : mine) values.push_back(r.*what);
        return median(std::move(values));
      };
      table.rows.push_back({ground, gait, std::to_string(mine.size()), fmt::format("{:.3f}", middle(&TerrainRun::speed_m_per_s)),
                            fmt::format("{:.3f}", middle(&TerrainRun::net_speed_m_per_s)),
                            fmt::format("{:.1f}", middle(&TerrainRun::cost_of_transport)),
                            fmt::format("{:.0f}", middle(&TerrainRun::force_99_N)),
                            fmt::format("{:.0f}", middle(&TerrainRun::force_peak_N))});
      c.x.push_back(mine[0].preset_deg), c.y.push_back(middle(&TerrainRun::cost_of_transport));
      v.x.push_back(mine[0].preset_deg), v.y.push_back(middle(&TerrainRun::net_speed_m_per_s));
    }
    cost.curves.push_back(std::move(c));
    speed.curves.push_back(std::move(v));
  }
  return page("The snake over three grounds", "Speed, cost of transport and contact force at three presets",
              "The same gait at a soft, Table II's and a stiff preset.", table, {std::move(speed), std::move(cost)});
}

}  // namespace vsa::stiffness_uses
