// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "unit/port.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <iostream>
#include <string_view>

#include "terminal/exit_codes.hpp"
#include "terminal/numbers.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/serial/ports.hpp"

namespace vsa::app {
namespace {

constexpr unsigned kLastId = 254;

std::optional<unsigned> id_in(std::string_view text) {
  unsigned id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
  if (error != std::errc() || end != text.data() + text.size() || id < 1 || id > kLastId) return std::nullopt;
  return id;
}

UnitPortOptions checked(UnitPortOptions options) {
  if (!(options.timeout_ms > 0 && options.timeout_ms <= 60000)) {
    throw InputError({"", "--timeout-ms", fmt::format("{}", options.timeout_ms), "out of range", "above 0 to 60000 ms"});
  }
  if (options.baud_Hz < 1 || options.baud_Hz > serial::kMostBaud_Hz)
    throw InputError(
        {"", "--baud-Hz", fmt::format("{}", options.baud_Hz), "out of range", fmt::format("1 to {}", serial::kMostBaud_Hz)});
  return options;
}

bus::ClientOptions client_options(const UnitPortOptions& options, bus::Dialect dialect) {
  bus::ClientOptions with;
  with.wire.dialect = dialect;
  with.reply_timeout =
      std::chrono::duration_cast<bus::Channel::Time>(std::chrono::duration<double, std::milli>(options.timeout_ms));
  // Who is patient is patient with a text's first byte and its pauses, too.
  with.slow_timeout = std::max(with.slow_timeout, with.reply_timeout);
  with.silence = std::max(with.silence, with.reply_timeout / 20);
  return with;
}

}  // namespace

void add_port_options(CLI::App& sub, UnitPortOptions& options) {
  sub.add_option("--dialect", options.dialect, "How the units speak; default: as their ping shows")->check(CLI::IsMember({6, 7}));
  sub.add_option("--baud-Hz", options.baud_Hz, "Rate of the port")->capture_default_str()->check(number_given());
  sub.add_option("--timeout-ms", options.timeout_ms, "Time for an answer")->capture_default_str()->check(number_given());
}

std::vector<std::uint8_t> parse_ids(const std::string& text, const std::string& flag) {
  std::vector<std::uint8_t> ids;
  std::string_view left = text;
  while (true) {
    const std::string_view part = left.substr(0, left.find(','));
    const std::size_t dash = part.find('-');
    const auto first = id_in(part.substr(0, dash));
    const auto last = dash == std::string_view::npos ? first : id_in(part.substr(dash + 1));
    if (!first || !last || *first > *last) {
      throw InputError({"", flag, text, "names no units", "ids from 1 to 254, such as 3 or 1-12 or 1,3,5"});
    }
    for (unsigned id = *first; id <= *last; ++id) ids.push_back(static_cast<std::uint8_t>(id));
    if (part.size() == left.size()) return ids;
    left.remove_prefix(part.size() + 1);
  }
}

int for_each_unit(const std::vector<std::uint8_t>& ids, const std::function<void(std::uint8_t)>& each) {
  std::vector<std::string> silent;
  for (const std::uint8_t id : ids) {
    try {
      each(id);
    } catch (const PortGone& error) {
      silent.emplace_back(error.what());
      break;
    } catch (const NoAnswer& error) {
      silent.emplace_back(error.what());
    }
  }
  for (const std::string& text : silent) std::cerr << "vsa: " << text << '\n';
  return silent.empty() ? kDone : kFailed;
}

std::array<Ticks, 2> as_told(std::array<Ticks, 2> has, const bus::ParameterValues& of) {
  constexpr std::uint8_t kPwm = 1, kCurrent = 2;  // control modes whose inputs are no positions
  if (!of.advanced || of.control_mode == kPwm || of.control_mode == kCurrent) return has;
  for (Ticks& t : has) t.value = static_cast<std::int16_t>(-t.value);
  return has;
}

UnitPort::UnitPort(const UnitPortOptions& options)
    : options_(checked(options)), path_(serial::port_path(options.port)), channel_(path_, options.baud_Hz) {}

bus::Client UnitPort::client(bus::Dialect dialect) { return {channel_, client_options(options_, dialect)}; }

bus::Result<bus::Dialect> UnitPort::look_for(std::uint8_t id) {
  constexpr double kMost_ms = 1000;
  UnitPortOptions brief = options_;
  brief.timeout_ms = std::min(brief.timeout_ms, kMost_ms);
  return bus::Client(channel_, client_options(brief, bus::Dialect::six)).dialect(id);
}

bus::Dialect UnitPort::dialect(std::uint8_t id) {
  const bus::Dialect seen = take(client(bus::Dialect::six).dialect(id), id, "a ping");
  if (!options_.dialect) return seen;
  return *options_.dialect == 7 ? bus::Dialect::seven : bus::Dialect::six;
}

void UnitPort::fail(bus::ClientError error, std::uint8_t id, const std::string& what, Wait waited) const {
  if (error == bus::ClientError::closed) throw PortGone(path_ + ": the port is gone");
  std::string text = fmt::format("{}: unit {}, {}: {}", path_, id, what, bus::describe(error));
  const double slow_ms =
      std::chrono::duration<double, std::milli>(client_options(options_, bus::Dialect::six).slow_timeout).count();
  if (error == bus::ClientError::timeout)
    text += fmt::format(" within {} ms (vsa ping {} lists the units)", waited == Wait::slow ? slow_ms : options_.timeout_ms,
                        shell_word(path_));
  throw NoAnswer(text);
}

}  // namespace vsa::app
