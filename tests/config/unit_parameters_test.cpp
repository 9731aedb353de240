// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A unit's values as people write and read them.
#include "vsa/config/unit_parameters.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace vsa::config {
namespace {

constexpr Resolutions kOneBit{1, 1, 1};

std::vector<std::string> problems_of(const ValueReader& reader) {
  std::vector<std::string> out;
  try {
    reader.throw_if_any();
  } catch (const InputError& error) {
    for (const Problem& p : error.problems()) out.push_back(p.text());
  }
  return out;
}

TEST(UnitParameters, AreThoseOfTheDialect) {
  const auto six = unit_parameter_names(bus::Dialect::six), seven = unit_parameter_names(bus::Dialect::seven);
  const auto has = [](const std::vector<std::string>& names, const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const auto* names : {&six, &seven}) EXPECT_TRUE(has(*names, "position_pid"));
  EXPECT_FALSE(has(six, "rate_limiter"));
  EXPECT_TRUE(has(seven, "rate_limiter"));
  EXPECT_EQ(unit_parameter_named(bus::Dialect::seven, "limits"), bus::ParameterId::limits);
  EXPECT_FALSE(unit_parameter_named(bus::Dialect::six, "rate_limiter"));
  EXPECT_THROW((void)need_unit_parameter(bus::Dialect::six, "rate_limiter", {}), InputError);
}

TEST(UnitParameters, ReadAnglesInDegreesOrTicks) {
  ValueReader reader("offsets", {"10", "10deg", "910ticks"});
  const auto value = std::get<std::array<std::int16_t, 3>>(read_unit_parameter(reader, bus::ParameterId::offsets, kOneBit));
  EXPECT_EQ(value, (std::array<std::int16_t, 3>{910, 910, 910})) << "a turn is 32768 ticks at one bit";
  EXPECT_TRUE(problems_of(reader).empty());
  EXPECT_EQ(angle_text(910, 1), "10.00° (910 ticks)");
}

TEST(UnitParameters, TellAllThatIsWrongWithTheirValues) {
  ValueReader limits("limits", {"100", "-100", "x", "90"});
  (void)read_unit_parameter(limits, bus::ParameterId::limits, kOneBit);
  const auto told = problems_of(limits);
  ASSERT_EQ(told.size(), 2u);
  EXPECT_NE(told[0].find("no angle"), std::string::npos) << told[0];
  EXPECT_NE(told[1].find("above the upper limit"), std::string::npos) << told[1];
  for (const auto& [values, wrong] : {std::pair{std::vector<std::string>{"5", "5"}, "above 0"}, {{"-5", "-5"}, "below 0"}}) {
    ValueReader steps("max_steps", values);
    (void)read_unit_parameter(steps, bus::ParameterId::max_steps, kOneBit);
    const auto problems = problems_of(steps);
    ASSERT_EQ(problems.size(), 1u);
    for (const char* part : {wrong, "lowest ≤ 0, highest ≥ 0"}) EXPECT_NE(problems[0].find(part), std::string::npos) << problems[0];
  }
  ValueReader few("position_pid", {"1"});
  (void)read_unit_parameter(few, bus::ParameterId::position_pid, kOneBit);
  EXPECT_EQ(problems_of(few).size(), 1u);
  ValueReader word("control_mode", {"sideways"});
  (void)read_unit_parameter(word, bus::ParameterId::control_mode, kOneBit);
  EXPECT_NE(problems_of(word).at(0).find("position_current"), std::string::npos) << "all words";
}

TEST(UnitParameters, AreEqualUpToTheUnitsFixedPoint) {
  using Gains = std::array<float, 3>;
  EXPECT_TRUE(same_unit_value(Gains{0.1f, 0, 0.8f}, Gains{0.1f + 1.0f / 65536, 0, 0.8f}));
  EXPECT_FALSE(same_unit_value(Gains{0.1f, 0, 0.8f}, Gains{0.1f + 3.0f / 65536, 0, 0.8f}));
  EXPECT_FALSE(same_unit_value(std::uint8_t{1}, std::uint8_t{2}));
}

}  // namespace
}  // namespace vsa::config
