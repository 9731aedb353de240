// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "emulate.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "console.hpp"
#include "exit_codes.hpp"
#include "interrupt.hpp"
#include "numbers.hpp"
#include "pace.hpp"
#include "port_report.hpp"
#include "settings.hpp"
#include "unit_port.hpp"
#include "vsa/config/preset.hpp"
#include "vsa/device/emulation.hpp"
#include "vsa/errors.hpp"
#include "vsa/serial/ports.hpp"
#include "vsa/serial/virtual_port.hpp"
#include "vsa/units.hpp"

namespace vsa::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMostId = 254;
constexpr std::int64_t kStepNs = 1'000'000;
constexpr std::uint8_t kMotorsOn = 3;

constexpr const char* kNotes =
    R"(The units run in real time until Ctrl-C, each with a shaft that turns freely. Software for the hardware opens the port's
path as it would a real one; --port NAME is a path if it has a '/', else a name in $XDG_RUNTIME_DIR, or /tmp.

Examples:
  vsa emulate qbmove_maker_pro
  vsa emulate qbmove_maker_pro --units 12 --port arm --active
  vsa emulate qbmove_maker_pro --units 3 --faulty 2 --lost-byte 0.01 --seed 7)";

void check(const EmulateOptions& o) {
  Problems problems;
  if (o.units < 1 || o.first_id < 1 || o.first_id > kMostId || o.units > kMostId + 1 - o.first_id) {
    problems.add({"", "--units, --first-id", fmt::format("{}, {}", o.units, o.first_id), "ids out of range", "ids from 1 to 254"});
  }
  if (o.duration_s && !(*o.duration_s > 0 && *o.duration_s <= 1e8)) {
    problems.add({"", "--duration-s", fmt::format("{}", *o.duration_s), "out of range", "above 0 to 1e8 s"});
  }
  problems.throw_if_any();
}

device::Faults faults_of(const FaultOptions& o) {
  device::Faults f;
  f.powered = !o.off;
  f.lost_byte = o.lost_byte;
  f.flipped_byte = o.flipped_byte;
  f.late_s = o.late_ms * 1e-3;
  constexpr std::array<const char*, 3> kWhere{"motor_1", "motor_2", "shaft"};
  for (std::size_t i = 0; i < f.encoder.size(); ++i) {
    f.encoder[i].stuck = std::find(o.stuck.begin(), o.stuck.end(), kWhere[i]) != o.stuck.end();
    f.encoder[i].noise_rad = o.noise_deg * kPi / 180;
  }
  f.supply_V = o.supply_V;
  for (std::size_t i = 0; i < f.motor_unplugged.size(); ++i)
    f.motor_unplugged[i] = std::find(o.unplugged.begin(), o.unplugged.end(), static_cast<int>(i) + 1) != o.unplugged.end();
  f.seed = o.seed;
  return f;
}

std::vector<device::EmulatedUnit> units_of(const EmulateOptions& o) {
  device::UnitConfig config = config::PresetLibrary().load(o.preset, parse_settings(o.set, "--set")).unit;
  config.program.dialect = o.dialect == 7 ? bus::Dialect::seven : bus::Dialect::six;
  if (o.active) config.memory.startup_activation = kMotorsOn;
  std::vector<device::EmulatedUnit> units(static_cast<std::size_t>(o.units));
  for (std::size_t i = 0; i < units.size(); ++i) {
    units[i].config = config;
    units[i].id = o.first_id + static_cast<int>(i);
    units[i].held = o.held;
  }
  return units;
}

void break_units(const EmulateOptions& o, device::Emulation& emulation) {
  const device::Faults faults = faults_of(o.faults);
  device::Faults none;
  none.seed = faults.seed;
  if (faults == none) {
    if (!o.faults.units.empty()) throw InputError({"", "--faulty", o.faults.units, "without a fault", "a fault, such as --off"});
    return;
  }
  Problems problems;
  const std::string all = fmt::format("{}-{}", o.first_id, o.first_id + o.units - 1);
  for (const std::uint8_t id : parse_ids(o.faults.units.empty() ? all : o.faults.units, "--faulty")) {
    const int index = id - o.first_id;
    if (index < 0 || index >= o.units) {
      problems.add({"", "--faulty", std::to_string(id), "no such unit", all});
      continue;
    }
    device::Faults own = faults;
    own.seed += static_cast<std::uint64_t>(index);  // units have their own luck
    emulation.set_faults(static_cast<std::size_t>(index), own);
  }
  problems.throw_if_any();
}

/// Ticks by the wall clock, and how well that went.
class Runner {
 public:
  Runner(device::Emulation& emulation, const serial::VirtualPort& port, std::optional<double> duration_s)
      : emulation_(emulation), port_(port), duration_s_(duration_s) {}

  /// The signal that ended it, or 0.
  int run() {
    const auto start = Clock::now();
    pace_.anchor(0, start);
    const std::int64_t end_ns = duration_s_ ? std::llround(*duration_s_ * 1e9) : std::numeric_limits<std::int64_t>::max();
    while (interrupted() == 0 && sim_ns_ < end_ns) {
      sim_ns_ += kStepNs;
      emulation_.advance(sim_ns_);
      if (!pace_.hold(sim_ns_)) tell_late();
      constexpr std::int64_t kShow = 100 * kStepNs;
      if (sim_ns_ % kShow == 0) show(Clock::now() - start);
    }
    console_.wipe();
    wall_s_ = std::chrono::duration<double>(Clock::now() - start).count();
    return sim_ns_ < end_ns ? interrupted() : 0;
  }
  [[nodiscard]] double simulated_s() const { return static_cast<double>(sim_ns_) * 1e-9; }
  [[nodiscard]] double wall_s() const { return wall_s_; }

 private:
  void tell_late() {
    if (std::exchange(told_, true)) return;
    console_.line("warning: this machine can't keep up with real time for so many units; simulated time falls behind");
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
  Console console_;
  RealTimePace pace_;
  std::int64_t sim_ns_ = 0;
  double wall_s_ = 0;
  bool told_ = false;
};

void introduce(const EmulateOptions& o, const std::string& path) {
  const std::string ids = o.units == 1 ? fmt::format("unit {}", o.first_id)
                                       : fmt::format("{} units, ids {} to {}", o.units, o.first_id, o.first_id + o.units - 1);
  std::cout << fmt::format("{:<20}{}  ({}, dialect {}, motors {})\n", "port", path, ids, o.dialect, o.active ? "on" : "off")
            << fmt::format("{:<20}vsa ping {}\n", "talk to it", path)
            << fmt::format("{:<20}vsa set {} active on --id {}\n", "", path, o.first_id) << fmt::format("{:<20}Ctrl-C\n", "end it")
            << std::flush;
}

}  // namespace

int run_emulate(const EmulateOptions& options) {
  check(options);
  device::Emulation emulation(units_of(options));
  break_units(options, emulation);
  catch_interrupts();
  int signal = 0;
  {
    const serial::VirtualPort port(emulation.line(), {serial::port_path(options.port.empty() ? options.preset : options.port)});
    introduce(options, port.path());
    Runner runner(emulation, port, options.duration_s);
    signal = runner.run();
    std::cout << fmt::format("{:<20}{:.3f} s in {:.3f} s of wall time\n", "simulated time", runner.simulated_s(), runner.wall_s())
              << port_report(port.counters(), emulation.line().lost());
  }
  if (!std::cout.flush()) return kFailed;
  return signal != 0 && options.duration_s ? kSignalled + signal : kDone;
}

namespace {

void add_faults(CLI::App& sub, FaultOptions& f) {
  constexpr const char* kGroup = "Faults";
  const auto add = [&](const char* name, auto& value, const char* text) {
    return sub.add_option(name, value, text)->group(kGroup)->check(number_given());
  };
  add("--faulty", f.units, "Units that the faults below are on, such as 2 or 1,3-5; default: all");
  sub.add_flag("--off", f.off, "Powered off")->group(kGroup);
  add("--lost-byte", f.lost_byte, "Probability that a byte to or from the unit is lost");
  add("--flipped-byte", f.flipped_byte, "Probability that a bit of a byte is flipped");
  add("--late-ms", f.late_ms, "Answers come so much later");
  add("--stuck", f.stuck, "Encoders that stand still: motor_1, motor_2, shaft")
      ->check(CLI::IsMember({"motor_1", "motor_2", "shaft"}));
  add("--noise-deg", f.noise_deg, "Noise of all encoders, uniform within ± so much");
  add("--supply-V", f.supply_V, "Another supply voltage");
  add("--unplugged", f.unplugged, "Motors that hang open: 1, 2")->check(CLI::IsMember({1, 2}));
  add("--seed", f.seed, "Of what happens by chance; the next unit has the next seed");
}

}  // namespace

void setup_emulate(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<EmulateOptions>();
  CLI::App* sub = app.add_subcommand("emulate", "Units on a virtual serial port, without a robot, in real time");
  sub->add_option("PRESET", options->preset, "Actuator preset; vsa actuators lists them")->required();
  sub->add_option("--units", options->units, "How many, on one line")->capture_default_str()->check(number_given());
  sub->add_option("--first-id", options->first_id, "Id of the first; the others follow")
      ->capture_default_str()
      ->check(number_given());
  sub->add_option("--port", options->port, "The port's path or name; default: vsa-PRESET");
  sub->add_option("--dialect", options->dialect, "Of the firmware")->capture_default_str()->check(CLI::IsMember({6, 7}));
  sub->add_flag("--active", options->active, "Motors on from the start, as the unit's start-up activation does");
  sub->add_flag("--held", options->held, "Shafts are held instead of free");
  sub->add_option("--set", options->set, "Override a parameter of the preset: key=value");
  sub->add_option("--duration-s", options->duration_s, "Seconds to run; default: until Ctrl-C")->check(number_given());
  add_faults(*sub, options->faults);
  sub->footer(kNotes);
  sub->callback([options, &exit_code] { exit_code = run_emulate(*options); });
}

}  // namespace vsa::app
