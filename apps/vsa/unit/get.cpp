// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "unit/get.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>

#include "terminal/exit_codes.hpp"
#include "terminal/table.hpp"
#include "vsa/config/unit_parameters.hpp"

namespace vsa::app {
namespace {

constexpr const char* kGetNotes =
    R"(WHAT: measurements, currents, inputs (the references), active, info (the unit's own text), parameters (all, as
they are in force), or one parameter: id, position_pid, current_pid, startup_activation, input_mode, control_mode, resolutions,
offsets, multipliers, limits_on, limits, max_steps, current_limit; dialect 7 also rate_limiter, serial_number.
Without WHAT: active, inputs, measurements, currents.

Examples:
  vsa get /tmp/vsa-qbmove_maker_pro_6_1
  vsa get qbmove_maker_pro_6_1 measurements currents --id 1-12
  vsa get /dev/ttyUSB0 control_mode --id 3)";

using Rows = std::vector<std::vector<std::string>>;

constexpr std::array<std::string_view, 6> kReadable{"measurements", "currents", "inputs", "active", "info", "parameters"};

template <std::size_t N>
std::vector<std::int32_t> values_of(const std::array<Ticks, N>& ticks) {
  std::vector<std::int32_t> values;
  for (const Ticks t : ticks) values.push_back(t.value);
  return values;
}

/// One unit that is asked for things.
class Asked {
 public:
  Asked(UnitPort& port, std::uint8_t id) : port_(port), id_(id), dialect_(port.dialect(id)), client_(port.client(dialect_)) {}

  void append(const std::string& what, Rows& rows) {
    if (what == "parameters") {
      for (const auto& name : config::unit_parameter_names(dialect_)) append(name, rows);
    } else {
      rows.push_back({std::to_string(id_), what, text(what)});
    }
  }

 private:
  std::string text(const std::string& what) {
    if (what == "active") return port_.take(client_.active(id_), id_, what) ? "on" : "off";
    if (what == "info") return port_.take(client_.info(id_), id_, what, UnitPort::Wait::slow);
    if (what == "inputs")
      return config::angles_text(values_of(as_told(port_.take(client_.inputs(id_), id_, what).inputs, parameters())),
                                 parameters().resolutions);
    if (what == "measurements")
      return config::angles_text(values_of(port_.take(client_.measurements(id_), id_, what).positions), parameters().resolutions);
    if (what == "currents") {
      const auto reply = port_.take(client_.currents(id_), id_, what);
      return fmt::format("motor 1 {} mA, motor 2 {} mA", reply.currents_mA[0], reply.currents_mA[1]);
    }
    return config::unit_parameter_text(parameters(), config::need_unit_parameter(dialect_, what, kReadable));
  }

  const bus::ParameterValues& parameters() {
    if (!parameters_) parameters_ = port_.take(client_.parameters(id_), id_, "its parameters", UnitPort::Wait::slow);
    return *parameters_;
  }

  UnitPort& port_;
  std::uint8_t id_;
  bus::Dialect dialect_;
  bus::Client client_;
  std::optional<bus::ParameterValues> parameters_;
};

}  // namespace

int run_get(const GetOptions& options) {
  const std::vector<std::uint8_t> ids = parse_ids(options.port.ids);
  std::vector<std::string> wanted = options.what;
  if (wanted.empty()) wanted = {"active", "inputs", "measurements", "currents"};
  for (const std::string& what : wanted) config::check_unit_word(what, kReadable);
  UnitPort port(options.port);
  Rows rows{{"unit", "what", "value"}};
  const int code = for_each_unit(ids, [&](std::uint8_t id) {
    Asked unit(port, id);
    for (const std::string& what : wanted) unit.append(what, rows);
  });
  if (rows.size() == 1) return code;
  if (std::all_of(wanted.begin(), wanted.end(), [](const auto& w) { return w == "info"; })) {
    for (std::size_t i = 1; i < rows.size(); ++i) std::cout << rows[i][2];
  } else {
    std::cout << table_text(rows, 0);
  }
  return code;
}

void setup_get(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<GetOptions>();
  CLI::App* sub = app.add_subcommand("get", "Read from units on a serial port, virtual or real");
  sub->add_option("PORT", options->port.port, "A port's path, or a virtual port's name")->required();
  sub->add_option("WHAT", options->what, "What to read, see below");
  sub->add_option("--id", options->port.ids, "Units, such as 3 or 1-12 or 1,3,5")->capture_default_str();
  add_port_options(*sub, options->port);
  sub->footer(kGetNotes);
  sub->callback([options, &exit_code] { exit_code = run_get(*options); });
}

}  // namespace vsa::app
