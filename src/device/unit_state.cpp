// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A unit's state as numbers.
#include "vsa/device/unit.hpp"
#include "vsa/state_io.hpp"

namespace vsa::device {

namespace {

bool within(std::int32_t v, std::int32_t least, std::int32_t most) noexcept { return v >= least && v <= most; }

/// What the program's arithmetic takes for granted.
bool possible(const firmware::ControllerState& s) noexcept {
  bool good = within(s.limit_pct, 0, 100);
  for (const std::int32_t sample : s.last_sample) good = good && within(sample, -32768, 32767);
  for (std::size_t i = 0; i < 2; ++i) {
    for (const std::int32_t pct : {s.pwm[i], s.duty[i], s.rate_before[i]}) good = good && within(pct, -100, 100);
    good = good && (s.current_sign[i] == 1 || s.current_sign[i] == -1);
  }
  return good;
}

}  // namespace

const char* UnitState::impossible() const noexcept {
  constexpr double kLongest_s = 1.0;
  if (started && !(last_dt > 0 && last_dt <= kLongest_s)) return "a last_dt above 0, up to 1 s, of a unit that has started";
  if (!within(limit_pct, 0, 100)) return "a limit of 0 … 100 %";
  return possible(program.loop) ? nullptr : "a loop's samples of 16 bits, and its duties, rates and limit of up to 100 %";
}

StateLayout Unit::state_layout() { return state::layout_of(UnitState{}); }

std::size_t Unit::state_size() noexcept { return state::size_of<UnitState>(); }

void Unit::save(const UnitState& unit, std::span<double> out) {
  check_state_size(out.size(), state_size());
  state::Writer writer(out);
  state::walk_fields(writer, unit);
}

void Unit::restore(UnitState& unit, std::span<const double> in) {
  check_state_size(in.size(), state_size());
  UnitState loaded;
  state::Reader reader(in);
  state::walk_fields(reader, loaded);
  if (reader.fault().there()) throw_if_any(reader.fault(), state_layout());
  unit = loaded;
}

}  // namespace vsa::device
