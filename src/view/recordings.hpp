// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the record button makes: one directory a recording, with CSV files and a replay page.
#pragma once

#include <filesystem>
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
  void start(const engine::World& world);
  void sample(const engine::World& world);
  /// Writes the page. Throws RecordError; the recording is over either way.
  void stop(const engine::World& world, std::string_view note);
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
  mutable std::mutex mutex_;
  std::vector<Done> done_;  ///< under the mutex
};

}  // namespace vsa::view
