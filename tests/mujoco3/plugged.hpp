// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A MuJoCo from 3.2 on with the plug-in loaded, and models for it as `vsa export` writes them.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>
#include <vector>

namespace vsa::mujoco::test {

struct Deleter {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
  void operator()(mjData* d) const { mj_deleteData(d); }
};
using ModelPtr = std::unique_ptr<mjModel, Deleter>;
using DataPtr = std::unique_ptr<mjData, Deleter>;

/// What a program prints; empty where it failed.
[[nodiscard]] std::string output_of(const std::string& command);

/// A world's model, of `vsa export --mjcf WORLD --plugin`. Once a process for each.
[[nodiscard]] const mjModel& exported(const std::string& world);

/// From text; null, and MuJoCo's error.
[[nodiscard]] ModelPtr load(const std::string& mjcf, std::string& error);

/// Commands of motion.hpp, then a step; `phase` shifts them.
void step(const mjModel& m, mjData& d, int number, double phase = 0);

/// What decides the future, and the first guess of the solver.
[[nodiscard]] std::vector<double> state_of(const mjModel& m, const mjData& d);
void set_state(const mjModel& m, mjData& d, const std::vector<double>& state);

/// One joint with a unit of that configuration and those actuators.
[[nodiscard]] std::string one_joint(const std::string& config, const std::string& actuators, const std::string& option = "",
                                    const std::string& more_instances = "");
inline const std::string kType = R"(<config key="type" value="qbmove_maker_pro_6_1"/>)";
inline const std::string kActuators = R"(<plugin name="e" joint="elbow" plugin="vsasim.unit" instance="elbow"/>
                                         <plugin name="p" joint="elbow" plugin="vsasim.unit" instance="elbow"/>)";

}  // namespace vsa::mujoco::test
