// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "recordings.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

namespace vsa::view {
namespace {

namespace fs = std::filesystem;
constexpr int kNumbersTried = 10'000;

std::string free_name(const fs::path& under) {
  for (int n = 1; n < kNumbersTried; ++n) {
    std::string name = fmt::format("recording-{:03}", n);
    std::error_code ignored;
    if (!fs::exists(under / name, ignored)) return name;
  }
  throw record::RecordError(under.string() + ": too many recordings");
}

}  // namespace

void Recordings::start(const engine::World& world) {
  name_ = free_name(under_);
  record::RecorderOptions options;
  options.page_template = template_;
  recorder_.emplace(world, under_ / name_, options);
}

void Recordings::sample(const engine::World& world) {
  if (recorder_) recorder_->sample(world);
}

void Recordings::stop(const engine::World& world, std::string_view note) {
  std::optional<record::Recorder> ended = std::move(recorder_);
  recorder_.reset();
  if (!ended) return;
  const fs::path page = ended->finish({{"until", fmt::format("{:.2f} s", world.time_s())}}, note);
  const std::lock_guard lock(mutex_);
  done_.push_back({name_, page});
}

std::vector<Recordings::Done> Recordings::done() const {
  const std::lock_guard lock(mutex_);
  return done_;
}

std::optional<Download> Recordings::get(std::string_view name) const {
  for (const Done& one : done()) {
    if (one.name != name) continue;
    std::ifstream in(one.page, std::ios::binary);
    if (!in) return std::nullopt;
    return Download{"text/html", one.name + ".html", std::string(std::istreambuf_iterator<char>(in), {})};
  }
  return std::nullopt;
}

}  // namespace vsa::view
