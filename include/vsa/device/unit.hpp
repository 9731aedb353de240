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
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "vsa/actuator/actuator.hpp"
#include "vsa/device/dice.hpp"
#include "vsa/device/faults.hpp"
#include "vsa/device/joint_solver.hpp"
#include "vsa/firmware/program.hpp"
#include "vsa/state.hpp"

namespace vsa::device {

inline constexpr int kMaxTicksPerStep = 17;  ///< host steps up to 16 ms

struct UnitConfig {
  actuator::ActuatorParams actuator;
  firmware::ProgramParams program;
  firmware::Memory memory = firmware::initial_memory(firmware::Model::maker_pro);  ///< both EEPROM pages; the ID is the robot's
  double preset_max = 0.785;                                                       ///< accepted |preset| of a command in SI units
  double substep_max_s = 1e-3;                                                     ///< longest physics segment, (0, 1 ms]

  /// Whether the program limits the duty by the supply.
  [[nodiscard]] bool supply_limited() const noexcept {
    return program.supply_table.value_or(program.model == firmware::Model::maker_pro);
  }
  /// The references that the program lets motor i have, raw, in the sense of the wire; the widest that it can hold if it doesn't
  /// limit.
  [[nodiscard]] std::array<std::int32_t, 2> reference_range_raw(int i) const noexcept;
  bool operator==(const UnitConfig&) const = default;
};

/// Adds what no unit could have: numbers that aren't finite or outside what the models need, no transmission, what doesn't go
/// together. `where` leads each key. A file's own bounds are checked where it is read.
void validate(const UnitConfig& config, std::string_view where, Problems& problems);
/// Whether two units are alike, laws compared by value (elastic::Transmission::equals).
[[nodiscard]] bool alike(const UnitConfig& a, const UnitConfig& b) noexcept;

/// What the bridges hold from one tick to the next.
struct Held {
  std::array<double, 2> voltage{};
  std::array<drive::Terminal, 2> terminal{drive::Terminal::driven, drive::Terminal::driven};
  double supply_V = 0;  ///< where the enable pin is modulated, by a duty of voltage/supply
  static auto fields(auto& s, auto&& visit) {
    return visit("voltage", "V", s.voltage, "terminal", "", s.terminal, "supply", "V", s.supply_V);
  }
};

/// A shaft's angle (rad) and speed (rad/s).
struct ShaftMotion {
  double angle = 0, speed = 0;
  static auto fields(auto& s, auto&& visit) { return visit("angle", "rad", s.angle, "speed", "rad/s", s.speed); }
};

struct UnitState {
  actuator::ActuatorState actuator;
  Held held;
  std::int32_t limit_pct = 100;  ///< the program's supply limit after its last tick
  bool supply_on = true;
  // what was promised to the host in the last step
  bool started = false;
  double start_y = 0;
  double applied_torque = 0;
  double path_work = 0;
  double last_speed = 0;
  double last_dt = 0;
  double unresolved = 0;  ///< (ω·dt)² of its spring on the inertia behind the joint, where it first went beyond 1
  ShaftMotion reached;    ///< where the shaft is at the last step's end, as foreseen
  firmware::ProgramState program;
  Faults faults;
  std::array<std::int32_t, 3> last_encoder{};  ///< what a stuck encoder says
  Dice dice;                                   ///< of the encoders' noise
  static auto fields(auto& s, auto&& visit) {
    return visit("physics", "", s.actuator, "held", "", s.held, "limit", "%", s.limit_pct, "supply_on", "", s.supply_on, "started",
                 "", s.started, "start_y", "rad", s.start_y, "applied_torque", "N·m", s.applied_torque, "path_work", "J",
                 s.path_work, "last_speed", "rad/s", s.last_speed, "last_dt", "s", s.last_dt, "unresolved", "", s.unresolved,
                 "reached", "", s.reached, "program", "", s.program, "faults", "", s.faults, "last_encoder", "", s.last_encoder,
                 "dice", "", s.dice);
  }
  [[nodiscard]] const char* impossible() const noexcept;
};

struct ShaftIn {
  double angle = 0;            ///< q at the step's start, rad
  double speed = 0;            ///< v, rad/s
  double inverse_inertia = 0;  ///< A = B_jj, 1/(kg·m²); 0: the shaft's motion is prescribed
  /// Somebody put the shaft there since the last step: its change of angle was no work, that of its speed no acceleration.
  bool placed = false;
};

/// A host step under way: the owner's scratch, of no meaning between steps.
struct StepPlan {
  std::int64_t t_ns = 0, dt_ns = 0;
  bool whole = false;  ///< one segment: no tick inside
  ShaftIn in;
  double y = 0;                ///< where the path begins
  double free = 0;             ///< Δy if the torques of this tree stay what they were
  double last_torque = 0;      ///< that they were
  double dy = 0;               ///< Δy as far as it is known
  actuator::Lead lead;         ///< of the step as a whole
  double shaft_weight = 0;     ///< w of the shaft's friction
  std::int64_t walked_ns = 0;  ///< how far the actuator has gone to be sampled
  std::size_t held_count = 0;
  std::array<Held, kMaxTicksPerStep + 1> held;
  actuator::ActuatorState start;  ///< where it stood, if it went
  actuator::Segment last;         ///< of the path's trials
  actuator::SegmentResult path;   ///< what the last trial found for the transmission
  drive::FrictionTorque rub;      ///< and for the shaft's friction
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

class Unit {
 public:
  explicit Unit(UnitConfig config);  ///< throws InputError with all that validate() finds
  [[nodiscard]] const UnitConfig& config() const noexcept { return config_; }
  [[nodiscard]] const firmware::Program& program() const noexcept { return program_; }

  /// At rest on its references for (equilibrium, preset), on for long, motors enabled, with the shaft where it is.
  [[nodiscard]] UnitState initial(double equilibrium_rad, double preset, double shaft_rad, std::uint8_t id = 1) const noexcept;
  /// Just switched on: motors off, pulleys at 0.
  [[nodiscard]] UnitState switched_on(double shaft_rad, std::uint8_t id, std::int64_t now_ns) const noexcept;

  /// Puts a unit somewhere as if it had been there for long: pulleys on the law's references for (equilibrium, preset), carried
  /// with the shaft by its speed; frictions relaxed; the program's references, encoder readings and turns as they are there; the
  /// ledger begins. What stays: supply, faults, parameter memory, and whether the motors are on.
  void place(UnitState& state, const UnitPlace& at) const noexcept;
  /// Adds why the program couldn't hold that place: references beyond its limits or its 16 bits, a preset beyond preset_max.
  void check_place(const UnitState& state, const UnitPlace& at, std::string_view where, Problems& problems) const;
  /// Makes the state of a unit with other parameters one of this. Angles, speeds, currents, the gears' bristles and the program's
  /// loop go on; springs and the other frictions begin relaxed where they are, the ledger begins anew. Where the parameter memory
  /// differs, the program has the new one at once, with its ID.
  void adopt(UnitState& state, const UnitConfig& from) const noexcept;

  /// One host step of a unit without a line; returns the mean torque on the shaft (spring and shaft friction).
  double step(UnitState& state, std::int64_t t_ns, std::int64_t dt_ns, const ShaftIn& in) noexcept;
  /// Whether the last step ended by this object found its solution (JointSolver::solve).
  [[nodiscard]] bool settled() const noexcept { return settled_; }

  /// A step of several segments has its Δy expected from here on; one of a single segment sets out with its trials.
  void begin_step(UnitState& state, StepPlan& plan, std::int64_t t_ns, std::int64_t dt_ns, const ShaftIn& in) const noexcept;
  /// Goes to the next tick, at `at_ns`, and reads the sensors there.
  firmware::TickInputs sample(UnitState& state, StepPlan& plan, std::int64_t at_ns) noexcept;
  /// After the program's tick: what the bridges do until the next.
  void hold(UnitState& state, StepPlan& plan) const noexcept;
  /// Solves a unit alone and ends its step; returns the torque.
  double end_step(UnitState& state, StepPlan& plan) noexcept;

  // For whoever solves: expect (before the ticks) | begin_trials, foresee, attempt as often as needed, finish.

  /// The torque for a small Δy, from what the last step left.
  [[nodiscard]] ShaftTorque expect(const UnitState& state, const StepPlan& plan, double dy) const noexcept;
  void begin_trials(UnitState& state, StepPlan& plan) noexcept;
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

  /// As if SET_INPUTS had just arrived.
  void set_inputs(UnitState& state, std::array<Ticks, 2> inputs) const noexcept;
  /// Motor references of a command as the bus carries them; the preset is clamped to preset_max, the rest to 16 bits.
  [[nodiscard]] std::array<Ticks, 2> inputs_for(double equilibrium_rad, double preset) const noexcept;

  /// A state as numbers (vsa/state.hpp): the same layout for every unit. They go on with equal parameters only; a unit with others
  /// has to adopt() what was restored. Another size, or numbers that no state has: InputError, and nothing has changed.
  [[nodiscard]] static StateLayout state_layout();
  [[nodiscard]] static std::size_t state_size() noexcept;
  static void save(const UnitState& state, std::span<double> out);
  static void restore(UnitState& state, std::span<const double> in);

  /// Takes effect at the next tick. The line's part (Faults::wiring) is the chain's.
  static void set_faults(UnitState& state, const Faults& faults) noexcept;

  /// The first tick of the step [t, t + dt); it may lie behind its end.
  [[nodiscard]] static constexpr std::int64_t first_tick_ns(std::int64_t t_ns) noexcept {
    return (t_ns + firmware::kTickNs - 1) / firmware::kTickNs * firmware::kTickNs;
  }
  [[nodiscard]] actuator::Actuator& physics() noexcept { return actuator_; }
  [[nodiscard]] const actuator::Actuator& physics() const noexcept { return actuator_; }

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
  void set_out(UnitState& state, StepPlan& plan) const noexcept;
  void drive_bridges(UnitState& state) const noexcept;
  [[nodiscard]] std::int64_t segment_ns(const StepPlan& plan, std::int64_t walked_ns) const noexcept;

  UnitConfig config_;
  std::int64_t substep_ns_;
  firmware::Program program_;
  drive::Friction shaft_friction_;
  drive::Friction tendon_;
  actuator::Actuator actuator_;
  JointSolver alone_;
  bool settled_ = true;
  firmware::Output out_;  // of a unit without a line: nobody hears it
};

}  // namespace vsa::device
