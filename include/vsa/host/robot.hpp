// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// All that a simulator sees of a robot made of VSAs: shaft angles and speeds in, shaft torques out.
//
// THE SHAFT COUPLING, one decision for every host
// A host integrates v' = v + dt·(a_other + B τ), q' = q + dt·v' (semi-implicit Euler: MuJoCo, DART, ODE and Bullet do), B =
// (M⁻¹)_aa over the actuated joints of a kinematic tree. Seen from
//     y = q − (dt/2) v,
// the same step reads y' = y + dt·(v + v')/2: the midpoint rule. So a unit works with y as its shaft angle, and the joints of a
// tree are solved together (device/joint_solver.hpp) for
//     Δy = dt·v + (dt²/2)·(a_other + B τ)                                                                    (1)
// With τ the MEAN torque of the spring over y → y + Δy (elastic::SegmentMean) τ·Δy = −ΔH exactly: an engine with that B gains
// exactly what the springs lose, at any step and any stiffness, in chains as in one joint.
//
// What a step can't resolve would then ring near Nyquist for ever. So the springs look ahead, towards where the engine will have
// the shaft, q' = q + dt·v' = y + 2Δy − (dt/2) v:
//     path y → y + Δy, shifted by w (q' − (y + Δy/2)),   w = (x⁴ − 4⁻⁴)/(16 + x⁴) ≥ 0,   x = ω·dt,  ω² = B_jj σ   (2)
// w is nothing for what is resolved (x = 0.3: 3e-4) and 1 for what isn't: then (2) is backward Euler in q, which brings it to rest.
// Frictions look ahead with a w of their own, from their bristle's stiffness: −k [(1 − w)(u + u')/2 + w u(q')]. In the middle of
// a step they do no work on v' = −v, and a held joint would buzz. What (2) takes from the energy is the ledger's `integrator`.
//   B        1/(kg·m²); per tree with `join` and the last argument of `advance`, else the diagonal per joint, else the configured
//            shaft_inertia_kgm2
//   a_other  acceleration by all else (gravity, contacts, other joints): JointIn::free_acceleration where the host works it out, else
//            from the last step: (v − v_before)/dt − B τ_before
// What (1) mispredicts is not hidden: it is the `coupling` entry of the energy ledger.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vsa/bus/master.hpp"
#include "vsa/device/faults.hpp"
#include "vsa/device/holder.hpp"
#include "vsa/device/port_line.hpp"
#include "vsa/device/reading.hpp"
#include "vsa/device/unit.hpp"
#include "vsa/host/robot_config.hpp"
#include "vsa/owner.hpp"
#include "vsa/state.hpp"

namespace vsa::state {
class Rewriter;
}

namespace vsa::host {

/// What a host tells of one joint at the start of a step.
struct JointIn {
  double angle_rad = 0;        ///< q at the step's start
  double speed_rad_per_s = 0;  ///< v there
  /// B_jj = (M⁻¹)_jj, 0 … 1e12/(kg·m²); none: the unit's configured shaft_inertia_kgm2 is used. Joints of a tree with a matrix have it
  /// there; told besides, it is B_jj as if nothing held the joint, by which a spring is or isn't too fast for the step.
  std::optional<double> inverse_inertia;
  /// Somebody put the joint there since the last step; what that did to angle and speed is neither work nor acceleration.
  bool placed = false;
  /// a_other + B τ_before of this step, ±1e12 rad/s²: how the joint would go on with its tree's torques of the last step (0 where it was
  /// placed, or of the first), by what gravity, springs and dampers do at the present angles and speeds. None: what moved the joint in
  /// the last step goes on; with dampers, followers (mimic) or much weight behind a light link a chain is quiet only if it is told.
  std::optional<double> free_acceleration_rad_per_s2 = std::nullopt;
  static auto fields(auto& s, auto&& visit) {
    return visit("angle", "rad", s.angle_rad, "speed", "rad/s", s.speed_rad_per_s, "inverse_inertia", "1/(kg·m²)",
                 s.inverse_inertia, "placed", "", s.placed, "free_acceleration", "rad/s²", s.free_acceleration_rad_per_s2);
  }
};

/// What an actuator is doing, for topics and recordings: all at one instant, the end of the last step. Physical truth; the unit's
/// own readings are `measured`.
struct ActuatorReading {
  double equilibrium_command_rad = 0;  ///< as it was given; of a trajectory: its value now
  double preset_command = 0;           ///< likewise, in UnitConfig::preset_unit()
  double equilibrium_rad = 0;          ///< attained, from the pulleys
  double preset = 0;                   ///< attained: from the pulleys, or by a torque servo
  double shaft_rad = 0;                ///< q; where the host observed it after its step, else as the unit foresaw it
  double shaft_speed_rad_per_s = 0;    ///< q̇, likewise
  double deflection_rad = 0;           ///< shaft − equilibrium
  double stiffness_Nm_per_rad = 0;     ///< σ at the present deflection
  double torque_Nm = 0;                ///< on the shaft by springs and frictions
  double mean_torque_Nm = 0;           ///< the same as the host got it: over the last step (of several substeps: the last one)
  std::array<double, 2> motor_rad{};   ///< the pulleys
  std::array<double, 2> motor_speed_rad_per_s{};  ///< of the pulleys
  std::array<double, 2> motor_torque_Nm{};        ///< on each pulley by its spring and tendon
  std::array<double, 2> current_A{};              ///< of each winding
  std::array<Ticks, 3> measured{};  ///< motor 1, motor 2, shaft as the bus master last read them; with a client, as they'd be read
};

/// Where an actuator is to stand, and what it has been told. See Robot::place.
struct Placement {
  double angle_rad = 0;                                  ///< of the shaft, q
  double preset = 0;                                     ///< in UnitConfig::preset_unit()
  double speed_rad_per_s = 0;                            ///< of the shaft, q̇; the pulleys go with it
  std::optional<double> equilibrium_rad = std::nullopt;  ///< none: where the springs give no torque (the angle, if they are equal)
};

/// What a robot has to tell of a run. A command that was out of range is clamped as the device does and reported once per actuator.
struct Notice {
  std::optional<std::size_t> actuator;  ///< none: of the robot as a whole
  std::string text;                     ///< one line, with the numbers
};

/// All that a simulator sees of a robot made of VSAs: shaft angles and speeds in, shaft torques out, with units, buses and firmware
/// behind them. One that was moved from throws std::logic_error from everything but its destructor and assignment; advance()
/// aborts.
class Robot {
 public:
  /// Throws InputError for values that no unit could have (validate(); config:: makes valid ones) and for what only the whole
  /// shows (ids, buses).
  explicit Robot(RobotConfig config);
  ~Robot();
  Robot(Robot&&) noexcept;
  Robot& operator=(Robot&&) noexcept;
  /// Another robot with the same parameters in the same state. Commands and faults that no step has taken yet aren't taken along; a
  /// bus with a serial port has one of its own.
  [[nodiscard]] Robot clone() const;

  /// As it is now: set_parameters() changes it. Units that are alike (device::alike) have one law together.
  [[nodiscard]] const RobotConfig& config() const;
  [[nodiscard]] std::size_t size() const;                                               ///< number of actuators
  [[nodiscard]] std::optional<std::size_t> find(std::string_view actuator_name) const;  ///< its index; none: no such name

  /// Which actuators' joints move each other: those of one kinematic tree. An actuator that is in none moves its own joint only.
  /// `shared`: on trees that other robots drive, too, and in none of `trees`; such a robot steps in a RobotGroup (host/robot_group.hpp).
  /// Between steps, by the stepping thread: units go on. Throws InputError for an index twice or out of range.
  void join(std::vector<std::vector<std::size_t>> trees, std::vector<std::size_t> shared = {});
  /// How many numbers `mobility` has: Σ n² over the trees.
  [[nodiscard]] std::size_t mobility_size() const;

  /// One host step [t, t + dt) in integer nanoseconds. in/out have one entry an actuator, in config order. dt in 1 ns … 16 ms.
  /// `mobility`: B of each tree, by rows, one after the other in the order of `join`, 1/(kg·m²); empty: each joint by itself.
  /// `holder`: asked about trees of `join` while they are solved; its accelerations are JointIn::free_acceleration's, which it needs.
  /// Allocates nothing, throws nothing, logs nothing. Spans of another size, a dt outside that range and a t outside 0 … 4e18 ns
  /// are programming errors, as is a robot with shared joints: one line on stderr, and abort. A joint that isn't finite: every
  /// torque is NaN, and the robot stays where it was.
  void advance(std::int64_t t_ns, std::int64_t dt_ns, std::span<const JointIn> in, std::span<double> torques_out,
               std::span<const double> mobility = {}, device::Holder* holder = nullptr) noexcept;

  /// Where the joints are after the host's step, one entry an actuator, for readings; without it those tell what the units foresaw,
  /// which only differs where contacts or others push. Another size: one line on stderr, and abort.
  void observe(std::span<const JointIn> joints) noexcept;

  /// From any thread; taken at the next step's start in order of arrival. NaN or infinity: refused (false). None: keep.
  bool command(std::size_t actuator, std::optional<double> equilibrium_rad, std::optional<double> preset);
  /// Past the law, from the next tick on: motor_voltages V for each motor; torque_servo N·m on the shaft (the first number), added to
  /// what its stiffness gives. InputError: another controller, a number that isn't finite. The stepping thread's.
  void command_direct(std::size_t actuator, const std::array<double, 2>& values);

  /// One actuator's part of several commands that belong together.
  struct Command {
    std::size_t actuator = 0;               ///< an index below size()
    std::optional<double> equilibrium_rad,  ///< none: keeps what it has
        preset;                             ///< in UnitConfig::preset_unit(); none: keeps what it has
  };
  /// Several at once, from any thread: all take effect in the same step, or none where one is refused (false).
  bool command(std::span<const Command> commands);
  /// A point of a trajectory.
  struct Knot {
    double time_s = 0;  ///< after the trajectory's start, ≥ 0
    double value = 0;   ///< rad, or in UnitConfig::preset_unit()
    static auto fields(auto& s, auto&& visit) { return visit("time", "s", s.time_s, "value", "rad, or the preset's", s.value); }
  };
  /// What of an actuator a trajectory leads.
  enum class Channel { equilibrium, preset };
  /// From the next step on, from any thread: linear between knots in simulated time, the last value held; it replaces what that
  /// channel had. No knots, times that don't grow from 0 on, numbers that aren't finite: refused (false).
  bool follow(std::size_t actuator, Channel channel, std::vector<Knot> knots);
  /// One channel's part of several trajectories that belong together.
  struct Path {
    std::size_t actuator = 0;                ///< an index below size()
    Channel channel = Channel::equilibrium;  ///< one of its two
    std::vector<Knot> knots;                 ///< times that increase
  };
  /// Several at once: all begin with the same step, or none where one is refused (false).
  bool follow(std::vector<Path> paths);

  /// Now. InputError, here and below: no such actuator.
  [[nodiscard]] ActuatorReading read(std::size_t actuator, device::Torques torques = device::Torques::told) const;
  [[nodiscard]] std::array<Ticks, 2> received_inputs(std::size_t actuator) const;  ///< references that came over its bus last
  /// Whether some spring swings so fast on what is behind its joint that steps hardly resolve it, ω·dt > ½, found in the first step or
  /// within 128; beyond 1 a notice tells. What such a joint does hangs on contacts, limits and frictions within a step: see `holder`.
  [[nodiscard]] bool is_stiff() const;
  [[nodiscard]] actuator::Ledger ledger(std::size_t actuator) const;  ///< energy ledger since the start or the last reset
  [[nodiscard]] actuator::Ledger ledger() const;                      ///< summed over all actuators
  /// Since the last call. Energy out of nothing is looked for after steps 1, 2, 4 … 64, and then after each 128th.
  [[nodiscard]] std::vector<Notice> take_notices();

  /// Cuts or restores the supply of every unit (0 V: the motors short through the bridge), at once. The stepping thread's.
  void set_supply(bool on);

  /// Puts an actuator somewhere as if it had been there for long, so that there is no kick: shaft at q with q̇, pulleys on the law's
  /// references for (equilibrium, preset), carried along by q̇, frictions relaxed; the commanded equilibrium and preset, the
  /// program's references, encoder readings and turns as they are there; waiting commands for it dropped; its ledger begins anew.
  /// The host sets the joint. With `step_s`, the step that comes, the pulleys stand where the coupling sees the shaft, at y = q −
  /// step/2·q̇; it matters only where q̇ isn't 0. Supply, faults and parameters stay, and motors that are off stay off. InputError:
  /// numbers out of range, or a place that the program can't hold (its limits, its 16 bits). The stepping thread's.
  void place(std::size_t actuator, const Placement& at, double step_s = 0);
  /// The host has put the joint there, between two steps: readings and the ledger's stored energy have the shaft where it is now. The
  /// unit's own orders stay. InputError: no such actuator, what isn't finite.
  void relocate(std::size_t actuator, double angle_rad, double speed_rad_per_s = 0);

  /// Other parameters from the next step on, for a randomised domain, say: checked by device::validate(). Motion, currents, the
  /// gears' bristles and the program's loop go on; springs and the other frictions begin relaxed where they are, the actuator's
  /// ledger begins anew; where firmware parameters differ, the program has them at once. Parameters aren't state: restore() and
  /// reset() keep them. InputError: values out of range, another controller, firmware model or dialect, another number of motors.
  /// The stepping thread's.
  void set_parameters(std::size_t actuator, const UnitConfig& unit);
  /// The same, with what the unit was made from, for who reads config().
  void set_parameters(std::size_t actuator, const UnitConfig& unit, std::string type, std::shared_ptr<const Settings> changed);

  /// All parameters as one value that never changes, for who steps many robots of one kind with one Robot (batch/batch.hpp): those in
  /// force, and `base` with other actuators in it, checked as set_parameters() does (InputError) and prepared for steps of dt_ns.
  [[nodiscard]] std::shared_ptr<const RobotConfig> parameters() const;
  /// `base` with other actuators in it, by their indices; those in force stay.
  [[nodiscard]] std::shared_ptr<const RobotConfig> parameters_with(const RobotConfig& base,
                                                                   std::span<const std::pair<std::size_t, ActuatorConfig>> changes,
                                                                   std::int64_t dt_ns) const;
  /// set_parameters() of every actuator whose own differ.
  void set_parameters(const std::shared_ptr<const RobotConfig>& parameters);
  /// Goes on with those, the state as it is: for a state that came from a robot with them. Allocates.
  void use(const std::shared_ptr<const RobotConfig>& parameters);
  /// Whether the last three take them for their own: InputError for none, and for actuators of other names or controllers than this
  /// robot's. Values that no unit could have they refuse themselves.
  void check(const std::shared_ptr<const RobotConfig>& parameters) const;
  /// Programs whose memory holds other firmware parameters than the robot's get these, with their ids: after a restore() of numbers
  /// that came from a robot with others.
  void renew_memories();
  [[nodiscard]] bool has_own_memories() const;  ///< whether renew_memories() would do nothing

  /// From any thread; from the next step on, until a reset. Throws InputError for values out of bounds or no such actuator.
  void set_faults(std::size_t actuator, const device::Faults& faults);
  void check_faults(std::size_t actuator, const device::Faults& faults) const;  ///< throws what set_faults() would
  [[nodiscard]] const device::Faults& faults(std::size_t actuator) const;       ///< in force

  /// The units' end of a bus's serial port; none if the bus has no serial port. Lives as long as the robot.
  [[nodiscard]] device::PortLine* serial_line(std::size_t bus);

  struct Snapshot;                                                 ///< opaque, copyable value
  [[nodiscard]] std::shared_ptr<const Snapshot> snapshot() const;  ///< of everything but parameters; allocates
  /// Of this robot or of another with the same actuators on the same buses; another's: InputError, and nothing changed. Commands
  /// that no step has taken yet are dropped. Parameters aren't part of it: see set_parameters().
  void restore(const Snapshot& snapshot);
  void check(const Snapshot& snapshot) const;  ///< throws what restore() would
  void reset();                                ///< back to the first sample

  /// The same as numbers (vsa/state.hpp), for a batch, a checkpoint, another program: everything that a snapshot holds, but for the
  /// parameters. Robots with the same actuators, ids and buses have the same layout; that of the parameters is the caller's to keep.
  /// save(), restore() and check() allocate nothing but an error's text.
  ///   save     throws InputError where more is under way than the layout has room for: a trajectory of more than kMostKnots, an
  ///            overcrowded line (device::ChainState::most_speeches); every snapshot() takes that
  ///   restore  throws InputError for another size and for numbers that no state has, and nothing has changed; it drops commands
  ///            that wait. check: whether restore() would throw
  static constexpr std::size_t kMostKnots = 64;
  [[nodiscard]] StateLayout state_layout() const;  ///< names, kinds and units of the numbers, in their order
  [[nodiscard]] std::size_t state_size() const;    ///< how many save() gives
  void save(std::span<double> out) const;          ///< fills state_size() numbers
  void restore(std::span<const double> in);        ///< as restore() of a snapshot, from such numbers
  void check(std::span<const double> in) const;    ///< throws what restore() would
  /// The same less the room that nothing takes (vsa/state_io.hpp), for who does it at every step: the state says how many they are.
  /// Behind what was written there since its begin(). InputError, too: room for less than state_size().
  void save_tight(state::Rewriter& out) const;
  std::size_t restore_tight(std::span<const double> in);  ///< as restore(), from the front; how many it took
  [[nodiscard]] std::uint64_t state_hash() const;         ///< of the numbers that save() gives; allocates

  /// For a host whose step may fail: keep() before it notes what snapshot() would hold, in memory that the robot has for it, so that
  /// nothing is allocated; go_back() is restore() of that, or of the first sample where nothing was kept. join() counts as keep().
  void keep();
  void go_back();  ///< to where keep() was called last

 private:
  friend class RobotGroup;
  struct Impl;
  [[nodiscard]] std::size_t known(std::size_t actuator) const;
  void require_step(const char* here, std::int64_t t_ns, std::int64_t dt_ns, std::span<const JointIn> in,
                    std::span<double> torques_out, std::span<const double> mobility) const noexcept;
  Owner<Impl> impl_;
};

}  // namespace vsa::host
