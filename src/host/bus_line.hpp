// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One bus of a robot: its units' chain, and who speaks to them: the master, or a client on a serial port. Units with a servo stand on
// it without being on its line: each has its command at every tick.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "vsa/bus/master.hpp"
#include "vsa/device/chain.hpp"
#include "vsa/device/port_line.hpp"
#include "vsa/device/unit.hpp"

namespace vsa::host {

struct ActuatorSlot;
struct BusConfig;
struct JointIn;

struct BusMember {
  device::Unit* unit;
  ActuatorSlot* slot;
  device::StepPlan* plan;  ///< scratch of one step; clusters may share it
  std::uint8_t id;
  std::size_t index;                      ///< of the actuator in its robot
  device::JointTrials* trials = nullptr;  ///< its joint's, where its numbers may be
  std::size_t joint = 0;                  ///< which it is of theirs
  bool changed = true;                    ///< its slot, since Robot::keep(), but for what is in lanes
};

struct BusState {
  device::ChainState chain;
  bus::MasterState master;
  static auto fields(auto& s, auto&& visit) { return visit("chain", "", s.chain, "master", "", s.master); }
};

class BusLine final : private bus::MasterClient, private device::ProgramKeeper {
 public:
  /// `members` by id, those with a servo behind the others; they stay where they are.
  BusLine(const BusConfig& config, std::vector<BusMember> members);

  /// Gives its members plans from the `first` on; returns the next free one.
  std::size_t use(std::span<device::StepPlan> plans, std::size_t first) noexcept;

  // One host step: begin, the ticks, then the joints are solved (host/cluster.hpp), end. A tick: the line up to it, then every unit's
  // that wasn't made beside others'.
  void run_line(std::int64_t to_ns) noexcept;
  void tick(std::int64_t at_ns) noexcept;
  void end(std::int64_t end_ns) noexcept;
  void show(std::size_t member) noexcept;            ///< before its state is looked at
  void look_anew() noexcept { chain_.look_anew(); }  ///< before states are changed
  [[nodiscard]] const std::vector<BusMember>& members() const noexcept { return members_; }
  [[nodiscard]] std::vector<BusMember>& members() noexcept { return members_; }
  void shift_time(std::int64_t by_ns) noexcept;
  void set_wiring(const ActuatorSlot& slot, const device::Faults& faults) noexcept;

  /// That member goes on as another unit; while it is locked.
  void set_unit(const ActuatorSlot& slot, device::Unit& unit) noexcept;

  [[nodiscard]] device::PortLine* port() noexcept { return port_.get(); }
  [[nodiscard]] std::array<Ticks, 3> measured(const ActuatorSlot& slot, const device::Unit& unit) const;

  /// Around state() and restore(): keeps the client out. For std::lock_guard; QuietBuses holds several.
  void lock() const {
    if (port_) port_->lock();
  }
  void unlock() const {
    if (port_) port_->unlock();
  }
  [[nodiscard]] const device::ChainState& chain_state() const noexcept { return chain_.state(); }
  [[nodiscard]] const bus::MasterState& master_state() const noexcept { return master_.state(); }
  /// What is wrong with a state of this bus at that time of the robot; null: nothing.
  [[nodiscard]] const char* impossible(const BusState& state, std::int64_t time_ns) const noexcept;
  [[nodiscard]] BusState state() const { return {chain_.state(), master_.state()}; }
  /// The same into what was saved to before, without allocating.
  void save(BusState& into) const {
    chain_.save(into.chain);
    into.master = master_.state();
  }
  /// The programs' states are restored by their owner.
  void restore(const BusState& state);

 private:
  [[nodiscard]] std::size_t member_of(const ActuatorSlot& slot) const noexcept;
  void open(std::size_t station) noexcept override;
  void changes(std::size_t station) noexcept override;
  std::array<Ticks, 2> inputs(int k, std::int64_t now_ns) noexcept override;
  void measured(int k, const std::array<Ticks, 3>& positions) noexcept override;

  void run_servo(BusMember& member, std::int64_t at_ns) noexcept;

  std::vector<BusMember> members_;
  std::size_t on_line_;  ///< how many of them, the first ones, are stations of the chain
  device::Chain chain_;
  bus::Master master_;
  std::unique_ptr<device::PortLine> port_;
  std::vector<firmware::TickInputs> sensors_;  // with a port: read before its lock is taken
};

/// Keeps the clients of all of a robot's buses out while it lives.
class QuietBuses {
 public:
  using Buses = std::vector<std::unique_ptr<BusLine>>;
  explicit QuietBuses(const Buses& buses) : buses_(buses) {
    for (const auto& bus : buses_) bus->lock();
  }
  ~QuietBuses() {
    for (const auto& bus : buses_) bus->unlock();
  }
  QuietBuses(const QuietBuses&) = delete;
  QuietBuses& operator=(const QuietBuses&) = delete;

 private:
  const Buses& buses_;
};

}  // namespace vsa::host
