// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/config/faults_text.hpp"

#include <gtest/gtest.h>

#include "vsa/errors.hpp"

namespace vsa::config {
namespace {

std::string refusal(std::string_view words) {
  try {
    (void)read_faults(words, "--fault");
  } catch (const InputError& error) {
    return error.what();
  }
  return "taken";
}

TEST(FaultsText, EveryFaultIsReadAndWrittenBack) {
  const std::string text =
      "off lost_byte=0.01 flipped_byte=0.02 late_s=0.005 stuck=motor_2 stuck=shaft noise_rad=0.1 supply_V=7.5 unplugged=1 seed=9";
  const device::Faults f = read_faults(text, "");
  EXPECT_FALSE(f.powered);
  EXPECT_EQ(f.lost_byte, 0.01);
  EXPECT_EQ(f.flipped_byte, 0.02);
  EXPECT_EQ(f.late_s, 0.005);
  EXPECT_FALSE(f.encoder[0].stuck);
  EXPECT_TRUE(f.encoder[1].stuck && f.encoder[2].stuck);
  for (const auto& e : f.encoder) EXPECT_EQ(e.noise_rad, 0.1);
  EXPECT_EQ(f.supply_V, 7.5);
  EXPECT_TRUE(f.motor_unplugged[0] && !f.motor_unplugged[1]);
  EXPECT_EQ(f.seed, 9U);
  EXPECT_EQ(faults_text(f), text);
  EXPECT_EQ(read_faults(" none\t", ""), device::Faults{});
  EXPECT_EQ(faults_text(device::Faults{}), "none");
}

TEST(FaultsText, WhatIsWrongIsNamedAllAtOnce) {
  const std::string all = refusal("of late_s=soon stuck=elbow unplugged=3 seed=-1 supply_V lost_byte=1.5");
  for (const char* part :
       {"of", "late_s=soon", "stuck=elbow", "motor_1, motor_2, shaft", "unplugged=3", "seed=-1", "supply_V", "1.5"})
    EXPECT_NE(all.find(part), std::string::npos) << part << "\n" << all;
  EXPECT_NE(refusal(""), "taken");
  EXPECT_NE(refusal("supply_V=5 supply_V=7").find("is given twice"), std::string::npos);
  EXPECT_EQ(refusal("stuck=motor_1 stuck=shaft"), "taken");
  EXPECT_NE(refusal("noise_rad=nan"), "taken");
  EXPECT_NE(refusal(std::string_view("supply_V=7\0", 11)), "taken");
}

}  // namespace
}  // namespace vsa::config
