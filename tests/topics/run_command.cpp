// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <memory>

#include "transport_test.hpp"

namespace vsa::test {
namespace {

struct Close {
  int* status;
  void operator()(FILE* pipe) const { *status = pclose(pipe); }
};

}  // namespace

Output run_command(const std::string& command) {
  Output out;
  int status = -1;
  {
    const std::unique_ptr<FILE, Close> pipe(popen(("timeout " + std::to_string(kPatience.count()) + " " + command).c_str(), "r"),
                                            Close{&status});
    std::array<char, 4096> buffer{};
    while (const std::size_t n = pipe ? fread(buffer.data(), 1, buffer.size(), pipe.get()) : 0) out.text.append(buffer.data(), n);
  }
  out.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return out;
}

}  // namespace vsa::test
