// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/serial/virtual_port.hpp"

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

#include "serial/port_link.hpp"
#include "serial/terminal_pair.hpp"

namespace vsa::serial {
namespace {

using Clock = bus::SerialLine::Clock;

constexpr std::size_t kReadBytes = 4096;

/// The system tells of a client's closing before it is done with it, which takes a while where many bytes lie there or processors are
/// busy: who seems to be there still is looked for again after so long each.
constexpr std::array<Clock::duration, 5> kLookAgain{std::chrono::milliseconds(1), std::chrono::milliseconds(10),
                                                    std::chrono::milliseconds(100), std::chrono::seconds(1),
                                                    std::chrono::seconds(10)};

/// Written by one thread, read by any: who reads a count finds done what it counts.
template <class T>
class Counter {
 public:
  void add(T n) noexcept { value_.store(value_.load(std::memory_order_relaxed) + n, std::memory_order_release); }
  void at_least(T n) noexcept {
    if (n > value_.load(std::memory_order_relaxed)) value_.store(n, std::memory_order_release);
  }
  [[nodiscard]] T get() const noexcept { return value_.load(std::memory_order_acquire); }

 private:
  std::atomic<T> value_{0};
};

std::int64_t nanoseconds(Clock::duration d) { return std::chrono::duration_cast<std::chrono::nanoseconds>(d).count(); }

timespec until(Clock::time_point when) {
  const std::int64_t ns = std::max<std::int64_t>(0, nanoseconds(when - Clock::now()));
  return {ns / 1'000'000'000, ns % 1'000'000'000};
}

Descriptor make_event() {
  Descriptor event(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!event) throw std::system_error(errno, std::generic_category(), "no event descriptor");
  return event;
}

}  // namespace

class VirtualPort::Server {
 public:
  Server(bus::SerialLine& line, const VirtualPortOptions& options)
      : line_(line), most_held_(options.most_held_bytes), link_(options.path), stop_(make_event()) {
    link_.point_to(pair_.device());
    // Signals are for the program's own threads.
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread_ = std::thread([this] { run(); });
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }
  ~Server() {
    eventfd_write(stop_.get(), 1);
    thread_.join();
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  [[nodiscard]] const std::string& path() const noexcept { return link_.path(); }
  [[nodiscard]] PortCounters counters() const noexcept {
    return {exchanges_.get(),    bytes_in_.get(),         bytes_out_.get(),      bytes_dropped_.get(),
            clients_gone_.get(), longest_exchange_.get(), longest_service_.get()};
  }

 private:
  void run();
  [[nodiscard]] std::optional<std::size_t> receive();
  void exchange(std::span<const std::uint8_t> bytes);
  void send();
  /// `lost`: the port is.
  enum class Clients { there, gone, lost };
  [[nodiscard]] Clients look_for_clients();

  bus::SerialLine& line_;
  std::size_t most_held_;
  PortLink link_;
  TerminalPair pair_;
  Descriptor stop_;
  std::array<std::uint8_t, kReadBytes> input_{};
  std::vector<std::uint8_t> answer_;  // what the terminal hasn't taken yet, and what the line says now
  Counter<std::uint64_t> exchanges_, bytes_in_, bytes_out_, bytes_dropped_, clients_gone_;
  Counter<std::int64_t> longest_exchange_, longest_service_;
  std::thread thread_;
};

void VirtualPort::Server::run() {
  std::size_t looked_again = kLookAgain.size();  // since somebody closed the port
  std::optional<Clock::time_point> look_again;
  while (true) {
    const short to_write = answer_.empty() ? 0 : POLLOUT;
    std::array<pollfd, 3> fds{pollfd{pair_.ours(), static_cast<short>(POLLIN | to_write), 0}, pollfd{stop_.get(), POLLIN, 0},
                              pollfd{pair_.watch(), POLLIN, 0}};
    const auto wake = line_.wake();
    const auto first = wake && look_again ? std::min(*wake, *look_again) : wake ? wake : look_again;
    const timespec timeout = first ? until(*first) : timespec{};
    if (ppoll(fds.data(), fds.size(), first ? &timeout : nullptr, nullptr) < 0 && errno != EINTR) return;
    const auto arrival = Clock::now();
    if (fds[1].revents != 0) return;
    const auto count = receive();
    if (count || (wake && *wake <= arrival)) {
      exchange(std::span{input_}.first(count.value_or(0)));
      send();
      longest_service_.at_least(nanoseconds(Clock::now() - arrival));
    } else if (!answer_.empty()) {
      send();
    }
    const bool left = pair_.somebody_left() || (fds[0].revents & POLLHUP) != 0;
    if (left) looked_again = 0;
    if (!left && !(look_again && *look_again <= arrival)) continue;
    const Clients clients = look_for_clients();
    if (clients == Clients::lost) return;
    look_again.reset();
    if (clients == Clients::there && looked_again < kLookAgain.size()) look_again = Clock::now() + kLookAgain[looked_again++];
  }
}

std::optional<std::size_t> VirtualPort::Server::receive() {
  const ssize_t n = read(pair_.ours(), input_.data(), input_.size());
  if (n <= 0) return std::nullopt;
  bytes_in_.add(static_cast<std::uint64_t>(n));
  return static_cast<std::size_t>(n);
}

void VirtualPort::Server::exchange(std::span<const std::uint8_t> bytes) {
  const auto before = Clock::now();
  line_.set_rate(pair_.clients_baud_Hz());
  line_.exchange(bytes, answer_);
  longest_exchange_.at_least(nanoseconds(Clock::now() - before));
  exchanges_.add(1);
}

void VirtualPort::Server::send() {
  std::size_t sent = 0;
  while (sent < answer_.size()) {
    const ssize_t n = write(pair_.ours(), answer_.data() + sent, answer_.size() - sent);
    if (n <= 0) break;
    sent += static_cast<std::size_t>(n);
  }
  bytes_out_.add(sent);
  answer_.erase(answer_.begin(), answer_.begin() + static_cast<std::ptrdiff_t>(sent));
  if (answer_.size() <= most_held_) return;
  bytes_dropped_.add(answer_.size() - most_held_);
  answer_.resize(most_held_);
}

VirtualPort::Server::Clients VirtualPort::Server::look_for_clients() {
  pair_.let_go();
  // What the last one wrote before it went is on the wire: the units hear it, nobody hears them. Reading needs to come to its end
  // before we can say that nobody came meanwhile, whose request this might be.
  while (pair_.deserted()) {
    const auto count = receive();
    if (!count) break;
    exchange(std::span{input_}.first(*count));
  }
  const bool gone = pair_.deserted();
  const bool held = pair_.take_hold(!gone);
  if (!gone) {
    send();
    return Clients::there;
  }
  answer_.clear();
  if (held) {
    pair_.restore();
  } else {
    try {
      // The old one goes last: until then an opener is told that it is busy.
      TerminalPair fresh;
      link_.point_to(fresh.device());
      pair_ = std::move(fresh);
    } catch (const std::exception&) {
      return Clients::lost;
    }
  }
  // Last: who sees it counted finds the port as new.
  clients_gone_.add(1);
  return Clients::gone;
}

VirtualPort::VirtualPort(bus::SerialLine& line, const VirtualPortOptions& options)
    : server_(std::make_unique<Server>(line, options)) {}
VirtualPort::~VirtualPort() = default;

const std::string& VirtualPort::path() const noexcept { return server_->path(); }
PortCounters VirtualPort::counters() const noexcept { return server_->counters(); }

}  // namespace vsa::serial
