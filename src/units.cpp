// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/units.hpp"

#include <array>
#include <utility>

namespace vsa {

std::string sliding(std::string_view words) {
  // The longest first: what is changed once isn't looked at again.
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 18> kWords{{{"N·m·rad", "N·m"},
                                                                                         {"Nm_rad", "Nm"},
                                                                                         {"N·m·s/rad", "N·s/m"},
                                                                                         {"N·m/rad", "N/m"},
                                                                                         {"Nms_per_rad", "Ns_per_m"},
                                                                                         {"Nm_per_rad", "N_per_m"},
                                                                                         {"rad_per_Nm", "m_per_N"},
                                                                                         {"load_torque_Nm", "load_force_N"},
                                                                                         {"torque_Nm", "force_N"},
                                                                                         {"kg·m²", "kg"},
                                                                                         {"_kgm2", "_kg"},
                                                                                         {"torque", "force"},
                                                                                         {"Torque", "Force"},
                                                                                         {"N·m", "N"},
                                                                                         {"_Nm", "_N"},
                                                                                         {"_rad", "_m"},
                                                                                         {"rad/s", "m/s"},
                                                                                         {"angle", "position"}}};
  std::string out;
  while (!words.empty()) {
    std::size_t used = 0;
    for (const auto& [turning, slides] : kWords) {
      if (words.substr(0, turning.size()) != turning) continue;
      out += slides;
      used = turning.size();
      break;
    }
    // Alone, as a unit: "[rad]", "0.1 rad".
    const bool alone = used == 0 && words.substr(0, 3) == "rad" && (out.empty() || out.back() == '[' || out.back() == ' ') &&
                       (words.size() == 3 || words[3] == ']' || words[3] == ' ' || words[3] == ',' || words[3] == '.');
    if (alone) {
      out += 'm';
      used = 3;
    }
    if (used == 0) {
      out += words.front();
      used = 1;
    }
    words.remove_prefix(used);
  }
  return out;
}

std::string_view unit_word(std::string_view unit) { return unit == "N·m/rad" ? "Nm_per_rad" : unit == "N/m" ? "N_per_m" : unit; }

}  // namespace vsa
