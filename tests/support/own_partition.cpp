// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// For test programs that talk by topics, or run programs that do.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace vsa::test {
namespace {

/// A partition and a discovery of this process's own, before the first node exists. Whoever runs a robot beside the tests would else
/// command theirs, and they his; and a process would hear of, and connect to, what those of other partitions serve.
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

}  // namespace
}  // namespace vsa::test
