// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/faults.hpp"

#include <cmath>
#include <string>

#include "vsa/checks.hpp"
#include "vsa/units.hpp"

namespace vsa::device {

Wiring Faults::wiring() const noexcept {
  return {powered, lost_byte, flipped_byte, static_cast<std::int64_t>(std::llround(late_s * 1e9))};
}

const char* Faults::impossible() const noexcept {
  const auto within = [](double v, double most) { return v >= 0 && v <= most; };
  bool possible = within(lost_byte, 1) && within(flipped_byte, 1) && within(late_s, kLatest_s);
  for (const EncoderFault& e : encoder) possible = possible && within(e.noise_rad, kPi);
  return possible && within(supply_V.value_or(0), kMostSupply_V) ? nullptr : "faults within their bounds";
}

void validate(const Faults& f, std::string_view where, Problems& problems) {
  Checks check(where, problems);
  const auto within = [&](const std::string& key, double v, double max, const char* unit) {
    if (!(v >= 0 && v <= max)) check.refuse(key, Checks::text(v), "is out of range", "0 … " + Checks::text(max) + unit);
  };
  within("lost_byte", f.lost_byte, 1, "");
  within("flipped_byte", f.flipped_byte, 1, "");
  within("late_s", f.late_s, Faults::kLatest_s, " s");
  for (std::size_t i = 0; i < f.encoder.size(); ++i)
    within("encoder_" + std::to_string(i + 1) + ".noise_rad", f.encoder[i].noise_rad, kPi, " rad");
  if (f.supply_V) within("supply_V", *f.supply_V, Faults::kMostSupply_V, " V");
}

}  // namespace vsa::device
