// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "recordings.hpp"

#include <fmt/format.h>

#include <chrono>
#include <system_error>

#include "vsa/files.hpp"

namespace vsa::view {
namespace {

namespace fs = std::filesystem;
constexpr int kNumbersTried = 10'000;

std::string free_name(const fs::path& under) {
  for (int n = 1; n < kNumbersTried; ++n) {
    std::string name = fmt::format("recording-{:03}", n);
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(under / name, ignored))) return name;
  }
  throw record::RecordError(under.string() + ": too many recordings");
}

}  // namespace

void Recordings::start(const host::Simulation& world) {
  name_ = free_name(under_);
  record::RecorderOptions options;
  options.page_template = template_;
  recorder_.emplace(world, under_ / name_, options);
}

void Recordings::sample(const host::Simulation& world) {
  if (recorder_) recorder_->sample(world);
}

void Recordings::stop(const host::Simulation& world, std::string_view note) {
  if (!recorder_) return;
  const std::vector<record::Statistic> summary{{"until", fmt::format("{:.2f} s", world.time_s())}};
  auto write = [given = std::move(*recorder_), summary, why = std::string(note)]() mutable {
    record::Recorder recorder = std::move(given);  // its memory goes with this thread
    return recorder.finish(summary, why);
  };
  recorder_.reset();
  try {
    endings_.push_back({name_, std::async(std::launch::async, std::move(write))});
  } catch (const std::system_error& error) {
    throw record::RecordError((under_ / name_).string() + ": no thread to write the page: " + error.what());
  }
}

bool Recordings::collect(std::vector<std::string>& problems) {
  const std::size_t before = endings_.size();
  for (std::size_t i = 0; i < endings_.size();) {
    Ending& ending = endings_[i];
    if (ending.page.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
      ++i;
      continue;
    }
    try {
      const fs::path page = ending.page.get();
      const std::lock_guard lock(mutex_);
      done_.push_back({ending.name, page});
    } catch (const std::exception& error) {  // a full disk, no memory, no thread
      problems.push_back(ending.name + ": " + error.what());
    }
    endings_.erase(endings_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return endings_.size() != before;
}

void Recordings::wait() const {
  for (const Ending& ending : endings_) ending.page.wait();
}

std::vector<std::string> Recordings::writing() const {
  std::vector<std::string> names;
  for (const Ending& ending : endings_) names.push_back(ending.name);
  return names;
}

std::vector<Recordings::Done> Recordings::done() const {
  const std::lock_guard lock(mutex_);
  return done_;
}

std::optional<Download> Recordings::get(std::string_view name) const {
  for (const Done& one : done()) {
    if (one.name != name) continue;
    auto page = read_file(one.page);
    if (!page) return std::nullopt;
    return Download{"text/html", one.name + ".html", std::move(*page)};
  }
  return std::nullopt;
}

}  // namespace vsa::view
