// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sweep/columns.hpp"
#include "vsa/config/text.hpp"
#include "vsa/sweep/optimize.hpp"

namespace vsa::sweep {
namespace {

using report::Chart;
using report::Curve;

const char* over_text(Objective::Over over) {
  return over == Objective::Over::mean ? "mean" : over == Objective::Over::worst ? "worst" : "median";
}

std::string name_of(const Plan& plan, std::size_t o) {
  const Objective& objective = plan.search()->objectives[o];
  return std::string(over_text(objective.over)) + " " + plan.measures()[objective.measure].name;
}

std::vector<std::size_t> searched_axes(const Plan& plan) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < plan.axes().size(); ++k)
    if (plan.axes()[k].kind == Axis::Kind::searched) out.push_back(k);
  return out;
}

double value_of(const Plan& plan, std::size_t candidate, std::size_t axis) {
  const std::size_t points = plan.points() / plan.candidates();
  return std::get<double>(plan.values(candidate * points)[axis]);
}

bool is_best(const Optimum& o, std::size_t candidate) { return std::find(o.best.begin(), o.best.end(), candidate) != o.best.end(); }

/// What the best of a generation reaches, and the best so far.
Chart progress(const Optimum& optimum, std::size_t o) {
  const Plan& plan = optimum.plan;
  const bool up = plan.search()->objectives[o].maximize;
  Curve all = report::curve("a candidate each", {}, {}, Curve::Style::markers, 1),
        best = report::curve("best so far", {}, {}, Curve::Style::line, 0);
  double so_far = std::nan("");
  for (std::size_t c = 0; c < plan.candidates(); ++c) {
    const double value = optimum.objectives[c][o];
    all.x.push_back(static_cast<double>(c) / plan.search()->population);
    all.y.push_back(value);
    if (std::isnan(so_far) || (up ? value > so_far : value < so_far)) so_far = value;
    best.x.push_back(all.x.back());
    best.y.push_back(so_far);
  }
  return {name_of(plan, o), "generation", name_of(plan, o), {all, best}, ""};
}

Chart against(const Optimum& optimum, std::size_t a, std::size_t b) {
  Curve all = report::curve("candidates", {}, {}, Curve::Style::markers, -1),
        front = report::curve("not beaten", {}, {}, Curve::Style::markers, 0);
  for (std::size_t c = 0; c < optimum.plan.candidates(); ++c) {
    Curve& curve = is_best(optimum, c) ? front : all;
    curve.x.push_back(optimum.objectives[c][a]);
    curve.y.push_back(optimum.objectives[c][b]);
  }
  return {"What one costs of the other",
          name_of(optimum.plan, a),
          name_of(optimum.plan, b),
          {all, front},
          "No candidate is better in both than one that isn't beaten."};
}

report::Table best_table(const Optimum& optimum) {
  constexpr std::size_t kShown = 12;
  const Plan& plan = optimum.plan;
  report::Table out{"Not beaten", {"candidate"}, {}, ""};
  for (const std::size_t k : searched_axes(plan)) out.head.push_back(plan.axes()[k].name);
  for (std::size_t o = 0; o < plan.search()->objectives.size(); ++o) out.head.push_back(name_of(plan, o));
  const std::size_t shown = std::min(kShown, optimum.best.size());
  for (std::size_t row = 0; row < shown; ++row) {  // from end to end of them
    const std::size_t c = optimum.best[shown == 1 ? 0 : row * (optimum.best.size() - 1) / (shown - 1)];
    std::vector<std::string> cells{std::to_string(c)};
    for (const std::size_t k : searched_axes(plan)) cells.push_back(fmt::format("{:.5g}", value_of(plan, c, k)));
    for (const double v : optimum.objectives[c]) cells.push_back(fmt::format("{:.5g}", v));
    out.rows.push_back(std::move(cells));
  }
  if (optimum.best.size() > kShown) out.caption = fmt::format("Some of {}: candidates.csv.", optimum.best.size());
  return out;
}

}  // namespace

std::string candidates_csv(const Optimum& optimum) {
  const Plan& plan = optimum.plan;
  const auto axes = searched_axes(plan);
  std::string out = "candidate,generation";
  for (const std::size_t k : axes) out += ',' + cell(plan.axes()[k].name);
  for (std::size_t o = 0; o < plan.search()->objectives.size(); ++o) out += ',' + cell(name_of(plan, o));
  out += ",not_beaten\n";
  for (std::size_t c = 0; c < plan.candidates(); ++c) {
    out += fmt::format("{},{}", c, c / plan.search()->population);
    for (const std::size_t k : axes) out += ',' + config::number_text(value_of(plan, c, k));
    for (const double v : optimum.objectives[c]) out += ',' + (std::isfinite(v) ? config::number_text(v) : "");
    out += is_best(optimum, c) ? ",1\n" : ",0\n";
  }
  return out;
}

report::Report optimum_page(const Optimum& optimum, const std::string& command) {
  const Plan& plan = optimum.plan;
  const Search& search = *plan.search();
  report::Report out;
  out.title = plan.title().empty() ? "Optimisation" : plan.title();
  out.subtitle =
      fmt::format("{} candidates by {}, {} runs each", plan.candidates(), search.algorithm, plan.runs() / plan.candidates());
  out.footer = command;
  report::Section found{"Found", {}};
  for (std::size_t a = 0; a < search.objectives.size(); ++a)
    for (std::size_t b = a + 1; b < search.objectives.size(); ++b) found.blocks.emplace_back(against(optimum, a, b));
  found.blocks.emplace_back(best_table(optimum));
  out.sections.push_back(std::move(found));
  report::Section way{"The way there", {}};
  for (std::size_t o = 0; o < search.objectives.size(); ++o) way.blocks.emplace_back(progress(optimum, o));
  out.sections.push_back(std::move(way));
  report::Section axes{"What was searched", {}};
  for (const std::size_t k : searched_axes(plan)) {
    for (std::size_t o = 0; o < search.objectives.size(); ++o) {
      Curve all = report::curve("candidates", {}, {}, Curve::Style::markers, -1),
            best = report::curve("not beaten", {}, {}, Curve::Style::markers, 0);
      for (std::size_t c = 0; c < plan.candidates(); ++c) {
        Curve& curve = is_best(optimum, c) ? best : all;
        curve.x.push_back(value_of(plan, c, k));
        curve.y.push_back(optimum.objectives[c][o]);
      }
      Chart chart{name_of(plan, o) + " by " + plan.axes()[k].name, plan.axes()[k].name, name_of(plan, o), {all, best}, ""};
      chart.x_log = plan.axes()[k].law == Axis::Law::log_uniform;
      axes.blocks.emplace_back(std::move(chart));
    }
  }
  out.sections.push_back(std::move(axes));
  return out;
}

}  // namespace vsa::sweep
