// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/view/request.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace vsa::view {
namespace {

Rules rules() {
  Rules out;
  out.actuators = {{{-2, 2}, {0, 0.7}}, {{-1, 1}, {0, 0.5}}, {{-3, 3}, {0, 0}}};
  out.moves = {false, true, true};
  out.gait_groups = {"even", "odd"};
  out.gait = out.control = out.hands = true;
  return out;
}

template <class T>
T read(const std::string& text) {
  const Parsed parsed = parse_request(text, rules());
  EXPECT_TRUE(parsed.request) << text << ": " << parsed.error;
  if (!parsed.request || !std::holds_alternative<T>(*parsed.request)) {
    ADD_FAILURE() << text << " is something else";
    return {};
  }
  return std::get<T>(*parsed.request);
}

std::string why(const std::string& text, const Rules& with = rules()) {
  const Parsed parsed = parse_request(text, with);
  EXPECT_FALSE(parsed.request) << text;
  return parsed.error;
}

TEST(Request, WhatTheSimulatorDoesntOfferIsRefusedWithAReason) {
  Rules few = rules();
  few.control = few.hands = false;
  for (const char* text :
       {R"({"do":"play"})", R"({"do":"pause"})", R"({"do":"reset"})", R"({"do":"step","steps":1})", R"({"do":"speed","factor":1})"})
    EXPECT_NE(why(text, few).find("simulator's own"), std::string::npos) << text;
  EXPECT_NE(why(R"({"do":"pull","link":2,"point_m":[1,2,3],"target_m":[4,5,6]})", few).find("no hands"), std::string::npos);
  for (const char* text : {R"({"do":"release"})", R"({"do":"next"})", R"({"do":"record","on":true})",
                           R"({"do":"command","actuators":[0],"equilibrium_rad":1})"})
    EXPECT_TRUE(parse_request(text, few).request) << text;
}

TEST(Request, ReadsWhatPagesSay) {
  read<Play>(R"({"do":"play"})");
  read<Pause>(R"({"do":"pause"})");
  read<Reset>(R"({"do":"reset"})");
  read<Release>(R"({"do":"release"})");
  read<GiveBack>(R"({"do":"give_back"})");
  read<Next>(R"({"do":"next"})");
  EXPECT_EQ(read<Step>(R"({"do":"step","steps":7})").steps, 7U);
  EXPECT_EQ(read<Speed>(R"({"do":"speed","factor":0.5})").factor, 0.5);
  EXPECT_EQ(read<Speed>(R"({"do":"speed","factor":null})").factor, std::nullopt);
  EXPECT_TRUE(read<Record>(R"({"do":"record","on":true})").on);
  EXPECT_FALSE(read<PlayGait>(R"({"do":"gait_play","on":false})").on);
  const auto command = read<Command>(R"({"do":"command","actuators":[0,1],"equilibrium_rad":-0.5,"preset":0.25})");
  EXPECT_EQ(command.actuators, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(command.equilibrium_rad, -0.5);
  EXPECT_EQ(command.preset, 0.25);
  EXPECT_EQ(read<Command>(R"({"do":"command","actuators":[2],"equilibrium_rad":1})").preset, std::nullopt);
  const auto pull = read<PullLink>(R"({"do":"pull","link":2,"point_m":[1,2,3],"target_m":[4,5,6e-1]})");
  EXPECT_EQ(pull.link, 2U);
  EXPECT_EQ(pull.target_m, (std::array<double, 3>{4, 5, 0.6}));
  const auto gait = read<ChangeGait>(
      R"({"do":"gait","frequency_rad_per_s":4,"groups":[{"name":"even","amplitude_rad":1,"offset_rad":0,"lambda":5,"delta_rad":0,)"
      R"("preset_rad":0.6},{"name":"odd","amplitude_rad":0.5,"offset_rad":-1,"lambda":2,"delta_rad":1.5,"preset_rad":0}]})");
  ASSERT_EQ(gait.to.groups.size(), 2U);
  EXPECT_EQ(gait.to.groups[1].delta_rad, 1.5);
}

TEST(Request, SaysWhatIsWrong) {
  EXPECT_EQ(why("play"), "not JSON");
  EXPECT_EQ(why(""), "not JSON");
  EXPECT_EQ(why("[1]"), "not an object");
  EXPECT_EQ(why(R"({"do":"speed","factor":1,"factor":2})"), "factor: is given twice");
  EXPECT_EQ(why("{}"), "do: missing");
  EXPECT_EQ(why(R"({"do":7})"), "do: not a text: 7");
  EXPECT_EQ(why(R"({"do":"fly"})"), "do = fly: unknown");
  EXPECT_EQ(why(R"({"do":"play","loud":1})"), "loud: unknown key");
  EXPECT_EQ(why(R"({"do":"step","steps":0})"), "steps = 0: out of range (allowed: 1 … 1000)");
  EXPECT_EQ(why(R"({"do":"step","steps":1.5})"), "steps: not a whole number: 1.5");
  EXPECT_EQ(why(R"({"do":"step","steps":18446744073709551615})"), "steps: not a whole number: 18446744073709551615");
  EXPECT_EQ(why(R"({"do":"speed","factor":-1})"), "factor = -1: out of range (allowed: 0.01 … 100)");
  EXPECT_EQ(why(R"({"do":"speed","factor":"1"})"), "factor: not a number: \"1\"");
  EXPECT_EQ(why(R"({"do":"record","on":1})"), "on: not true or false: 1");
  EXPECT_EQ(why(R"({"do":"speed","factor":NaN})"), "not JSON");
  EXPECT_EQ(why(R"({"do":"speed","factor":1e999})"), "not JSON") << "a number that no double holds";
}

TEST(Request, RefusesACommandWholeWhereOneActuatorCantTakeIt) {
  EXPECT_NE(why(R"({"do":"command","actuators":[0,1],"equilibrium_rad":1.5})").find("allowed: -1 … 1"), std::string::npos);
  EXPECT_NE(why(R"({"do":"command","actuators":[0],"preset":-0.1})").find("preset"), std::string::npos);
  EXPECT_NE(why(R"({"do":"command","actuators":[2],"preset":0.1})").find("allowed: 0 … 0"), std::string::npos);
  EXPECT_NE(why(R"({"do":"command","actuators":[3],"preset":0.1})").find("out of range"), std::string::npos);
  EXPECT_NE(why(R"({"do":"command","actuators":[0,0],"preset":0.1})").find("twice"), std::string::npos);
  EXPECT_NE(why(R"({"do":"command","actuators":[],"preset":0.1})").find("none"), std::string::npos);
  EXPECT_NE(why(R"({"do":"command","actuators":[0]})").find("both missing"), std::string::npos);
  EXPECT_NE(why(R"({"do":"command","actuators":0,"preset":0.1})").find("not a list"), std::string::npos);
}

TEST(Request, PullsOnlyLinksThatMoveToPlacesInReach) {
  EXPECT_NE(why(R"({"do":"pull","link":0,"point_m":[0,0,0],"target_m":[0,0,0]})").find("doesn't move"), std::string::npos);
  EXPECT_NE(why(R"({"do":"pull","link":9,"point_m":[0,0,0],"target_m":[0,0,0]})").find("out of range"), std::string::npos);
  EXPECT_NE(why(R"({"do":"pull","link":1,"point_m":[0,0],"target_m":[0,0,0]})").find("three"), std::string::npos);
  EXPECT_NE(why(R"({"do":"pull","link":1,"point_m":[0,0,0],"target_m":[0,0,1e9]})").find("out of range"), std::string::npos);
}

TEST(Request, SpeaksOfAGaitOnlyWhereOnePlays) {
  Rules none = rules();
  none.gait = false;
  EXPECT_EQ(why(R"({"do":"gait_play","on":true})", none), "gait_play: this run plays no gait");
  EXPECT_EQ(why(R"({"do":"give_back"})", none), "give_back: this run plays no gait");
}

TEST(Request, OfAnyBytesIsReadOrRefused) {
  const std::vector<std::string> seeds = {
      R"({"do":"command","actuators":[0,1],"equilibrium_rad":-0.5,"preset":0.25})",
      R"({"do":"pull","link":2,"point_m":[1,2,3],"target_m":[4,5,6]})",
      R"({"do":"gait","frequency_rad_per_s":4,"groups":[{"name":"even","amplitude_rad":1,"offset_rad":0,"lambda":5,"delta_rad":0,"preset_rad":0.6}]})",
      R"({"do":"step","steps":7})", R"({"do":"speed","factor":0.5})"};
  std::mt19937 dice(7);
  const auto any = [&](std::size_t n) { return static_cast<std::size_t>(dice() % n); };
  const Rules with = rules();
  int read = 0;
  for (int i = 0; i < 200'000; ++i) {
    std::string text = seeds[any(seeds.size())];
    for (std::size_t k = any(4); k > 0 && !text.empty(); --k) {
      const std::size_t at = any(text.size());
      if (any(3) == 0)
        text.erase(at, any(8));
      else if (any(2) == 0)
        text[at] = static_cast<char>(dice());
      else
        text.insert(at, seeds[any(seeds.size())].substr(any(20), any(12)));
    }
    const Parsed parsed = parse_request(text, with);
    ASSERT_NE(parsed.request.has_value(), !parsed.error.empty()) << text;
    if (!parsed.request) continue;
    ++read;
    if (const auto* c = std::get_if<Command>(&*parsed.request)) {
      for (const std::size_t a : c->actuators) {
        ASSERT_LT(a, with.actuators.size());
        const auto& limits = with.actuators[a];
        ASSERT_TRUE(std::abs(c->equilibrium_rad.value_or(0)) <= limits.equilibrium_rad.max) << text;
        ASSERT_TRUE(c->preset.value_or(0) >= 0 && c->preset.value_or(0) <= limits.preset.max) << text;
      }
    }
  }
  EXPECT_GT(read, 10'000) << "the fuzz must reach what lies behind the reading";
  const std::string deep(100'000, '[');
  EXPECT_FALSE(parse_request(deep, with).request);
  EXPECT_FALSE(parse_request(R"({"do":)" + std::string(2000, '[') + std::string(2000, ']') + "}", with).request);
}

}  // namespace
}  // namespace vsa::view
