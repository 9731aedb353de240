// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/emulation.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace vsa::device {
namespace {

constexpr int kMaxId = 254;

std::vector<std::shared_ptr<Unit>> checked(const std::vector<EmulatedUnit>& given) {
  Problems problems;
  if (given.empty()) problems.add({"", "units", "0", "nothing to emulate", "at least one"});
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::string key = "unit " + std::to_string(i + 1);
    const int id = given[i].id;
    if (id < 1 || id > kMaxId) problems.add({"", key + ".id", std::to_string(id), "is out of range", "1 … 254"});
    const auto same = [id](const EmulatedUnit& other) { return other.id == id; };
    if (std::any_of(given.begin(), given.begin() + static_cast<std::ptrdiff_t>(i), same))
      problems.add({"", key + ".id", std::to_string(id), "another unit has this id", "unique ids on a line"});
    if (given[i].config.servo)
      problems.add({"", key, std::string(control::name_of(given[i].config.servo->kind)),
                    "a unit with this controller speaks no qbmove protocol", "units with control.kind = qbmove"});
    if (!std::isfinite(given[i].shaft_rad)) problems.add({"", key + ".shaft_rad", "", "isn't a number", "a finite angle"});
  }
  problems.throw_if_any();
  std::vector<std::shared_ptr<Unit>> units;
  for (const EmulatedUnit& unit : given) {
    const auto equal = [&](const std::shared_ptr<Unit>& other) { return alike(other->config(), unit.config); };
    const auto known = std::find_if(units.begin(), units.end(), equal);
    units.push_back(known != units.end() ? *known : std::make_shared<Unit>(unit.config));
  }
  return units;
}

}  // namespace

Emulation::Emulation(std::vector<EmulatedUnit> units, const LineConfig& line,
                     std::function<bus::SerialLine::Clock::time_point()> now, std::string_view instructions)
    : units_(checked(units)),
      states_([&] {
        std::vector<UnitState> states;
        for (std::size_t i = 0; i < units.size(); ++i) {
          states.push_back(units_[i]->switched_on(units[i].shaft_rad, static_cast<std::uint8_t>(units[i].id), 0));
          if (!units[i].pages) continue;
          firmware::ProgramState& program = states.back().program;
          program.memory.user = units[i].pages->user;
          program.memory.factory = units[i].pages->factory;
          units_[i]->program().power_up(program, 0);
        }
        return states;
      }()),
      trials_(units.size(), 0, instructions),
      chain_(line, stations()),
      port_(chain_, std::move(now)) {
  plans_.resize(units.size());
  inputs_.resize(units.size());
  torques_.resize(units.size());
  for (std::size_t i = 0; i < units.size(); ++i) {
    shafts_.push_back({units[i].shaft_rad, 0, units[i].held ? 0.0 : 1.0 / units_[i]->config().actuator.shaft_inertia_kgm2});
    order_.push_back(i);
  }
  // Equal units become neighbours, by the first of their kind.
  const auto kind = [this](std::size_t i) { return std::find(units_.begin(), units_.end(), units_[i]) - units_.begin(); };
  std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) { return kind(a) < kind(b); });
  for (const std::size_t i : order_) joints_.push_back({units_[i].get(), &states_[i], &plans_[i]});
}

std::vector<Station> Emulation::stations() {
  std::vector<Station> out;
  for (std::size_t i = 0; i < units_.size(); ++i) out.push_back({&units_[i]->program(), &states_[i].program});
  return out;
}

void Emulation::advance(std::int64_t until_ns) {
  while (now_ns_ + firmware::kTickNs <= until_ns) step();
}

void Emulation::step() {
  take_faults();
  for (std::size_t i = 0; i < units_.size(); ++i) {
    const Shaft& shaft = shafts_[i];
    units_[i]->begin_step(states_[i], plans_[i], now_ns_, firmware::kTickNs, {shaft.angle, shaft.speed, shaft.inverse_inertia});
    inputs_[i] = units_[i]->sample(states_[i], plans_[i], now_ns_);
  }
  port_.ticks(now_ns_, [this](std::int64_t line_ns) {
    for (std::size_t i = 0; i < units_.size(); ++i) {
      chain_.tick(i, inputs_[i], line_ns);
      units_[i]->hold(states_[i], plans_[i]);
    }
  });
  constexpr double dt = static_cast<double>(firmware::kTickNs) * 1e-9;
  trials_.solve_each(joints_, torques_);
  for (std::size_t k = 0; k < order_.size(); ++k) {
    Shaft& shaft = shafts_[order_[k]];
    if (shaft.inverse_inertia > 0) shaft.speed += dt * shaft.inverse_inertia * torques_[k];
    shaft.angle += dt * shaft.speed;
  }
  now_ns_ += firmware::kTickNs;
}

void Emulation::set_faults(std::size_t unit, const Faults& faults) {
  Problems problems;
  if (unit >= size()) problems.add({"", "unit", std::to_string(unit), "no such unit", "below " + std::to_string(size())});
  validate(faults, "", problems);
  problems.throw_if_any();
  const std::lock_guard lock(faults_mutex_);
  faults_.emplace_back(unit, faults);
}

UnitPages Emulation::pages(std::size_t unit) const {
  if (unit >= size()) throw InputError({"", "unit", std::to_string(unit), "no such unit", "below " + std::to_string(size())});
  return port_.locked([&] {
    const firmware::MemoryState& memory = states_[unit].program.memory;
    return UnitPages{memory.user, memory.factory};
  });
}

void Emulation::take_faults() {
  std::vector<std::pair<std::size_t, Faults>> taken;
  {
    const std::lock_guard lock(faults_mutex_);
    taken.swap(faults_);
  }
  for (const auto& [i, faults] : taken) {
    Unit::set_faults(states_[i], faults);
    port_.locked([this, unit = i, &of = faults] { chain_.set_wiring(unit, of.wiring(), of.seed); });
  }
}

Emulation::Reading Emulation::read(std::size_t unit) const {
  const UnitState& s = states_.at(unit);
  return {{s.actuator.motor[0].angle, s.actuator.motor[1].angle}, shafts_[unit].angle, shafts_[unit].speed, s.applied_torque};
}

}  // namespace vsa::device
