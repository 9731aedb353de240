// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "transport_test.hpp"

namespace vsa::test {
namespace {

/// A partition and a discovery of this process's own, before the first node exists: tests of several builds may run side by side,
/// and a process would else hear of, and connect to, what those of other partitions serve.
class OwnPartition : public testing::Environment {
 public:
  void SetUp() override {
    setenv("IGN_PARTITION", ("vsa_test_" + std::to_string(getpid())).c_str(), 1);
    const int port = 20'000 + 2 * (getpid() % 6'000);
    setenv("IGN_DISCOVERY_MSG_PORT", std::to_string(port).c_str(), 1);
    setenv("IGN_DISCOVERY_SRV_PORT", std::to_string(port + 1).c_str(), 1);
    unsetenv("IGN_IP");
  }
};

[[maybe_unused]] const testing::Environment* const kOwnPartition = testing::AddGlobalTestEnvironment(new OwnPartition);

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
