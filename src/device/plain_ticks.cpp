// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "device/plain_ticks.hpp"

#include "device/numbers.hpp"
#include "vsa/device/duty.hpp"
#include "vsa/device/unit.hpp"
#include "vsa/firmware/loop_steps.hpp"

namespace vsa::device {
namespace {

bool alike(const firmware::Orders& a, const firmware::Orders& b) noexcept {
  return a.onoff == b.onoff && a.current_mA == b.current_mA && a.pwm == b.pwm;
}

bool in_position_mode(const firmware::Memory& m) noexcept {
  return m.control_mode == static_cast<std::uint8_t>(firmware::ControlMode::position) && m.input_mode == 0 &&
         m.multiplier == std::array{1.0F, 1.0F, 1.0F};
}

bool idle(const firmware::ProgramState& p, std::int64_t now_ns) noexcept {
  return !p.in_bootloader && !p.bytes_waiting && !p.buffer.overflow && !p.activation_waits && !p.watchdog.enabled &&
         !p.watchdog.expired && p.calibration.stage == firmware::Calibration::Stage::stop &&
         p.busy_until_ns - now_ns < firmware::kTickNs;
}

}  // namespace

PlainTicks::Duties::Duties(const Bridges& bridges) noexcept : of(bridges) {
  for (std::size_t m = 0; m < 2; ++m) {
    for (std::size_t i = 0; i < volts[m].size(); ++i) {
      const double output = (static_cast<double>(i) - kFull) / of.limit_pct;
      volts[m][i] = of.polarity[m] * drive::bridge_voltage(of.bridge[m], of.supply_V, output, of.limit_pct / kDutyScale);
    }
  }
}

PlainTicks::PlainTicks(const UnitConfig& c, const PlainTicks* like)
    : supply_V_(c.actuator.supply_V), supply_(firmware::supply_reading(sensor::supply_adc(c.actuator.supply_V))) {
  common_.encoder[2] = c.actuator.shaft_encoder;
  common_.shaft_zero_rad = c.actuator.shaft_zero_rad;
  common_.limit_pct = c.supply_limited() ? firmware::supply_limit_pct(supply_) : kFull;
  const firmware::ProgramParams& params = c.program;
  program_ = !c.servo && params.model == firmware::Model::maker_pro && params.generation == firmware::Generation::v6 &&
             !params.repairs.jump_check_in_16_bits && !params.repairs.watchdog_stops_motors && supply_.value > 0 &&
             common_.limit_pct > 0;
  if (!program_) return;
  Bridges bridges{supply_V_, common_.limit_pct, {}, {}};
  for (std::size_t m = 0; m < 2; ++m) {
    const actuator::SideParams& side = c.actuator.side[m];
    const drive::MotorParams motor = drive::at_pulley(side.motor, side.gearbox.ratio);
    common_.encoder[m] = side.encoder;
    common_.back_emf_Vs_per_rad[m] = motor.back_emf_Vs_per_rad;
    common_.resistance_Ohm[m] = motor.resistance_Ohm + side.bridge.switch_Ohm;
    bridges.bridge[m] = side.bridge;
    bridges.polarity[m] = side.polarity;
  }
  const bool shares = like != nullptr && like->duties_ != nullptr && like->duties_->of == bridges;
  duties_ = shares ? like->duties_ : std::make_shared<const Duties>(bridges);
  for (std::size_t m = 0; m < 2; ++m) common_.volts_of_duty[m] = duties_->volts[m].data();
}

bool PlainTicks::plain(const UnitState& s, std::int64_t now_ns) const noexcept {
  if (!program_) return false;
  const firmware::ProgramState& p = s.program;
  const firmware::ControllerState& c = p.loop;
  Faults sound;
  sound.seed = s.faults.seed;
  const bool loop = !c.first_tick && !c.reset_samples && c.supply.value == supply_.value && c.limit_pct == common_.limit_pct &&
                    s.limit_pct == common_.limit_pct && c.supply_seen && alike(c.orders, c.orders_new) &&
                    alike(c.orders_old, c.orders_new) && c.current[0].value == c.current_old[0].value &&
                    c.current[1].value == c.current_old[1].value;
  return loop && in_position_mode(p.memory.current) && idle(p, now_ns) && p.enable == 3 && s.supply_on && s.faults == sound &&
         s.held.supply_V == supply_V_;
}

bool PlainTicks::volts(const std::array<std::int32_t, 2>& duty_pct, std::int32_t limit_pct, double supply_V,
                       std::array<double, 2>& volts) const noexcept {
  if (!program_ || limit_pct != common_.limit_pct || supply_V != supply_V_) return false;
  for (std::size_t m = 0; m < 2; ++m) {
    const std::int32_t at = duty_pct[m] + kFull;
    if (at < 0 || at > 2 * kFull) return false;
    volts[m] = duties_->volts[m][static_cast<std::size_t>(at)];
  }
  return true;
}

}  // namespace vsa::device
