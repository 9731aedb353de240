// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Lines to put behind a port, clients of the rawest kind, and places for links.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "vsa/bus/codec.hpp"
#include "vsa/bus/serial_line.hpp"
#include "vsa/firmware/program.hpp"

namespace vsa::serial::test {

using Bytes = std::vector<std::uint8_t>;
using Clock = std::chrono::steady_clock;
inline constexpr std::chrono::seconds kPatience{120};

/// Looks again and again. True as soon as it holds.
inline bool eventually(const std::function<bool()>& holds) {
  for (const auto end = Clock::now() + kPatience; Clock::now() < end; std::this_thread::yield())
    if (holds()) return true;
  return holds();
}

/// Says back what it hears.
class Echo final : public bus::SerialLine {
 public:
  void exchange(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& answer) override {
    answer.insert(answer.end(), bytes.begin(), bytes.end());
  }
  void set_rate(std::int64_t baud_Hz) override { rate_Hz = baud_Hz; }
  std::atomic<std::int64_t> rate_Hz{0};  ///< the client's, at its last bytes
  [[nodiscard]] std::optional<Clock::time_point> wake() const override { return std::nullopt; }
};

/// The units' programs alone: no motors, no bus time. A unit ticks when a byte comes.
class Programs final : public bus::SerialLine {
 public:
  explicit Programs(int units, firmware::ProgramParams params = {}) : program_(params) {
    for (int i = 0; i < units; ++i) {
      states_.push_back(program_.fresh(0));
      states_.back().memory.current.id = states_.back().memory.stored.id = static_cast<std::uint8_t>(i + 1);
    }
  }
  void exchange(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& answer) override {
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    for (auto& state : states_) {
      program_.poll(state, ns(now), empty_output());
      keep(now);
      for (const std::uint8_t byte : bytes) {
        program_.receive(state, byte, ns(now), empty_output());
        keep(now);
      }
    }
    for (auto& [due, says] : waiting_) {
      if (due > now) continue;
      answer.insert(answer.end(), says.begin(), says.end());
      says.clear();
    }
    std::erase_if(waiting_, [](const auto& w) { return w.second.empty(); });
  }
  [[nodiscard]] std::optional<Clock::time_point> wake() const override {
    const std::lock_guard lock(mutex_);
    std::optional<Clock::time_point> first;
    for (const auto& [due, says] : waiting_)
      if (!first || due < *first) first = due;
    return first;
  }

 private:
  static std::int64_t ns(Clock::time_point t) { return t.time_since_epoch().count(); }
  firmware::Output& empty_output() {
    out_.clear();
    return out_;
  }
  void keep(Clock::time_point now) {
    for (int i = 0; i < out_.count; ++i) {
      const auto view = out_.view(out_.replies[i]);
      // Short delays are the wire's, which this line doesn't have; a store's stay.
      const std::chrono::nanoseconds delay(out_.replies[i].delay_ns > 10'000'000 ? out_.replies[i].delay_ns : 0);
      waiting_.emplace_back(now + delay, Bytes(view.begin(), view.end()));
    }
  }

  firmware::Program program_;
  std::vector<firmware::ProgramState> states_;
  firmware::Output out_;
  std::vector<std::pair<Clock::time_point, Bytes>> waiting_;
  mutable std::mutex mutex_;
};

/// A client without manners: no lock, no settings.
class RawClient {
 public:
  explicit RawClient(const std::string& path) : fd_(open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {}
  ~RawClient() { leave(); }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;
  void leave() {
    if (fd_ >= 0) close(fd_);
    fd_ = -1;
  }
  [[nodiscard]] int fd() const { return fd_; }
  /// Bytes that the port took at once.
  std::size_t write(const Bytes& bytes) const {
    const ssize_t n = ::write(fd_, bytes.data(), bytes.size());
    return n > 0 ? static_cast<std::size_t>(n) : 0;
  }
  /// Reads until so many bytes are there, or none comes any more.
  [[nodiscard]] Bytes read(std::size_t count, int patience_ms = 30000) const {
    Bytes all;
    std::array<std::uint8_t, 4096> some{};
    while (all.size() < count) {
      pollfd port{fd_, POLLIN, 0};
      if (poll(&port, 1, patience_ms) <= 0) break;
      const ssize_t n = ::read(fd_, some.data(), std::min(some.size(), count - all.size()));
      if (n <= 0) break;
      all.insert(all.end(), some.begin(), some.begin() + n);
    }
    return all;
  }

 private:
  int fd_;
};

class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "vsa_serial_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  [[nodiscard]] bool empty() const { return std::filesystem::is_empty(path_); }

 private:
  std::filesystem::path path_;
};

template <class R>
Bytes request(std::uint8_t id, const R& r) {
  const bus::FrameBytes frame = bus::encode_request({}, id, r);
  return {frame.begin(), frame.end()};
}

/// Without the one that looks.
inline std::set<int> open_descriptors() {
  std::set<int> open_ones;
  for (const auto& each : std::filesystem::directory_iterator("/proc/self/fd"))
    open_ones.insert(std::stoi(each.path().filename().string()));
  std::erase_if(open_ones, [](int fd) { return fcntl(fd, F_GETFD) < 0; });
  return open_ones;
}

}  // namespace vsa::serial::test
