// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/config/actuator_type.hpp"
#include "vsa/errors.hpp"

namespace vsa::config {

std::vector<Override> parse_overrides(const std::vector<std::string>& texts, const std::string& from) {
  std::vector<Override> out;
  Problems problems;
  for (const std::string& text : texts) {
    const std::size_t at = text.find('=');
    if (at == std::string::npos || at == 0 || at + 1 == text.size()) {
      problems.add({"", from, '"' + text + '"', "isn't a parameter and its value", "key=value, as drive.friction_Nm=0.7"});
      continue;
    }
    out.push_back({text.substr(0, at), text.substr(at + 1)});
  }
  problems.throw_if_any();
  return out;
}

}  // namespace vsa::config
