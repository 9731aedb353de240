// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/serial/serial_channel.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "serial/descriptor.hpp"
#include "serial/refuse.hpp"
#include "serial/terminal.hpp"
#include "vsa/errors.hpp"
#include "vsa/serial/ports.hpp"

namespace vsa::serial {
namespace {

using Time = bus::Channel::Time;
constexpr Time kWritePatience = std::chrono::seconds(1);

Descriptor open_port(const std::string& path) {
  if (is_left_behind(path)) refuse(path, "nobody serves this port any more: its owner was killed", "a port that is served");
  Descriptor fd(open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (fd) return fd;
  if (errno == EBUSY) refuse(path, "another program has it open for itself", "a free port, or end that program first");
  if (errno == ENOENT) refuse(path, "no such port", "a port that exists");
  refuse(path, std::string("can't be opened: ") + std::strerror(errno), "a serial port that may be read and written");
}

/// Waits for `events`. Negative: an error; 0: time is up.
int wait_for(int fd, short events, Time timeout) {
  const Time end = std::chrono::steady_clock::now().time_since_epoch() + timeout;
  while (true) {
    const Time left = std::max(Time::zero(), Time(end - std::chrono::steady_clock::now().time_since_epoch()));
    const timespec for_time{left.count() / 1'000'000'000, left.count() % 1'000'000'000};
    pollfd port{fd, events, 0};
    const int ready = ppoll(&port, 1, &for_time, nullptr);
    if (ready >= 0 || errno != EINTR) return ready;
  }
}

}  // namespace

SerialChannel::SerialChannel(const std::string& path, std::int64_t baud_Hz) {
  if (baud_Hz < 1 || baud_Hz > kMostBaud_Hz)
    throw InputError({path, "baud_Hz", std::to_string(baud_Hz), "out of range", "1 to " + std::to_string(kMostBaud_Hz)});
  Descriptor fd = open_port(path);
  if (isatty(fd.get()) == 0) refuse(path, "is no serial port", "such as /dev/ttyUSB0, or what vsa emulate prints");
  if (flock(fd.get(), LOCK_EX | LOCK_NB) != 0) {
    refuse(path, "another program talks on it", "a free port, or end that program first");
  }
  if (!make_raw(fd.get())) refuse(path, std::string("can't be set up: ") + std::strerror(errno), "a serial port");
  if (!set_baud(fd.get(), baud_Hz)) refuse(path, "can't do " + std::to_string(baud_Hz) + " baud", "a port that can");
  ioctl(fd.get(), TIOCEXCL);  // where the system has it; flock is what our own programs go by
  tcflush(fd.get(), TCIFLUSH);
  fd_ = fd.release();
}

SerialChannel::~SerialChannel() {
  ioctl(fd_, TIOCNXCL);
  flock(fd_, LOCK_UN);
  close(fd_);
}

bool SerialChannel::write(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd_, bytes.data(), bytes.size());
    if (n > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(n));
    } else if (n < 0 && errno == EINTR) {
      continue;
    } else if (n == 0 || errno != EAGAIN || wait_for(fd_, POLLOUT, kWritePatience) <= 0) {
      return false;
    }
  }
  return true;
}

std::optional<std::size_t> SerialChannel::read(std::span<std::uint8_t> into, Time timeout) {
  const int ready = wait_for(fd_, POLLIN, timeout);
  if (ready < 0) return std::nullopt;
  if (ready == 0) return 0;
  const ssize_t n = ::read(fd_, into.data(), into.size());
  if (n > 0) return static_cast<std::size_t>(n);
  if (n < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
  return std::nullopt;
}

Time SerialChannel::now() const { return std::chrono::steady_clock::now().time_since_epoch(); }

}  // namespace vsa::serial
