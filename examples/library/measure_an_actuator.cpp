// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Measures how fast an actuator steps, soft and stiff, as `vsa characterize` does, and shows how far it is. Takes a second.
#include <cstdio>
#include <exception>

#include "vsa/study/characterization.hpp"

namespace study = vsa::study;

int main() {
  try {
    study::CharacterizationOptions options;
    options.specimen.type = "qbmove_maker_pro";
    options.experiments = {study::Experiment::speed};
    options.preset = {0, 0.6};  // rad
    const auto measured = study::run(study::plan_characterization(options), [](const study::Progress& p) {
      std::fprintf(stderr, "\r%3.0f %% of %.0f s", 100 * p.simulated_s / p.total_s, p.total_s);
      return p.wall_s < 600;  // false: stop
    });
    std::fputc('\n', stderr);
    if (!measured) return 1;
    for (const study::SpeedResult& r : measured->speed) {
      std::printf("preset %.1f rad: %.2f rad/s, overshoot %.1f %%\n", r.options.preset, r.mean.shaft.mean_speed,
                  r.mean.shaft.overshoot_pct);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
