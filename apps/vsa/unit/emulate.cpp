// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "unit/emulate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <system_error>

#include "terminal/console.hpp"
#include "terminal/exit_codes.hpp"
#include "terminal/faults_help.hpp"
#include "terminal/interrupt.hpp"
#include "terminal/numbers.hpp"
#include "terminal/pace.hpp"
#include "unit/port.hpp"
#include "unit/port_report.hpp"
#include "unit/unit_memory.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/config/faults_text.hpp"
#include "vsa/config/text.hpp"
#include "vsa/device/emulation.hpp"
#include "vsa/elastic/inverse.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/output_file.hpp"
#include "vsa/serial/ports.hpp"
#include "vsa/serial/processors_awake.hpp"
#include "vsa/serial/virtual_port.hpp"
#include "vsa/units.hpp"

namespace vsa::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMostId = 254;
constexpr std::int64_t kStepNs = 1'000'000;
constexpr std::uint8_t kMotorsOn = 3;

constexpr const char* kEmulateNotes =
    R"(The units run in real time until Ctrl-C, each with a shaft that turns freely. Software for the hardware opens the port's
path as it would a real one; --port NAME is a path if it has a '/', else a name in $XDG_RUNTIME_DIR, or /tmp.

Examples:
  vsa emulate qbmove_maker_pro_6_1
  vsa emulate qbmove_maker_pro_6_1 --units 12 --port arm --active
  vsa emulate qbmove_maker_pro_6_1 --units 3 --fault "2 lost_byte=0.01 seed=7" --fault "1,3 noise_rad=0.01"

)";

void check(const EmulateOptions& o) {
  Problems problems;
  if (o.units < 1 || o.first_id < 1 || o.first_id > kMostId || o.units > kMostId + 1 - o.first_id) {
    problems.add({"", "--units, --first-id", fmt::format("{}, {}", o.units, o.first_id), "ids out of range", "ids from 1 to 254"});
  }
  if (o.duration_s && !(*o.duration_s > 0 && *o.duration_s <= 1e8)) {
    problems.add({"", "--duration-s", fmt::format("{}", *o.duration_s), "out of range", "above 0 to 1e8 s"});
  }
  const auto good = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; };
  if (o.port.find('/') == std::string::npos && !std::all_of(o.port.begin(), o.port.end(), good)) {
    problems.add({"", "--port", o.port, "can't be the name of a serial port", "letters, digits, and _ - . (or a path)"});
  }
  problems.throw_if_any();
}

std::vector<device::EmulatedUnit> units_of(const EmulateOptions& o) {
  const config::ActuatorType type = config::TypeLibrary().load(o.type, config::parse_overrides(o.set, "--set"));
  if (type.unit.servo)
    throw InputError({"", "type", o.type, "speaks no qbmove protocol: its controller is " + type.controller,
                      "an actuator type whose control.kind is qbmove"});
  device::UnitConfig config = type.unit;
  if (o.dialect) config.program.dialect = *o.dialect == 7 ? bus::Dialect::seven : bus::Dialect::six;
  if (o.active) config.memory.startup_activation = kMotorsOn;
  std::vector<device::EmulatedUnit> units(static_cast<std::size_t>(o.units));
  for (std::size_t i = 0; i < units.size(); ++i) {
    units[i].config = config;
    units[i].id = o.first_id + static_cast<int>(i);
    units[i].held = o.held;
  }
  return units;
}

/// A unit that has a memory begins with that.
void tell_left_out(const EmulateOptions& o, const firmware::Memory& asked) {
  if (o.first_id != EmulateOptions().first_id)
    std::cerr << fmt::format("warning: --first-id = {}: left out: the units have the ids of {}\n", o.first_id, o.memory);
  if (!o.set.empty() && !(asked == config::TypeLibrary().load(o.type, {}).unit.memory))
    std::cerr << fmt::format("warning: --set: of what a unit stores, {} counts\n", o.memory);
}

/// As the units have them, from their memory of an earlier day too: an id twice where two were given the same.
std::vector<int> ids_of(const device::Emulation& emulation) {
  std::vector<int> ids;
  for (std::size_t i = 0; i < emulation.size(); ++i) ids.push_back(emulation.pages(i).user.id);
  return ids;
}

std::string ids_text(const std::vector<int>& ids, const char* to) {
  for (std::size_t i = 1; i < ids.size(); ++i)
    if (ids[i] != ids[i - 1] + 1) return fmt::format("{}", fmt::join(ids, ","));
  return ids.size() == 1 ? std::to_string(ids.front()) : fmt::format("{}{}{}", ids.front(), to, ids.back());
}

/// "IDS FAULT …": as `vsa run --fault`, with units instead of actuators.
void break_units(const std::string& text, device::Emulation& emulation) {
  const std::string_view trimmed = config::trim(text);
  const std::size_t end = std::min(trimmed.find_first_of(" \t\n\r\f\v"), trimmed.size());
  const std::string who(trimmed.substr(0, end));
  device::Faults faults = config::read_faults(trimmed.substr(end), "--fault");
  const std::vector<int> ids = ids_of(emulation);
  Problems problems;
  const auto named = who == "all" ? std::vector<std::uint8_t>{} : parse_ids(who, "--fault");
  for (const std::uint8_t id : named)
    if (std::find(ids.begin(), ids.end(), id) == ids.end())
      problems.add({"", "--fault", std::to_string(id), "no such unit", "all, " + ids_text(ids, "-")});
  problems.throw_if_any();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (who != "all" && std::find(named.begin(), named.end(), ids[i]) == named.end()) continue;
    emulation.set_faults(i, faults);
    ++faults.seed;  // units have their own luck
  }
}

void break_units(const EmulateOptions& o, device::Emulation& emulation) {
  Problems problems;
  for (const std::string& text : o.faults) {
    try {
      break_units(text, emulation);
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
  problems.throw_if_any();
}

/// Ticks by the wall clock, and how well that went.
class Runner {
 public:
  Runner(device::Emulation& emulation, const serial::VirtualPort& port, std::optional<double> duration_s, UnitMemory* memory)
      : emulation_(emulation), port_(port), duration_s_(duration_s), memory_(memory) {}

  /// The signal that ended it, or 0.
  int run() {
    const auto start = Clock::now();
    pace_.anchor(0, start);
    keep();
    const std::int64_t end_ns = duration_s_ ? std::llround(*duration_s_ * 1e9) : std::numeric_limits<std::int64_t>::max();
    while (interrupted() == 0 && sim_ns_ < end_ns) {
      sim_ns_ += kStepNs;
      emulation_.advance(sim_ns_);
      if (!pace_.hold(sim_ns_)) tell_late();
      constexpr std::int64_t kShow = 100 * kStepNs;
      if (sim_ns_ % kShow == 0) {
        tell_wrong_rate();
        keep();
        show(Clock::now() - start);
      }
    }
    tell_wrong_rate();
    keep();
    console_.wipe();
    wall_s_ = std::chrono::duration<double>(Clock::now() - start).count();
    return sim_ns_ < end_ns ? interrupted() : 0;
  }
  [[nodiscard]] double simulated_s() const { return static_cast<double>(sim_ns_) * 1e-9; }
  [[nodiscard]] double wall_s() const { return wall_s_; }
  [[nodiscard]] bool kept() const { return kept_; }  ///< what the units have stored, as far as a file keeps it

 private:
  /// Where it can't, the units go on, and it is tried again.
  void keep() {
    if (memory_ == nullptr) return;
    try {
      memory_->keep(emulation_);
      kept_ = true;
    } catch (const OutputError& error) {
      if (std::exchange(kept_, false))
        console_.line(fmt::format("warning: {}; what the units store is lost until it can", error.what()));
    }
  }
  void tell_late() {
    if (std::exchange(told_, true)) return;
    console_.line("warning: this machine can't keep up with real time for so many units; simulated time falls behind");
  }
  void tell_wrong_rate() {
    const auto wrong = emulation_.line().wrong_rate();
    if (wrong.bytes > 0 && !std::exchange(told_rate_, true)) console_.line("warning: " + wrong.text());
  }
  void show(Clock::duration wall) {
    const auto unit = emulation_.read(0);
    console_.status(fmt::format("{:.0f} s, {} exchanges, first unit: motors {:.1f}° {:.1f}°, shaft {:.1f}°",
                                std::chrono::duration<double>(wall).count(), port_.counters().exchanges, degrees(unit.motor_rad[0]),
                                degrees(unit.motor_rad[1]), degrees(unit.shaft_rad)));
  }
  static double degrees(double rad) { return rad * 180 / kPi; }

  device::Emulation& emulation_;
  const serial::VirtualPort& port_;
  std::optional<double> duration_s_;
  UnitMemory* memory_;
  Console console_;
  RealTimePace pace_;
  std::int64_t sim_ns_ = 0;
  double wall_s_ = 0;
  bool told_ = false, told_rate_ = false, kept_ = true;
};

/// "on", "off", or "on of 2,7": whose motors are on from the start.
std::string motors_text(const device::Emulation& emulation) {
  std::vector<int> on;
  for (std::size_t i = 0; i < emulation.size(); ++i)
    if (const firmware::Memory user = emulation.pages(i).user; user.startup_activation == kMotorsOn) on.push_back(user.id);
  if (on.empty()) return "off";
  return on.size() == emulation.size() ? "on" : "on of " + ids_text(on, " to ");
}

void introduce(const EmulateOptions& o, const device::Emulation& emulation, const std::string& path, bus::Dialect dialect,
               bool antagonists) {
  const std::vector<int> ids = ids_of(emulation);
  const std::string units =
      ids.size() == 1 ? fmt::format("unit {}", ids.front()) : fmt::format("{} units, ids {}", ids.size(), ids_text(ids, " to "));
  std::cout << fmt::format("{:<20}{}  ({}, dialect {}, motors {})\n", "port", path, units, static_cast<int>(dialect),
                           motors_text(emulation))
            << fmt::format("{:<20}vsa ping {}\n", "talk to it", shell_word(path))
            << fmt::format("{:<20}vsa set {} active on --id {}\n", "", shell_word(path), ids.front())
            << fmt::format("{:<20}Ctrl-C\n", "end it") << std::flush;
  if (!antagonists)
    std::cerr << fmt::format("warning: {}: its references aren't equilibrium ± preset; use vsa set {} inputs …\n", o.type,
                             shell_word(path));
}

}  // namespace

int run_emulate(const EmulateOptions& options) {
  check(options);
  std::vector<device::EmulatedUnit> units = units_of(options);
  std::optional<UnitMemory> memory;
  if (!options.memory.empty()) {
    memory.emplace(options.memory, options.type, units.size());
    for (std::size_t i = 0; i < memory->pages().size(); ++i) units[i].pages = memory->pages()[i];
    if (!memory->pages().empty()) tell_left_out(options, units.front().config.memory);
    for (const Problem& notice : memory->notices()) std::cerr << "warning: " << notice.text() << '\n';
  }
  const bus::Dialect dialect = units.front().config.program.dialect;
  device::Emulation emulation(units);
  break_units(options, emulation);
  if (options.any_rate) emulation.line().take_any_rate();
  std::optional<serial::ProcessorsAwake> awake;
  if (options.low_latency) awake.emplace();
  catch_interrupts();
  int signal = 0;
  bool kept = true;
  {
    const serial::VirtualPort port(emulation.line(), {serial::port_path(options.port.empty() ? options.type : options.port)});
    introduce(options, emulation, port.path(), dialect, elastic::antagonistic(*units.front().config.actuator.transmission));
    Runner runner(emulation, port, options.duration_s, memory ? &*memory : nullptr);
    signal = runner.run();
    kept = runner.kept();
    std::cout << fmt::format("{:<20}{:.3f} s in {:.3f} s of wall time\n", "simulated time", runner.simulated_s(), runner.wall_s())
              << port_report(port.counters(), emulation.line().lost(), emulation.line().wrong_rate().bytes);
  }
  if (!kept) return kFailed;
  return signal != 0 && options.duration_s ? kSignalled + signal : kDone;
}

void setup_emulate(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<EmulateOptions>();
  CLI::App* sub = app.add_subcommand("emulate", "Units on a virtual serial port, without a robot, in real time");
  sub->add_option("TYPE", options->type, "Actuator type; vsa actuators lists them")->required();
  sub->add_option("--units", options->units, "How many, on one line")->capture_default_str()->check(number_given());
  sub->add_option("--first-id", options->first_id, "Id of the first; the others follow")
      ->capture_default_str()
      ->check(number_given());
  sub->add_option("--port", options->port, "The port's path or name; default: vsa-TYPE");
  sub->add_option("--dialect", options->dialect, "Of the firmware; default: the type's")->check(CLI::IsMember({6, 7}));
  auto* active = sub->add_flag("--active", options->active, "Motors on from the start, as the unit's start-up activation does");
  sub->add_option("--memory", options->memory, "Keep what the units store in this file, and begin with what is there")
      ->excludes(active);
  sub->add_flag("--held", options->held, "Shafts are held instead of free");
  sub->add_flag("--any-rate", options->any_rate, "Hear clients whatever rate their port is set to; for those that can't set one");
  sub->add_flag("--low-latency", options->low_latency, kLowLatencyHelp);
  sub->add_option("--set", options->set, "Override a parameter of the type: key=value")->allow_extra_args(false);
  sub->add_option("--duration-s", options->duration_s, "Seconds to run; default: until Ctrl-C")->check(number_given());
  sub->add_option("--fault", options->faults, "Break something: \"IDS FAULT …\", such as \"2 off\", or \"all FAULT …\"")
      ->allow_extra_args(false);
  sub->footer(kEmulateNotes + std::string(kFaultsHelp));
  sub->callback([options, &exit_code] { exit_code = run_emulate(*options); });
}

}  // namespace vsa::app
