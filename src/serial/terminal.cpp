// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The kernel's own termios2, because the C library's termios knows only a list of rates. The two headers don't go together in one
// file.
#include "serial/terminal.hpp"

#include <asm/termbits.h>
#include <sys/ioctl.h>

#include <cstdlib>

namespace vsa::serial {

bool make_raw(int fd) noexcept {
  termios2 t{};
  if (ioctl(fd, TCGETS2, &t) != 0) return false;
  t.c_iflag = 0;
  t.c_oflag = 0;
  t.c_lflag = 0;
  t.c_cflag &= ~static_cast<tcflag_t>(CSIZE | PARENB | CSTOPB | CRTSCTS);
  t.c_cflag |= CS8 | CREAD | CLOCAL;
  t.c_cc[VMIN] = 1;
  t.c_cc[VTIME] = 0;
  return ioctl(fd, TCSETS2, &t) == 0;
}

bool is_raw(int fd) noexcept {
  termios2 t{};
  constexpr tcflag_t kFrame = CSIZE | PARENB | CSTOPB | CRTSCTS | CREAD | CLOCAL;
  return ioctl(fd, TCGETS2, &t) == 0 && t.c_iflag == 0 && t.c_oflag == 0 && t.c_lflag == 0 &&
         (t.c_cflag & kFrame) == (CS8 | CREAD | CLOCAL);
}

std::int64_t baud_of(int fd) noexcept {
  termios2 t{};
  return ioctl(fd, TCGETS2, &t) == 0 ? static_cast<std::int64_t>(t.c_ospeed) : 0;
}

bool set_baud(int fd, std::int64_t baud_Hz) noexcept {
  termios2 t{};
  if (ioctl(fd, TCGETS2, &t) != 0) return false;
  t.c_cflag &= ~static_cast<tcflag_t>(CBAUD | (CBAUD << IBSHIFT));
  t.c_cflag |= BOTHER | (BOTHER << IBSHIFT);
  t.c_ispeed = t.c_ospeed = static_cast<speed_t>(baud_Hz);
  if (ioctl(fd, TCSETS2, &t) != 0 || ioctl(fd, TCGETS2, &t) != 0) return false;
  return std::llabs(static_cast<long long>(t.c_ospeed) - baud_Hz) * 40 <= baud_Hz;
}

}  // namespace vsa::serial
