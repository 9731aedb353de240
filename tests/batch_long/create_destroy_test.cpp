// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Ten thousand times made, used and dropped: for the sanitizers, and nothing may stay behind. minutes under asan: label long.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "vsa/batch/batch.hpp"
#include "vsa/errors.hpp"

namespace vsa::batch {
namespace {

using engine::World;

constexpr int kTimes = 10'000;

/// Bytes in use; 0 under a sanitizer, whose own allocator mallinfo2 doesn't know, and which tells leaks by itself.
std::size_t in_use() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return 0;
#else
  const struct mallinfo2 now = mallinfo2();
  return now.uordblks + now.hblkhd;
#endif
}

/// `once`, many times; what stays in use after the first few is less than a byte a time and a page. What several threads have at hand in
/// between hangs on who did what, so the most after a few times counts, and the least after the last few.
template <class Once>
void again_and_again(int times, Once&& once) {
  constexpr int kWarm = 112, kPage = 4096, kLook = 14;
  std::size_t warm = 0, last = std::numeric_limits<std::size_t>::max();
  for (int k = 0; k < kWarm; ++k) {
    once(k);
    if (k >= kWarm - kLook) warm = std::max(warm, in_use());
  }
  for (int k = 0; k < times; ++k) {
    once(k);
    if (k >= times - kLook) last = std::min(last, in_use());
  }
  EXPECT_LE(last, warm + static_cast<std::size_t>(times + kPage));
}

TEST(TenThousandTimes, AUnit) {
  const device::UnitConfig config = config::TypeLibrary().load("qbmove_maker_pro_6_1").unit;
  again_and_again(kTimes, [&](int k) {
    device::Unit unit(config);
    device::UnitState state = unit.initial(0.1, 0.2, 0.0);
    for (int step = 0; step < 2; ++step)
      EXPECT_TRUE(std::isfinite(unit.step(state, step * 1'000'000, 1'000'000, {0.001 * k, 0.0, 0.0})));
  });
}

TEST(TenThousandTimes, AWorld) {
  const World from = World::load("bench_load.sdf");
  again_and_again(kTimes, [&](int k) {
    World w = from.clone();
    if (k % 3 == 0) w.set_link_parameters(w.link("terrain_flat::link"), {0, {}, 0.5});
    w.step();
    const auto before = w.snapshot();
    World moved = std::move(w);
    moved.step();
    moved.restore(*before);
  });
}

TEST(HundredsOfTimes, AWorldFromItsFileOrNone) {
  again_and_again(kTimes / 25, [&](int k) {
    if (k % 2 == 0) World::load("bench_load.sdf").step();
    EXPECT_THROW((void)World::load("no_such_world.sdf"), InputError);
    EXPECT_THROW((void)World::load_string("<sdf version='1.6'><world name='w'><model"), InputError);
  });
}

TEST(TenThousandTimes, ABatchWithParametersCommandsAndFailures) {
  const World from = World::load("bench_load.sdf");
  std::vector<double> bad(from.state_size());
  from.save(bad);
  const StateLayout layout = from.state_layout();
  for (const StateEntry& e : layout.entries())
    if (e.name.rfind("physics/joint", 0) == 0 && e.name.find(".speed") != std::string::npos) bad[e.offset] = 1e11;
  again_and_again(kTimes, [&](int k) {
    Batch batch(from, 2, 1 + static_cast<std::size_t>(k % 3 == 0));
    if (k % 4 == 0) batch.set(1, "", "link.friction", 0.5);
    if (k % 16 == 0) {
      batch.randomize(static_cast<std::uint64_t>(k), std::vector<Spread>{{"", "drive.friction_Nm", {{}, 0.5, 1.0}}});
      EXPECT_THROW(batch.set(0, "shaft", "drive.friction_Nm", -1.0), InputError);
    }
    if (k % 8 == 0) {
      batch.preset()[0] = INFINITY;
      EXPECT_THROW(batch.step(), InputError);
      batch.preset()[0] = std::nan("");
    }
    if (k % 5 == 0) batch.restore(0, bad);
    batch.step(2);
    EXPECT_EQ(batch.status(0) == Status::failed, k % 5 == 0);
    Batch moved = std::move(batch);
    moved.reset();
  });
}

TEST(ALongRun, OfCopiesWithTheirOwnParametersNeedsNoMoreMemoryInTheEnd) {
  Batch batch(World::load("bench_load.sdf"), 8, 2);
  const std::vector<Spread> what{{"", "drive.friction_Nm", {{}, 0.5, 1.0}}, {"", "link.mass_kg", {{}, 0.9, 1.1, true}}};
  again_and_again(308, [&](int k) {  // ends with the same seed as the warming-up
    batch.randomize(static_cast<std::uint64_t>(k % 7), what);
    batch.step(5);
    batch.reset();
  });
}

}  // namespace
}  // namespace vsa::batch
