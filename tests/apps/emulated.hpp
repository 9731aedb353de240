// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Units on a virtual port of a test's own, and what a command said.
#pragma once

#include <gtest/gtest.h>

#include <csignal>
#include <string>
#include <vector>

#include "subprocess.hpp"

namespace vsa::test {

using Arguments = std::vector<std::string>;

/// vsa emulate qbmove_maker_pro_6_1 on a port of its own, which is there.
class Emulated {
 public:
  explicit Emulated(const Arguments& more = {}, const std::string& type = "qbmove_maker_pro_6_1")
      : path((scratch / "port").string()), process_(arguments(path, more, type)) {
    ready = process_.read_until([](const Result& r) { return r.out.find("Ctrl-C") != std::string::npos; });
  }
  Result end(int signal = SIGTERM) {
    process_.send(signal);
    return process_.wait();
  }
  Result vsa(Arguments words, const Arguments& more = {}) const {
    words.insert(words.begin() + 1, path);
    words.insert(words.end(), more.begin(), more.end());
    // The tests' machine may be busy with other things.
    words.insert(words.end(), {"--timeout-ms", "20000"});
    return run_vsa(words);
  }

 private:
  static Arguments arguments(const std::string& path, const Arguments& more, const std::string& type) {
    Arguments all{"emulate", type, "--port", path};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Scratch scratch;

 public:
  std::string path;
  bool ready = false;

 private:
  Subprocess process_;
};

inline void expect(const Result& result, int exit_code, const Arguments& parts) {
  EXPECT_EQ(result.exit_code, exit_code) << result.out << result.err;
  for (const auto& part : parts) {
    EXPECT_NE((result.out + result.err).find(part), std::string::npos) << "no '" << part << "' in:\n" << result.out << result.err;
  }
}

}  // namespace vsa::test
