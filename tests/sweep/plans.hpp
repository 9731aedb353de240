// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "vsa/errors.hpp"
#include "vsa/sweep/plan.hpp"

namespace vsa::sweep::testing {

namespace fs = std::filesystem;

/// A directory of this test's own, gone with it.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "vsa-sweep-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Scratch() { fs::remove_all(path_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] fs::path operator/(const std::string& name) const { return path_ / name; }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

 private:
  fs::path path_;
};

/// An arm's shaft is told where to go; short and cheap.
inline const std::string kScenario = R"(
[scenario]
world = "bench_load"
duration_s = 0.05
)";
inline const std::string kMeasure = R"(
[[measure]]
name = "last_rad"
signal = "shaft_rad"
actuator = "shaft"
)";

[[nodiscard]] inline Plan plan_of(const Scratch& scratch, const std::string& text) {
  return Plan::load(scratch.write("plan.toml", text));
}

/// The problems of a plan that is refused; empty: it isn't.
[[nodiscard]] inline std::string refusal(const Scratch& scratch, const std::string& text, bool with_worlds = false) {
  try {
    const Plan plan = plan_of(scratch, text);
    if (with_worlds) plan.check();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace vsa::sweep::testing
