// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Makes threads late, at random: preloaded (LD_PRELOAD) into a program, it lets calls of the C library by which threads and programs meet
// sleep before or after. What is done in the wrong order for another thread to see then fails once in tens of runs, where a busy machine
// shows it once in thousands.
//
// VSA_LATE_IN: only programs whose file is below this folder; unset: all. VSA_LATE_SEED: another pattern, 1 unless given.
#include <dlfcn.h>
#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace {

/// A thread has slow turns, one in kSlowTurns: there every second call is late by up to kMost_ns. Threads that are all late alike seldom
/// meet in another order; of one that is late alone others see what it has done so far.
constexpr std::uint64_t kTurn_ns = 16'000'000, kSlowTurns = 3, kMost_ns = 6'000'000;

bool g_on = false;
std::uint64_t g_seed = 1;
thread_local std::uint64_t t_id = 0, t_calls = 0;

/// splitmix64's mix (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
std::uint64_t mixed(std::uint64_t z) noexcept {
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31U);
}

/// Straight to the kernel: a signal's handler may come here, too.
void maybe_late() noexcept {
  if (!g_on) return;
  if (t_id == 0) t_id = mixed((g_seed << 32U) + static_cast<std::uint64_t>(syscall(SYS_gettid)));
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::uint64_t turn =
      (static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000U + static_cast<std::uint64_t>(now.tv_nsec)) / kTurn_ns;
  if (mixed(t_id + turn) % kSlowTurns != 0) return;
  const std::uint64_t r = mixed(t_id ^ ++t_calls);
  if (r % 2 != 0) return;
  const int before = errno;
  const timespec pause{0, static_cast<long>((r >> 16U) % kMost_ns)};
  syscall(SYS_nanosleep, &pause, nullptr);
  errno = before;
}

/// The next library's function of this name.
template <class F>
F real(const char* name, F& kept) noexcept {
  if (!kept) kept = reinterpret_cast<F>(dlsym(RTLD_NEXT, name));
  return kept;
}

[[gnu::constructor]] void start() noexcept {
  std::array<char, PATH_MAX> self{};
  const ssize_t n = readlink("/proc/self/exe", self.data(), self.size() - 1);
  const char* in = std::getenv("VSA_LATE_IN");
  const char* seed = std::getenv("VSA_LATE_SEED");
  if (seed != nullptr) g_seed = std::strtoull(seed, nullptr, 10);
  g_on = n > 0 && (in == nullptr || std::strncmp(self.data(), in, std::strlen(in)) == 0);
}

}  // namespace

// NAME(…) as the C library's, late before and after. noexcept or not as its header has it.
// NOLINTBEGIN(bugprone-macro-parentheses): types and lists
#define VSA_LATE(result, name, parameters, arguments, exceptions)               \
  extern "C" [[gnu::visibility("default")]] result name parameters exceptions { \
    static result(*kept) parameters = nullptr;                                  \
    maybe_late();                                                               \
    const result r = real(#name, kept) arguments;                               \
    maybe_late();                                                               \
    return r;                                                                   \
  }
// NOLINTEND(bugprone-macro-parentheses)

VSA_LATE(int, pthread_mutex_lock, (pthread_mutex_t * m), (m), noexcept)
VSA_LATE(int, pthread_mutex_unlock, (pthread_mutex_t * m), (m), noexcept)
VSA_LATE(int, pthread_cond_signal, (pthread_cond_t * c), (c), noexcept)
VSA_LATE(int, pthread_cond_broadcast, (pthread_cond_t * c), (c), noexcept)
VSA_LATE(ssize_t, read, (int fd, void* to, size_t n), (fd, to, n), )
VSA_LATE(ssize_t, write, (int fd, const void* from, size_t n), (fd, from, n), )
VSA_LATE(int, close, (int fd), (fd), )
VSA_LATE(int, poll, (pollfd * fds, nfds_t n, int ms), (fds, n, ms), )
VSA_LATE(int, ppoll, (pollfd * fds, nfds_t n, const timespec* t, const sigset_t* s), (fds, n, t, s), )
VSA_LATE(int, eventfd_write, (int fd, eventfd_t value), (fd, value), )
VSA_LATE(ssize_t, send, (int fd, const void* from, size_t n, int flags), (fd, from, n, flags), )
VSA_LATE(ssize_t, recv, (int fd, void* to, size_t n, int flags), (fd, to, n, flags), )
VSA_LATE(ssize_t, sendmsg, (int fd, const msghdr* m, int flags), (fd, m, flags), )
VSA_LATE(ssize_t, recvmsg, (int fd, msghdr* m, int flags), (fd, m, flags), )
VSA_LATE(int, accept, (int fd, sockaddr* a, socklen_t* n), (fd, a, n), )
VSA_LATE(int, accept4, (int fd, sockaddr* a, socklen_t* n, int flags), (fd, a, n, flags), )
VSA_LATE(int, connect, (int fd, const sockaddr* a, socklen_t n), (fd, a, n), )
VSA_LATE(int, bind, (int fd, const sockaddr* a, socklen_t n), (fd, a, n), noexcept)
VSA_LATE(int, unlink, (const char* path), (path), noexcept)
VSA_LATE(int, rename, (const char* from, const char* to), (from, to), noexcept)
VSA_LATE(int, symlink, (const char* to, const char* path), (to, path), noexcept)
VSA_LATE(int, tcflush, (int fd, int which), (fd, which), noexcept)

extern "C" [[gnu::visibility("default")]] int ioctl(int fd, unsigned long request, ...) noexcept {
  static int (*kept)(int, unsigned long, ...) = nullptr;
  va_list rest;
  va_start(rest, request);
  void* argument = va_arg(rest, void*);
  va_end(rest);
  maybe_late();
  const int r = real("ioctl", kept)(fd, request, argument);
  maybe_late();
  return r;
}
