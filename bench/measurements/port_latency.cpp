// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Round trips on a serial port, as a host with all units in one cycle meets them: for every unit SET_INPUTS, then GET_MEASUREMENTS
// and its answer. The clock runs from the request's write to the answer's last byte. Every miss (longer than the host library's
// 4 ms) is shown with the time it came at.
//
//   port_latency PORT [--units 12] [--seconds 600] [--cycle-ms 12]
//
// PORT `bare` is a pseudo-terminal of this program with a thread that answers at once and does nothing else: what the machine
// itself takes.
#include <fcntl.h>
#include <fmt/format.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "vsa/bus/client.hpp"
#include "vsa/bus/codec.hpp"
#include "vsa/errors.hpp"
#include "vsa/serial/ports.hpp"
#include "vsa/serial/serial_channel.hpp"

namespace {

using Clock = std::chrono::steady_clock;
using Micro = std::chrono::duration<double, std::micro>;

constexpr double kMiss_us = 4000;
const std::string kBare = "bare";

/// Answers GET_MEASUREMENTS with zeros.
class BareTerminal {
 public:
  BareTerminal() : fd_(posix_openpt(O_RDWR | O_NOCTTY)) {
    if (fd_ < 0 || grantpt(fd_) != 0 || unlockpt(fd_) != 0) throw std::runtime_error("no pseudo-terminal to be had");
    path_ = ptsname(fd_);
    // Held open, so that a client's end doesn't end it.
    client_end_ = open(path_.c_str(), O_RDWR | O_NOCTTY);
    termios raw{};
    tcgetattr(client_end_, &raw);
    cfmakeraw(&raw);
    tcsetattr(client_end_, TCSANOW, &raw);
    thread_ = std::thread([this] { serve(); });
    thread_.detach();  // until the program ends: it has nothing to put away
  }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  void serve() const {
    std::vector<std::uint8_t> heard;
    std::array<std::uint8_t, 256> chunk{};
    for (ssize_t n = 0; (n = ::read(fd_, chunk.data(), chunk.size())) > 0;) {
      heard.insert(heard.end(), chunk.begin(), chunk.begin() + n);
      const std::size_t length = ask(0).view().size();
      if (heard.size() < length) continue;
      const std::span<const std::uint8_t> last(heard.end() - static_cast<std::ptrdiff_t>(length), heard.end());
      const std::uint8_t id = last[2];
      const auto question = ask(id);
      if (!std::equal(last.begin(), last.end(), question.begin(), question.end())) continue;
      const auto answer = vsa::bus::encode_reply(vsa::bus::Wire{}, id, vsa::bus::MeasurementsReply{});
      if (::write(fd_, answer.view().data(), answer.view().size()) < 0) return;
      heard.clear();
    }
  }
  static vsa::bus::FrameBytes ask(std::uint8_t id) {
    return vsa::bus::encode_request(vsa::bus::Wire{}, id, vsa::bus::GetMeasurements{});
  }

  int fd_, client_end_ = -1;
  std::string path_;
  std::thread thread_;
};

struct Settings {
  std::string port;
  int units = 12;
  double seconds = 600;
  double cycle_ms = 12;
};

Settings read(int argc, char** argv) {
  Settings s;
  if (argc < 2) throw vsa::InputError({"", "PORT", "", "is missing", "port_latency PORT [--units N] [--seconds T] [--cycle-ms T]"});
  s.port = argv[1] == kBare ? kBare : vsa::serial::port_path(argv[1]);
  for (int i = 2; i < argc; i += 2) {
    const std::string flag = argv[i];
    char* end = nullptr;
    const double value = i + 1 < argc ? std::strtod(argv[i + 1], &end) : 0;
    if (end == nullptr || *end != '\0' || !(value > 0)) throw vsa::InputError({"", flag, "", "needs a number above 0", ""});
    if (flag == "--units" && value <= 254)
      s.units = static_cast<int>(value);
    else if (flag == "--seconds")
      s.seconds = value;
    else if (flag == "--cycle-ms")
      s.cycle_ms = value;
    else
      throw vsa::InputError(
          {"", flag, fmt::format("{}", value), "unknown or out of range", "--units 1…254, --seconds, --cycle-ms"});
  }
  return s;
}

struct Measured {
  std::vector<double> trips_us;
  std::map<int, int> no_answer;  ///< by unit
  std::uint64_t cycles = 0, late_cycles = 0, misses = 0;
};

void cycle(vsa::bus::Client& client, const Settings& s, Clock::time_point start, Measured& m) {
  for (int unit = 1; unit <= s.units; ++unit) {
    const auto id = static_cast<std::uint8_t>(unit);
    const auto swing = static_cast<std::int16_t>(500 * ((m.cycles / 50 + static_cast<std::uint64_t>(unit)) % 3));
    static_cast<void>(client.set_inputs(id, {vsa::Ticks{swing}, vsa::Ticks{static_cast<std::int16_t>(-swing)}}));
    const auto before = Clock::now();
    const auto answer = client.measurements(id);
    const double took_us = Micro(Clock::now() - before).count();
    m.trips_us.push_back(took_us);
    if (!answer) ++m.no_answer[unit];
    if (answer && took_us <= kMiss_us) continue;
    ++m.misses;
    std::cout << fmt::format("miss at {:.3f} s: unit {}, {:.2f} ms{}\n", std::chrono::duration<double>(before - start).count(),
                             unit, took_us / 1000, answer ? "" : std::string(", ") + vsa::bus::describe(answer.error()));
  }
  ++m.cycles;
}

void report(Measured m) {
  std::sort(m.trips_us.begin(), m.trips_us.end());
  const auto quantile = [&m](double q) {
    return m.trips_us[std::min(m.trips_us.size() - 1, static_cast<std::size_t>(q * static_cast<double>(m.trips_us.size())))];
  };
  std::cout << fmt::format(
      "{} round trips in {} cycles, {} cycles late; us: p50 {:.0f}, p99 {:.0f}, p99.9 {:.0f}, p99.99 {:.0f}, max {:.0f}\n",
      m.trips_us.size(), m.cycles, m.late_cycles, quantile(0.5), quantile(0.99), quantile(0.999), quantile(0.9999),
      m.trips_us.back());
  std::cout << fmt::format("misses (over 4 ms or no answer): {}\n", m.misses);
  for (const auto& [unit, count] : m.no_answer) std::cout << fmt::format("  unit {}: {} without an answer\n", unit, count);
}

int measure(const Settings& s) {
  std::optional<BareTerminal> bare;
  if (s.port == kBare) bare.emplace();
  vsa::serial::SerialChannel channel(bare ? bare->path() : s.port);
  vsa::bus::Client client(channel, {.reply_timeout = std::chrono::milliseconds(50)});
  for (int unit = 1; unit <= s.units && !bare; ++unit) static_cast<void>(client.activate(static_cast<std::uint8_t>(unit), true));
  const auto start = Clock::now();
  const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double, std::milli>(s.cycle_ms));
  Measured m;
  m.trips_us.reserve(static_cast<std::size_t>(s.seconds * 1000 / s.cycle_ms + 1) * static_cast<std::size_t>(s.units));
  for (auto due = start; std::chrono::duration<double>(due - start).count() < s.seconds; due += period) {
    if (Clock::now() > due + period) {
      ++m.late_cycles;
      due = Clock::now();
    }
    std::this_thread::sleep_until(due);
    cycle(client, s, start, m);
  }
  report(std::move(m));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return measure(read(argc, argv));
  } catch (const vsa::InputError& error) {
    std::cerr << "port_latency: " << error.what() << '\n';
    return 2;
  }
}
