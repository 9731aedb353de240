// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "serial/terminal_pair.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/ioctl.h>
#include <termios.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "serial/terminal.hpp"

namespace vsa::serial {
namespace {

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

}  // namespace

TerminalPair::TerminalPair() : ours_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK)) {
  if (!ours_ || grantpt(ours_.get()) != 0 || unlockpt(ours_.get()) != 0) fail("no pseudo-terminal");
  std::array<char, PATH_MAX> name{};
  if (ptsname_r(ours_.get(), name.data(), name.size()) != 0 || !open_theirs()) fail("no pseudo-terminal");
  device_ = name.data();
  if (!make_raw(theirs_.get())) fail("no raw mode on a pseudo-terminal");
  watch_ = Descriptor(inotify_init1(IN_CLOEXEC | IN_NONBLOCK));
  add_watch();
  if (!watch_ || watch_id_ < 0) fail("can't watch the pseudo-terminal (see fs.inotify.max_user_instances)");
}

bool TerminalPair::open_theirs() noexcept {
  theirs_ = Descriptor(ioctl(ours_.get(), TIOCGPTPEER, O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
  return static_cast<bool>(theirs_);
}

void TerminalPair::add_watch() noexcept { watch_id_ = inotify_add_watch(watch_.get(), device_.c_str(), IN_CLOSE); }

std::int64_t TerminalPair::clients_baud_Hz() const noexcept { return baud_of(ours_.get()); }

bool TerminalPair::somebody_left() const noexcept {
  bool left = false;
  alignas(inotify_event) std::array<char, 4096> events{};
  while (true) {
    const ssize_t n = read(watch_.get(), events.data(), events.size());
    if (n <= 0) return left;
    for (ssize_t at = 0; at < n;) {
      inotify_event event{};
      std::memcpy(&event, events.data() + at, sizeof event);
      left = left || (event.mask & (IN_CLOSE | IN_Q_OVERFLOW)) != 0;
      at += static_cast<ssize_t>(sizeof event) + event.len;
    }
  }
}

void TerminalPair::let_go() noexcept {
  locked_ = 0;
  if (theirs_) {
    ioctl(theirs_.get(), TIOCGEXCL, &locked_);
    ioctl(theirs_.get(), TIOCNXCL);
  }
  // Our own closing must not wake the watch. A client's closing is seen by `deserted` if it came before the new watch, and by the
  // watch if after.
  inotify_rm_watch(watch_.get(), watch_id_);
  theirs_.reset();
  add_watch();
}

bool TerminalPair::deserted() const noexcept {
  pollfd end{ours_.get(), 0, 0};
  poll(&end, 1, 0);
  return (end.revents & POLLHUP) != 0;
}

bool TerminalPair::take_hold(bool clients) noexcept {
  if (!open_theirs()) return false;
  if (clients && locked_ != 0) ioctl(theirs_.get(), TIOCEXCL);
  return true;
}

void TerminalPair::restore() noexcept {
  // What a client left raw stays as it is, as on a real port: one that opens just now may be setting its own.
  if (!is_raw(theirs_.get())) static_cast<void>(make_raw(theirs_.get()));
  tcflush(theirs_.get(), TCIFLUSH);
}

}  // namespace vsa::serial
