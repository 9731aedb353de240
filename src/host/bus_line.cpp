// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "host/bus_line.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

#include "host/state.hpp"
#include "vsa/device/reading.hpp"
#include "vsa/owner.hpp"

namespace vsa::host {
namespace {

using Members = std::span<const BusMember>;

std::size_t count_on_line(Members members) {
  const auto servo = std::find_if(members.begin(), members.end(), [](const BusMember& m) { return m.unit->servo() != nullptr; });
  return static_cast<std::size_t>(servo - members.begin());
}

std::vector<device::Station> stations(Members members) {
  std::vector<device::Station> out;
  for (const BusMember& m : members) out.push_back({&m.unit->program(), &m.slot->unit.program});
  return out;
}

std::vector<std::uint8_t> ids(Members members) {
  std::vector<std::uint8_t> out;
  for (const BusMember& m : members) out.push_back(m.id);
  return out;
}

bus::Schedule schedule(const BusConfig& config, std::size_t units) {
  return bus::make_schedule(std::max(static_cast<int>(units), 1), config.baud_Hz, config.cycle_s);
}

}  // namespace

BusLine::BusLine(const BusConfig& config, std::vector<BusMember> members)
    : members_(std::move(members)),
      on_line_(count_on_line(members_)),
      chain_({schedule(config, on_line_).rate, 0}, stations(Members(members_).first(on_line_))),
      master_(schedule(config, on_line_), ids(Members(members_).first(on_line_)), *this) {
  if (!config.serial_port) {
    chain_.set_keeper(*this);
    return;
  }
  port_ = std::make_unique<device::PortLine>(chain_);
  if (config.any_rate) port_->take_any_rate();
  sensors_.resize(members_.size());
}

/// A client's line runs by itself.
void BusLine::run_line(std::int64_t to_ns) noexcept {
  if (!port_) chain_.run_to(to_ns, master_);
}

void BusLine::show(std::size_t member) noexcept {
  if (member < on_line_) chain_.show(member);
}

void BusLine::open(std::size_t station) noexcept {
  BusMember& m = members_[station];
  m.changed = true;
  if (m.trials != nullptr) m.trials->open(m.joint);
}

void BusLine::changes(std::size_t station) noexcept { members_[station].changed = true; }

void BusLine::tick(std::int64_t at_ns) noexcept {
  if (port_) {
    for (std::size_t k = 0; k < members_.size(); ++k)
      sensors_[k] = members_[k].unit->sample(members_[k].slot->unit, *members_[k].plan, at_ns);
    port_->ticks(at_ns, [this](std::int64_t line_ns) {
      for (std::size_t k = 0; k < members_.size(); ++k) {
        chain_.tick(k, sensors_[k], line_ns);
        members_[k].unit->hold(members_[k].slot->unit, *members_[k].plan);
      }
    });
    return;
  }
  for (std::size_t k = 0; k < on_line_; ++k) {
    const BusMember& m = members_[k];
    if (m.plan->ticked) continue;
    chain_.tick(k, m.unit->sample(m.slot->unit, *m.plan, at_ns), at_ns);
    m.unit->hold(m.slot->unit, *m.plan);
  }
  for (std::size_t k = on_line_; k < members_.size(); ++k) run_servo(members_[k], at_ns);
}

void BusLine::run_servo(BusMember& m, std::int64_t at_ns) noexcept {
  m.changed = true;
  device::UnitState& state = m.slot->unit;
  m.unit->command(state, m.slot->equilibrium.at(at_ns), m.slot->preset.at(at_ns));
  m.unit->run_servo(state, *m.plan, at_ns);
  m.slot->measured = device::measured(*m.unit, state);
}

std::size_t BusLine::use(std::span<device::StepPlan> plans, std::size_t first) noexcept {
  for (BusMember& m : members_) m.plan = &plans[first++];
  return first;
}

/// A frame whose bytes set out in this step carries what was commanded by now, even if it arrives in the next.
void BusLine::end(std::int64_t end_ns) noexcept { run_line(end_ns); }

void BusLine::shift_time(std::int64_t by_ns) noexcept {
  if (port_) return;  // its clock takes jumps as it takes any speed
  chain_.shift_time(by_ns);
  master_.shift_time(by_ns);
}

std::size_t BusLine::member_of(const ActuatorSlot& slot) const noexcept {
  const auto member = std::find_if(members_.begin(), members_.end(), [&](const BusMember& m) { return m.slot == &slot; });
  require(member != members_.end(), "vsa::host::BusLine", "the actuator isn't on this bus");
  return static_cast<std::size_t>(member - members_.begin());
}

void BusLine::set_wiring(const ActuatorSlot& slot, const device::Faults& faults) noexcept {
  const std::size_t k = member_of(slot);
  if (k >= on_line_) return;
  const std::lock_guard quiet(*this);
  chain_.set_wiring(k, faults.wiring(), faults.seed);
}

void BusLine::set_unit(const ActuatorSlot& slot, device::Unit& unit) noexcept {
  const std::size_t k = member_of(slot);
  members_[k].unit = &unit;
  if (k < on_line_) chain_.set_program(k, unit.program());
}

std::array<Ticks, 3> BusLine::measured(const ActuatorSlot& slot, const device::Unit& unit) const {
  if (!port_) return slot.measured;
  return port_->locked([&] { return device::measured(unit, slot.unit); });
}

const char* BusLine::impossible(const BusState& state, std::int64_t time_ns) const noexcept {
  constexpr std::int64_t kSlack_ns = 1'000'000'000;
  const int frames = 2 * static_cast<int>(on_line_);
  if (state.master.frame < 0 || state.master.frame >= std::max(frames, 1)) return "master.frame below two per unit";
  if (port_ || frames == 0) return nullptr;
  const std::int64_t near_ns = master_.schedule().cycle_ns + kSlack_ns;
  const std::int64_t start_ns = state.master.cycle_start_ps / bus::kPsPerNs;
  return start_ns >= time_ns - near_ns && start_ns <= time_ns + near_ns ? nullptr : "a master.cycle_start near the robot's time";
}

void BusLine::restore(const BusState& state) {
  chain_.restore(state.chain);
  master_.restore(state.master);
  if (port_) port_->forget();
}

std::array<Ticks, 2> BusLine::inputs(int k, std::int64_t now_ns) noexcept {
  const BusMember& m = members_[static_cast<std::size_t>(k)];
  return m.unit->inputs_for(m.slot->equilibrium.at(now_ns), m.slot->preset.at(now_ns));
}

void BusLine::measured(int k, const std::array<Ticks, 3>& positions) noexcept {
  BusMember& m = members_[static_cast<std::size_t>(k)];
  m.changed = true;
  m.slot->measured = positions;
}

}  // namespace vsa::host
