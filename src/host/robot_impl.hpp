// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a robot consists of.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "host/bus_line.hpp"
#include "host/cluster.hpp"
#include "host/command_queue.hpp"
#include "host/state.hpp"
#include "vsa/errors.hpp"
#include "vsa/host/robot.hpp"
#include "vsa/state_io.hpp"

namespace vsa::host {

inline constexpr std::int64_t kLookSteps = 128;
inline constexpr double kCreated = 0.01;  ///< energy out of nothing that is told: over what moved, and over what shafts exchanged
inline constexpr double kCreatedLeast_J = 1e-3, kCreatedAtShafts_J = 1e-2;  ///< at least; the second: a robot that falls makes 2e-3
/// And all the time, for each actuator: what firmware that plucks a joint makes where the ground holds it, for nobody foresees that the
/// joint will not move. The snake at rest makes 4e-5 W an actuator, in Gazebo Classic 2.4e-4.
inline constexpr double kCreatedAtRest_W = 5e-4;

/// Whether a joint can be worked with.
[[nodiscard]] inline bool is_told(const JointIn& joint) noexcept {
  const double a = joint.inverse_inertia.value_or(0.0);
  return std::isfinite(joint.angle_rad) && std::isfinite(joint.speed_rad_per_s) && a >= 0 && a <= kMostMobility &&
         std::abs(joint.free_acceleration_rad_per_s2.value_or(0.0)) <= kMostAcceleration;
}

/// Adds what a unit's state can't cross.
void check_kind(const std::string& name, const UnitConfig& from, const UnitConfig& to, Problems& problems);

struct Robot::Impl {
  explicit Impl(RobotConfig c) : config(std::move(c)) {
    units.reserve(config.actuators.size());
    for (ActuatorConfig& a : config.actuators) {
      units.push_back(unit_for(a.unit));
      a.unit.actuator.transmission = units.back()->config().actuator.transmission;
    }
    state.actuators.resize(units.size());
    for (std::size_t i = 0; i < units.size(); ++i) {
      const ActuatorConfig& a = config.actuators[i];
      ActuatorSlot& slot = state.actuators[i];
      slot.equilibrium.value = a.initial_equilibrium_rad;
      slot.preset.value = a.initial_preset;
      slot.unit = first_state(i);
    }
    plans.resize(units.size());  // as many as the largest cluster could have: they share them
    notices.reserve(units.size());
    queue.reserve(4 * units.size());  // two commands of both channels each
    make_buses();
    make_clusters({}, {});
    made_of = std::make_shared<const RobotConfig>(config);
    initial.made_of = made_of;
    initial.state = state;
    for (const auto& bus : buses) initial.buses.push_back(bus->state());
    for (Snapshot* room : {&kept, &loaded}) {
      *room = initial;
      for (std::size_t b = 0; b < buses.size(); ++b) buses[b]->save(room->buses[b]);
    }
    numbers = size_as_numbers();
  }

  /// Where the shaft is will be known at the first step.
  [[nodiscard]] device::UnitState first_state(std::size_t i) const noexcept {
    const ActuatorConfig& a = config.actuators[i];
    return units[i]->initial(a.initial_equilibrium_rad, a.initial_preset, a.initial_equilibrium_rad,
                             static_cast<std::uint8_t>(a.id));
  }

  void make_buses() {
    for (std::size_t b = 0; b < config.buses.size(); ++b) {
      std::vector<std::size_t> on_it;
      for (std::size_t i = 0; i < units.size(); ++i)
        if (config.actuators[i].bus == b) on_it.push_back(i);
      std::stable_sort(on_it.begin(), on_it.end(),
                       [this](std::size_t x, std::size_t y) { return config.actuators[x].id < config.actuators[y].id; });
      std::stable_partition(on_it.begin(), on_it.end(), [this](std::size_t i) { return units[i]->servo() == nullptr; });
      std::vector<BusMember> members;
      for (const std::size_t i : on_it)
        members.push_back({units[i].get(), &state.actuators[i], nullptr, static_cast<std::uint8_t>(config.actuators[i].id), i});
      buses.push_back(std::make_unique<BusLine>(config.buses[b], std::move(members)));
    }
  }

  void make_clusters(std::vector<std::vector<std::size_t>> joined, std::vector<std::size_t> with_others) {
    ClusterParts parts;
    mobility_size = 0;
    for (const auto& tree : joined) mobility_size += tree.size() * tree.size();
    for (const auto& bus : buses) parts.buses.push_back(bus.get());
    for (std::size_t i = 0; i < units.size(); ++i) {
      parts.bus_of.push_back(config.actuators[i].bus);
      parts.joints.push_back({units[i].get(), &state.actuators[i].unit, nullptr});
    }
    home();
    parts.trees = trees = std::move(joined);
    parts.shared = shared = std::move(with_others);
    clusters = host::make_clusters(parts);
    for (Cluster& cluster : clusters) cluster.use(plans);
    lodgings.resize(units.size());
    for (const auto& bus : buses) {
      std::size_t k = 0;
      for (const BusMember& m : bus->members()) lodgings[m.index] = {m.trials, m.joint, bus.get(), k++};
    }
  }

  /// A unit's numbers, up to date, to be looked at.
  [[nodiscard]] const ActuatorSlot& shown(std::size_t i) const noexcept {
    const Lodging& l = lodgings[i];
    if (l.trials != nullptr) l.trials->show(l.joint);
    l.bus->show(l.member);
    return state.actuators[i];
  }
  [[nodiscard]] const RobotState& shown() const noexcept {
    for (std::size_t i = 0; i < lodgings.size(); ++i) static_cast<void>(shown(i));
    return state;
  }
  /// Everybody's numbers, to be changed.
  RobotState& home() noexcept {
    for (Cluster& cluster : clusters) cluster.leave();
    for (const auto& bus : buses) bus->look_anew();
    return state;
  }
  [[nodiscard]] BusMember& member(std::size_t i) noexcept { return lodgings[i].bus->members()[lodgings[i].member]; }

  /// Units with equal parameters share one instance, which goes in lanes and a thousand times into the processor's cache. States are
  /// their own.
  std::shared_ptr<device::Unit> unit_for(const UnitConfig& unit, const actuator::Actuator* prepared = nullptr) {
    for (const auto& known : distinct)
      if (device::alike(known->config(), unit)) return known;
    distinct.push_back(prepared == nullptr
                           ? std::make_shared<device::Unit>(unit)
                           : std::make_shared<device::Unit>(unit, prepared, distinct.empty() ? nullptr : distinct.back().get()));
    return distinct.back();
  }

  void take_commands() noexcept {
    queue.drain([this](Order& c) {
      ActuatorSlot& slot = state.actuators[c.actuator];
      member(c.actuator).changed = true;
      const BusConfig& bus = config.buses[config.actuators[c.actuator].bus];
      if (bus.serial_port) return notice(c.actuator, slot.noted_port, true, NoticeKind::port, 0);  // its client commands
      if (units[c.actuator]->config().is(control::ServoKind::motor_voltages))
        return notice(c.actuator, slot.noted_port, true, NoticeKind::voltages, 0);
      Track& track = c.channel == Channel::equilibrium ? slot.equilibrium : slot.preset;
      if (c.knots) {
        track.begin(std::move(c.knots), state.time_ns);
      } else {
        track.hold(c.value);
      }
      note_range(c.actuator);
    });
  }

  void take_faults() noexcept {
    faults.drain([this](FaultOrder& f) {
      const ActuatorConfig& a = config.actuators[f.actuator];
      ActuatorSlot& slot = home().actuators[f.actuator];
      device::Unit::set_faults(slot.unit, f.faults);
      buses[a.bus]->set_wiring(slot, f.faults);
    });
  }

  void notice(std::size_t i, bool& noted, bool now, NoticeKind kind, double value) noexcept {
    if (now && !noted) notices.push_back({i, kind, value});
    noted = noted || now;
  }

  void note_range(std::size_t i) noexcept {
    ActuatorSlot& slot = state.actuators[i];
    const UnitConfig& unit = config.actuators[i].unit;
    const double limit = unit.preset_max;
    const double q = slot.equilibrium.last(), p = slot.preset.last();
    notice(i, slot.noted_preset, std::abs(p) > limit, NoticeKind::preset, p);
    const auto x = unit.actuator.transmission->references({q, std::clamp(p, -limit, limit)});
    bool out = false;
    for (int m = 0; m < 2 && unit.references_limited(); ++m) {
      const auto [low, high] = unit.reference_range_raw(m);
      out = out || x[m] < radians(Raw{low}) || x[m] > radians(Raw{high});
    }
    notice(i, slot.noted_limits, out, NoticeKind::limits, q);
  }

  void look_at_client(BusLine& bus) noexcept {
    if (bus.port() == nullptr || bus.members().empty()) return;
    const std::size_t first = bus.members().front().index;
    const device::PortLine::WrongRate wrong = bus.port()->wrong_rate();
    notice(first, state.actuators[first].noted_rate, wrong.bytes > 0, NoticeKind::rate, static_cast<double>(wrong.client_Hz));
  }

  /// What a user should know of the run as a whole; now and then.
  void look() noexcept {
    static_cast<void>(shown());
    for (std::size_t i = 0; i < units.size(); ++i) {
      member(i).changed = true;
      ActuatorSlot& slot = state.actuators[i];
      for (Track* track : {&slot.equilibrium, &slot.preset}) track->settle(state.time_ns);
      notice(i, slot.noted_unresolved, slot.unit.unresolved > device::kUnresolved, NoticeKind::unresolved, slot.unit.unresolved);
      state.stiff = state.stiff || slot.unit.unresolved > 0;
    }
    for (const auto& bus : buses) look_at_client(*bus);
    look_at_energy();
  }

  /// Reads what the units have and changes nothing of it.
  void look_at_energy() noexcept {
    actuator::Ledger sum;
    for (const ActuatorSlot& slot : shown().actuators) sum += slot.unit.actuator.ledger;
    notice(0, state.noted_unsettled, state.unsettled > 0, NoticeKind::unsettled, static_cast<double>(state.unsettled));
    // A motor that holds turns 15 W into heat, beside which a joint that shakes for ever is nothing: so by what shafts exchange, too.
    const double at_rest =
        kCreatedAtShafts_J + kCreatedAtRest_W * static_cast<double>(units.size()) * 1e-9 * static_cast<double>(state.stepped_ns);
    const bool created = sum.coupling < -std::max(kCreated * sum.moved(), kCreatedLeast_J) ||
                         sum.coupling < -std::max(kCreated * sum.delivered_moved, at_rest);
    notice(0, state.noted_energy, created, NoticeKind::energy,
           -sum.coupling / std::max(sum.delivered_moved, -sum.coupling));  // no more than all
  }

  void expect(std::int64_t t_ns) noexcept {
    if (t_ns == state.time_ns) return;
    home();
    for (const auto& bus : buses) bus->shift_time(t_ns - state.time_ns);
    state.time_ns = t_ns;
  }

  /// What comes first in a step, and what last.
  void begin_step(std::int64_t t_ns) noexcept {
    expect(t_ns);
    take_commands();
    take_faults();
  }
  void end_step(std::int64_t end_ns) noexcept {
    state.stepped_ns += end_ns - state.time_ns;
    state.time_ns = end_ns;
    const std::int64_t steps = ++state.steps;
    if (units.empty()) return;
    if (steps % kLookSteps == 1) {
      look();
    } else if (steps < kLookSteps && (steps & (steps - 1)) == 0) {
      look_at_energy();  // a short run is told of it, too
    }
  }

  /// What is in lanes stays there, and of units that have most of their numbers there only what else has changed is copied.
  void keep() {
    const QuietBuses quiet(buses);
    kept.made_of = made_of;
    kept.state.time_ns = state.time_ns;
    kept.state.steps = state.steps;
    kept.state.stepped_ns = state.stepped_ns;
    kept.state.unsettled = state.unsettled;
    kept.state.noted_unsettled = state.noted_unsettled;
    kept.state.noted_energy = state.noted_energy;
    kept.state.stiff = state.stiff;
    for (Cluster& cluster : clusters) cluster.keep();
    for (std::size_t i = 0; i < lodgings.size(); ++i) {
      const Lodging& l = lodgings[i];
      l.bus->show(l.member);
      bool& changed = member(i).changed;
      if (!changed && l.trials != nullptr && l.trials->in_kept(l.joint)) continue;
      changed = false;
      kept.state.actuators[i] = state.actuators[i];
    }
    for (std::size_t b = 0; b < buses.size(); ++b) buses[b]->save(kept.buses[b]);
  }

  void go_back() {
    const QuietBuses quiet(buses);
    put_back(kept);
    for (Cluster& cluster : clusters) cluster.go_back();
    if (kept.made_of != made_of) adopt(*kept.made_of);
  }

  void restore(const Snapshot& from) {
    const QuietBuses quiet(buses);
    put_back(from);
    if (from.made_of != made_of) adopt(*from.made_of);
  }

  void put_back(const Snapshot& from) {
    queue.clear();
    faults.clear();
    for (Cluster& cluster : clusters) cluster.forget();
    state = from.state;
    for (std::size_t b = 0; b < buses.size(); ++b) buses[b]->restore(from.buses[b]);
  }

  void check(const RobotConfig* theirs) const;
  void adopt(const RobotConfig& from) noexcept;  ///< the state came from a robot with these parameters
  void set_parameters(std::size_t actuator, const UnitConfig& unit);
  void use(const std::shared_ptr<const RobotConfig>& to);
  void drop_unused();
  [[nodiscard]] std::size_t size_as_numbers() const;
  [[nodiscard]] StateLayout layout() const;
  /// Into `loaded`; how many it took. Throws what Robot::restore does.
  std::size_t read_numbers(std::span<const double> in, state::Room room);
  std::size_t restore_numbers(std::span<const double> in, state::Room room);
  template <class Writer>
  void write_numbers(Writer& writer) const;

  RobotConfig config;
  std::shared_ptr<const RobotConfig> made_of;  ///< the same, for snapshots
  std::vector<std::shared_ptr<device::Unit>> units;
  std::vector<std::shared_ptr<device::Unit>> distinct;
  /// Where a unit's numbers may be meanwhile.
  struct Lodging {
    device::JointTrials* trials = nullptr;  ///< null: none
    std::size_t joint = 0;                  ///< of theirs
    BusLine* bus = nullptr;                 ///< frames that it hasn't heard of yet
    std::size_t member = 0;                 ///< of that
  };
  RobotState state;  ///< of a unit that may be out of date: shown() to look at one, home() to change any
  std::vector<device::StepPlan> plans;
  std::vector<std::unique_ptr<BusLine>> buses;
  std::vector<Cluster> clusters;
  std::vector<Lodging> lodgings;
  std::vector<std::vector<std::size_t>> trees;  ///< as the host joined them
  std::vector<std::size_t> shared;              ///< likewise
  std::size_t mobility_size = 0;
  Snapshot initial, kept, loaded;  ///< the last two have room for all that a state may grow to
  std::size_t numbers = 0;         ///< of a state
  CommandQueue queue;
  FaultQueue faults;
  NoticeList notices;
};

}  // namespace vsa::host
