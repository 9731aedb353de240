// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/serial/processors_awake.hpp"

#include <fstream>

#include "support.hpp"
#include "vsa/errors.hpp"

namespace vsa::serial::test {
namespace {

TEST(ProcessorsAwake, AsksForNoLatencyAtAll) {
  const Scratch scratch;
  const std::string device = scratch / "latency";
  std::ofstream(device) << "";
  {
    const ProcessorsAwake awake(device);
    std::ifstream file(device, std::ios::binary);
    const std::string wish{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(wish, std::string(4, '\0'));
  }
}

TEST(ProcessorsAwake, SaysWhichFileItCannotHave) {
  try {
    const ProcessorsAwake awake("/nowhere/latency");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/latency"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace vsa::serial::test
