// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/Validators.hpp>
#include <string>

namespace vsa::app {

/// CLI11 reads an empty argument as 0 or as not given; here it is bad usage.
[[nodiscard]] inline CLI::Validator number_given() {
  return CLI::Validator([](std::string& text) { return text.empty() ? std::string("a number is missing") : std::string(); }, "");
}

}  // namespace vsa::app
