// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/record/recorder.hpp"

#include <utility>

#include "vsa/config/faults_text.hpp"

namespace vsa::record {
namespace {

ActuatorInfo describe(const host::ActuatorConfig& config) {
  const auto& law = config.unit.actuator.transmission;
  return {config.name,
          config.joint,
          config.type,
          std::string(config.unit.preset_unit()),
          law ? law->motor_count() : 2,
          {},
          config.unit.actuator.linear()};
}

void add_faults(const ActuatorInfo& actuator, const device::Faults& faults, std::string& all) {
  if (faults == device::Faults{}) return;
  (all += all.empty() ? "" : "; ") += actuator.name + " " + config::faults_text(faults);
}

RunInfo info_of(const host::Simulation& world, const RecorderOptions& options) {
  RunInfo info = record::describe(world);
  if (!options.faults.empty()) info.faults = options.faults;
  return info;
}

}  // namespace

void read(const host::Simulation& world, Sample& sample) {
  sample.time_ns = world.time_ns();
  sample.actuators.clear();
  sample.ledger = {};
  for (std::size_t r = 0; r < world.robot_count(); ++r) {
    for (std::size_t i = 0; i < world.robot(r).size(); ++i) sample.actuators.push_back(world.robot(r).read(i));
    sample.ledger += world.robot(r).ledger();
  }
  sample.poses.resize(world.links().size());
  world.poses(sample.poses);
  sample.bodies = world.body_energy();
}

RunInfo describe(const host::Simulation& world) {
  RunInfo info{world.name(), world.step_s(), {}, world.links()};
  for (std::size_t r = 0; r < world.robot_count(); ++r) {
    RobotInfo robot{world.robot_model(r), {}};
    for (const host::ActuatorConfig& a : world.robot(r).config().actuators) {
      robot.actuators.push_back(describe(a));
      const std::size_t index = robot.actuators.size() - 1;
      robot.actuators.back().links = links_of_joint(robot.model, a.joint, index, info.links);
      add_faults(robot.actuators.back(), world.robot(r).faults(index), info.faults);
    }
    info.robots.push_back(std::move(robot));
  }
  return info;
}

Recorder::Recorder(const host::Simulation& world, const std::filesystem::path& directory, RecorderOptions options)
    : record_{info_of(world, options), directory, std::move(options)} {
  read(world, sample_);
  record_.add(sample_);
}

void Recorder::sample(const host::Simulation& world) {
  if (!record_.due(world.time_ns())) return;
  read(world, sample_);
  record_.add(sample_);
}

std::filesystem::path Recorder::finish(const std::vector<Statistic>& summary, std::string_view note) {
  return record_.finish(summary, note);
}

}  // namespace vsa::record
