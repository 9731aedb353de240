// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "run/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "run/scenario.hpp"
#include "run/set_up.hpp"
#include "terminal/interrupt.hpp"
#include "unit/port_report.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/output_file.hpp"
#include "vsa/seat/seat.hpp"
#include "vsa/topics/transport.hpp"

namespace vsa::app {
namespace {

constexpr double kTravelRate_Hz = 100;
constexpr std::chrono::milliseconds kIdleWait{100};

/// Those were told when they were met (terminal/old_spellings.hpp).
bool is_old_spelling(const std::string& warning, const engine::World& world) {
  for (std::size_t i = 0; i < world.robot_count(); ++i) {
    const std::vector<std::string>& notices = world.robot(i).config().notices;
    if (std::find(notices.begin(), notices.end(), warning) != notices.end()) return true;
  }
  return false;
}

}  // namespace

RunSession::RunSession(const RunOptions& options, Console& console)
    : console_(console),
      options_(seeded(options)),
      speed_(speed_of(options)),
      world_(scenario::load_world(options)),
      player_(options, world_),
      robot_model_(scenario::travelling_model(world_)),
      travel_window_s_(scenario::travel_window_s(player_.gait())),
      control_(options.paused),
      travel_(travel_window_s_, std::max(1 / kTravelRate_Hz, world_.step_s())),
      travel_cadence_(kTravelRate_Hz) {
  for (const auto& warning : world_.warnings())
    if (!is_old_spelling(warning, world_)) console_.line("warning: " + warning);
  if (world_.robot_count() == 0)
    console_.line("warning: the world has no actuator: no model that moves has a <plugin name=\"vsa::Robot\">");
  scenario::break_robots(world_, options_.faults);
  const auto report = [&console](const std::string& line) { console.line(line); };
  for (std::size_t i = 0; i < world_.robot_count(); ++i) world_.seat(i).report_to(report);
  const std::string why_none = options.no_topics ? "" : topics::why_no_topics();
  if (!options.no_topics && why_none.empty()) server_.emplace(world_, control_, report);
  if (!why_none.empty()) console_.line("note: " + why_none);
  open_ports();
  if (options.view) open_view(options);
  // Last, so that a run that is refused has not touched an earlier record.
  if (!options.record.empty()) {
    static_cast<void>(scenario_text(options_, 0, {}));
    recorder_.emplace(world_, options.record, recorder_options(options_));
    tell_of_other_records();
    write_scenario({"This run hasn't come to its end."});
  }
  if (options_.duration_s) {
    end_ns_ = world_.time_ns() + std::llround(*options_.duration_s * 1e9);
    tell_of_late_commands(*options_.duration_s);
  }
}

void RunSession::tell_of_late_commands(double duration_s) const {
  // Steps take what is due when they begin.
  const double step_s = world_.step_s(), last_s = (std::ceil(duration_s / step_s * (1 - 1e-12)) - 1) * step_s;
  const auto is_late = [&](const scenario::Command& c) { return c.time_s > last_s * (1 + 1e-12); };
  const auto late = std::count_if(options_.commands.begin(), options_.commands.end(), is_late);
  if (late == 0) return;
  const scenario::Command& first = *std::find_if(options_.commands.begin(), options_.commands.end(), is_late);
  console_.line("warning: " + std::to_string(late) + (late == 1 ? " command isn't" : " commands aren't") +
                " given, the run ends at " + config::number_text(duration_s) + " s: " + first.actuator + " at " +
                config::number_text(first.time_s) + " s" + (late == 1 ? "" : " is the first"));
}

void RunSession::open_view(const RunOptions& options) {
  view::LiveOptions with;
  with.server.port = static_cast<std::uint16_t>(options.view_port.value_or(0));
  with.page_template = config::find_data("web/live.html").value_or("");
  with.replay_template = config::find_data("web/replay.html").value_or("");
  with.records = options.view_records.empty() ? "." : options.view_records;
  with.speed = speed_;
  view_.emplace(world_, player_.gait(), &control_, std::move(with));
  console_.line("live view: " + view_->url());
}

/// Another world's actuators have a file of another name, which nobody overwrites.
void RunSession::tell_of_other_records() {
  const std::vector<std::filesystem::path> ours = recorder_->files();
  std::vector<std::string> others;
  std::error_code none;
  for (std::filesystem::directory_iterator at(options_.record, none), end; !none && at != end; at.increment(none)) {
    const std::string name = at->path().filename().string();
    constexpr std::string_view kActuators = "_actuators.csv";
    const bool a_record =
        name.size() > kActuators.size() && name.compare(name.size() - kActuators.size(), name.npos, kActuators) == 0;
    const bool own =
        std::any_of(ours.begin(), ours.end(), [&](const auto& file) { return file.filename() == at->path().filename(); });
    if (a_record && !own) others.push_back(name);
  }
  std::sort(others.begin(), others.end());
  if (!others.empty()) console_.line("warning: " + options_.record + " keeps an earlier run's " + config::join(others));
}

void RunSession::write_scenario(std::vector<std::string> remarks) {
  for (std::string& remark : remarks) std::replace(remark.begin(), remark.end(), '\n', ' ');
  const double duration_s = done() || world_.time_ns() == 0 ? options_.duration_s.value_or(0) : world_.time_s();
  write_whole(std::filesystem::path(options_.record) / kScenario, scenario_text(options_, duration_s, remarks));
}

/// What came from elsewhere while it ran, so that the file can't repeat it.
std::vector<std::string> RunSession::outside() {
  std::vector<std::string> out;
  const auto add = [&](bool any, const std::string& what) {
    if (any) out.push_back(what + ": the run may differ from what this file repeats.");
  };
  if (server_) add(server_->heard() > 0, "Commands came on topics (" + std::to_string(server_->heard()) + "), which aren't here");
  if (view_) add(view_->counts().viewers > 0, "A live page was open, and what it asked for isn't here");
  bool clients = false;
  for (std::size_t i = 0; i < world_.robot_count(); ++i) {
    for (const auto& port : world_.seat(i).ports()) clients = clients || port->counters().bytes_in > 0;
  }
  add(clients, "A client talked on a serial port, and what it said isn't here");
  return out;
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
      case seat::RunControl::Next::step:
        step();
        break;
      case seat::RunControl::Next::reset:
        reset();
        break;
      case seat::RunControl::Next::wait:
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
  player_.apply(world_);
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
  if (steps_ % kLookAtClock == 0) console_.progress(world_.time_s(), options_.duration_s, speed_factor());
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
  scenario::break_robots(world_, options_.faults);
  ++resets_;
  player_.reset();
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
  } else if (!robot_model_.empty()) {
    out.push_back({"distance travelled",
                   fmt::format("not measured: the run is shorter than the {:.2f} s that are averaged over", travel_window_s_)});
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
    for (const std::string& problem : view_->failed()) failures_.push_back("a recording in the view failed: " + problem);
  }
  if (recorder_) {
    const auto attempt = [this](auto&& what) {
      try {
        what();
      } catch (const OutputError& error) {
        failures_.emplace_back(error.what());
      }
    };
    attempt([&] {
      const auto page = recorder_->finish(out, note);
      out.push_back({"replay page", page.empty() ? recorder_->without_page() : page.string()});
    });
    std::string files;
    for (const auto& file : recorder_->files()) files += file.string() + ", ";
    std::vector<std::string> remarks = outside();
    if (!note.empty()) remarks.insert(remarks.begin(), note);
    attempt([&] { write_scenario(std::move(remarks)); });
    files += (std::filesystem::path(options_.record) / kScenario).string();
    out.push_back({"recorded data", files});
  }
  return out;
}

}  // namespace vsa::app
