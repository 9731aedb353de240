// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What ping, get and set have in common: a port, the units meant, how they speak.
#pragma once

#include <CLI/App.hpp>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "vsa/bus/client.hpp"
#include "vsa/serial/serial_channel.hpp"

namespace vsa::app {

struct UnitPortOptions {
  std::string port;
  std::string ids = "1";       ///< "1", "1-12", "1,3,5"
  std::optional<int> dialect;  ///< 6 or 7; none: by the unit's ping
  std::int64_t baud_Hz = bus::kDefaultBaud_Hz;
  double timeout_ms = 20;
};

void add_port_options(CLI::App& sub, UnitPortOptions& options);
/// What `each` does with every one of them; who doesn't answer is told at the end, and the exit code says so.
int for_each_unit(const std::vector<std::uint8_t>& ids, const std::function<void(std::uint8_t)>& each);
/// Throws InputError.
[[nodiscard]] std::vector<std::uint8_t> parse_ids(const std::string& text, const std::string& flag = "--id");

/// A unit didn't answer, or not as it should: the command fails (exit code 1).
class NoAnswer : public std::runtime_error {
 public:
  using runtime_error::runtime_error;
};

/// No unit will answer there any more.
class PortGone : public NoAnswer {
 public:
  using NoAnswer::NoAnswer;
};

/// References as they were sent. The advanced unit's program inverts what comes and not what goes, but where a reference is one of
/// deflection or is the third encoder's.
[[nodiscard]] std::array<Ticks, 2> as_told(std::array<Ticks, 2> has, const bus::ParameterValues& of);

class UnitPort {
 public:
  /// Opens the port. Throws InputError.
  explicit UnitPort(const UnitPortOptions& options);

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  /// What the options say, or else what the unit's ping shows. Throws NoAnswer.
  [[nodiscard]] bus::Dialect dialect(std::uint8_t id);
  [[nodiscard]] bus::Client client(bus::Dialect dialect);
  /// A ping of one that hopefully isn't there: nobody waits longer than a second for that.
  [[nodiscard]] bus::Result<bus::Dialect> look_for(std::uint8_t id);
  /// How long an answer may take: --timeout-ms, or what texts, lists and the unit's memory need.
  enum class Wait { brief, slow };
  /// The content, or NoAnswer with unit, port and what was asked.
  template <class T>
  [[nodiscard]] T take(const bus::Result<T>& result, std::uint8_t id, const std::string& what, Wait waited = Wait::brief) const {
    if (!result) fail(result.error(), id, what, waited);
    return *result;
  }

 private:
  [[noreturn]] void fail(bus::ClientError error, std::uint8_t id, const std::string& what, Wait waited) const;

  UnitPortOptions options_;
  std::string path_;
  serial::SerialChannel channel_;
};

}  // namespace vsa::app
