// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Putting a unit somewhere without a kick, and giving it other parameters on its way.
#include <cmath>
#include <cstdlib>
#include <string>

#include "device/pulley_speeds.hpp"
#include "vsa/checks.hpp"
#include "vsa/device/unit.hpp"
#include "vsa/firmware/arithmetic.hpp"
#include "vsa/firmware/exchange.hpp"

namespace vsa::device {
namespace {

constexpr double kTurn = kRawPerTurn;
constexpr double kMaxTurns = 120;  // the program counts turns in 8 bits

double raw_of(double rad) noexcept { return rad / (2.0 * kPi) * kTurn; }

/// The turns that the program would have counted on the way to where the encoder's word is now.
std::int8_t turns_at(double true_raw, std::int32_t word, std::int32_t sample) noexcept {
  const double offset = firmware::cut_16(firmware::wrap_sub(sample, word));
  return static_cast<std::int8_t>(std::lround((true_raw + offset - sample) / kTurn));
}

}  // namespace

void Unit::check_place(const UnitState& state, const UnitPlace& at, std::string_view where, Problems& problems) const {
  const auto say = [&](const char* key, double value, std::string message, std::string allowed) {
    problems.add({"", std::string(where) + key, Checks::text(value), std::move(message), std::move(allowed)});
  };
  const double furthest = kMaxTurns * 2.0 * kPi;
  if (!(std::abs(at.shaft_rad) <= furthest)) say("angle_rad", at.shaft_rad, "is out of range", "±" + Checks::text(furthest));
  if (!(std::abs(at.speed) <= 1e4)) say("speed_rad_per_s", at.speed, "is out of range", "±10000");
  if (!(std::abs(at.preset) <= config_.preset_max)) {
    say("preset", at.preset, "is out of range", "±" + Checks::text(config_.preset_max));
  } else if (!std::isfinite(at.equilibrium)) {
    say("equilibrium_rad", at.equilibrium, "isn't finite", "a finite number");
  } else if (servo_) {
    check_servo_place(at, where, problems);
  } else {
    const auto x = config_.actuator.transmission->references({at.equilibrium, at.preset});
    UnitState trial = state;
    set_inputs(trial, inputs_for(at.equilibrium, at.preset));
    const double sign = config_.program.model == firmware::Model::advanced ? -1.0 : 1.0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(actuator_.motors()); ++i) {
      const double step = std::ldexp(1.0, config_.memory.resolution[i]) + 1;
      if (std::abs(sign * trial.program.loop.ref_new[i] - raw_of(x[i])) <= step) continue;
      const auto [low, high] = config_.reference_range_raw(static_cast<int>(i));
      say("equilibrium_rad", at.equilibrium,
          "with this preset asks motor " + std::to_string(i + 1) + " for what its program can't hold",
          "references of " + Checks::text(radians(Raw{low})) + " … " + Checks::text(radians(Raw{high})) + " rad");
      break;
    }
  }
}

void Unit::place(UnitState& s, const UnitPlace& at) const noexcept {
  UnitState placed;
  placed.program = s.program;
  placed.supply_on = s.supply_on;
  placed.faults = s.faults;
  placed.last_encoder = s.last_encoder;
  placed.dice = s.dice;
  placed.held.terminal = s.held.terminal;
  placed.held.supply_V = s.held.supply_V;
  placed.last_speed = at.speed;
  placed.last_dt = 2.0 * at.lag_s;
  placed.reached = {at.shaft_rad, at.speed};
  if (servo_) {
    placed.servo = s.servo;
    place_servo(placed, at);
    s = placed;
    return;
  }
  auto x = config_.actuator.transmission->references({at.equilibrium, at.preset});
  const auto speed = pulley_speeds(*config_.actuator.transmission, at);
  for (std::size_t i = 0; i < 2; ++i) x[i] -= at.lag_s * speed[i];
  placed.actuator = actuator_.initial(x, at.shaft_rad - at.lag_s * at.speed, speed);

  firmware::ControllerState& loop = placed.program.loop;
  const firmware::ControllerState before = s.program.loop;
  loop = {};
  loop.orders = before.orders, loop.orders_old = before.orders_old, loop.orders_new = before.orders_new;
  placed.program.calibration = {};
  set_inputs(placed, inputs_for(at.equilibrium, at.preset));
  const firmware::TickInputs sensors = read_sensors(placed, at.shaft_rad);
  firmware::settle(program_, placed.program, sensors);
  const double shaft_sign = config_.program.model == firmware::Model::advanced ? -1.0 : 1.0;
  const double shaft_raw =
      raw_of(shaft_sign * (at.shaft_rad + config_.actuator.shaft_zero_rad) + config_.actuator.shaft_encoder.zero_rad);
  loop.turns[2] = turns_at(shaft_raw, sensors.encoder[2], loop.last_sample[2]);
  loop.meas[2] = firmware::wrap_add(loop.meas[2], loop.turns[2] * static_cast<std::int32_t>(kTurn));
  loop.meas_old = loop.meas;
  loop.first_tick = false;
  loop.orders.onoff = before.orders.onoff, loop.orders_old.onoff = before.orders_old.onoff;
  loop.orders_new.onoff = before.orders_new.onoff;
  placed.program.enable = s.program.enable;
  placed.limit_pct = loop.limit_pct;
  s = placed;
}

void Unit::relocate(UnitState& s, double shaft_rad, double speed) const noexcept {
  const double y = shaft_rad - 0.5 * s.last_dt * speed;
  s.started ? actuator_.relocate(s.actuator, y) : actuator_.place(s.actuator, y);
  s.reached = {shaft_rad, speed};
}

void Unit::adopt(UnitState& s, const UnitConfig& from) const noexcept {
  if (!(from.memory == config_.memory)) {
    firmware::MemoryState& m = s.program.memory;
    for (firmware::Memory* copy : {&m.stored, &m.current, &m.user, &m.factory}) {
      const std::uint8_t id = copy->id;
      const bool valid = copy->valid;
      *copy = config_.memory;
      copy->id = id;
      copy->valid = valid;
    }
  }
  // The step under way goes on: what was promised to the host in it stays so, and closes the new ledger's balance.
  actuator_.place(s.actuator, s.actuator.shaft);
  actuator::Ledger& l = s.actuator.ledger;
  l.pending = s.started ? s.path_work : 0.0;
  l.stored_at_start += l.pending;
}

}  // namespace vsa::device
