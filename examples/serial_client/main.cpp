// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// serial_client PORT [UNIT]: moves one unit to 10° and back, and prints where it is.
#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "vsa/bus/client.hpp"

namespace {

using namespace std::chrono_literals;

constexpr double kDegreesPerTick = 360.0 / 32768;  // at the default resolution

/// The least that a serial port needs: raw, 2 Mbaud, reads with a time-out.
class Port final : public vsa::bus::Channel {
 public:
  explicit Port(const char* path) : fd_(open(path, O_RDWR | O_NOCTTY)) {
    termios settings{};
    if (tcgetattr(fd_, &settings) != 0) return;
    cfmakeraw(&settings);
    cfsetspeed(&settings, B2000000);
    settings.c_cflag |= CLOCAL | CREAD;
    settings.c_cc[VMIN] = 0;
    settings.c_cc[VTIME] = 0;
    ready_ = tcsetattr(fd_, TCSANOW, &settings) == 0;
  }
  ~Port() override {
    if (fd_ >= 0) close(fd_);
  }
  bool ready() const { return ready_; }

  bool write(std::span<const std::uint8_t> bytes) override {
    return ::write(fd_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
  }
  std::optional<std::size_t> read(std::span<std::uint8_t> into, Time timeout) override {
    pollfd port{fd_, POLLIN, 0};
    if (poll(&port, 1, static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(timeout).count())) == 0) return 0;
    const ssize_t count = (port.revents & POLLHUP) != 0 ? -1 : ::read(fd_, into.data(), into.size());
    if (count < 0) return std::nullopt;
    return static_cast<std::size_t>(count);
  }
  Time now() const override { return std::chrono::steady_clock::now().time_since_epoch(); }

 private:
  int fd_;
  bool ready_ = false;
};

vsa::Ticks ticks(double degrees) { return {static_cast<std::int16_t>(degrees / kDegreesPerTick)}; }

/// Sends the references every 10 ms for a while. False: the unit doesn't answer.
bool hold(vsa::bus::Client& client, Port& port, std::uint8_t unit, double degrees) {
  vsa::bus::Result<vsa::bus::MeasurementsReply> at = vsa::bus::ClientError::timeout;
  for (const auto end = port.now() + 1s; port.now() < end;) {
    if (!client.set_inputs(unit, {ticks(degrees + 10), ticks(degrees - 10)})) return false;
    at = client.measurements(unit);
    if (!at) return false;
    poll(nullptr, 0, 10);
  }
  std::printf("asked for %.0f°: the shaft is at %.1f°\n", degrees, at->positions[2].value * kDegreesPerTick);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fputs("usage: serial_client PORT [UNIT]\n", stderr), 2;
  Port port(argv[1]);
  if (!port.ready()) return std::perror(argv[1]), 2;
  const auto unit = static_cast<std::uint8_t>(argc > 2 ? std::atoi(argv[2]) : 1);
  vsa::bus::Client client(port, {.reply_timeout = 200ms, .attempts = 5});  // a unit needs 4 ms, a busy machine more
  const bool moved =
      client.ping(unit) && client.activate(unit, true) && hold(client, port, unit, 10) && hold(client, port, unit, 0);
  static_cast<void>(client.activate(unit, false));
  if (!moved) std::fprintf(stderr, "unit %d doesn't answer\n", unit);
  return moved ? 0 : 1;
}
