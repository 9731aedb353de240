// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sensor/sensors.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace vsa::sensor;

TEST(Encoder, OneCountIsSixteenRaw) {
  const EncoderParams p{12, 0.0};
  const double count = 2 * vsa::kPi / 4096;
  EXPECT_EQ(encoder_sample(p, 0.0), 0);
  EXPECT_EQ(encoder_sample(p, 0.999 * count), 0);
  EXPECT_EQ(encoder_sample(p, 1.001 * count), 16);
  EXPECT_EQ(encoder_sample(p, -0.001 * count), -16);
}

TEST(Encoder, WrapsAtHalfATurn) {
  const EncoderParams p{12, 0.0};
  EXPECT_EQ(encoder_sample(p, vsa::kPi - 1e-6), 32752);
  EXPECT_EQ(encoder_sample(p, vsa::kPi + 1e-6), -32768);
  EXPECT_EQ(encoder_sample(p, 1.0 + 2e6 * vsa::kPi), encoder_sample(p, 1.0));
}

TEST(Encoder, AddsItsZeroAndSurvivesNonsense) {
  EXPECT_EQ(encoder_sample({12, 0.0107}, 0.0), 96);  // six whole counts of 1.534 mrad
  EXPECT_EQ(encoder_sample({12, 0.0}, std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_EQ(encoder_sample({12, 0.0}, std::numeric_limits<double>::infinity()), 0);
}

TEST(AnalogSense, ReadsBackWithinOneCount) {
  for (double amps : {0.0, 0.1, 1.0, 3.0}) EXPECT_NEAR(current_from_adc(current_adc(amps)).value, amps * 1e3, 4.0);
  for (double volts : {0.0, 8.0, 12.0, 24.0}) EXPECT_NEAR(supply_from_adc(supply_adc(volts)).value, volts * 1e3, 16.0);
  EXPECT_EQ(current_adc(1e9), kAdcMax);
  EXPECT_EQ(supply_adc(std::numeric_limits<double>::quiet_NaN()), kAdcMax);
}

TEST(Current, IsSensedWithoutItsDirection) {
  for (const double amperes : {0.01, 1.5, 20.0}) EXPECT_EQ(vsa::sensor::current_adc(-amperes), vsa::sensor::current_adc(amperes));
  EXPECT_GT(vsa::sensor::current_adc(-1.5), vsa::sensor::kAdcOffset);
}

}  // namespace
