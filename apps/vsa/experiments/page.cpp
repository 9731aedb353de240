// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "experiments/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "vsa/not_a_number.hpp"

namespace vsa::app {
namespace {

using study::TaskResults;
using study::Tasks;

std::string short_text(double value) { return std::isfinite(value) ? fmt::format("{:.3g}", value) : "–"; }

/// What ranks a type in a task; NaN: it isn't ranked. Energy counts per torque held, since each holds its own.
double distance_m(const TaskResults& r) {
  const auto best = r.farthest();
  return best ? best->distance_m() : kNaN;
}
double settled_s(const TaskResults& r) {
  const auto best = r.soonest();
  return best ? best->settled_s : kNaN;
}
/// What the motors feed back isn't counted.
double energy_J(const TaskResults& r) {
  const auto best = r.cheapest();
  return best ? std::max(0.0, best->energy_J) : kNaN;
}
double energy_J_per_Nm(const TaskResults& r) { return energy_J(r) / r.load_Nm; }

using Score = double (*)(const TaskResults&);

/// The types from the best on; those without a number at the end, in the order they have.
std::vector<const TaskResults*> ordered(const Tasks& tasks, Score score, bool most) {
  std::vector<const TaskResults*> out;
  for (const TaskResults& r : tasks.each) out.push_back(&r);
  std::stable_sort(out.begin(), out.end(), [&](const TaskResults* a, const TaskResults* b) {
    const double x = score(*a), y = score(*b);
    if (std::isnan(x) || std::isnan(y)) return !std::isnan(x) && std::isnan(y);
    return most ? x > y : x < y;
  });
  return out;
}

/// "2"; equal numbers share a place.
std::string place(const Tasks& tasks, const TaskResults& of, Score score, bool most) {
  const double own = score(of);
  if (std::isnan(own)) return "–";
  const auto better = std::count_if(tasks.each.begin(), tasks.each.end(),
                                    [&](const TaskResults& r) { return most ? score(r) > own : score(r) < own; });
  return std::to_string(better + 1);
}

std::string at(const TaskResults& r, double preset) {
  return r.preset_unit().empty() ? "" : fmt::format("preset {} {}", short_text(preset), r.preset_unit());
}

/// `note(results)`: at which preset.
template <class Text, class Note>
report::Bars bars(std::string title, const Tasks& tasks, Score score, bool most, Text text, Note note) {
  report::Bars out;
  out.title = std::move(title);
  for (const TaskResults* r : ordered(tasks, score, most)) {
    const double value = score(*r);
    out.bars.push_back({r->actuator.name, value, std::isnan(value) ? "–" : text(*r), std::isnan(value) ? "" : note(*r), ""});
  }
  return out;
}

report::Section bars_section(const Tasks& tasks) {
  report::Bars far = bars(
      "Throws farthest", tasks, distance_m, true, [](const TaskResults& r) { return short_text(distance_m(r)) + " m"; },
      [](const TaskResults& r) { return at(r, r.farthest()->preset); });
  far.caption = "A ball 0.5 m from the axis, at 45°, without air.";
  report::Bars soon = bars(
      "Settles soonest after a blow", tasks, settled_s, false, [](const TaskResults& r) { return short_text(settled_s(r)) + " s"; },
      [](const TaskResults& r) { return at(r, r.soonest()->preset); });
  soon.caption = "Within 5 % of its largest way; short is good.";
  report::Bars cheap = bars(
      "Holds cheapest", tasks, energy_J_per_Nm, false,
      [](const TaskResults& r) { return short_text(energy_J_per_Nm(r)) + " J per N·m"; },
      [](const TaskResults& r) { return at(r, r.cheapest()->preset); });
  cheap.caption = "Energy from the supply in 10 s over the torque held; short is good.";
  return {"The best of each type", {far, soon, cheap}};
}

/// A curve a type over the share of its largest preset; types without one have a point.
template <class Results, class Value>
report::Chart by_preset(const Tasks& tasks, report::Chart chart, Results TaskResults::*results, Value value) {
  using report::Curve;
  constexpr Curve::Style kStyles[] = {Curve::Style::line, Curve::Style::dashed, Curve::Style::dotted};
  int i = 0;
  for (const TaskResults& r : tasks.each) {
    const bool many = (r.*results).size() > 1;
    Curve curve = report::curve(r.actuator.name, {}, {}, many ? kStyles[i / 6 % 3] : Curve::Style::markers, i);
    for (const auto& one : r.*results) {
      curve.x.push_back(many ? one.preset / r.presets.back() * 0.9 : 0.0);
      curve.y.push_back(value(r, one));
    }
    ++i;
    if (!curve.x.empty()) chart.curves.push_back(std::move(curve));
  }
  return chart;
}

report::Section preset_section(const Tasks& tasks) {
  const std::string x = "preset, of the largest that the motors wind to [1]";
  return {"By preset",
          {by_preset(tasks, {"Throw", x, "distance [m]", {}, "With the best back swing of each preset."}, &TaskResults::throws,
                     [](const TaskResults&, const study::ThrowResult& t) { return t.distance_m(); }),
           by_preset(tasks, {"Settling", x, "time [s]", {}, "A gap: not settled after 18 s.", true}, &TaskResults::settles,
                     [](const TaskResults&, const study::SettleResult& s) { return s.settled_s; }),
           by_preset(tasks, {"Holding", x, "energy in 10 s, per torque [J/(N·m)]", {}, "A gap: not held."}, &TaskResults::holds,
                     [](const TaskResults& r, const study::HoldResult& h) { return std::max(h.energy_J, 0.0) / r.load_Nm; })}};
}

std::string how_text() {
  return "A rigid link on the shaft, axis upright, the unit under its own program. Throw: the equilibrium swings back by 1 rad "
         "and, "
         "after a while that was searched, forward by as much on the other side. Settle: a blow gives the resting link 2 rad/s. "
         "Hold: a "
         "torque for 10 s after it has come to rest. All of it simulated, at up to five presets from 0 to 90 % of the largest that "
         "the motors wind to; the best counts. No heat, no gravity on the link.";
}

}  // namespace

report::Table tasks_table(const Tasks& tasks) {
  report::Table out{
      "Every type's best",
      {"type", "rank", "link [kg·m²]", "throws [m]", "place", "of its motors' speed [1]", "settles in [s]", "place", "holds [N·m]",
       "for [J]", "per N·m [J]", "place"},
      {},
      "Of its motors' speed: the link's over the no-load speed of the softest preset. Energy in 10 s. –: nothing that counts; "
      "equal numbers share a place."};
  for (const TaskResults& r : tasks.each) {
    const auto far = r.farthest();
    out.rows.push_back({r.actuator.name, r.actuator.rank.empty() ? "–" : r.actuator.rank, short_text(r.inertia_kgm2),
                        short_text(distance_m(r)), place(tasks, r, distance_m, true),
                        short_text(far ? far->link_rad_per_s / r.no_load_speed_rad_per_s : kNaN), short_text(settled_s(r)),
                        place(tasks, r, settled_s, false), short_text(r.load_Nm), short_text(energy_J(r)),
                        short_text(energy_J_per_Nm(r)), place(tasks, r, energy_J_per_Nm, false)});
  }
  return out;
}

report::Report tasks_page(const Tasks& tasks, const std::string& command) {
  report::Report out;
  out.title = "Which actuator throws farthest, settles soonest, holds cheapest?";
  out.subtitle = fmt::format("{} types, each with a link and a load in proportion to its torque unless given", tasks.each.size());
  report::Section first = bars_section(tasks);
  first.blocks.insert(first.blocks.begin(), report::Text{how_text()});
  out.sections = {std::move(first), {"", {tasks_table(tasks)}}, preset_section(tasks)};
  out.footer = command + " · vsa " VSA_VERSION;
  return out;
}

}  // namespace vsa::app
