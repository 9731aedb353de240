// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "validate_output.hpp"
#include "vsa/errors.hpp"

namespace vsa::app {
namespace {

using Json = nlohmann::ordered_json;
using report::Chart;
using report::Curve;

Curve curve(std::string name, std::vector<double> x, std::vector<double> y, Curve::Style style, int color) {
  Curve c;
  c.name = c.group = std::move(name);
  c.x = std::move(x);
  c.y = std::move(y);
  c.style = style;
  c.color = color;
  return c;
}

Chart loop_chart(const RecordingCheck& r) {
  Chart out;
  out.title = fmt::format("Preset {:.4f} rad", r.preset);
  out.x_label = "deflection [rad]";
  out.y_label = "load torque [N·m]";
  out.curves = {curve("recorded, rising", r.data.rising_rad, r.data.torque_Nm, Curve::Style::markers, 0),
                curve("recorded, falling", r.data.falling_rad, r.data.torque_Nm, Curve::Style::markers, 1),
                curve("simulated, rising", r.ours.rising_rad, r.ours.torque_Nm, Curve::Style::line, 0),
                curve("simulated, falling", r.ours.falling_rad, r.ours.torque_Nm, Curve::Style::line, 1)};
  out.caption = r.file;
  return out;
}

std::vector<double> width(const experiment::Branches& b) {
  std::vector<double> out;
  for (std::size_t i = 0; i < b.torque_Nm.size(); ++i) out.push_back(b.falling_rad[i] - b.rising_rad[i]);
  return out;
}

Chart width_chart(const RecordingCheck& r) {
  Chart out;
  out.title = fmt::format("Width of the loop, preset {:.4f} rad", r.preset);
  out.x_label = "load torque [N·m]";
  out.y_label = "falling − rising [rad]";
  out.curves = {curve("recorded", r.data.torque_Nm, width(r.data), Curve::Style::markers, 0),
                curve("simulated", r.ours.torque_Nm, width(r.ours), Curve::Style::line, 0)};
  return out;
}

Chart time_chart(std::string title, std::string y_label, const experiment::TimeSeries& ours, const experiment::TimeSeries& theirs) {
  Chart out;
  out.title = std::move(title);
  out.x_label = "time from the command [s]";
  out.y_label = std::move(y_label);
  out.curves = {curve("simulated", ours.time_s, ours.value, Curve::Style::line, 0),
                curve("2015", theirs.time_s, theirs.value, Curve::Style::dashed, 1)};
  return out;
}

report::Figures figures(const Validation& v) {
  report::Figures out;
  for (const experiment::Verdict& d : v.verdicts) {
    out.figures.push_back({d.bound.quantity, fmt::format("{:.4g}", d.value), experiment::bound_text(d.bound),
                           d.held ? report::Figure::Verdict::good : report::Figure::Verdict::bad});
  }
  return out;
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json numbers(const std::vector<double>& values) {
  Json out = Json::array();
  for (const double v : values) out.push_back(number(v));
  return out;
}

Json branches_json(const experiment::Branches& b) {
  return {{"load_torque_Nm", numbers(b.torque_Nm)},
          {"deflection_rising_rad", numbers(b.rising_rad)},
          {"deflection_falling_rad", numbers(b.falling_rad)}};
}

std::size_t once(const std::string& text, const std::string& marker, const std::filesystem::path& file) {
  const std::size_t at = text.find(marker);
  if (at == std::string::npos || text.find(marker, at + 1) != std::string::npos) {
    throw InputError({file.string(), "--markdown", "", "this line isn't there exactly once", marker});
  }
  return at;
}

}  // namespace

std::string results_json(const Validation& v) {
  Json out;
  out["program"] = "vsa " VSA_VERSION;
  out["command"] = v.command;
  out["preset"] = v.actuator.name;
  Json& overrides = out["overrides"] = Json::object();
  for (const config::Override& o : v.overrides) overrides[o.key] = o.value;
  out["passed"] = experiment::all_held(v.verdicts);
  Json& bounds = out["bounds"] = Json::array();
  for (const experiment::Verdict& d : v.verdicts) {
    bounds.push_back({{"quantity", d.bound.quantity},
                      {"value", number(d.value)},
                      {"min", d.bound.min ? Json(*d.bound.min) : Json(nullptr)},
                      {"max", d.bound.max ? Json(*d.bound.max) : Json(nullptr)},
                      {"held", d.held},
                      {"why", d.bound.why}});
  }
  Json& all = out["quantities"] = Json::object();
  for (const auto& [name, value] : quantities(v)) all[name] = number(value);
  Json& periods = out["periods"] = Json::array();
  for (const PeriodCheck& p : v.periods) {
    periods.push_back({{"preset_rad", p.preset},
                       {"period_s", p.period_s},
                       {"rms_rad", number(p.rms.both_rad)},
                       {"loop_area_Nm_rad", number(p.loop.area_Nm_rad)},
                       {"mean_width_rad", number(p.loop.mean_width_rad)}});
  }
  Json& recordings = out["recordings"] = Json::array();
  for (const RecordingCheck& r : v.recordings) {
    recordings.push_back({{"file", r.file},
                          {"preset_rad", r.preset},
                          {"recorded_loop_area_Nm_rad", number(r.data_loop.area_Nm_rad)},
                          {"recorded_mean_width_rad", number(r.data_loop.mean_width_rad)},
                          {"recorded", branches_json(r.data)},
                          {"simulated", branches_json(r.ours)}});
  }
  out["wall_s"] = v.wall_s;
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

report::Report validation_report(const Validation& v) {
  report::Report out;
  out.title = "Validation of " + v.actuator.name;
  out.subtitle = experiment::all_held(v.verdicts) ? "every stated bound is held" : "a stated bound is broken";
  const std::vector<report::Table> tables = validation_tables(v);
  out.sections.push_back({"Stated bounds", {figures(v), tables[0]}});
  report::Section load{"Load test: hardware and simulation", {tables[1], tables[2]}};
  for (const RecordingCheck& r : v.recordings) {
    load.blocks.emplace_back(loop_chart(r));
    load.blocks.emplace_back(width_chart(r));
  }
  load.blocks.emplace_back(tables[3]);
  report::Section speed{"Figure 4: step of the equilibrium", {tables[4]}};
  for (const SpeedCheck& s : v.speeds) {
    speed.blocks.emplace_back(time_chart(fmt::format("Preset {} %", s.percent), "shaft [rad]", s.ours, s.theirs));
  }
  report::Section preset{"Figure 5: step of the preset", {tables[5]}};
  for (const PresetStepCheck& p : v.preset_steps) {
    preset.blocks.emplace_back(time_chart(p.loaded ? "With load" : "No load", "attained preset [rad]", p.ours, p.theirs));
  }
  out.sections.push_back(std::move(load));
  out.sections.push_back(std::move(speed));
  out.sections.push_back(std::move(preset));
  out.footer = v.command + " · vsa " VSA_VERSION;
  return out;
}

std::string with_tables(const std::filesystem::path& file, const std::string& tables) {
  const std::string block = std::string(kMarkdownBegin) + "\n\n" + tables + kMarkdownEnd;
  std::error_code error;
  if (!std::filesystem::exists(file, error) && !error) return block + '\n';
  if (!std::filesystem::is_regular_file(file, error)) {
    throw InputError({file.string(), "--markdown", "", "isn't a file that can be read", "a Markdown file, or a new name"});
  }
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t begin = once(text, kMarkdownBegin, file), end = once(text, kMarkdownEnd, file);
  if (end < begin) throw InputError({file.string(), "--markdown", "", "the markers are in the wrong order", kMarkdownBegin});
  return text.substr(0, begin) + block + text.substr(end + std::string_view(kMarkdownEnd).size());
}

}  // namespace vsa::app
