// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "command/command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "terminal/exit_codes.hpp"
#include "terminal/numbers.hpp"
#include "vsa/errors.hpp"
#include "vsa/topics/command_client.hpp"
#include "vsa/units.hpp"

namespace vsa::app {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kLook{100};    // between two looks for robots
constexpr milliseconds kRepeat{200};  // a command that didn't show in a state by then is sent again
constexpr double kSame = 1e-9;        // rad, m or of a preset

double radians_of(double degrees) { return degrees * kPi / 180.0; }

std::string list(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

/// The robot to command. Throws InputError where the choice isn't clear; none: it doesn't run within the time.
std::optional<std::string> choose_model(const CommandOptions& options, const topics::CommandClient& client,
                                        Clock::time_point deadline) {
  const std::string wanted = options.model.empty() ? "" : host::topic_scope(options.model, "--model");
  std::vector<std::string> models;
  std::optional<std::string> only;  // confirmed by a second look: robots of one process appear one by one
  while (Clock::now() < deadline) {
    models = client.models();
    if (!wanted.empty() && std::binary_search(models.begin(), models.end(), wanted)) return wanted;
    if (wanted.empty() && models.size() > 1) throw InputError({"", "--model", "", "several robots run; say which", list(models)});
    if (wanted.empty() && models.size() == 1) {
      if (only == models.front()) return only;
      only = models.front();
    }
    std::this_thread::sleep_for(kLook);
  }
  if (wanted.empty() && only) return only;
  if (models.empty()) {
    std::cerr << fmt::format(
        "vsa: no running robot found within {} s (start one: vsa run WORLD.sdf; same IGN_PARTITION and IGN_IP?)\n",
        options.timeout_s);
  } else {
    std::cerr << fmt::format("vsa: no robot '{}' runs (running: {})\n", wanted, list(models));
  }
  return std::nullopt;
}

/// What is said in degrees where the actuator has rad, and as it is elsewhere: m, N·m/rad.
double as_commanded(double said, const std::string& unit) { return unit == "rad" ? radians_of(said) : said; }

std::string with_unit(double said, const std::string& unit) {
  return unit == "rad" ? fmt::format("{}°", said) : fmt::format("{} {}", said, unit);
}

/// What actuators are told, and in which units: all the same.
struct Told {
  std::vector<std::string> actuators;
  host::JointStates::Units units;
  double equilibrium = 0, preset = 0;

  [[nodiscard]] bool has_preset() const { return !units.preset.empty(); }
  [[nodiscard]] host::Trajectory trajectory() const {
    host::Trajectory command;
    command.points.emplace_back();
    for (const auto& name : actuators) {
      command.names.push_back(name);
      command.points.front().positions.push_back(equilibrium);
      if (!has_preset()) continue;
      command.names.push_back(name + "_preset");
      command.points.front().positions.push_back(preset);
    }
    return command;
  }
};

/// The actuators that the command goes to, and what they get. Throws InputError for a joint that the robot doesn't have, and where a
/// number would be in several units.
Told choose(const CommandOptions& options, const host::JointStates& state) {
  Told out;
  for (std::size_t i = 0; i < state.names.size(); ++i) {
    if (!options.joint.empty() && state.names[i] != options.joint) continue;
    const host::JointStates::Units& units = state.units[i];
    if (!out.actuators.empty() && (units.equilibrium != out.units.equilibrium || units.preset != out.units.preset))
      throw InputError({"", "--joint", "", "the actuators of " + state.model + " have different units", list(state.names)});
    out.actuators.push_back(state.names[i]);
    out.units = units;
  }
  if (out.actuators.empty())
    throw InputError({"", "--joint", options.joint, "no such actuator in " + state.model, list(state.names)});
  out.equilibrium = as_commanded(options.equilibrium_deg, out.units.equilibrium);
  out.preset = as_commanded(options.preset_deg, out.units.preset);
  return out;
}

bool follows(const Told& told, const host::JointStates& state) {
  return std::all_of(told.actuators.begin(), told.actuators.end(), [&](const std::string& name) {
    const auto at = std::find(state.names.begin(), state.names.end(), name);
    if (at == state.names.end()) return false;
    const auto& now = state.commands[static_cast<std::size_t>(at - state.names.begin())];
    const auto same = [](double a, double b) { return std::abs(a - b) < kSame * std::max(1.0, std::abs(b)); };
    return same(now.equilibrium_rad, told.equilibrium) && (!told.has_preset() || same(now.preset, told.preset));
  });
}

int command_model(const CommandOptions& options, topics::CommandClient& client, const std::string& model,
                  Clock::time_point deadline) {
  client.watch(model);
  Told told;
  Clock::time_point repeat_at{};
  std::int64_t first_ns = -1;
  bool time_moved = false;
  while (Clock::now() < deadline) {
    const auto state = client.wait_for_state(kRepeat);
    if (state && told.actuators.empty()) {
      told = choose(options, *state);
      first_ns = state->time_ns;
    }
    if (state) time_moved = time_moved || state->time_ns != first_ns;
    if (state && repeat_at != Clock::time_point{} && follows(told, *state)) {
      const bool one = told.actuators.size() == 1;
      const std::string preset = told.has_preset() ? " with preset " + with_unit(options.preset_deg, told.units.preset) : "";
      std::cout << fmt::format("{}: {} follow{} {}{}, as far as {} limits allow\n", model, list(told.actuators), one ? "s" : "",
                               with_unit(options.equilibrium_deg, told.units.equilibrium), preset, one ? "its" : "their");
      return kDone;
    }
    if (!told.actuators.empty() && Clock::now() >= repeat_at) {
      client.send(told.trajectory());
      repeat_at = Clock::now() + kRepeat;
    }
  }
  const char* why = told.actuators.empty() ? "its state didn't arrive"
                    : time_moved
                        ? "its state doesn't show the command (a bus with a serial port takes none; the robot's own terminal tells)"
                        : "its simulated time stands still: is the world paused?";
  std::cerr << fmt::format("vsa: {} doesn't follow within {} s: {}\n", model, options.timeout_s, why);
  return kFailed;
}

void check(const CommandOptions& options) {
  Problems problems;
  const auto finite = [&problems](const char* key, double value) {
    if (!std::isfinite(value)) problems.add({"", key, fmt::format("{}", value), "not a finite number", "a number of degrees"});
  };
  finite("EQUILIBRIUM_DEG", options.equilibrium_deg);
  finite("PRESET_DEG", options.preset_deg);
  if (!(options.timeout_s > 0 && options.timeout_s <= 86400)) {
    problems.add({"", "--timeout-s", fmt::format("{}", options.timeout_s), "out of range", "above 0 to 86400 s"});
  }
  problems.throw_if_any();
}

}  // namespace

int run_command(const CommandOptions& options) {
  check(options);
  const auto deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.timeout_s));
  topics::CommandClient client;
  const auto model = choose_model(options, client, deadline);
  return model ? command_model(options, client, *model, deadline) : kFailed;
}

void setup_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CommandOptions>();
  CLI::App* sub = app.add_subcommand("command", "Move a robot that runs; return once its state shows the command");
  sub->add_option("EQUILIBRIUM_DEG", options->equilibrium_deg, "Equilibrium position, degrees; m of a linear actuator")
      ->required()
      ->check(number_given());
  sub->add_option("PRESET_DEG", options->preset_deg, "Stiffness preset, degrees; where it is no angle in its own unit")
      ->required()
      ->check(number_given());
  sub->add_option("--model", options->model, "Which robot; not needed while only one runs");
  sub->add_option("--joint", options->joint, "Which actuator; default: all of the robot's");
  sub->add_option("--timeout-s", options->timeout_s, "Give up after so many seconds")->capture_default_str()->check(number_given());
  sub->footer("Example: vsa command -20 35 --model snake --joint joint_1");
  sub->callback([options, &exit_code] { exit_code = run_command(*options); });
}

}  // namespace vsa::app
