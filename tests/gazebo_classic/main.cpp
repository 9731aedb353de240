// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "classic_world.hpp"

/// One server for all tests of this program. It isn't shut down: a thread of Gazebo's transport may still read from a connection
/// that the shutdown closes (gazebo-classic issue 1908). Every test has removed its own world before.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  vsa::test::start_server();
  const int failed = RUN_ALL_TESTS();
  std::cout.flush();
  std::fflush(nullptr);
  _exit(failed);
}
