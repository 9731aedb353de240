// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The built command as its users run it: a process with arguments, exit code, two streams and signals.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace vsa::test {

struct Result {
  int exit_code = -1;  ///< 128 + n where signal n ended it
  std::string out, err;
};

struct Surroundings {
  bool terminal = false;                      ///< standard error is a pseudo-terminal, else a pipe
  bool full_stdout = false;                   ///< standard output is /dev/full
  std::optional<std::uint64_t> largest_file;  ///< bytes; a write beyond fails as on a full disk
  std::vector<std::pair<std::string, std::string>> environment;
  std::string program = "vsa";  ///< in the build's bin/, or a path
};

class Subprocess {
 public:
  Subprocess(const std::vector<std::string>& arguments, const Surroundings& surroundings = {});
  ~Subprocess();  ///< kills it if it still runs
  Subprocess(const Subprocess&) = delete;
  Subprocess& operator=(const Subprocess&) = delete;

  /// Reads both streams until the condition holds, the process ends, or the tests' patience does. True: the condition holds.
  bool read_until(const std::function<bool(const Result&)>& condition);
  void send(int signal) const;
  Result wait();  ///< to its end

 private:
  bool read_some(int timeout_ms);  ///< false: both streams ended

  pid_t pid_ = -1;
  int out_ = -1, err_ = -1;
  Result result_;
  bool reaped_ = false;
};

Result run_vsa(const std::vector<std::string>& arguments, const Surroundings& surroundings = {});

/// A directory of this test's own, removed with its content.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

std::string read_file(const std::filesystem::path& file);
void write_file(const std::filesystem::path& file, const std::string& text);

inline constexpr std::chrono::seconds kPatience{300};

}  // namespace vsa::test
