// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What tests of sweeps, searches and ranks share: a plan, its tables and logs, a job of mpirun's.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

#include "subprocess.hpp"

namespace vsa::test {

/// 40 runs whose lengths differ a hundredfold, of which two fail.
inline std::string plan_text(const std::string& more = "") {
  return more + R"(
repetitions = 2
[scenario]
world = "bench_pole"
duration_s = 0.2
faults = ["shaft noise_rad=0.003"]
[[vary]]
key = "set.drive.friction_Nm"
name = "friction_Nm"
range = [0.3, 0.6]
count = 2
[[vary]]
key = "scenario.duration_s"
log = [0.2, 20.0]
count = 10
[[measure]]
name = "shaft_rad"
signal = "shaft_rad"
actuator = "shaft"
statistic = "rms"
[[measure]]
name = "supply_J"
signal = "supply_J"
)";
}

inline std::string plan(const Scratch& scratch, const std::string& more = "") {
  write_file(scratch / "plan.toml", plan_text(more));
  return scratch / "plan.toml";
}

inline std::string tables(const std::filesystem::path& folder) {
  const std::string h5 = std::filesystem::exists(folder / "results.h5") ? read_file(folder / "results.h5") : "";
  return read_file(folder / "results.csv") + h5;
}

inline std::string by_threads(const Scratch& scratch) {
  const Result r = run_vsa({"sweep", plan(scratch), "--out", scratch / "threads"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  return tables(scratch / "threads");
}

inline std::size_t runs_in(const std::filesystem::path& folder) {
  std::size_t lines = 0;
  std::error_code none;
  for (const auto& log : std::filesystem::directory_iterator(folder / "log", none)) {
    const std::string text = read_file(log.path());
    lines += static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    lines -= text.empty() ? 0 : 1;
  }
  return lines;
}

/// Until the folder has so many; false: the tests' patience is at its end.
inline bool wait_for_runs(const std::filesystem::path& folder, std::size_t count) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (runs_in(folder) < count) {
    if (std::chrono::steady_clock::now() > end) return false;
    usleep(1000);
  }
  return true;
}

/// vsa-mpi as `mpirun` starts it; where this build has none, or the machine no mpirun, that is said.
class WithRanks : public ::testing::Test {
 protected:
  /// Why there are none; empty: there are.
  [[nodiscard]] static std::string no_ranks() {
    if (!std::filesystem::exists(std::filesystem::path(VSA_BINARY_DIR) / "bin" / "vsa-mpi")) return "this build found no MPI";
    return std::system("command -v mpirun > /dev/null") != 0 ? "no mpirun on this machine" : "";
  }
  [[nodiscard]] static Surroundings mpirun() {
    Surroundings s;
    s.program = "/usr/bin/env";
    // As root, and more ranks than processors: what a test needs and Open MPI refuses unless told.
    s.environment = {{"OMPI_ALLOW_RUN_AS_ROOT", "1"},
                     {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
                     {"OMPI_MCA_rmaps_base_oversubscribe", "1"},
                     {"ASAN_OPTIONS", "detect_leaks=0"},  // Open MPI's own
                     {"PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe"}};
    return s;
  }
  /// `arguments`: the command and its own.
  static std::vector<std::string> job(int ranks, const std::vector<std::string>& arguments) {
    std::vector<std::string> out{"mpirun", "-n", std::to_string(ranks),
                                 (std::filesystem::path(VSA_BINARY_DIR) / "bin" / "vsa-mpi").string()};
    out.insert(out.end(), arguments.begin(), arguments.end());
    return out;
  }
};

}  // namespace vsa::test
