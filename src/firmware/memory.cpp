// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/firmware/memory.hpp"

#include "vsa/firmware/arithmetic.hpp"

namespace vsa::firmware {
namespace {

constexpr std::int32_t fixed(float v) noexcept { return truncate(v * 65536.0F); }

}  // namespace

Memory initial_memory(Model model, const Memory& was) noexcept {
  Memory m = was;
  m.id = 1;
  m.double_position = m.double_current = {};
  if (model == Model::maker_pro) {
    m.position = {fixed(0.1F), 0, fixed(0.8F)};
    m.current = {fixed(5.0F), 0, 0};
    m.watchdog_period = 0;
  } else {
    m.position = {fixed(-0.1F), 0, fixed(-0.8F)};
    m.current = {fixed(3.0F), 0, 0};
    m.double_position = {fixed(-0.3F), 0, fixed(-0.02F)};
    m.double_current = {fixed(0.8F), 0, fixed(0.05F)};
    m.watchdog_period = 250;
  }
  m.startup_activation = m.input_mode = m.control_mode = 0;
  m.limits_on = 1;
  m.limit_low = {-30000, -30000};
  m.limit_high = {30000, 30000};
  m.multiplier = {1.0F, 1.0F, 1.0F};
  m.resolution = {1, 1, 1};
  m.offset = {};
  m.max_stiffness = 3000 << 1;
  m.current_limit_mA = 1500;
  m.valid = true;
  return m;
}

int store(MemoryState& m, Page page) noexcept {
  m.current = m.stored;
  (page == Page::user ? m.user : m.factory) = m.stored;
  return kMemoryRows;
}

int restore(MemoryState& m, Model model) noexcept {
  m.stored = m.factory;
  return m.stored.valid ? store(m, Page::user) : initialise(m, model);
}

int initialise(MemoryState& m, Model model) noexcept {
  m.stored = initial_memory(model, m.stored);
  return store(m, Page::user) + store(m, Page::factory);
}

int recall(MemoryState& m, Model model) noexcept {
  m.stored = m.user;
  if (!m.stored.valid) return restore(m, model);
  m.current = m.stored;
  return 0;
}

}  // namespace vsa::firmware
