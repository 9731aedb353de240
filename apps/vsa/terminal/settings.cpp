// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "terminal/settings.hpp"

#include "vsa/errors.hpp"

namespace vsa::app {

std::vector<config::Override> parse_settings(const std::vector<std::string>& texts, const std::string& flag) {
  std::vector<config::Override> out;
  Problems problems;
  for (const std::string& text : texts) {
    const std::size_t at = text.find('=');
    if (at == std::string::npos || at == 0 || at + 1 == text.size()) {
      problems.add({"", flag, '"' + text + '"', "isn't a parameter and its value", "key=value, as drive.friction_Nm=0.7"});
      continue;
    }
    out.push_back({text.substr(0, at), text.substr(at + 1)});
  }
  problems.throw_if_any();
  return out;
}

}  // namespace vsa::app
