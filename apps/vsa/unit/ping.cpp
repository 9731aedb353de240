// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "unit/ping.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>
#include <numeric>

#include "terminal/exit_codes.hpp"
#include "terminal/table.hpp"
#include "vsa/errors.hpp"
#include "vsa/serial/ports.hpp"

namespace vsa::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kScan_ms = 5;

constexpr const char* kPingNotes =
    R"(Without PORT the only virtual port that runs is taken. Devices such as /dev/ttyUSB0 are listed, never tried unasked:
they may be anything. Without --id and --timeout-ms each of the 254 has 5 ms for its answer.

Examples:
  vsa ping
  vsa ping /tmp/vsa-qbmove_maker_pro_6_1
  vsa ping /dev/ttyUSB0 --id 1-12)";

/// The one virtual port there is. Throws InputError with what could be meant.
std::string only_port() {
  const serial::PortList found = serial::find_ports();
  if (found.virtual_ports.size() == 1) return found.virtual_ports.front();
  std::vector<std::string> all = found.virtual_ports;
  all.insert(all.end(), found.devices.begin(), found.devices.end());
  const std::string choice = all.empty() ? "a port's path; vsa emulate makes one" : fmt::format("{}", fmt::join(all, ", "));
  throw InputError(
      {"", "PORT", "", found.virtual_ports.empty() ? "no virtual port runs" : "several virtual ports run; say which", choice});
}

std::vector<std::uint8_t> all_ids() {
  std::vector<std::uint8_t> ids(254);
  std::iota(ids.begin(), ids.end(), std::uint8_t{1});
  return ids;
}

std::vector<std::string> row(std::uint8_t id, bus::Dialect dialect, const bus::PingReply& reply, Clock::duration took) {
  const bool seven = dialect == bus::Dialect::seven;
  return {std::to_string(id), seven ? "7" : "6", fmt::format("{:.2f} ms", std::chrono::duration<double, std::milli>(took).count()),
          seven ? std::to_string(reply.serial_number) : "–"};
}

}  // namespace

int run_ping(UnitPortOptions options) {
  const bool scan = options.ids.empty();
  const std::vector<std::uint8_t> ids = scan ? all_ids() : parse_ids(options.ids);
  if (options.port.empty()) options.port = only_port();
  UnitPort port(options);
  std::vector<std::vector<std::string>> rows{{"unit", "dialect", "answered in", "serial number"}};
  std::vector<int> silent;
  for (const std::uint8_t id : ids) {
    auto dialect = port.client(bus::Dialect::six).dialect(id);
    if (dialect && options.dialect) dialect = *options.dialect == 7 ? bus::Dialect::seven : bus::Dialect::six;
    if (!dialect && dialect.error() != bus::ClientError::timeout) static_cast<void>(port.take(dialect, id, "a ping"));
    const auto before = Clock::now();
    const auto reply = dialect ? port.client(*dialect).ping(id) : bus::Result<bus::PingReply>(dialect.error());
    if (reply)
      rows.push_back(row(id, *dialect, *reply, Clock::now() - before));
    else if (!scan)
      silent.push_back(id);
  }
  if (rows.size() > 1) std::cout << port.path() << '\n' << table_text(rows, terminal_width());
  std::cout.flush();
  if (!silent.empty()) std::cerr << fmt::format("vsa: {}: no answer from unit {}\n", port.path(), fmt::join(silent, ", "));
  if (scan && rows.size() == 1) std::cerr << fmt::format("vsa: {}: no unit answers\n", port.path());
  return silent.empty() && rows.size() > 1 ? kDone : kFailed;
}

void setup_ping(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<UnitPortOptions>();
  options->ids.clear();
  CLI::App* sub = app.add_subcommand("ping", "Which units answer on a serial port, virtual or real");
  sub->add_option("PORT", options->port, "A port's path, or a virtual port's name");
  sub->add_option("--id", options->ids, "Units, such as 3 or 1-12 or 1,3,5; default: all, 1 to 254");
  add_port_options(*sub, *options);
  sub->footer(kPingNotes);
  sub->callback([options, sub, &exit_code] {
    if (options->ids.empty() && sub->count("--timeout-ms") == 0) options->timeout_ms = kScan_ms;
    exit_code = run_ping(*options);
  });
}

}  // namespace vsa::app
