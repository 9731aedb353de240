// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A balance that closes says little while its own closures may be anything: what the springs' means and the coupling miss has to stay
// a small part of what moved, and the coupling must not give energy out of nothing.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "vsa/actuator/ledger.hpp"

namespace vsa::test {

/// `part`: the closures' largest share of what moved. A tenth of that may come out of nothing.
inline void expect_small_closures(const actuator::Ledger& ledger, double part) {
  EXPECT_LT(std::abs(ledger.integrator), part * ledger.moved());
  EXPECT_LT(std::abs(ledger.coupling), part * ledger.moved());
  EXPECT_GT(ledger.coupling, -0.1 * part * ledger.moved());
}

}  // namespace vsa::test
