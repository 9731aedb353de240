// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "vsa/firmware/arithmetic.hpp"
#include "vsa/firmware/program.hpp"

namespace vsa::firmware {
namespace {

constexpr std::uint16_t kDivider = 100;  // ticks a step
constexpr std::uint8_t kPauses = 10;     // steps to wait for the motors
constexpr std::int32_t kStep = 91;       // 65536/720: 0.5°
constexpr std::int32_t kThreshold_mA = 1000;
constexpr Gains kGains{6553, 0, 19660};  // 0.1, 0, 0.3

bool touches(const ControllerState& loop, bool magnitude) noexcept {
  for (const MilliAmp current : loop.current)
    if ((magnitude ? std::abs(current.value) : current.value) > kThreshold_mA) return true;
  return false;
}

}  // namespace

void Program::calibrate(ProgramState& s, std::int64_t now_ns) const noexcept {
  if (s.calibration.stage == Calibration::Stage::stop) return;
  if (s.calibration.divider == kDivider) {
    calibration_step(s, now_ns);
    s.calibration.divider = 0;
  }
  ++s.calibration.divider;
}

void Program::calibration_step(ProgramState& s, std::int64_t now_ns) const noexcept {
  using Stage = Calibration::Stage;
  Calibration& c = s.calibration;
  Memory& current = s.memory.current;
  const bool own_gains = params_.model == Model::advanced;
  switch (c.stage) {
    case Stage::start:
      s.receiver_off = !own_gains;
      c.saved = current.position;
      s.loop.ref_new = {};
      if ((s.loop.orders_new.onoff & 3) == 0) s.enable = 3;
      c.stage = Stage::wait_before;
      break;
    case Stage::wait_before:
      if (++c.pauses != kPauses) break;
      c.pauses = 0;
      if (!own_gains) current.position = kGains;
      c.stage = Stage::go_apart;
      break;
    case Stage::go_apart:
      s.loop.ref_new = {wrap_add(s.loop.ref_new[0], kStep), wrap_sub(s.loop.ref_new[1], kStep)};
      if (!touches(s.loop, params_.repairs.calibration_both_motors)) break;
      s.memory.stored.max_stiffness = static_cast<std::uint16_t>(s.loop.ref[0]);
      if (!own_gains) current.position = c.saved;
      s.loop.ref_new = {};
      c.stage = Stage::wait_after;
      break;
    case Stage::wait_after:
      if (++c.pauses != kPauses) break;
      c.pauses = 0;
      c.stage = Stage::finish;
      break;
    case Stage::finish:
      finish_calibration(s, now_ns);
      break;
    default:
      break;
  }
}

void Program::finish_calibration(ProgramState& s, std::int64_t now_ns) const noexcept {
  if ((s.loop.orders_new.onoff & 3) == 0) s.enable = 0;
  const int rows = store(s.memory, Page::factory) + store(s.memory, Page::user);
  begin_store(params_, s, rows, now_ns);
  s.calibration.stage = Calibration::Stage::stop;
  s.receiver_off = false;
}

}  // namespace vsa::firmware
