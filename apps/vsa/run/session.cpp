// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "run/session.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "terminal/find_file.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/settings.hpp"
#include "unit/port_report.hpp"
#include "vsa/errors.hpp"
#include "vsa/seat/seat.hpp"
#include "vsa/units.hpp"

namespace vsa::app {
namespace {

constexpr double kTravelWindow_s = 1.3;  // where no gait tells its period; close to Table II's 2π/4.71 s
constexpr double kTravelRate_Hz = 100;
constexpr std::chrono::milliseconds kIdleWait{100};
constexpr double kSlowest = 0.01, kFastest = 100;  // of --speed

engine::Concave concave_of(const std::string& text) {
  return text == "hull" ? engine::Concave::hull : text == "decompose" ? engine::Concave::decompose : engine::Concave::refuse;
}

engine::World load_world(const RunOptions& options) {
  engine::WorldOptions with;
  with.concave = concave_of(options.concave);
  with.actuator.overrides = parse_settings(options.set, "--set");
  if (!options.preset.empty()) {
    with.actuator.preset = options.preset;
    static_cast<void>(with.presets.load(options.preset, with.actuator.overrides));  // its problems, once and by their own names
  }
  return engine::World::load(find_file(options.world, "world", "models/worlds", ".sdf"), std::move(with));
}

std::optional<engine::Gait> load_gait(const std::string& name) {
  if (name.empty()) return std::nullopt;
  return engine::Gait::load(find_file(name, "gait", "models/gaits", ".toml"));
}

double travel_window_s(const std::optional<engine::Gait>& gait) {
  return gait && gait->params().frequency_rad_per_s > 0 ? 2 * kPi / gait->params().frequency_rad_per_s : kTravelWindow_s;
}

/// The page's template is generated, so it lies beside the build, where the other data needn't be.
record::RecorderOptions recorder_options(const std::vector<std::string>& faults) {
  record::RecorderOptions options;
  for (const std::string& text : faults) (options.faults += options.faults.empty() ? "" : "; ") += text;
  options.page_template = config::find_data("web/replay.html").value_or("");
  return options;
}

/// Each text goes to the robots that have its actuator.
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

std::string top_level(const std::string& scoped) { return scoped.substr(0, scoped.find("::")); }

}  // namespace

RunSession::RunSession(const RunOptions& options, Console& console)
    : console_(console),
      speed_(speed_of(options)),
      faults_(options.faults),
      duration_s_(options.duration_s),
      world_(load_world(options)),
      gait_(load_gait(options.gait)),
      robot_model_(world_.robot_count() > 0 ? top_level(world_.robot_model(0)) : ""),
      travel_window_s_(travel_window_s(gait_)),
      control_(options.paused),
      travel_(travel_window_s_, 1 / kTravelRate_Hz),
      travel_cadence_(kTravelRate_Hz) {
  for (const auto& warning : world_.warnings()) console_.line("warning: " + warning);
  if (world_.robot_count() == 0)
    console_.line("warning: the world has no actuator: no model that moves has a <plugin name=\"vsa::Robot\">");
  break_robots(world_, faults_);
  if (gait_) gait_->bind(world_);
  const auto report = [&console](const std::string& line) { console.line(line); };
  for (std::size_t i = 0; i < world_.robot_count(); ++i) world_.seat(i).report_to(report);
  if (!options.no_topics) server_.emplace(world_, control_, report);
  open_ports();
  if (options.view) open_view(options);
  // Last, so that a run that is refused has not touched an earlier record.
  if (!options.record.empty()) recorder_.emplace(world_, options.record, recorder_options(faults_));
  if (duration_s_) end_ns_ = world_.time_ns() + std::llround(*duration_s_ * 1e9);
}

void RunSession::open_view(const RunOptions& options) {
  view::LiveOptions with;
  with.server.port = static_cast<std::uint16_t>(options.view_port);
  with.page_template = config::find_data("web/live.html").value_or("");
  with.replay_template = config::find_data("web/replay.html").value_or("");
  with.records = options.view_records;
  with.speed = speed_;
  view_.emplace(world_, gait_ ? &*gait_ : nullptr, control_, std::move(with));
  console_.line("live view: " + view_->url());
}

void RunSession::open_ports() {
  Problems problems;
  for (std::size_t i = 0; i < world_.robot_count(); ++i) {
    try {
      world_.seat(i).open_ports();
      has_ports_ = has_ports_ || !world_.seat(i).ports().empty();
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
  problems.throw_if_any();
}

int RunSession::run() {
  take_speed();
  while (!done() && interrupted() == 0) {
    if (view_) view_->serve();
    switch (control_.next(world_.time_ns())) {
      case topics::RunControl::Next::step:
        step();
        break;
      case topics::RunControl::Next::reset:
        reset();
        break;
      case topics::RunControl::Next::wait:
        idle();
        break;
    }
  }
  wall_.pause();
  console_.wipe();
  return done() ? 0 : interrupted();
}

void RunSession::step() {
  wall_.run();
  if (gait_) gait_->apply(world_);
  world_.step();
  ++steps_;
  if (recorder_) recorder_->sample(world_);
  if (!robot_model_.empty() && travel_cadence_.due(world_.time_ns())) {
    travel_cadence_.taken(world_.time_ns());
    travel_.add(world_.center_of_mass(robot_model_));
  }
  if (server_) {
    server_->stepped();
  } else {
    for (std::size_t i = 0; i < world_.robot_count(); ++i) world_.seat(i).publish_step(world_.time_ns());
  }
  if (view_) view_->stepped();
  keep_time();
  constexpr std::uint64_t kLookAtClock = 16;  // steps between two looks at the wall clock for the progress line
  if (steps_ % kLookAtClock == 0) console_.progress(world_.time_s(), duration_s_, speed_factor());
}

void RunSession::take_speed() {
  if (view_) speed_ = view_->speed(), speed_changes_ = view_->speed_changes();
  pace_.set_speed(speed_.value_or(1));
  pace_.anchor(world_.time_ns());
}

/// At full speed nothing waits, but a client on a serial port lives by the wall clock and wants to know.
void RunSession::keep_time() {
  if (view_ && view_->speed_changes() != speed_changes_) take_speed();
  if (!speed_ && (!has_ports_ || told_late_)) return;
  RealTimePace::Clock::time_point due;
  const bool in_time = speed_ ? pace_.hold(world_.time_ns()) : pace_.keeps_up(world_.time_ns(), RealTimePace::Clock::now(), due);
  if (in_time || std::exchange(told_late_, true)) return;
  console_.line("warning: this machine can't keep up with real time in this world");
}

void RunSession::reset() {
  world_.reset();
  break_robots(world_, faults_);
  ++resets_;
  if (gait_) gait_->reset();
  travel_.restart();
  travel_cadence_.restart();
  if (recorder_) recorder_->sample(world_);
  if (server_) server_->idle();
  if (view_) view_->idle();
  pace_.anchor(world_.time_ns());
}

void RunSession::idle() {
  wall_.pause();
  if (server_) server_->idle();
  if (view_) view_->idle();
  control_.wait(kIdleWait);
  pace_.anchor(world_.time_ns());
}

double RunSession::speed_factor() const {
  const double wall_s = wall_.seconds();
  return wall_s > 0 ? static_cast<double>(steps_) * world_.step_s() / wall_s : 0.0;
}

std::vector<record::Statistic> RunSession::statistics() const {
  std::vector<record::Statistic> out;
  out.push_back({"simulated time",
                 fmt::format("{:.3f} s in {:.2f} s of wall time", static_cast<double>(steps_) * world_.step_s(), wall_.seconds())});
  out.push_back({"real-time factor", fmt::format("{:.1f}", speed_factor())});
  if (resets_ > 0) out.push_back({"resets", fmt::format("{}; what follows counts from the last one", resets_)});
  if (world_.robot_count() == 0) return out;
  if (travel_.measured()) {
    out.push_back(
        {"distance travelled", fmt::format("{:.2f} m along the path, {:.2f} m net ({}, centre of mass averaged over {:.2f} s)",
                                           travel_.path_m(), travel_.net_m(), robot_model_, travel_window_s_)});
  } else {
    out.push_back(
        {"distance travelled", fmt::format("not measured: the run is shorter than {:.2f} s, one gait period", travel_window_s_)});
  }
  const actuator::Ledger energy = world_.ledger();
  out.push_back({"energy from supply", fmt::format("{:.4g} J", energy.supply)});
  out.push_back({"  became heat", fmt::format("{:.4g} J in copper, {:.4g} J in bridges, {:.4g} J in gearboxes, {:.4g} J in "
                                              "tendons, {:.4g} J at shafts, {:.4g} J viscous",
                                              energy.copper, energy.bridge, energy.motor_friction, energy.tendon_friction,
                                              energy.shaft_friction, energy.viscous)});
  out.push_back({"  went to robots", fmt::format("{:.4g} J delivered at the shafts, {:+.4g} J stored in the actuators",
                                                 energy.delivered, energy.stored() - energy.stored_at_start)});
  out.push_back({"  model and step", fmt::format("{:+.3g} J motor constants, {:+.3g} J integration, {:+.3g} J coupling",
                                                 energy.conversion, energy.integrator, energy.coupling)});
  return out;
}

std::vector<record::Statistic> RunSession::finish(const std::string& note) {
  wall_.pause();
  for (std::size_t i = 0; !server_ && i < world_.robot_count(); ++i) world_.seat(i).publish(world_.time_ns());
  std::vector<record::Statistic> out = statistics();
  for (std::size_t i = 0; i < world_.robot_count(); ++i) {
    for (const auto& port : world_.seat(i).ports())
      out.push_back({"serial port", port->path() + ": " + in_a_line(port->counters())});
  }
  if (view_) {
    for (const auto& page : view_->finish(note)) out.push_back({"recorded in the view", page.string()});
  }
  if (recorder_) {
    const auto page = recorder_->finish(out, note);
    out.push_back({"replay page", page.empty() ? recorder_->without_page() : page.string()});
    std::string files;
    for (const auto& file : recorder_->files()) files += (files.empty() ? "" : ", ") + file.string();
    out.push_back({"recorded data", files});
  }
  return out;
}

}  // namespace vsa::app
