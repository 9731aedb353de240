// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <utility>

#include "doctor/doctor.hpp"
#include "vsa/engine/world.hpp"
#include "vsa/errors.hpp"

namespace vsa::app {

void load_world(Findings& findings, const std::filesystem::path& file) {
  try {
    const auto world = engine::World::load(file);
    findings.ok("world", fmt::format("{} loads, {} s a step", file.string(), world.step_s()));
    for (std::size_t r = 0; r < world.robot_count(); ++r)
      findings.ok("robot", fmt::format("{} with {} actuator{}", world.robot_model(r), world.robot(r).size(),
                                       world.robot(r).size() == 1 ? "" : "s"));
    if (world.robot_count() == 0)
      findings.problem("robot", "no model has a <plugin name=\"vsa::Robot\">", "docs/reference/config.md shows one");
    for (const std::string& warning : world.warnings()) findings.note("vsa run", warning);
  } catch (const InputError& error) {
    for (Problem p : error.problems()) {
      const std::string allowed = std::exchange(p.allowed, "");
      findings.problem("world", p.text(), allowed.empty() ? "mend the file" : allowed);
    }
  }
}

}  // namespace vsa::app
