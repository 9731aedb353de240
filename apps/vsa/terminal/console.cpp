// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "terminal/console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace vsa::app {

std::string progress_text(double now_s, std::optional<double> total_s, double factor) {
  const std::string rate = fmt::format("{:.1f}× real time", factor);
  if (!total_s) return fmt::format("{:.1f} s, {}", now_s, rate);
  constexpr int kWidth = 30;
  const int done = static_cast<int>(std::clamp(now_s / *total_s, 0.0, 1.0) * kWidth);
  return fmt::format("[{:#>{}}{:.>{}}] {:.1f} / {:.1f} s, {}", "", done, "", kWidth - done, now_s, *total_s, rate);
}

Console::Console() : terminal_(isatty(STDERR_FILENO) != 0) {}

Console::~Console() { wipe(); }

void Console::line(const std::string& text) {
  const std::lock_guard lock(mutex_);
  wipe_locked();
  std::fputs(("vsa: " + text + "\n").c_str(), stderr);
}

void Console::progress(double now_s, std::optional<double> total_s, double factor) {
  if (terminal_) status(progress_text(now_s, total_s, factor));
}

void Console::status(const std::string& text) {
  if (!terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  const std::lock_guard lock(mutex_);
  std::fputs(("\r\033[K" + text).c_str(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

void Console::wipe() {
  const std::lock_guard lock(mutex_);
  wipe_locked();
}

void Console::wipe_locked() {
  if (drawn_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

}  // namespace vsa::app
