// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <string>

#include "vsa/checks.hpp"
#include "vsa/firmware/program.hpp"

namespace vsa::firmware {

void validate(const ProgramParams& p, std::string_view where, Problems& problems) {
  constexpr double kLongestRow_ns = 1e9;
  Checks check(where, problems);
  if (p.generation != Generation::v6 && p.model != Model::maker_pro) {
    check.refuse("generation", "", "older loops are those of the maker pro: the advanced unit has one",
                 "6.1, or firmware.model = maker_pro");
  }
  check.within("row_write_ns", static_cast<double>(p.row_write_ns), 0, kLongestRow_ns);
}

void validate(const Memory& m, std::string_view where, Problems& problems) {
  Checks check(where, problems);
  for (const std::uint8_t bits : m.resolution) check.within("resolution", bits, 0, 8);
  for (const float factor : m.multiplier) check.finite("multiplier", factor);
  for (std::size_t i = 0; i < 2; ++i) {
    if (m.limit_low[i] < m.limit_high[i]) continue;
    check.refuse("limit_low_raw", std::to_string(m.limit_low[i]), "must be below firmware.limit_high_raw",
                 "below " + std::to_string(m.limit_high[i]));
    if (m.limit_low[0] == m.limit_low[1] && m.limit_high[0] == m.limit_high[1]) break;
  }
}

}  // namespace vsa::firmware
