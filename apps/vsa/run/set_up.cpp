// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "run/set_up.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "terminal/settings.hpp"
#include "vsa/config/find_file.hpp"
#include "vsa/errors.hpp"
#include "vsa/scoped_name.hpp"
#include "vsa/seat/seat.hpp"
#include "vsa/units.hpp"

namespace vsa::app {
namespace {

constexpr double kTravelWindow_s = 1.3;  // where no gait tells its period; close to Table II's 2π/4.71 s
constexpr std::uint64_t kSeedsApart = 1000;

engine::Concave concave_of(const std::string& text) {
  return text == "hull" ? engine::Concave::hull : text == "decompose" ? engine::Concave::decompose : engine::Concave::refuse;
}

}  // namespace

engine::World load_world(const RunOptions& options) {
  engine::WorldOptions with;
  with.step_s = options.step_s;
  with.concave = concave_of(options.concave);
  with.actuator.flag = options.scenario.empty() ? "--set" : "--set or [set]";
  with.actuator.overrides = parse_settings(options.set, with.actuator.flag);
  if (!options.type.empty()) {
    with.actuator.type = options.type;
    static_cast<void>(with.types.load(options.type, with.actuator.overrides));  // its problems, once and by their own names
  }
  return engine::World::load(config::find_file(options.world, "world", "models/worlds", ".sdf"), std::move(with));
}

RunOptions seeded(RunOptions options) {
  for (std::size_t i = 0; options.seed && i < options.faults.size(); ++i) {
    std::string& text = options.faults[i];
    if (text.find(" seed=") == std::string::npos) text += " seed=" + std::to_string(*options.seed + kSeedsApart * i);
  }
  options.seed.reset();
  return options;
}

double travel_window_s(const std::optional<motion::Gait>& gait) {
  return gait && gait->params().frequency_rad_per_s > 0 ? 2 * kPi / gait->params().frequency_rad_per_s : kTravelWindow_s;
}

/// The page's template is generated, so it lies beside the build, where the other data needn't be.
record::RecorderOptions recorder_options(const RunOptions& run) {
  record::RecorderOptions options;
  options.rate_Hz = run.record_rate_Hz;
  options.page_rate_Hz = run.page_rate_Hz;
  for (const std::string& text : run.faults) (options.faults += options.faults.empty() ? "" : "; ") += text;
  options.page_template = config::find_data("web/replay.html").value_or("");
  return options;
}

void break_robots(engine::World& world, const std::vector<std::string>& faults) {
  Problems problems;
  for (const std::string& text : faults) {
    const std::string who = text.substr(0, text.find(' '));
    bool known = false;
    try {
      for (std::size_t i = 0; i < world.robot_count(); ++i) {
        const bool last = i + 1 == world.robot_count() && !known;
        if (who != "all" && !world.robot(i).find(who) && !last) continue;
        known = true;
        (void)world.seat(i).apply_faults(text, "--fault");
      }
    } catch (const InputError& error) {
      problems.add_all(error);
    }
    if (world.robot_count() == 0) problems.add({"", "--fault", text, "the world has no actuator", ""});
  }
  problems.throw_if_any();
}

/// "max": none.
std::optional<double> speed_of(const RunOptions& options) {
  if (options.speed.empty()) return options.realtime || options.view ? std::optional(1.0) : std::nullopt;
  if (options.speed == "max") return std::nullopt;
  char* end = nullptr;
  const double factor = std::strtod(options.speed.c_str(), &end);
  if (end != options.speed.c_str() + options.speed.size() || !(factor >= kSlowest && factor <= kFastest)) {
    throw InputError({"", "--speed", options.speed, "not a speed", "0.01 … 100, or max"});
  }
  return factor;
}

std::string travelling_model(const engine::World& world) {
  if (world.robot_count() == 0) return "";
  const std::string_view model = outermost(world.robot_model(0));
  const auto& links = world.links();
  const bool free = std::any_of(links.begin(), links.end(), [&](const auto& l) {
    return l.model == model && !l.is_static && world.free_dof(world.link(l.name)).has_value();
  });
  return std::string(free ? model : "");
}

}  // namespace vsa::app
