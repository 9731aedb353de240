// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "unit/set.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <tuple>

#include "terminal/exit_codes.hpp"
#include "vsa/config/unit_parameters.hpp"
#include "vsa/files.hpp"

namespace vsa::app {
namespace {

constexpr const char* kSetNotes = R"(WHAT and its values; angles in degrees, or in the unit's ticks as 910ticks:
  inputs MOTOR_1 MOTOR_2          references of both motors
  equilibrium EQUILIBRIUM PRESET   the same as equilibrium + preset and equilibrium - preset: of antagonists
  position_stiffness POSITION S   the unit's own command; S in percent of its max stiffness, -100 to 100
  active on|off                   motors on: they hold where they are, until the next references
  PARAMETER VALUE...              named as vsa get PORT parameters shows them; most act only once they are stored
  store                           write the parameters to the unit's memory
  store_defaults                  write them to its page of defaults
  restore                         take that page's parameters, the id too, and store them: nobody can ask for that id
                                  before, and where another unit has it, neither can be told anything any more
  baudrate 460800|2000000         the rate that it listens and answers at, at once and until it is switched off

Examples:
  vsa set qbmove_maker_pro_6_1 active on
  vsa set qbmove_maker_pro_6_1 equilibrium 20 15
  vsa set /dev/ttyUSB0 inputs -910ticks 910ticks --id 3
  vsa set /dev/ttyUSB0 position_pid 0.1 0 0.8 --id 1-12 --store)";

constexpr std::array<std::string_view, 8> kWritable{
    "inputs", "equilibrium", "position_stiffness", "active", "store", "store_defaults", "restore", "baudrate"};
constexpr auto kSettles = std::chrono::seconds(2);  // references show two ticks later, which a busy machine may delay
constexpr std::int32_t kLowest = std::numeric_limits<std::int16_t>::min();
constexpr std::int32_t kHighest = std::numeric_limits<std::int16_t>::max();

/// One unit that is told things.
class Told {
 public:
  Told(UnitPort& port, std::uint8_t id, const SetOptions& options)
      : port_(port), id_(id), options_(options), dialect_(port.dialect(id)), client_(port.client(dialect_)) {}

  /// Reads the values, tells the unit, looks whether it did; says what it has now.
  std::string tell() {
    config::ValueReader reader(options_.what, options_.values);
    if (options_.what == "active") return activate(reader);
    if (options_.what == "inputs" || options_.what == "equilibrium") return references(reader);
    if (options_.what == "position_stiffness") return position_stiffness(reader);
    if (options_.what == "baudrate") return baud_rate(reader);
    if (options_.what == "store" || options_.what == "store_defaults" || options_.what == "restore") {
      reader.expect(0, "vsa set PORT " + options_.what);
      reader.throw_if_any();
      return memory();
    }
    return parameter(reader);
  }

 private:
  std::string activate(config::ValueReader& reader);
  std::string references(config::ValueReader& reader);
  std::string position_stiffness(config::ValueReader& reader);
  std::string baud_rate(config::ValueReader& reader);
  std::string memory();
  std::string parameter(config::ValueReader& reader);
  void check_free(std::uint8_t id) const;
  void warn_of_mode();
  void store();
  /// The list is long, and who only switches motors on needs none of it.
  const bus::ParameterValues& now() {
    if (!now_) now_ = port_.take(client_.parameters(id_), id_, "its parameters", UnitPort::Wait::slow);
    return *now_;
  }
  [[nodiscard]] std::int32_t motor_ticks(config::ValueReader& reader, std::size_t index, std::size_t motor) {
    return reader.ticks(index, now().resolutions[motor], kLowest, kHighest);
  }
  [[nodiscard]] std::string shown(const std::array<Ticks, 2>& has);

  UnitPort& port_;
  std::uint8_t id_;
  const SetOptions& options_;
  bus::Dialect dialect_;
  bus::Client client_;
  std::optional<bus::ParameterValues> now_;
};

std::string Told::shown(const std::array<Ticks, 2>& has) {
  return "references " + config::angles_text({has[0].value, has[1].value}, now().resolutions);
}

/// References are of motors' positions in two of the modes only.
void Told::warn_of_mode() {
  const std::string mode = config::unit_parameter_text(now(), bus::ParameterId::control_mode);
  if (mode == "position" || mode == "position_current") return;
  std::cerr << fmt::format("warning: unit {}: its control_mode is {}: references are no positions of the motors there\n", id_,
                           mode);
}

/// Two units of one id answer at once, and neither can be told anything any more.
void Told::check_free(std::uint8_t id) const {
  if (id == id_) return;
  const auto there = port_.look_for(id);
  if (!there && there.error() == bus::ClientError::timeout) return;
  if (!there && there.error() == bus::ClientError::closed) static_cast<void>(port_.take(there, id, "a ping"));
  throw InputError({"", "id", std::to_string(id), "is that of a unit that answers on " + port_.path() + " already",
                    "an id that nobody has; vsa ping " + shell_word(port_.path()) + " lists them"});
}

std::string Told::activate(config::ValueReader& reader) {
  constexpr std::array<std::string_view, 2> kWords{"off", "on"};
  const bool on = reader.expect(1, "on") && reader.word(0, kWords) == 1;
  reader.throw_if_any();
  static_cast<void>(port_.take(client_.activate(id_, on), id_, "active"));
  const auto end = std::chrono::steady_clock::now() + kSettles;
  while (port_.take(client_.active(id_), id_, "active") != on) {
    if (std::chrono::steady_clock::now() < end) continue;
    throw NoAnswer(fmt::format("{}: unit {}: the motors stay {} (a sensor beyond ±142.8° keeps them off; see vsa get {} --id {})",
                               port_.path(), id_, on ? "off" : "on", shell_word(port_.path()), id_));
  }
  return on ? "motors on" : "motors off";
}

std::string Told::references(config::ValueReader& reader) {
  std::array<Ticks, 2> inputs{};
  if (reader.expect(2, options_.what + " 10 -10")) {
    std::int32_t a = motor_ticks(reader, 0, 0);
    std::int32_t b = motor_ticks(reader, 1, 1);
    reader.throw_if_any();
    // Each motor's sum in its own ticks: their resolutions may differ.
    if (options_.what == "equilibrium") std::tie(a, b) = std::pair(a + motor_ticks(reader, 1, 0), motor_ticks(reader, 0, 1) - b);
    if (std::min(a, b) < kLowest || std::max(a, b) > kHighest) reader.refuse(0, "with the preset out of the unit's range", "less");
    inputs = {Ticks{static_cast<std::int16_t>(a)}, Ticks{static_cast<std::int16_t>(b)}};
  }
  reader.throw_if_any();
  warn_of_mode();
  static_cast<void>(port_.take(client_.set_inputs(id_, inputs), id_, options_.what));
  const auto end = std::chrono::steady_clock::now() + kSettles;
  while (true) {
    const std::array<Ticks, 2> has = as_told(port_.take(client_.inputs(id_), id_, "inputs").inputs, now());
    if (has == inputs) return shown(has);
    if (std::chrono::steady_clock::now() < end) continue;
    throw NoAnswer(
        fmt::format("{}: unit {}: {}: not what was asked for; see its limits and control_mode", port_.path(), id_, shown(has)));
  }
}

std::string Told::position_stiffness(config::ValueReader& reader) {
  std::int32_t position = 0;
  double percent = 0;
  if (reader.expect(2, "position_stiffness 10 50")) {
    position = motor_ticks(reader, 0, 0);
    percent = reader.number(1, -100, 100, " %");
  }
  reader.throw_if_any();
  const double part = std::min(std::round(percent / 100 * 32768), double{kHighest});
  const auto sent =
      client_.set_position_stiffness(id_, Ticks{static_cast<std::int16_t>(position)}, static_cast<std::int16_t>(part));
  static_cast<void>(port_.take(sent, id_, options_.what));
  return fmt::format("position {} with {} % of its max stiffness sent", config::angle_text(position, now().resolutions[0]),
                     percent);
}

/// Nobody answers it: a unit that hears the old rate still didn't take it.
std::string Told::baud_rate(config::ValueReader& reader) {
  constexpr std::array<std::string_view, 2> kRates{"460800", "2000000"};
  const std::string rate = reader.expect(1, "460800") ? std::string(kRates[reader.word(0, kRates)]) : "";
  reader.throw_if_any();
  constexpr std::uint8_t kSlow = 13, kFast = 3;  // divide 6 MHz
  static_cast<void>(port_.take(client_.send(id_, bus::SetBaudRate{rate == kRates[0] ? kSlow : kFast}), id_, options_.what));
  if (rate == std::to_string(options_.port.baud_Hz)) return "listens at " + rate + " bit/s, as before";
  if (port_.look_for(id_))
    throw NoAnswer(fmt::format("{}: unit {}: still answers at {} bit/s", port_.path(), id_, options_.port.baud_Hz));
  return fmt::format("was told to listen at {} bit/s: --baud-Hz {} from now on", rate, rate);
}

std::string Told::memory() {
  if (options_.what == "store") {
    store();
    return "stored";
  }
  const bool restores = options_.what == "restore";
  const bus::Request request = restores ? bus::Request(bus::RestoreDefaults{}) : bus::Request(bus::StoreDefaults{});
  static_cast<void>(port_.take(client_.acknowledge(id_, request), id_, options_.what, UnitPort::Wait::slow));
  if (!restores) return "stored as its defaults, and in force";
  return port_.look_for(id_) ? "has its defaults, stored"
                             : "has its defaults, stored, and with them another id: vsa ping " + shell_word(port_.path()) +
                                   " finds it, unless another unit has that id too: then both answer at once";
}

std::string Told::parameter(config::ValueReader& reader) {
  const bus::ParameterId parameter = config::need_unit_parameter(dialect_, options_.what, kWritable);
  const bus::ParameterValue value = config::read_unit_parameter(reader, parameter, now().resolutions);
  reader.throw_if_any();
  const bool new_id = parameter == bus::ParameterId::id;
  if (new_id) check_free(std::get<std::uint8_t>(value));
  static_cast<void>(port_.take(client_.set_parameter(id_, parameter, value), id_, options_.what));
  if (!options_.store) return options_.what + " sent; most parameters act, and are kept, once they are stored (vsa set PORT store)";
  // A new id is in force at once in dialect seven, in six from the store on, which the old one answers.
  if (new_id && dialect_ == bus::Dialect::seven) id_ = std::get<std::uint8_t>(value);
  store();
  if (new_id) id_ = std::get<std::uint8_t>(value);
  // Dialect six doesn't answer a set, so only the list tells; it shows what is in force, after the store.
  now_.reset();
  const std::string text = fmt::format("{} = {}", options_.what, config::unit_parameter_text(now(), parameter));
  if (!config::same_unit_value(bus::get(now(), parameter), value))
    throw NoAnswer(fmt::format("{}: unit {} didn't take it: {}", port_.path(), id_, text));
  return text + ", stored";
}

void Told::store() { static_cast<void>(port_.take(client_.store(id_), id_, "store", UnitPort::Wait::slow)); }

}  // namespace

int run_set(const SetOptions& options) {
  const std::vector<std::uint8_t> ids = parse_ids(options.port.ids);
  if (options.what == "id" && ids.size() > 1) {
    throw InputError({"", "--id", options.port.ids, "several units can't have the same id", "one unit"});
  }
  if (options.what == "restore" && ids.size() > 1)
    throw InputError({"", "--id", options.port.ids, "several units may all have the same id in their defaults", "one unit"});
  if (options.what == "id" && !options.store) {
    throw InputError({"", "--store", "",
                      "is missing: a unit that has a new id and hasn't stored it hears the old one and answers "
                      "with the new one, so that nobody hears it",
                      "--store"});
  }
  config::check_unit_word(options.what, kWritable);
  const bool is_parameter = std::find(kWritable.begin(), kWritable.end(), options.what) == kWritable.end();
  if (options.store && !is_parameter) throw InputError({"", "--store", options.what, "is no parameter", "with a parameter only"});
  UnitPort port(options.port);
  const int code = for_each_unit(
      ids, [&](std::uint8_t id) { std::cout << fmt::format("unit {}: {}\n", id, Told(port, id, options).tell()) << std::flush; });
  return code;
}

void setup_set(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SetOptions>();
  CLI::App* sub = app.add_subcommand("set", "Command units on a serial port, virtual or real, or set their parameters");
  sub->add_option("PORT", options->port.port, "A port's path, or a virtual port's name")->required();
  sub->add_option("WHAT", options->what, "What to set, see below")->required();
  sub->add_option("VALUE", options->values, "Its values");
  sub->add_option("--id", options->port.ids, "Units, such as 3 or 1-12 or 1,3,5")->capture_default_str();
  sub->add_flag("--store", options->store, "Then write the parameters to the unit's memory");
  add_port_options(*sub, options->port);
  sub->footer(kSetNotes);
  sub->callback([options, &exit_code] { exit_code = run_set(*options); });
}

}  // namespace vsa::app
