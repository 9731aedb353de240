// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "run/set_up.hpp"

#include <cstdlib>

#include "vsa/config/find_file.hpp"
#include "vsa/errors.hpp"

namespace vsa::app {

RunOptions seeded(RunOptions options) {
  options.faults = scenario::seeded_faults(options);
  options.seed.reset();
  return options;
}

/// The page's template is generated, so it lies beside the build, where the other data needn't be.
record::RecorderOptions recorder_options(const RunOptions& run) {
  record::RecorderOptions options;
  options.rate_Hz = run.record_rate_Hz;
  options.page_rate_Hz = run.page_rate_Hz;
  for (const std::string& text : run.faults) (options.faults += options.faults.empty() ? "" : "; ") += text;
  options.page_template = config::find_data("web/replay.html").value_or("");
  return options;
}

/// "max": none.
std::optional<double> speed_of(const RunOptions& options) {
  if (options.speed.empty()) return options.realtime || options.view ? std::optional(1.0) : std::nullopt;
  if (options.speed == "max") return std::nullopt;
  char* end = nullptr;
  const double factor = std::strtod(options.speed.c_str(), &end);
  if (end != options.speed.c_str() + options.speed.size() || !(factor >= kSlowest && factor <= kFastest)) {
    throw InputError({"", "--speed", options.speed, "not a speed", "0.01 … 100, or max"});
  }
  return factor;
}

}  // namespace vsa::app
