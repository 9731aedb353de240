// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/device/lever_batch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "device/numbers.hpp"
#include "vsa/checks.hpp"
#include "vsa/errors.hpp"

namespace vsa::device {
namespace {

constexpr double kKeep = std::numeric_limits<double>::quiet_NaN();
constexpr double kFar = 1e6;             // rad, rad/s, N·m: beyond any lever, and far from where an encoder's turns overflow
constexpr double kLeastInertia = 1e-12;  // kg·m²
constexpr std::int64_t kLatest_ns = 4'000'000'000'000'000'000;  // so that a sum of two is a number
constexpr int kMostSteps = 1'000'000'000, kSlice = 1'000'000;

void check(const Lever& lever) {
  Problems problems;
  const auto bad = [&](const char* key, double value, const char* allowed) {
    problems.add({"", key, Checks::text(value), "out of range", allowed});
  };
  if (!(lever.inertia_kgm2 >= kLeastInertia) || !std::isfinite(lever.inertia_kgm2))
    bad("inertia_kgm2", lever.inertia_kgm2, "1e-12 or more");
  if (!(lever.damping_Nms_per_rad >= 0) || !std::isfinite(lever.damping_Nms_per_rad))
    bad("damping_Nms_per_rad", lever.damping_Nms_per_rad, "0 or more");
  if (!(std::abs(lever.gravity_Nm) <= kFar)) bad("gravity_Nm", lever.gravity_Nm, "−1e6 … 1e6");
  problems.throw_if_any();
}

void check_near(const char* key, std::size_t unit, double value) {
  if (!(std::abs(value) <= kFar))
    throw InputError({"", std::string(key) + "[" + std::to_string(unit) + "]", Checks::text(value), "out of range", "−1e6 … 1e6"});
}

/// What a unit's references stand for: for a command of one of the two, which leaves the other.
elastic::EquilibriumPreset commanded(const Unit& unit, const UnitState& s) {
  const UnitConfig& config = unit.config();
  if (config.servo) return {s.servo.command.equilibrium, s.servo.command.preset};
  const double rad_per_raw = (inverted(config) ? -1.0 : 1.0) * radians(Raw{1});
  const auto& ref = s.program.loop.ref_new;
  return config.actuator.transmission->attained({ref[0] * rad_per_raw, ref[1] * rad_per_raw});
}

}  // namespace

LeverBatch::LeverBatch(const UnitConfig& config, std::size_t units, const Lever& lever, std::string_view instructions)
    : units_(config, units, instructions),
      unit_(config),
      levers_(units, lever),
      equilibrium_(units, kKeep),
      preset_(units, kKeep),
      push_(units, 0.0),
      angle_(units, 0.0),
      speed_(units, 0.0),
      inverse_inertia_(units, 1.0 / lever.inertia_kgm2),
      torque_(units, 0.0),
      held_equilibrium_(units, 0.0),
      held_preset_(units, 0.0) {
  check(lever);
}

void LeverBatch::set_lever(std::size_t i, const Lever& lever) {
  (void)this->lever(i);
  check(lever);
  levers_[i] = lever;
  inverse_inertia_[i] = 1.0 / lever.inertia_kgm2;
}

const Lever& LeverBatch::lever(std::size_t i) const {
  if (i >= levers_.size())
    throw InputError({"", "unit", std::to_string(i), "there is no such unit", "0 … " + std::to_string(levers_.size() - 1)});
  return levers_[i];
}

void LeverBatch::command() {
  for (std::size_t i = 0; i < size(); ++i) {
    if (!std::isnan(equilibrium_[i])) check_near("equilibrium", i, equilibrium_[i]);
    if (!std::isnan(preset_[i])) check_near("preset", i, preset_[i]);
    check_near("push", i, push_[i]);
  }
  for (std::size_t i = 0; i < size(); ++i) {
    const double q = std::isnan(equilibrium_[i]) ? held_equilibrium_[i] : equilibrium_[i];
    const double p = std::isnan(preset_[i]) ? held_preset_[i] : preset_[i];
    if (q == held_equilibrium_[i] && p == held_preset_[i]) continue;
    units_.command(i, q, p);
    held_equilibrium_[i] = q;
    held_preset_[i] = p;
  }
}

/// One that would fly off stays where it is.
std::optional<std::size_t> LeverBatch::move(double dt) noexcept {
  std::optional<std::size_t> flown;
  for (std::size_t i = 0; i < size(); ++i) {
    const Lever& l = levers_[i];
    const double pull = l.gravity_Nm == 0 ? 0.0 : l.gravity_Nm * std::sin(angle_[i]), scale = dt * inverse_inertia_[i];
    const double speed = (speed_[i] + scale * (torque_[i] - pull + push_[i])) / (1.0 + scale * l.damping_Nms_per_rad);
    const double angle = angle_[i] + dt * speed;
    if (std::abs(speed) <= kFar && std::abs(angle) <= kFar) {
      speed_[i] = speed;
      angle_[i] = angle;
    } else {
      flown = flown.value_or(i);
    }
  }
  return flown;
}

void LeverBatch::step(int steps, std::int64_t dt_ns, const std::function<void()>& between) {
  if (steps < 1 || steps > kMostSteps)
    throw InputError({"", "steps", std::to_string(steps), "out of range", "1 … " + std::to_string(kMostSteps)});
  units_.check_step(dt_ns);
  command();
  const auto slice = std::max(1, static_cast<int>(kSlice / size()));
  for (int n = 0; n < steps; ++n) {
    if (between && n > 0 && n % slice == 0) between();
    units_.step(dt_ns, angle_, speed_, inverse_inertia_, torque_);
    if (const auto flown = move(1e-9 * static_cast<double>(dt_ns)))
      throw InputError({"", "lever[" + std::to_string(*flown) + "]", "", "would fly off in this step and stays where it is",
                        "−1e6 … 1e6 rad and rad/s: another step, inertia or push, or a reset"});
  }
}

void LeverBatch::check_reset(std::size_t i, double equilibrium_rad, double preset, double shaft_rad, double speed_rad_per_s) const {
  (void)lever(i);
  for (const auto& [key, value] : {std::pair{"equilibrium_rad", equilibrium_rad}, std::pair{"preset", preset},
                                   std::pair{"shaft_rad", shaft_rad}, std::pair{"speed_rad_per_s", speed_rad_per_s}})
    check_near(key, i, value);
}

void LeverBatch::reset(std::size_t i, double equilibrium_rad, double preset, double shaft_rad, double speed_rad_per_s) {
  check_reset(i, equilibrium_rad, preset, shaft_rad, speed_rad_per_s);
  UnitState state = unit_.initial(equilibrium_rad, preset, shaft_rad);
  firmware::Program::shift_time(state.program, units_.time_ns());
  units_.set(i, state);
  held_equilibrium_[i] = equilibrium_rad;
  held_preset_[i] = preset;
  angle_[i] = shaft_rad;
  speed_[i] = speed_rad_per_s;
  torque_[i] = 0;
}

UnitState LeverBatch::state(std::size_t i) const {
  UnitState s = units_.state(i);
  s.reached = {angle_[i], speed_[i]};
  return s;
}

void LeverBatch::restore(std::size_t i, const UnitState& state, std::int64_t time_ns) {
  (void)lever(i);
  check_near("shaft_rad", i, state.reached.angle);
  check_near("speed_rad_per_s", i, state.reached.speed);
  for (const auto& [key, value] : {std::pair{"time_ns", time_ns}, std::pair{"program.busy_until", state.program.busy_until_ns},
                                   std::pair{"program.watchdog.next_clock", state.program.watchdog.next_clock_ns}})
    if (value < -kLatest_ns || value > kLatest_ns)
      throw InputError({"", key, std::to_string(value), "out of range", "−4e18 … 4e18 ns"});
  UnitState here = state;
  firmware::Program::shift_time(here.program, units_.time_ns() - time_ns);
  units_.set(i, here);
  const elastic::EquilibriumPreset held = commanded(unit_, state);
  held_equilibrium_[i] = held.equilibrium;
  held_preset_[i] = held.preset;
  angle_[i] = state.reached.angle;
  speed_[i] = state.reached.speed;
  torque_[i] = state.applied_torque;
}

}  // namespace vsa::device
