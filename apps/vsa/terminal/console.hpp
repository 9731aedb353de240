// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Standard error as people and pipes want it: a progress line that redraws itself on a terminal, none in a pipe, and whole lines
// that may come from any thread.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>

namespace vsa::app {

class Console {
 public:
  Console();
  ~Console();  ///< wipes the progress line
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void line(const std::string& text);

  /// Redraws at most 10 times a second; on anything but a terminal it does nothing. `total_s` none: the run has no end.
  void progress(double now_s, std::optional<double> total_s, double factor);
  /// The same for any text.
  void status(const std::string& text);
  void wipe();

 private:
  void wipe_locked();

  bool terminal_;
  std::mutex mutex_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point next_{};
};

/// "[#####.....]  5.0 / 10.0 s, 12.3× real time"
[[nodiscard]] std::string progress_text(double now_s, std::optional<double> total_s, double factor);

}  // namespace vsa::app
