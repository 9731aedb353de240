// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The units of a MuJoCo model as one robot: those whose joints move each other are solved together (vsa/host/robot.hpp). What the
// plug-in's functions do is done here; of MuJoCo's they need the model and its data only, so that any program can step units beside
// a MuJoCo of its own (tests/mujoco does with 2.2.2, which has no plug-ins).
//
//   reset(state)               the first sample, into the plug-in's part of mjData
//   observe(d, state)          for sensors: the units as they are, at the positions and speeds of d; then read(unit, …)
//   compute(m, d, state)       torques of the step that comes, t … t + dt, from the present positions, speeds, M and controls
//   advance(m, d, state)       the step has been made: state becomes that of t + dt
//
// PURE: compute() and observe() change nothing but this object's scratch: the same state and data give the same torques, however often
// and whatever was computed between. What decides the future is `state`: numbers without pointers, which MuJoCo copies and sets as it
// likes. So a MuJoCo that steps several mjData needs one object each, and none of them knows of another.
//
// STATE of n units: [how many numbers of it count, begun, which controls were taken as commands (n × 2), what pushed each
// of the model's degrees of freedom in the last step, what constraints did, the seat's without the room
// that nothing takes (vsa/seat/seat.hpp), 0 …]. There is room for one tree of all, and for no knots of trajectories, which nobody can
// command here. Before anything is made of a state, all of it that counts is compared with the one that this object is at.
//
// CONTROLS say where a unit shall be, from the first step on: equilibrium (rad; m of a linear actuator) and preset (the type's unit);
// or the voltages of its motors. A number that isn't finite leaves the command as it is. They become commands on the unit's line at
// the step that first sees them; the line and the program take their time, as on hardware.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "mobility.hpp"
#include "unit_spec.hpp"
#include "vsa/seat/seat.hpp"
#include "vsa/state_io.hpp"

namespace vsa::mujoco {

/// A unit and the model's actuators of that instance, in the model's order: equilibrium, preset; or its motors' voltages.
struct Unit {
  UnitSpec spec;
  std::vector<int> actuators;
};

/// What a sensor tells, in this order. Of a linear actuator m and N instead of rad and N·m; 0 where a type has no such thing. All of
/// it is of the end of the last step, with the shaft where the model has it now.
enum class Reading : std::size_t {
  ticks_1,           ///< motor 1, as its line's master read it last
  ticks_2,           ///< motor 2
  ticks_shaft,       ///< shaft
  current_1_A,       ///< motor 1
  current_2_A,       ///< motor 2
  stiffness,         ///< −∂τ/∂q of the springs, N·m/rad
  preset,            ///< attained, from the pulleys
  equilibrium,       ///< attained
  deflection,        ///< shaft less equilibrium
  torque,            ///< on the shaft, mean over the last step
  energy_supply,     ///< J drawn from the supply since the start
  energy_delivered,  ///< J given to the joint
  energy_stored,     ///< J in springs, motors and presliding, less that of the start
  energy_lost        ///< J turned to heat
};
inline constexpr std::size_t kReadings = static_cast<std::size_t>(Reading::energy_lost) + 1;

class Units {
 public:
  /// Throws InputError with every problem of the units, their actuators and the model's options.
  Units(const mjModel& m, std::vector<Unit> units);
  ~Units();
  Units(const Units&) = delete;
  Units& operator=(const Units&) = delete;
  /// Another, at the first sample, without report. Safe from several threads at once.
  [[nodiscard]] std::unique_ptr<Units> clone() const;

  /// How many numbers the state of such units has in a model of so many degrees of freedom. Throws InputError for what is wrong without one.
  [[nodiscard]] static std::size_t state_size(std::span<const UnitSpec> specs, std::size_t dofs);
  [[nodiscard]] std::size_t state_size() const noexcept { return size_; }
  [[nodiscard]] std::size_t size() const noexcept { return units_.size(); }
  [[nodiscard]] const Unit& unit(std::size_t i) const { return units_[i]; }

  void reset(std::span<double> state) const;
  void compute(const mjModel& m, mjData& d, std::span<const double> state);
  [[nodiscard]] double torque(std::size_t unit) const { return seat_->torques()[unit]; }  ///< of the last compute()
  /// After a step of MuJoCo's that began with compute(); without one since the last time nothing moves.
  void advance(const mjModel& m, mjData& d, std::span<double> state);
  void observe(const mjData& d, std::span<const double> state);
  void read(std::size_t unit, std::span<double> out) const;  ///< kReadings numbers, after observe()
  /// Of another's mjData, which is being copied: what its last compute() foresaw, too.
  void copy_step(const Units& other);

  /// Gets a readable line: a unit's command beyond its range, a joint that is no longer finite.
  void report_to(seat::Seat::Report report) { seat_->report_to(std::move(report)); }

 private:
  struct Joint {
    int id = -1, q = -1, v = -1;
    double start = 0;
  };
  Units(const Units& other, std::unique_ptr<seat::Seat> seat);
  class Holds;
  void begin();
  void find_stiff(const mjModel& m, mjData& d);
  [[nodiscard]] bool held(std::size_t tree) const;
  void renew_held();
  void command(const mjModel& m, const mjData& d);
  void step(const mjModel& m, mjData& d);
  [[nodiscard]] bool is_at(std::span<const double> state) const;
  void take(std::span<const double> state);
  void note();                             ///< here_, of the seat
  [[nodiscard]] Pushed pushed() noexcept;  ///< in the last step

  std::vector<Unit> units_;
  std::size_t dofs_ = 0;  ///< the model's
  std::vector<Joint> joints_;
  std::vector<bool> volts_;                      ///< the unit's controls are its motors' voltages
  std::vector<std::vector<std::size_t>> trees_;  ///< as the seat joins them
  std::vector<std::vector<int>> tree_dofs_;      ///< of them
  std::vector<int> driven_, stiff_;  ///< degrees of freedom: of all units; of those, if the step hardly resolves a spring
  std::vector<double> alone_, last_,
      more_;                         ///< by unit: B_jj as if free; torques of the last step; by unit of a tree: more than those
  std::vector<std::size_t> beside_;  ///< what else changes B (physics/dofs_beside.hpp)
  std::unique_ptr<seat::Seat> seat_;
  std::size_t size_ = 0;
  Mobility mobility_;
  state::Rewriter here_{0, 0};  ///< the state that the seat is at
  bool there_ = false;          ///< it is
  std::vector<double> first_;   ///< that of the first sample
  bool computed_ = false;       ///< here_ is where the step that compute() foresaw leads
};

}  // namespace vsa::mujoco
