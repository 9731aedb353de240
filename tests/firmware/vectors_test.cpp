// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The controller against the public firmware's own outputs (data/PROVENANCE.md) and against a second statement of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "independent_model.hpp"
#include "scenario.hpp"

namespace {

using namespace vsa::firmware;
using namespace vsa::firmware::test;

constexpr long kTicks = 1'000'000;
constexpr long kTicksPerHash = 1000;

std::ifstream open_data(const std::string& name) { return std::ifstream(VSA_SOURCE_DIR "/tests/firmware/data/" + name); }

Model model_of(const std::string& name) { return name == "advanced" ? Model::advanced : Model::maker_pro; }

struct ControllerRun {
  explicit ControllerRun(Model model, int mode) : scenario(model, mode), controller{model, model == Model::maker_pro, {}} {}

  void next() {
    scenario.next();
    if (scenario.zeroed) {
      state.turns = {};
      state.reset_samples = true;
    }
    if (scenario.new_references) {
      state.ref_new = scenario.references;
      state.orders_new = scenario.orders;
    }
    controller.tick({scenario.stored, scenario.current}, state, scenario.inputs());
  }

  Scenario scenario;
  Controller controller;
  ControllerState state;
};

struct Case {
  std::string model;
  int mode = 0;
  std::vector<std::uint32_t> hashes;
};

std::vector<Case> read_hashes() {
  std::vector<Case> cases;
  auto in = open_data("controller_hashes.txt");
  std::size_t count = 0;
  for (Case c; in >> c.model >> c.mode >> count;) {
    c.hashes.assign(count, 0);
    for (std::uint32_t& h : c.hashes) in >> std::hex >> h >> std::dec;
    cases.push_back(c);
  }
  return cases;
}

TEST(Vectors, AMillionTicksInEveryModeHaveThePublicProgramsHashes) {
  const auto cases = read_hashes();
  ASSERT_EQ(cases.size(), 13U) << "seven modes of the maker pro, six of the advanced unit";
  for (const Case& c : cases) {
    ASSERT_EQ(c.hashes.size() * kTicksPerHash, static_cast<std::size_t>(kTicks));
    ControllerRun run(model_of(c.model), c.mode);
    Hash hash;
    for (long tick = 1; tick <= kTicks; ++tick) {
      run.next();
      hash.add(record_of(run.state));
      if (tick % kTicksPerHash != 0) continue;
      ASSERT_EQ(hash.value >> 32, c.hashes[tick / kTicksPerHash - 1]) << c.model << " mode " << c.mode << " before tick " << tick;
    }
  }
}

TEST(Vectors, TheFirstTicksAreThePublicProgramsFieldByField) {
  auto in = open_data("controller_ticks.csv");
  std::string header, line;
  std::getline(in, header);
  std::map<std::pair<std::string, int>, ControllerRun> runs;
  int rows = 0;
  while (std::getline(in, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream row(line);
    std::string model;
    int mode = 0, tick = 0;
    row >> model >> mode >> tick;
    TickRecord want;
    for (std::int32_t& field : want.field) row >> field;
    ASSERT_TRUE(row) << line;
    auto run = runs.try_emplace({model, mode}, model_of(model), mode).first;
    run->second.next();
    ASSERT_EQ(record_of(run->second.state).field, want.field) << model << " mode " << mode << " tick " << tick;
    ++rows;
  }
  EXPECT_GE(rows, 1900);
}

TEST(Vectors, AMillionTicksInEveryModeAgreeWithTheIndependentModel) {
  for (int mode = 0; mode <= 6; ++mode) {
    ControllerRun run(Model::maker_pro, mode);
    IndependentUnit other;
    for (long tick = 0; tick < kTicks; ++tick) {
      run.next();
      if (run.scenario.zeroed) other.zero();
      if (run.scenario.new_references) {
        other.next_reference = {run.scenario.references[0], run.scenario.references[1]};
        other.next_onoff = run.scenario.orders.onoff;
      }
      other.tick(run.scenario);
      ASSERT_EQ(record_of(run.state).field, other.record().field) << "mode " << mode << " tick " << tick;
    }
  }
}

/// A scenario that never overflowed would prove little.
TEST(Vectors, TheScenariosReachOverflowsJumpsAndBothSignsOfEverything) {
  long overflows = 0, rejected = 0, wrapped_turns = 0, bad_words = 0, no_supply = 0, crossed = 0;
  ControllerRun run(Model::maker_pro, 0);
  for (long tick = 0; tick < 100'000; ++tick) {
    const auto turns = run.state.turns;
    run.next();
    const Memory& m = run.scenario.current;
    for (int i = 0; i < 2; ++i) {
      const std::int64_t product = std::int64_t{m.position.p} * (std::int64_t{run.state.ref_old[i]} - run.state.meas[i]);
      overflows += product != static_cast<std::int32_t>(product) ? 1 : 0;
      crossed += m.limit_low[i] > m.limit_high[i] ? 1 : 0;
      rejected += run.state.rejected[i] > 0 ? 1 : 0;
      wrapped_turns += turns[i] != run.state.turns[i] ? 1 : 0;
      bad_words += parity_even(run.scenario.words[i]) ? 0 : 1;
    }
    no_supply += run.state.supply.value <= 0 ? 1 : 0;
  }
  EXPECT_GT(overflows, 10'000);
  EXPECT_GT(rejected, 1000);
  EXPECT_GT(wrapped_turns, 300);
  EXPECT_GT(bad_words, 1000);
  EXPECT_GT(no_supply, 1000);
  EXPECT_GT(crossed, 1000);
}

}  // namespace
