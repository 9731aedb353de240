// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/firmware/info.hpp"

#include "unit_bench.hpp"

namespace {

using namespace vsa::firmware;
using namespace vsa::firmware::test;
namespace bus = vsa::bus;

std::string info(UnitBench& u) {
  const Bytes bytes = u.request(bus::GetInfo{0});
  return {bytes.begin(), bytes.end()};
}

bool has_line(const std::string& text, const std::string& line) { return text.find("\r\n" + line + "\r\n") != std::string::npos; }

TEST(Info, HasTheLinesThatClientsLookFor) {
  UnitBench u;
  u.in.encoder = {3200, -3200, 16};
  u.tick(2);
  const std::string text = info(u);
  for (const char* line : {"Firmware version: QBMMP v6.1.0.",
                           "ID: 1",
                           "Number of sensors: 3",
                           "PWM Limit: 61",
                           "Motor references: 0 0 ",
                           "Motor enabled: NO",
                           "1 -> 1600",
                           "2 -> -1600",
                           "3 -> 8",
                           "Voltage (mV): 12001",
                           "P -> 0.099991",
                           "D -> 0.799988",
                           "P -> 5.000000",
                           "Startup activation: NO",
                           "Input mode: USB",
                           "Control Mode: Position",
                           "1 -> 1.000000",
                           "Position limit active: 1",
                           "Position limit motor 2: inf -> -15000  sup -> 15000",
                           "Max stiffness: 3000",
                           "Current limit: 1500",
                           "debug: 0"})
    EXPECT_TRUE(has_line(text, line)) << line << "\nin\n" << text;
  EXPECT_LT(text.size(), kInfoBytes);
}

TEST(Info, OtherKindsAreNotAnswered) {
  UnitBench u;
  EXPECT_TRUE(u.request(bus::GetInfo{1}).empty());
}

TEST(Info, ModeFiveShowsTheWrongGainsUnlessRepaired) {
  for (const bool repaired : {false, true}) {
    UnitBench u(with({.info_gains = repaired}));
    u.state.memory.current.control_mode = 5;
    u.state.memory.current.double_position.p = 3 << 16;
    EXPECT_EQ(has_line(info(u), "P -> 3.000000"), repaired);
  }
}

TEST(Info, NumbersHaveTheDevicesTypes) {
  UnitBench u;
  u.state.loop.ref_old = {80000, 0};
  u.state.memory.stored.max_stiffness = 40000;
  u.state.memory.current.multiplier = {-0.0000004F, 16777216.0F, 1e20F};
  const std::string text = info(u);
  EXPECT_TRUE(has_line(text, "Motor references: -25536 0 ")) << "40000 in 16 bits";
  EXPECT_TRUE(has_line(text, "Max stiffness: -12768")) << "40000 in 16 bits, shifted";
  EXPECT_TRUE(has_line(text, "1 -> -0.000000"));
  EXPECT_TRUE(has_line(text, "2 -> 16777216.000000"));
  EXPECT_TRUE(has_line(text, "3 -> 100000002004087734272.000000"));
}

TEST(Info, TheAdvancedUnitSaysMore) {
  UnitBench u(advanced_unit());
  u.tick(2);
  const std::string text = info(u);
  EXPECT_TRUE(has_line(text, "Firmware version: QBADV v6.1.6."));
  EXPECT_TRUE(has_line(text, "Motor references - Position: 0 0 "));
  EXPECT_TRUE(has_line(text, "Max pwm rate: 255"));
}

TEST(Info, ATextThatDoesNotFitIsCut) {
  UnitBench u;
  std::array<char, 10> small{};
  const InfoSource source{Model::maker_pro, {}, {u.state.memory.stored, u.state.memory.current}, u.state.loop, 0};
  EXPECT_EQ(info_text(source, small), "\r\nFirmware");
}

}  // namespace
