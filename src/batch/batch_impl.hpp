// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A Batch's insides: the copies as numbers and parameters, and a World for each thread.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "batch/crew.hpp"
#include "batch/parameter_book.hpp"
#include "vsa/batch/batch.hpp"

namespace vsa::batch {

struct Batch::Impl {
  Impl(const engine::World& world, std::size_t copies, std::size_t threads);
  [[nodiscard]] static std::unique_ptr<Impl> made(const engine::World& world, std::size_t copies, std::size_t threads);

  [[nodiscard]] std::size_t copies() const noexcept { return failure.size(); }
  [[nodiscard]] std::size_t actuators() const { return worlds.front().actuators().size(); }
  [[nodiscard]] std::span<double> state(std::size_t copy) { return std::span(numbers).subspan(copy * first.size(), first.size()); }
  [[nodiscard]] bool has_own_parameters(std::size_t copy) const noexcept { return parameters[copy].of != book.first().of; }
  void check_copy(std::size_t copy) const;
  void check(std::span<const std::size_t> which) const;
  void check_commands(std::span<const std::size_t> which) const;

  void command(engine::World& world, std::size_t copy);
  void read(const engine::World& world, std::size_t copy);
  /// The copy's parameters and state into that World, and from it.
  void take(engine::World& world, std::size_t copy);
  void put(std::size_t worker, std::size_t copy);
  void note(engine::World& world, std::size_t copy);
  void step(std::size_t worker, std::size_t copy, int steps, bool commanded) noexcept;
  void step(int steps, std::span<const std::size_t> which, const std::function<void()>& between);
  void begin(std::size_t worker, std::size_t copy);  ///< where all began
  void reset(std::span<const std::size_t> which);
  void restore(std::size_t copy, std::span<const double> from);

  // batch_parameters.cpp
  struct CopyChanges {
    std::size_t copy = 0;
    std::vector<Change> changes;
  };
  void set(std::span<const Setting> settings);
  void randomize(std::uint64_t seed, std::span<const Spread> what, std::span<const std::size_t> which);
  void change(const std::vector<CopyChanges>& all);
  using NextParameters = std::function<CopyParameters(std::size_t worker, std::size_t item)>;
  void use(std::span<const std::size_t> which, const NextParameters& next);

  Crew crew;
  ParameterBook book;
  std::vector<engine::World> worlds;  ///< one a thread
  std::vector<engine::JointHandle> joints;
  std::vector<std::vector<double>> rooms;  ///< of a thread, for a state
  std::vector<double> first, numbers;      ///< states: where all began; copy by copy
  std::vector<CopyParameters> parameters;  ///< of a copy
  bool parameters_differ = false;          ///< they did once: a thread's World may have any
  bool own_memories = true;                ///< no program held other firmware parameters than its actuator's when all began
  std::vector<std::string> failure;
  std::vector<std::vector<std::string>> notices;  ///< of a copy, since they were taken
  std::vector<std::size_t> all;
  std::vector<double> equilibrium, preset;
  std::vector<double> time, shaft, speed, torque, stiffness, motor, position, joint_speed;
  std::vector<scene::Pose> poses;
};

}  // namespace vsa::batch
