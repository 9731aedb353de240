// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the record button makes: one directory a recording, with CSV files, an MCAP file and a replay page. The page is written by a
// thread of its own when a recording ends, so that the world goes on meanwhile.
#pragma once

#include <filesystem>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "vsa/record/recorder.hpp"
#include "vsa/view/server.hpp"

namespace vsa::view {

class Recordings {
 public:
  Recordings(std::filesystem::path under, std::filesystem::path page_template)
      : under_(std::move(under)), template_(std::move(page_template)) {}

  struct Done {
    std::string name;  ///< "recording-001"
    std::filesystem::path page;
  };

  /// Throws InputError, RecordError.
  void start(const host::Simulation& world);
  void sample(const host::Simulation& world);
  /// The recording is over; what is left of the files and the page are written behind the caller's back. Throws RecordError where
  /// no thread can be had for that.
  void stop(const host::Simulation& world, std::string_view note);
  /// Whether a page was finished or failed since the last call. What failed goes to `problems`.
  bool collect(std::vector<std::string>& problems);
  /// Until every page is written.
  void wait() const;
  [[nodiscard]] std::vector<std::string> writing() const;  ///< names of those that are being written
  [[nodiscard]] bool running() const noexcept { return recorder_.has_value(); }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }  ///< of the one under way or the last
  [[nodiscard]] std::filesystem::path directory() const { return under_ / name_; }

  /// Any thread.
  [[nodiscard]] std::vector<Done> done() const;
  [[nodiscard]] std::optional<Download> get(std::string_view name) const;

 private:
  std::filesystem::path under_, template_;
  std::string name_;
  std::optional<record::Recorder> recorder_;
  struct Ending {
    std::string name;
    std::future<std::filesystem::path> page;
  };
  std::vector<Ending> endings_;  ///< the loop's thread only
  mutable std::mutex mutex_;
  std::vector<Done> done_;  ///< under the mutex
};

}  // namespace vsa::view
