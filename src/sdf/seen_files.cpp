// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sdf/seen_files.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>

namespace vsa::reader {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kTick_ns = 50'000'000;        // five of the longest ticks of the kernel's clock
constexpr std::int64_t kCoarse_ns = 2 * kSecond_ns;  // FAT's

bool exists(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

}  // namespace

SeenFiles::Stamp SeenFiles::stamp(const std::string& path) {
  struct stat s {};
  if (::stat(path.c_str(), &s) != 0) return {};
  const auto ns = [](const timespec& t) { return static_cast<std::int64_t>(t.tv_sec) * kSecond_ns + t.tv_nsec; };
  return {true, s.st_dev, s.st_ino, s.st_size, ns(s.st_mtim), ns(s.st_ctim)};
}

bool SeenFiles::is_settled(const Stamp& s) {
  if (!s.there) return true;
  const std::int64_t now_ns =
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch()).count();
  const bool whole_seconds = s.written_ns % kSecond_ns == 0 && s.changed_ns % kSecond_ns == 0;
  return std::max(s.written_ns, s.changed_ns) + (whole_seconds ? kCoarse_ns : kTick_ns) < now_ns;
}

void SeenFiles::reads(const std::filesystem::path& path) {
  const auto [at, first] = read_.try_emplace(path.string());
  if (!first) return;
  at->second = stamp(at->first);
  settled_ = settled_ && is_settled(at->second);
}

bool SeenFiles::asks(const std::filesystem::path& path) {
  const auto [at, first] = asked_.try_emplace(path.string(), false);
  if (first) at->second = exists(at->first);
  return at->second;
}

bool SeenFiles::unchanged() const {
  return std::all_of(read_.begin(), read_.end(), [](const auto& seen) { return stamp(seen.first) == seen.second; }) &&
         std::all_of(asked_.begin(), asked_.end(), [](const auto& seen) { return exists(seen.first) == seen.second; });
}

}  // namespace vsa::reader
