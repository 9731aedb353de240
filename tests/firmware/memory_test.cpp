// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/firmware/memory.hpp"

#include <gtest/gtest.h>

namespace {

using namespace vsa::firmware;

MemoryState initialised(Model model = Model::maker_pro) {
  MemoryState m;
  recall(m, model);
  return m;
}

TEST(Memory, AnEmptyEepromIsFilledWithTheInitialValuesAtPowerUp) {
  MemoryState m;
  EXPECT_EQ(recall(m, Model::maker_pro), 2 * kMemoryRows);
  EXPECT_EQ(m.current, initial_memory(Model::maker_pro));
  EXPECT_EQ(m.user, m.current);
  EXPECT_EQ(m.factory, m.current);
}

TEST(Memory, TheMakersInitialValues) {
  const Memory m = initial_memory(Model::maker_pro);
  EXPECT_EQ(m.id, 1);
  EXPECT_EQ(m.position, (Gains{6553, 0, 52428})) << "0.1 and 0.8 in 16.16, truncated";
  EXPECT_EQ(m.current, (Gains{5 << 16, 0, 0}));
  EXPECT_EQ(m.double_position, Gains{});
  EXPECT_EQ(m.double_current, Gains{});
  EXPECT_EQ(m.max_stiffness, 6000);
  EXPECT_EQ(m.current_limit_mA, 1500);
  EXPECT_EQ(m.watchdog_period, 0);
  const Memory a = initial_memory(Model::advanced);
  EXPECT_EQ(a.position, (Gains{-6553, 0, -52428}));
  EXPECT_EQ(a.double_position, (Gains{-19660, 0, -1310}));
  EXPECT_EQ(a.double_current, (Gains{52428, 0, 3276}));
  EXPECT_EQ(a.watchdog_period, 250);
}

TEST(Memory, AStoreMakesTheStoredSetCurrentAndWritesOnePage) {
  MemoryState m = initialised();
  m.stored.current_limit_mA = 700;
  EXPECT_EQ(store(m, Page::user), kMemoryRows);
  EXPECT_EQ(m.current.current_limit_mA, 700);
  EXPECT_EQ(m.user.current_limit_mA, 700);
  EXPECT_EQ(m.factory.current_limit_mA, 1500);
}

TEST(Memory, StoringDefaultsMakesThemCurrentTooButNotForTheNextPowerUp) {
  MemoryState m = initialised();
  m.stored.id = 7;
  store(m, Page::factory);
  EXPECT_EQ(m.current.id, 7);
  recall(m, Model::maker_pro);
  EXPECT_EQ(m.current.id, 1);
}

TEST(Memory, RestoreTakesTheFactoryPageAndStoresIt) {
  MemoryState m = initialised();
  m.stored.id = 7;
  store(m, Page::factory);
  m.stored.id = 9;
  store(m, Page::user);
  EXPECT_EQ(restore(m, Model::maker_pro), kMemoryRows);
  EXPECT_EQ(m.stored.id, 7);
  EXPECT_EQ(m.current.id, 7);
  EXPECT_EQ(m.user.id, 7);
}

TEST(Memory, InitialisationLeavesMaxStepsAndTheBaudRateAlone) {
  MemoryState m = initialised();
  m.stored.max_step_positive = 55;
  m.stored.baud_rate = 13;
  m.stored.id = 9;
  EXPECT_EQ(initialise(m, Model::maker_pro), 2 * kMemoryRows);
  EXPECT_EQ(m.current.id, 1);
  EXPECT_EQ(m.factory.max_step_positive, 55);
  EXPECT_EQ(m.user.baud_rate, 13);
}

}  // namespace
