// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A unit's electronics: what its program reads and what its duty becomes; how a unit begins.
#include <algorithm>
#include <cmath>
#include <utility>

#include "device/numbers.hpp"
#include "device/plain_ticks.hpp"
#include "vsa/device/duty.hpp"
#include "vsa/device/unit.hpp"
#include "vsa/elastic/travel.hpp"
#include "vsa/errors.hpp"
#include "vsa/firmware/exchange.hpp"

namespace vsa::device {
namespace {

std::int16_t to_ticks(double rad, int resolution) noexcept {
  const double raw = std::nearbyint(rad / (2.0 * kPi) * kRawPerTurn);
  const double ticks = std::floor(raw / static_cast<double>(std::int64_t{1} << std::min(resolution, 31)));
  return static_cast<std::int16_t>(std::clamp(ticks, -32768.0, 32767.0));
}

UnitConfig checked(UnitConfig config) {
  Problems problems;
  validate(config, "", problems);
  problems.throw_if_any();
  return config;
}

/// At the pulleys, with all the resistance that the current meets.
std::optional<control::Servo> make_servo(const UnitConfig& c) {
  if (!c.servo) return std::nullopt;
  std::array<control::ServoMotor, 2> motors;
  for (std::size_t i = 0; i < 2; ++i) {
    const actuator::SideParams& side = c.actuator.side[i];
    motors[i] = {drive::at_pulley(side.motor, side.gearbox.ratio), 2.0 * kPi / static_cast<double>(1 << side.encoder.bits),
                 elastic::shaft_per_pulley(*c.actuator.transmission, i)};
    motors[i].motor.resistance_Ohm += side.bridge.switch_Ohm;
  }
  return control::Servo(*c.servo, motors, c.actuator.transmission, 1.0 / c.actuator.shaft_scale);
}

}  // namespace

std::array<std::int32_t, 2> UnitConfig::reference_range_raw(int i) const noexcept {
  const auto n = static_cast<std::size_t>(i);
  if (servo) {
    constexpr double kWidest = 2147483647.0;
    const double most = references_limited() ? servo->reference_max_rad / (2.0 * kPi) * kRawPerTurn : kWidest;
    const auto raw = static_cast<std::int32_t>(std::min(most, kWidest));
    return {-raw, raw};
  }
  if (memory.limits_on == 0) {
    const std::int32_t unit = std::int32_t{1} << std::min<int>(memory.resolution[n], 16);
    return {-32768 * unit, 32767 * unit};
  }
  const bool turned = program.model == firmware::Model::advanced;
  return turned ? std::array{-memory.limit_high[n], -memory.limit_low[n]} : std::array{memory.limit_low[n], memory.limit_high[n]};
}

Unit::Unit(UnitConfig config) : Unit(checked(std::move(config)), nullptr, nullptr) {}

Unit::Unit(UnitConfig config, const actuator::Actuator* physics, const Unit* like)
    : config_(std::move(config)),
      substep_ns_(std::llround(config_.substep_max_s * 1e9)),
      program_(config_.program),
      servo_(make_servo(config_)),
      shaft_friction_(actuator::shaft_friction(config_.actuator)),
      tendon_(drive::FrictionParams{config_.actuator.tendon.friction, config_.actuator.tendon.presliding_J}),
      actuator_(physics == nullptr ? actuator::Actuator(config_.actuator) : *physics),
      plain_ticks_(std::make_shared<const PlainTicks>(config_, like == nullptr ? nullptr : like->plain_ticks_.get())) {}

std::array<Ticks, 2> Unit::inputs_for(double equilibrium_rad, double preset) const noexcept {
  const double kept = std::clamp(preset, -config_.preset_max, config_.preset_max);
  const auto x = config_.actuator.transmission->references({equilibrium_rad, kept});
  return {Ticks{to_ticks(x[0], config_.memory.resolution[0])}, Ticks{to_ticks(x[1], config_.memory.resolution[1])}};
}

void Unit::set_inputs(UnitState& s, std::array<Ticks, 2> inputs) const noexcept {
  firmware::set_inputs(config_.program.model, {s.program.memory.stored, s.program.memory.current}, s.program.loop, inputs);
}

UnitState Unit::switched_on(double shaft_rad, std::uint8_t id, std::int64_t now_ns) const noexcept {
  UnitState s;
  firmware::Memory shipped = config_.memory;
  shipped.id = id;
  s.program = program_.fresh(now_ns, shipped);
  s.actuator = actuator_.initial({0.0, 0.0}, shaft_rad);
  s.reached.angle = shaft_rad;
  if (servo_) servo_->settle(s.servo, read_servo(s, shaft_rad), {{0.0, 0.0, shaft_rad}});
  return s;
}

UnitState Unit::initial(double equilibrium_rad, double preset, double shaft_rad, std::uint8_t id) const noexcept {
  UnitState s = switched_on(shaft_rad, id, 0);
  if (servo_) {
    s.servo.command.equilibrium = equilibrium_rad;
    s.servo.command.preset = std::clamp(preset, -config_.preset_max, config_.preset_max);
    settle_servo(s, resting_pulleys(s.servo.command, shaft_rad), shaft_rad);
    s.servo.begun_rad = shaft_rad;
    return s;
  }
  set_inputs(s, inputs_for(equilibrium_rad, preset));
  const double rad_per_raw = (inverted(config_) ? -1.0 : 1.0) * radians(Raw{1});
  const auto& ref = s.program.loop.ref_new;
  s.actuator = actuator_.initial({ref[0] * rad_per_raw, ref[1] * rad_per_raw}, shaft_rad);
  firmware::settle(program_, s.program, read_sensors(s, shaft_rad));
  s.limit_pct = s.program.loop.limit_pct;
  return s;
}

void Unit::set_faults(UnitState& s, const Faults& faults) noexcept {
  s.faults = faults;
  s.dice = {faults.seed};
}

double Unit::supply_V(const UnitState& s) const noexcept {
  return s.supply_on ? s.faults.supply_V.value_or(config_.actuator.supply_V) : 0.0;
}

firmware::TickInputs Unit::read_sensors(UnitState& s, double shaft) const noexcept {
  const actuator::ActuatorParams& p = config_.actuator;
  firmware::TickInputs in;
  // The advanced program turns the motors' words round and not the shaft's, and on the wire all three; in deflection mode the
  // motors follow the shaft only if its encoder counts the other way. So its magnet must be mounted like that.
  const double shaft_sign = inverted(config_) ? -1.0 : 1.0;
  const std::array<double, 3> angle{s.actuator.motor[0].angle, s.actuator.motor[1].angle,
                                    shaft_sign * (p.shaft_scale * shaft + p.shaft_zero_rad)};
  const std::array<const sensor::EncoderParams*, 3> encoder{&p.side[0].encoder, &p.side[1].encoder, &p.shaft_encoder};
  for (std::size_t i = 0; i < 3; ++i) {
    const EncoderFault& fault = s.faults.encoder[i];
    const double noise = fault.noise_rad > 0 ? fault.noise_rad * (2.0 * s.dice.uniform() - 1.0) : 0.0;
    if (!fault.stuck) s.last_encoder[i] = sensor::encoder_sample(*encoder[i], angle[i] + noise);
    in.encoder[i] = s.last_encoder[i];
  }
  for (int i = 0; i < 2; ++i)
    in.current_adc[i] =
        sensor::current_adc(actuator_.motor_current(s.actuator, i, s.held.voltage[i], s.held.terminal[i], s.held.supply_V));
  in.supply_adc = sensor::supply_adc(supply_V(s));
  return in;
}

void Unit::hold(UnitState& s, StepPlan& plan) const noexcept {
  drive_bridges(s);
  plan.held[plan.held_count++] = s.held;
}

void Unit::drive_bridges(UnitState& s) const noexcept {
  const double supply = supply_V(s);
  if (servo_) {
    s.held.supply_V = supply;
    for (std::size_t i = 0; i < 2; ++i) {
      const actuator::SideParams& side = config_.actuator.side[i];
      const bool open = s.faults.motor_unplugged[i] || (!s.faults.powered && !side.bridge.brake_when_off);
      s.held.terminal[i] = open ? drive::Terminal::open : drive::Terminal::driven;
      s.held.voltage[i] = open ? 0.0 : side.polarity * s.servo.voltage[i];
    }
    return;
  }
  const firmware::Drive drive = program_.drive(s.program);
  const bool direct = s.program.memory.current.control_mode == static_cast<std::uint8_t>(firmware::ControlMode::pwm);
  // The duty went out before this tick's supply reading changed the limit.
  const std::int32_t limit = direct ? kFull : s.limit_pct;
  s.limit_pct = s.program.loop.limit_pct;
  s.held.supply_V = supply;
  const bool whole =
      s.faults.powered && drive.enabled[0] && drive.enabled[1] && !s.faults.motor_unplugged[0] && !s.faults.motor_unplugged[1];
  if (whole && plain_ticks_->volts(drive.duty_pct, limit, supply, s.held.voltage)) {
    s.held.terminal = {drive::Terminal::driven, drive::Terminal::driven};
    return;
  }
  for (int i = 0; i < 2; ++i) {
    const actuator::SideParams& side = config_.actuator.side[i];
    const bool on = s.faults.powered && drive.enabled[i];
    const bool enable = side.bridge.pin == drive::PwmPin::enable;  // then off is a duty of 0: open, but for the diodes
    const bool open = s.faults.motor_unplugged[i] || (!on && !side.bridge.brake_when_off && !enable);
    const double output = limit > 0 ? drive.duty_pct[i] / static_cast<double>(limit) : 0.0;
    s.held.terminal[i] = open ? drive::Terminal::open : drive::Terminal::driven;
    s.held.voltage[i] = on && !open ? side.polarity * drive::bridge_voltage(side.bridge, supply, output, limit / kDutyScale) : 0.0;
  }
}

}  // namespace vsa::device
