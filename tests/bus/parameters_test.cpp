// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The parameter list against packets that the public firmware's own function made (tests/bus/data), and the values of a set.
#include "vsa/bus/parameters.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "bus/hex.hpp"

namespace {

using namespace vsa::bus;
using vsa_test::hex;
using vsa_test::unhex;
using Bytes = std::vector<std::uint8_t>;

constexpr Wire kSix{};
constexpr Wire kSeven{Dialect::seven};
constexpr std::uint8_t kId = 7;

Bytes recorded(const std::string& name) {
  std::ifstream file(std::string(VSA_SOURCE_DIR) + "/tests/bus/data/" + name);
  std::stringstream text;
  text << file.rdbuf();
  return unhex(text.str());
}

/// The values in the recorded packets' comments, as the unit turns them to wire values.
ParameterValues recorded_values() {
  ParameterValues v;
  v.id = 7;
  v.position_pid = {6553 / 65536.0F, 0, 52428 / 65536.0F};
  v.current_pid = {5, 0, 0};
  v.resolutions = {1, 1, 1};
  v.offsets = {-150, -50, 50};
  v.multipliers = {1, 1, 1};
  v.limits_on = 1;
  v.limits = {-15000, 15000, -15000, 15000};
  v.max_steps = {-3, 70000};
  v.current_limit = 1500;
  return v;
}

ParameterValues recorded_values_mode3() {
  ParameterValues v = recorded_values();
  v.position_pid = {1000 / 65536.0F, 0, 0};  // the double loop's
  v.current_pid = {0, 0, -500 / 65536.0F};
  v.startup_activation = 3;
  v.input_mode = 1;
  v.control_mode = 3;
  v.limits_on = 0;
  return v;
}

Bytes list(Wire wire, const ParameterValues& v) {
  Bytes out(kMaxListBytes);
  out.resize(encode_parameter_list(wire, kId, v, out));
  return out;
}

TEST(ParameterList, IsByteForByteWhatThePublicFirmwareMakes) {
  for (const auto& [name, values] :
       {std::pair{"parameter_list_mode0.hex", recorded_values()}, std::pair{"parameter_list_mode3.hex", recorded_values_mode3()}}) {
    const Bytes body = recorded(name), ours = list(kSix, values);
    ASSERT_EQ(body.size(), 1201U) << name;
    ASSERT_EQ(ours.size(), 1205U);
    EXPECT_EQ(hex(std::span{ours}.first(4)), "3A 3A 07 B1");
    for (std::size_t i = 0; i < body.size(); ++i) ASSERT_EQ(ours[i + 4], body[i]) << name << " at " << i;
    Bytes whole(ours.begin(), ours.begin() + 4);
    whole.insert(whole.end(), body.begin(), body.end());
    EXPECT_EQ(decode_parameter_list(kSix, whole), values);
  }
}

TEST(ParameterList, ItsChecksumCoversOneHundredSeventySixBytesUnlessRepaired) {
  Bytes bytes = list(kSix, recorded_values());
  EXPECT_EQ(bytes.back(), checksum(std::span{bytes}.subspan(4, 176)));
  const Bytes repaired = list({Dialect::six, false, true}, recorded_values());
  EXPECT_EQ(checksum(std::span{repaired}.subspan(4)), 0);
  EXPECT_EQ(decode_parameter_list(kSix, repaired), recorded_values());
  // An error behind byte 175 isn't seen, one before is.
  bytes[4 + 600] ^= 1;
  EXPECT_TRUE(decode_parameter_list(kSix, bytes).has_value());
  bytes[4 + 100] ^= 1;
  EXPECT_EQ(decode_parameter_list(kSix, bytes), std::nullopt);
}

TEST(ParameterList, DialectSevenCountsUnitsOfThirtyTwoAndHasFifteenSlots) {
  ParameterValues v = recorded_values();
  v.rate_limiter = 2;
  v.serial_number = 0x00980001;
  const Bytes bytes = list(kSeven, v);
  ASSERT_EQ(bytes.size(), 4U + 38U * 32U);
  EXPECT_EQ(hex(std::span{bytes}.first(6)), "3A 3A 07 26 0C 0F");
  EXPECT_EQ(checksum(std::span{bytes}.subspan(4)), 0);
  // Where the public client looks, in its buffer without CMD: count at 50·13 + 2, value behind it.
  const auto buffer = std::span{bytes}.subspan(5);
  EXPECT_EQ(buffer[50 * 13 + 2], 1);
  EXPECT_EQ(buffer[50 * 13 + 3], 2);
  EXPECT_EQ(decode_parameter_list(kSeven, bytes), v);
  EXPECT_EQ(decode_parameter_list(kSix, bytes), std::nullopt);
}

TEST(ParameterList, SlotsCarryTextAndMenu) {
  const Bytes bytes = list(kSix, recorded_values_mode3());
  EXPECT_EQ(read_slot(bytes, 1)->text, "1 - Device ID:");
  EXPECT_EQ(read_slot(bytes, 6)->text, "6 - Control mode: Position and current");
  EXPECT_EQ(read_slot(bytes, 4)->menu, 3);
  EXPECT_EQ(read_slot(bytes, 5)->menu, 1);
  EXPECT_EQ(read_slot(bytes, 6)->menu, 2);
  EXPECT_EQ(read_slot(bytes, 11)->count, 4);
  EXPECT_EQ(read_slot(bytes, 11)->values.size(), 16U);
  EXPECT_EQ(read_slot(bytes, 0), std::nullopt);
  EXPECT_EQ(read_slot(bytes, 14), std::nullopt);
  EXPECT_EQ(read_slot(Bytes{}, 1), std::nullopt);
}

TEST(ParameterList, AFlagWithoutAWordTakesTheLengthOfTheFlagBefore) {
  // The unit's length variable keeps its value when no case matches: 28 of "4 - Startup Activation: YES" and its zero.
  ParameterValues v = recorded_values();
  v.startup_activation = 3;
  v.input_mode = 9;
  const Bytes bytes = list(kSix, v);
  EXPECT_EQ(read_slot(bytes, 5)->text, "5 - Input mode:");
  EXPECT_EQ(bytes[4 + 205 + 28], 1);
}

TEST(ParameterList, EveryTruncationAndRandomBytesAreRefusedOrHarmless) {
  const Bytes whole = list(kSix, recorded_values());
  for (std::size_t n = 0; n < whole.size(); ++n) ASSERT_EQ(decode_parameter_list(kSix, std::span{whole}.first(n)), std::nullopt);
  std::mt19937 random(11);
  for (int t = 0; t < 3000; ++t) {
    Bytes bytes = whole;
    for (int k = 0; k < 20; ++k) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    (void)decode_parameter_list(kSix, bytes);
    for (std::uint16_t i = 0; i < 30; ++i) {
      const auto slot = read_slot(bytes, i);
      ASSERT_LE(slot ? slot->values.size() + slot->text.size() : 0, kSlotBytes);
    }
  }
  Bytes small(1204);
  EXPECT_EQ(encode_parameter_list(kSix, kId, recorded_values(), small), 0U);
}

template <class T>
T any(std::mt19937& random) {
  if constexpr (std::is_same_v<T, float>)
    return static_cast<float>(static_cast<std::int32_t>(random())) / 65536.0F;
  else
    return static_cast<T>(random());
}

ParameterValues any_values(std::mt19937& random) {
  ParameterValues v;
  for (const ParameterInfo& info : parameter_table(Dialect::seven)) {
    ParameterValue value = get(v, info.id);
    std::visit(
        [&random](auto& x) {
          using T = std::decay_t<decltype(x)>;
          if constexpr (std::is_arithmetic_v<T>)
            x = any<T>(random);
          else
            for (auto& e : x) e = any<typename T::value_type>(random);
        },
        value);
    EXPECT_TRUE(put(v, info.id, value));
  }
  return v;
}

TEST(ParameterList, AnyValuesComeBackInBothDialects) {
  std::mt19937 random(12);
  for (int t = 0; t < 2000; ++t) {
    const ParameterValues seven = any_values(random);
    ASSERT_EQ(decode_parameter_list(kSeven, list(kSeven, seven)), seven);
    ParameterValues six = seven;
    six.rate_limiter = 0;
    six.serial_number = 0;
    ASSERT_EQ(decode_parameter_list(kSix, list(kSix, seven)), six);
  }
}

TEST(SetParameterValues, AnyValueComesBackAndAnotherTypeIsRefused) {
  std::mt19937 random(13);
  for (int t = 0; t < 500; ++t) {
    const ParameterValues v = any_values(random);
    for (const ParameterInfo& info : parameter_table(Dialect::seven)) {
      const auto set = encode_value(info.id, get(v, info.id));
      ASSERT_TRUE(set.has_value());
      EXPECT_EQ(set->value_bytes, info.count * value_bytes(info.type));
      EXPECT_EQ(decode_value(Dialect::seven, *set), get(v, info.id));
    }
  }
  EXPECT_EQ(encode_value(ParameterId::id, std::int16_t{3}), std::nullopt);
  EXPECT_EQ(encode_value(ParameterId::limits, std::array<std::int32_t, 2>{}), std::nullopt);
  SetParameter unknown;
  unknown.index = 14;
  EXPECT_EQ(decode_value(Dialect::six, unknown), std::nullopt);
  EXPECT_TRUE(decode_value(Dialect::seven, unknown).has_value());
}

}  // namespace
