// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Many copies of a world, stepped by several threads.
//
//   vsa::batch::Batch batch(vsa::engine::World::load("snake_flat.sdf"), 256);
//   for (std::size_t c = 0; c < batch.size(); ++c) batch.equilibrium()[c * batch.actuators()] = 0.01 * c;
//   batch.step(10);
//   batch.shaft_rad()[…];
//
// A copy is its state as numbers (engine::World::save) and its parameters; each thread has one World, takes a copy's numbers and
// parameters, steps, and puts the numbers back. So a further copy costs 8 bytes a number and its readings, and which thread steps it,
// how many there are and in which order changes no bit: each copy goes as a World by itself would that has its parameters.
//
// After fork() the child has the copies as they were, and threads of its own as soon as it steps.
//
// Arrays are by copy, then by actuator, joint or link; they stay where they are as long as the Batch does. One thread calls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/batch/spread.hpp"
#include "vsa/engine/world.hpp"

namespace vsa::batch {

/// Of a copy; failed: it is stepped no more until it is set anew.
enum class Status { running, failed };
/// What a robot of a copy has to tell (host::Notice): what was clamped, what a step can't resolve, energy out of nothing.
struct Notice {
  std::size_t copy = 0;  ///< below Batch::size()
  std::string text;      ///< one line, with the numbers
};

/// Many copies of a world: states and parameters as rows, stepped by a crew of threads. One thread calls; blocks until all have
/// stepped.
class Batch {
 public:
  /// Copies of the world as it is, its hands (pulls, wrenches, torques) and parameters included. threads: how many step, the caller
  /// one of them; 0: as many as the machine has. InputError: no copies, more than kMostThreads or than the system starts, a state
  /// without numbers (engine::World::save). std::bad_alloc: no memory for that many copies and threads, as its text says.
  Batch(const engine::World& world, std::size_t copies, std::size_t threads = 0);
  ~Batch();
  Batch(Batch&&) noexcept;
  Batch& operator=(Batch&&) noexcept;
  static constexpr std::size_t kMostThreads = 1024;  ///< of `threads`

  [[nodiscard]] std::size_t size() const;                                ///< copies
  [[nodiscard]] std::size_t threads() const;                             ///< that step
  [[nodiscard]] std::size_t actuators() const;                           ///< of a copy, in the order of World::actuators()
  [[nodiscard]] std::size_t links() const;                               ///< of a copy, in the order of World::links()
  [[nodiscard]] const std::vector<engine::JointHandle>& joints() const;  ///< with one axis, in the order of World::joints()
  [[nodiscard]] const engine::World& world() const;                      ///< for names; its state is that of any copy

  /// Commands, given at the beginning of every step(): size() × actuators(). NaN: that channel keeps what it has. At first all NaN.
  [[nodiscard]] std::span<double> equilibrium();  ///< rad
  [[nodiscard]] std::span<double> preset();       ///< in the law's preset unit

  /// World::step() so many times, 1 … 1e9, of every copy or of those. One that fails (a blow-up, a state without numbers) is marked,
  /// stays where it was before it failed, isn't stepped any more until it is set anew, and the others go on. InputError: a copy that
  /// isn't there or is named twice, an infinite command; nothing was stepped then.
  void step(int steps = 1);
  void step(int steps, std::span<const std::size_t> which);  ///< of those copies
  /// The same in slices, so that it can be ended: `between` is called between two of them in the caller's thread, where all of `which`
  /// that run are at the same step; what it throws ends the stepping there. A slice is of kSlice World steps of all copies together,
  /// but of kLeastSlice of each at least. The bits are those of one piece, but of a copy whose state can't be saved: it stays where
  /// its slice began.
  void step(int steps, std::span<const std::size_t> which, const std::function<void()>& between);
  static constexpr int kSlice = 4096,  ///< World steps of a slice, of all copies together
      kLeastSlice = 10;                ///< World steps of each copy in it, at least
  /// Back to where the Batch began, with the copy's parameters: as the World was then, after World::set_parameters().
  void reset();
  void reset(std::span<const std::size_t> which);  ///< of those copies
  /// Numbers of a world of this file (World::save), or of another copy: that copy goes on from there with its own parameters, those of
  /// its firmware, too. InputError: no such state, and nothing has changed.
  void restore(std::size_t copy, std::span<const double> state);
  /// Numbers as World::save gives them; valid until that copy is stepped or set.
  [[nodiscard]] std::span<const double> state(std::size_t copy) const;

  /// One number of one copy; at first all have the World's. A key is one of the actuator's type (drive.friction_Nm …: `vsa
  /// actuators TYPE`), or of a link: link.mass_kg, with which the inertia goes in proportion; link.inertia_factor, 1e-6 … 1e6 on
  /// top of that, at first 1; link.friction, Coulomb's of all its shapes. Who: an actuator or a link as World finds it; empty:
  /// every one that has the key; one of motor 2 alone (drive_2.…) have those whose type or overrides give it. It holds from
  /// the next step on, and the copy becomes what World::set_parameters() would make of
  /// it: motion goes on. InputError, here and below: what isn't there, what is out of bounds, with copy, name, key and what is
  /// allowed; nothing has changed then.
  void set(std::size_t copy, std::string_view who, std::string_view key, double value);
  void set(std::size_t copy, std::string_view who, std::string_view key, std::string_view word);  ///< "coast", "true"
  void set(std::span<const Setting> settings);                                                    ///< of equal ones the last counts
  /// A draw for each, which depends on seed, copy, who and key alone (spread.hpp): neither on threads nor on other copies or draws.
  void randomize(std::uint64_t seed, std::span<const Spread> what);
  void randomize(std::uint64_t seed, std::span<const Spread> what, std::span<const std::size_t> which);  ///< of those copies
  void reset_parameters();                                    ///< the World's again; reset() leaves them
  void reset_parameters(std::span<const std::size_t> which);  ///< of those copies
  [[nodiscard]] std::vector<std::string> owners(const std::string& who, const std::string& key) const;  ///< names of those meant
  /// Now: of each of them; of the first; as text. A word is its place in the list of words; NaN: optional, and not given.
  [[nodiscard]] std::vector<double> values(std::size_t copy, const std::string& who, const std::string& key) const;
  [[nodiscard]] double value(std::size_t copy, const std::string& who, const std::string& key) const;      ///< of the first
  [[nodiscard]] std::string text(std::size_t copy, const std::string& who, const std::string& key) const;  ///< of the first
  /// For a World of this file: World::set_parameters().
  [[nodiscard]] std::shared_ptr<const engine::World::Parameters> parameters(std::size_t copy) const;

  [[nodiscard]] Status status(std::size_t copy) const;               ///< InputError: no such copy
  [[nodiscard]] const std::string& failure(std::size_t copy) const;  ///< why it failed; empty: it didn't
  /// Since the last call, by copies, in the order of their steps. Each is told once until its copy is reset; not what the World had told
  /// before the Batch began. Of a copy that nobody asks of for long the first kMostNotices are kept, and a line that says so.
  [[nodiscard]] std::vector<Notice> take_notices();
  static constexpr std::size_t kMostNotices = 32;  ///< of a copy, between two calls

  /// Readings after the last step(), reset() or restore() of each copy, as World has them.
  [[nodiscard]] std::span<const double> time_s() const;                 ///< size()
  [[nodiscard]] std::span<const double> shaft_rad() const;              ///< size() × actuators(), as the next ones
  [[nodiscard]] std::span<const double> shaft_speed_rad_per_s() const;  ///< as shaft_rad()
  [[nodiscard]] std::span<const double> torque_Nm() const;              ///< as shaft_rad(); of springs and frictions
  [[nodiscard]] std::span<const double> stiffness_Nm_per_rad() const;   ///< as shaft_rad(); σ
  [[nodiscard]] std::span<const double> motor_rad() const;              ///< size() × actuators() × 2
  [[nodiscard]] std::span<const double> joint_position() const;         ///< size() × joints().size(); rad or m
  [[nodiscard]] std::span<const double> joint_speed() const;            ///< as joint_position(); rad/s or m/s
  [[nodiscard]] std::span<const scene::Pose> poses() const;             ///< size() × links()

 private:
  struct Impl;
  Owner<Impl> impl_;
};

}  // namespace vsa::batch
