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
constexpr double kSame_rad = 1e-9;

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

host::Trajectory command_for(const CommandOptions& options, const std::vector<std::string>& actuators) {
  host::Trajectory command;
  command.points.emplace_back();
  for (const auto& name : actuators) {
    command.names.push_back(name);
    command.names.push_back(name + "_preset");
    command.points.front().positions.push_back(radians_of(options.equilibrium_deg));
    command.points.front().positions.push_back(radians_of(options.preset_deg));
  }
  return command;
}

/// The actuators that the command goes to. Throws InputError for a joint that the robot doesn't have.
std::vector<std::string> choose_actuators(const CommandOptions& options, const host::JointStates& state) {
  if (options.joint.empty()) return state.names;
  if (std::find(state.names.begin(), state.names.end(), options.joint) == state.names.end()) {
    throw InputError({"", "--joint", options.joint, "no such actuator in " + state.model, list(state.names)});
  }
  return {options.joint};
}

bool follows(const CommandOptions& options, const host::JointStates& state, const std::vector<std::string>& actuators) {
  return std::all_of(actuators.begin(), actuators.end(), [&](const std::string& name) {
    const auto at = std::find(state.names.begin(), state.names.end(), name);
    if (at == state.names.end()) return false;
    const auto& now = state.commands[static_cast<std::size_t>(at - state.names.begin())];
    return std::abs(now.equilibrium_rad - radians_of(options.equilibrium_deg)) < kSame_rad &&
           std::abs(now.preset - radians_of(options.preset_deg)) < kSame_rad;
  });
}

int command_model(const CommandOptions& options, topics::CommandClient& client, const std::string& model,
                  Clock::time_point deadline) {
  client.watch(model);
  std::vector<std::string> actuators;
  host::Trajectory command;
  Clock::time_point repeat_at{};
  std::int64_t first_ns = -1;
  bool time_moved = false;
  while (Clock::now() < deadline) {
    const auto state = client.wait_for_state(kRepeat);
    if (state && actuators.empty()) {
      actuators = choose_actuators(options, *state);
      command = command_for(options, actuators);
      first_ns = state->time_ns;
    }
    if (state) time_moved = time_moved || state->time_ns != first_ns;
    if (state && repeat_at != Clock::time_point{} && follows(options, *state, actuators)) {
      std::cout << fmt::format("{}: {} follow{} {}° with preset {}°, as far as {} limits allow\n", model, list(actuators),
                               actuators.size() == 1 ? "s" : "", options.equilibrium_deg, options.preset_deg,
                               actuators.size() == 1 ? "its" : "their");
      return kDone;
    }
    if (!actuators.empty() && Clock::now() >= repeat_at) {
      client.send(command);
      repeat_at = Clock::now() + kRepeat;
    }
  }
  const char* why = actuators.empty() ? "its state didn't arrive"
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
  sub->add_option("EQUILIBRIUM_DEG", options->equilibrium_deg, "Equilibrium position, degrees")->required()->check(number_given());
  sub->add_option("PRESET_DEG", options->preset_deg, "Stiffness preset, degrees")->required()->check(number_given());
  sub->add_option("--model", options->model, "Which robot; not needed while only one runs");
  sub->add_option("--joint", options->joint, "Which actuator; default: all of the robot's");
  sub->add_option("--timeout-s", options->timeout_s, "Give up after so many seconds")->capture_default_str()->check(number_given());
  sub->footer("Example: vsa command -20 35 --model snake --joint joint_1");
  sub->callback([options, &exit_code] { exit_code = run_command(*options); });
}

}  // namespace vsa::app
