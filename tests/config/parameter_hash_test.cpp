// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A state file's word on a unit's parameters, tried on every key that a type's file may have.
#include "vsa/device/parameter_hash.hpp"

#include <algorithm>
#include <set>

#include "support.hpp"
#include "vsa/config/schema.hpp"
#include "vsa/config/text.hpp"

namespace vsa::test {
namespace {

using device::parameter_hash;

std::vector<double> values_of(const config::Parameter& p) {
  if (p.kind == config::Kind::toggle) return {0, 1};
  if (p.kind != config::Kind::word) return {p.min, p.max, p.kind == config::Kind::integer ? p.min + 1 : 0.3 * p.min + 0.7 * p.max};
  std::vector<double> places{0};
  for (std::ptrdiff_t k = std::count(p.words.begin(), p.words.end(), '|'); k > 0; --k) places.push_back(static_cast<double>(k));
  return places;
}

TEST(ParameterHash, TellsEveryKeyOfEveryTypeAndNothingElse) {
  std::set<std::string_view> told;
  for (const std::string& name : shipped().names()) {
    const device::UnitConfig unit = shipped().load(name).unit;
    ASSERT_EQ(parameter_hash(unit), parameter_hash(shipped().load(name).unit)) << name << " read twice";
    for (const config::Parameter& p : config::parameters()) {
      if (!config::why_absent(p, unit).empty()) continue;
      for (const double value : values_of(p)) {
        device::UnitConfig other = unit;
        p.apply(other, value);
        const bool same = device::alike(other, unit);
        EXPECT_EQ(parameter_hash(other) == parameter_hash(unit), same) << name << ": " << p.key << " = " << value;
        if (!same) told.insert(p.key);
      }
    }
  }
  for (const config::Parameter& p : config::parameters())
    // A second lead goes into a law of two travels, which no shipped type has.
    EXPECT_TRUE(told.count(p.key) == 1 || p.key == "drive_2.lead_m_per_rad" || (p.set == nullptr && p.set_side == nullptr))
        << p.key << " was never another";
}

TEST(ParameterHash, TellsEveryNumberOfALaw) {
  for (const std::string& name : shipped().names()) {
    const config::ActuatorType type = shipped().load(name);
    for (const config::Entry& e : type.entries) {
      const auto value = config::parse_number(e.value);
      if (e.key.rfind("elastic.", 0) != 0 || !value || *value == 0) continue;
      device::UnitConfig other;
      try {
        other = shipped().load(name, {{e.key, std::to_string(*value * 1.01)}}).unit;
      } catch (const InputError&) {
        continue;  // at its bound
      }
      EXPECT_EQ(parameter_hash(other) == parameter_hash(type.unit), device::alike(other, type.unit)) << name << ": " << e.key;
    }
  }
}

TEST(ParameterHash, LeavesTheIdOut) {
  device::UnitConfig unit = shipped().load("qbmove_maker_pro").unit;
  const std::uint64_t before = parameter_hash(unit);
  unit.memory.id = static_cast<std::uint8_t>(unit.memory.id + 1);
  EXPECT_EQ(parameter_hash(unit), before);
}

}  // namespace
}  // namespace vsa::test
