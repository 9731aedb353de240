// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One emulated unit: its program (firmware::Program, 1 kHz, sample and hold), its electronics and its physics, driven by a host's
// steps.
//
// A host step [t, t + dt) is cut at every firmware tick and at substep_max_s. At a tick, the encoders are sampled on the path first
// predicted, the program runs, and the bridges hold their voltages until the next tick. Each tick happens once; the physics between
// them is then solved for the path that the shaft really takes (device/joint_solver.hpp), with those voltages. Only ticks inside a
// step depend on the prediction, whose error is of second order in the step.
//
// Where several units share a line or a robot, their owner runs the ticks, all units' first tick before anyone's second, with the
// bytes between (device/chain.hpp), and solves the joints of a kinematic tree together:
//     begin_step;  predict;  for each tick { bytes up to step_tick_ns;  sample;  the program's tick;  hold };  solve
// `step` does this for a unit alone.
//
// What isn't the program: encoder, ADC, bridge. The program's duty, a percentage after its supply limit, drives the bridge as
// (output of the law, limit in force); a motor whose enable pin is low is braked or open (drive.off_mode), one that is unplugged is
// open.
//
// A unit with a servo (vsa/control/servo.hpp) has no program and no line: at each tick the servo reads the same encoders, and the
// bridge gives the voltages that it asks for.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "vsa/actuator/actuator.hpp"
#include "vsa/control/servo.hpp"
#include "vsa/device/dice.hpp"
#include "vsa/device/faults.hpp"
#include "vsa/device/joint_solver.hpp"
#include "vsa/device/unit_config.hpp"
#include "vsa/firmware/program.hpp"
#include "vsa/state.hpp"

namespace vsa::device {

inline constexpr int kMaxTicksPerStep = 17;  ///< host steps up to 16 ms

/// What the bridges hold from one tick to the next.
struct Held {
  std::array<double, 2> voltage{};                                                            ///< V
  std::array<drive::Terminal, 2> terminal{drive::Terminal::driven, drive::Terminal::driven};  ///< of each motor
  double supply_V = 0;  ///< where the enable pin is modulated, by a duty of voltage/supply
  static auto fields(auto& s, auto&& visit) {
    return visit("voltage", "V", s.voltage, "terminal", "", s.terminal, "supply", "V", s.supply_V);
  }
};

/// A shaft's angle (rad) and speed (rad/s).
struct ShaftMotion {
  double angle = 0,  ///< q
      speed = 0;     ///< q̇
  static auto fields(auto& s, auto&& visit) { return visit("angle", "rad", s.angle, "speed", "rad/s", s.speed); }
};

/// Beyond the first a step hardly resolves a spring's swing, beyond the second it doesn't.
inline constexpr double kHardlyResolved = 0.25, kUnresolved = 1.0;  ///< (ω·dt)²
/// (ω·dt)² of the shaft on its friction's bristle beyond which that is an edge, which a solution must be looked for on.
inline constexpr double kEdge = 100;
/// All that changes of a unit; the same size for every unit. It goes on with equal parameters only: Unit::adopt takes it to others.
struct UnitState {
  actuator::ActuatorState actuator;  ///< motors, springs, ledger
  Held held;                         ///< by the bridges, until the next tick
  std::int32_t limit_pct = 100;      ///< the program's supply limit after its last tick
  bool supply_on = true;             ///< Robot::set_supply
  bool started = false;              ///< whether there was a step; the next ones are what was promised to the host in it
  double start_y = 0;                ///< y where its path began, rad
  double applied_torque = 0;         ///< mean torque that the host got, N·m
  double path_work = 0;              ///< that the actuator booked along its own path, J
  double last_speed = 0;             ///< v at its start, rad/s
  double last_dt = 0;                ///< its length, s
  double unresolved = 0;  ///< (ω·dt)² of its spring on the inertia behind the joint, where it first went beyond ¼, or 1
  ShaftMotion reached;    ///< where the shaft is at the last step's end, as foreseen
  firmware::ProgramState program;              ///< of a unit without a servo
  Faults faults;                               ///< in force
  std::array<std::int32_t, 3> last_encoder{};  ///< what a stuck encoder says
  Dice dice;                                   ///< of the encoders' noise
  control::ServoState servo;                   ///< of a unit that has one
  static auto fields(auto& s, auto&& visit) {
    return visit("physics", "", s.actuator, "held", "", s.held, "limit", "%", s.limit_pct, "supply_on", "", s.supply_on, "started",
                 "", s.started, "start_y", "rad", s.start_y, "applied_torque", "N·m", s.applied_torque, "path_work", "J",
                 s.path_work, "last_speed", "rad/s", s.last_speed, "last_dt", "s", s.last_dt, "unresolved", "", s.unresolved,
                 "reached", "", s.reached, "program", "", s.program, "faults", "", s.faults, "last_encoder", "", s.last_encoder,
                 "dice", "", s.dice, "servo", "", s.servo);
  }
  [[nodiscard]] const char* impossible() const noexcept;
};

/// What a host tells of the shaft at the start of a step (see host::JointIn).
struct ShaftIn {
  double angle = 0;            ///< q at the step's start, rad
  double speed = 0;            ///< v, rad/s
  double inverse_inertia = 0;  ///< A = B_jj, 1/(kg·m²); 0: the shaft's motion is prescribed
  /// Somebody put the shaft there since the last step: its change of angle was no work, that of its speed no acceleration.
  bool placed = false;
  double free_acceleration = std::numeric_limits<double>::quiet_NaN();  ///< host::JointIn's, rad/s²; NaN: not told
};

/// A host step under way: the owner's scratch, of no meaning between steps.
struct StepPlan {
  std::int64_t t_ns = 0,                        ///< when the step begins
      dt_ns = 0;                                ///< how long it is
  bool whole = false;                           ///< one segment: no tick inside
  bool ticked = false;                          ///< its tick was made by JointTrials::tick
  bool tried = false;                           ///< for a Δy, in a step of several segments
  ShaftIn in;                                   ///< as it was told
  double y = 0;                                 ///< where the path begins
  double free = 0;                              ///< Δy if the torques of this tree stay what they were
  double last_torque = 0;                       ///< that they were
  double dy = 0;                                ///< Δy as far as it is known
  actuator::Lead lead;                          ///< of the step as a whole
  double shaft_weight = 0;                      ///< w of the shaft's friction
  std::int64_t walked_ns = 0;                   ///< how far the actuator has gone to be sampled
  std::size_t held_count = 0;                   ///< entries of `held`
  std::array<Held, kMaxTicksPerStep + 1> held;  ///< from each tick to the next; the first: from the step's start
  actuator::ActuatorState start;                ///< where it stood, if it went
  actuator::Segment last;                       ///< of the path's trials
  actuator::SegmentResult path;                 ///< what the last trial found for the transmission
  drive::FrictionTorque rub;                    ///< and for the shaft's friction
};

/// Where a unit is put; see Unit::place.
struct UnitPlace {
  double shaft_rad = 0;    ///< q
  double speed = 0;        ///< q̇, rad/s
  double equilibrium = 0;  ///< commanded, rad
  double preset = 0;       ///< commanded
  double lag_s = 0;        ///< half a host step: shaft and pulleys stand where the coupling sees them, y = q − lag·q̇
};

template <class T>
struct UnitPhysics;
class PlainTicks;

/// One emulated unit: its controller (the qbmove's program, or a servo), its electronics and its physics, driven by a host's steps.
/// Holds parameters and what follows from them; the state is the owner's, so that equal units share a Unit. Not for two threads at
/// once: it has scratch.
class Unit {
 public:
  explicit Unit(UnitConfig config);  ///< throws InputError with all that validate() finds
  /// Of a config() that was checked. `physics`: the physics() of a unit of the same, prepared for its steps; `like`: one with which it
  /// may have something in common, which then isn't worked out again. Either may be null.
  Unit(UnitConfig checked, const actuator::Actuator* physics, const Unit* like);
  [[nodiscard]] const UnitConfig& config() const noexcept { return config_; }           ///< as checked
  [[nodiscard]] const firmware::Program& program() const noexcept { return program_; }  ///< of a unit with a servo: unused
  [[nodiscard]] const control::Servo* servo() const noexcept { return servo_ ? &*servo_ : nullptr; }  ///< null: it has the program

  /// At rest on its references for (equilibrium, preset), on for long, motors enabled, with the shaft where it is; with a torque
  /// servo the pulley stands where the spring gives what it should.
  [[nodiscard]] UnitState initial(double equilibrium_rad, double preset, double shaft_rad, std::uint8_t id = 1) const noexcept;
  /// Just switched on: motors off, pulleys at 0. A servo is on at once, with the command 0.
  [[nodiscard]] UnitState switched_on(double shaft_rad, std::uint8_t id, std::int64_t now_ns) const noexcept;

  /// Puts a unit somewhere as if it had been there for long: pulleys on the law's references for (equilibrium, preset), carried
  /// with the shaft by its speed; frictions relaxed; the program's references, encoder readings and turns as they are there; the
  /// ledger begins. What stays: supply, faults, parameter memory, and whether the motors are on.
  void place(UnitState& state, const UnitPlace& at) const noexcept;
  /// Adds why the program couldn't hold that place: references beyond its limits or its 16 bits, a preset beyond preset_max.
  void check_place(const UnitState& state, const UnitPlace& at, std::string_view where, Problems& problems) const;
  /// The host has put the shaft there, between two steps: neither work nor acceleration, its frictions relaxed, the stored energy is
  /// what it is there. Orders, pulleys and the program stay.
  void relocate(UnitState& state, double shaft_rad, double speed) const noexcept;
  /// Makes the state of a unit with other parameters one of this. Angles, speeds, currents, the gears' bristles and the program's
  /// loop go on; springs and the other frictions begin relaxed where they are, the ledger begins anew. Where the parameter memory
  /// differs, the program has the new one at once, with its ID.
  void adopt(UnitState& state, const UnitConfig& from) const noexcept;

  /// One host step of a unit without a line; returns the mean torque on the shaft (spring and shaft friction).
  double step(UnitState& state, std::int64_t t_ns, std::int64_t dt_ns, const ShaftIn& in) noexcept;
  /// Whether the last step ended by this object found its solution (JointSolver::solve).
  [[nodiscard]] bool settled() const noexcept { return settled_; }
  /// Whether the shaft's friction is an edge beside this step, on what is behind the joint alone.
  [[nodiscard]] bool has_edge(const StepPlan& plan) const noexcept;

  /// A step of several segments has its Δy expected from here on; one of a single segment sets out with its trials.
  void begin_step(UnitState& state, StepPlan& plan, std::int64_t t_ns, std::int64_t dt_ns, const ShaftIn& in) const noexcept;
  /// Goes to the next tick, at `at_ns`, and reads the sensors there.
  firmware::TickInputs sample(UnitState& state, StepPlan& plan, std::int64_t at_ns) noexcept;
  void hold(UnitState& state, StepPlan& plan) const noexcept;  ///< after the program's tick: what the bridges do until the next
  void run_servo(UnitState& state, StepPlan& plan, std::int64_t at_ns) noexcept;  ///< all three of a unit with a servo
  double end_step(UnitState& state, StepPlan& plan) noexcept;  ///< solves a unit alone and ends its step; the torque

  /// The torque for a small Δy, from what the last step left. Whoever solves calls this (before the ticks), then begin_trials,
  /// foresee, attempt as often as needed, finish.
  [[nodiscard]] ShaftTorque expect(const UnitState& state, const StepPlan& plan, double dy) const noexcept;
  void begin_trials(UnitState& state, StepPlan& plan) noexcept;  ///< sets out from the Δy that is known by then
  /// Instead of them, of units that have lanes: whether this step is one for src/device/lanes/kernel.hpp.
  [[nodiscard]] bool may_go_beside(const UnitState& state, const StepPlan& plan) const noexcept;
  /// As `expect`, with what the bridges do now. Steps of one segment only; the others keep to `expect`.
  [[nodiscard]] ShaftTorque foresee(const UnitState& state, StepPlan& plan, double dy) const noexcept;
  /// The torque along y → y + dy. `rough`: of a step with one segment, as Actuator::attempt has it.
  ShaftTorque attempt(UnitState& state, StepPlan& plan, double dy, bool rough) noexcept;
  /// The torque of the last attempt, carried to a Δy that is `move` further, and whether that may be the answer.
  [[nodiscard]] ShaftTorque carried(const UnitState& state, const StepPlan& plan, double move) const noexcept;
  /// Ends the step at the last attempt; `torque` is what the host gets.
  void finish(UnitState& state, StepPlan& plan, double move, double torque) noexcept;

  /// A command that comes by itself: to the servo, or as if SET_INPUTS had just arrived. Of motor_voltages it does nothing.
  void command(UnitState& state, double equilibrium_rad, double preset) const noexcept;
  /// What a servo takes besides: motor_voltages V for each motor, torque_servo N·m for the first. Any other has no use for it.
  static void command_direct(UnitState& state, const std::array<double, 2>& values) noexcept;
  void set_inputs(UnitState& state, std::array<Ticks, 2> inputs) const noexcept;  ///< as if SET_INPUTS had just arrived
  /// Motor references of a command as the bus carries them; the preset is clamped to preset_max, the rest to 16 bits.
  [[nodiscard]] std::array<Ticks, 2> inputs_for(double equilibrium_rad, double preset) const noexcept;

  /// A state as numbers (vsa/state.hpp): the same layout for every unit. They go on with equal parameters only; a unit with others
  /// has to adopt() what was restored. Another size, or numbers that no state has: InputError, and nothing has changed.
  [[nodiscard]] static StateLayout state_layout();
  [[nodiscard]] static std::size_t state_size() noexcept;             ///< the same for every unit
  static void save(const UnitState& state, std::span<double> out);    ///< fills state_size() numbers
  static void restore(UnitState& state, std::span<const double> in);  ///< all or nothing

  /// Takes effect at the next tick. The line's part (Faults::wiring) is the chain's.
  static void set_faults(UnitState& state, const Faults& faults) noexcept;

  /// The first tick of the step [t, t + dt); it may lie behind its end.
  [[nodiscard]] static constexpr std::int64_t first_tick_ns(std::int64_t t_ns) noexcept {
    return (t_ns + firmware::kTickNs - 1) / firmware::kTickNs * firmware::kTickNs;
  }
  [[nodiscard]] actuator::Actuator& physics() noexcept { return actuator_; }  ///< motors, springs and the shaft's friction
  [[nodiscard]] const actuator::Actuator& physics() const noexcept { return actuator_; }  ///< to look at
  [[nodiscard]] std::int64_t substep_ns() const noexcept { return substep_ns_; }          ///< a longer step is cut, ticks or not
  /// What ticks side by side have in common (src/device/plain_ticks.hpp).
  [[nodiscard]] const PlainTicks& plain_ticks() const noexcept { return *plain_ticks_; }

  /// A step's physics, for one unit or several side by side (src/device/unit_lanes.hpp).
  template <class T>
  [[nodiscard]] UnitPhysics<T> steps() const noexcept;

 private:
  [[nodiscard]] firmware::TickInputs read_sensors(UnitState& state, double shaft) const noexcept;
  [[nodiscard]] double supply_V(const UnitState& state) const noexcept;
  friend class UnitBatch;
  /// Whether a step is one segment, and of a unit without a line its tick at t, and then the rest of such a step.
  [[nodiscard]] bool whole(std::int64_t t_ns, std::int64_t dt_ns) const noexcept;
  void tick(UnitState& state, std::int64_t t_ns, double shaft_rad) noexcept;
  double step_held(UnitState& state, std::int64_t t_ns, std::int64_t dt_ns, const ShaftIn& in) noexcept;
  double end_whole(UnitState& state, StepPlan& plan) noexcept;
  actuator::Lead set_out(UnitState& state, StepPlan& plan) const noexcept;
  void drive_bridges(UnitState& state) const noexcept;
  double walk(UnitState& state, StepPlan& plan, std::int64_t at_ns) noexcept;
  [[nodiscard]] control::ServoReadings read_servo(UnitState& state, double shaft_rad) const noexcept;
  void tick_servo(UnitState& state, double shaft_rad) const noexcept;
  [[nodiscard]] std::array<double, 2> resting_pulleys(const control::ServoCommand& command, double shaft_rad) const noexcept;
  void settle_servo(UnitState& state, const std::array<double, 2>& pulleys, double shaft_rad) const noexcept;
  void find_shaft(UnitState& state, double shaft_rad) const noexcept;
  [[nodiscard]] double lead() const noexcept;  ///< of a torque servo: how far the shaft goes with a radian of the pulley
  void place_servo(UnitState& placed, const UnitPlace& at) const noexcept;
  void check_servo_place(const UnitPlace& at, std::string_view where, Problems& problems) const;
  [[nodiscard]] std::int64_t segment_ns(std::int64_t t_ns, std::int64_t dt_ns, std::int64_t walked_ns) const noexcept;

  UnitConfig config_;
  std::int64_t substep_ns_;
  firmware::Program program_;
  std::optional<control::Servo> servo_;
  drive::Friction shaft_friction_;
  drive::Friction tendon_;
  actuator::Actuator actuator_;
  std::shared_ptr<const PlainTicks> plain_ticks_;
  StepPlan plan_;  // scratch of step(): its thousand bytes are cleared once
  bool settled_ = true;
  firmware::Output out_;  // of a unit without a line: nobody hears it
};

}  // namespace vsa::device
