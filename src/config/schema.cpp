// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/config/schema.hpp"

#include <array>
#include <cstdint>
#include <iterator>
#include <utility>

#include "vsa/elastic/travel.hpp"
#include "vsa/units.hpp"

namespace vsa::config {
namespace {

using Unit = device::UnitConfig;

constexpr std::string_view kFirmware = "the published firmware, NMMI/qbmove-maker-pro 6.1";
constexpr std::string_view kDefect = "the published programs have this defect";
constexpr std::string_view kSensor = "AS5045 magnetic encoder, as the qbmove has";
constexpr std::string_view kPulleySide = "numbers given at the driving pulley need no ratio";

void set_bits(Unit& u, double v) {
  for (auto* encoder : {&u.actuator.side[0].encoder, &u.actuator.side[1].encoder, &u.actuator.shaft_encoder})
    encoder->bits = static_cast<int>(v);
}
void set_zero(Unit& u, double v) {
  for (auto* encoder : {&u.actuator.side[0].encoder, &u.actuator.side[1].encoder, &u.actuator.shaft_encoder}) encoder->zero_rad = v;
}

/// Of an input that is an angle there is none; reading a type refuses it.
void set_lead(Unit& u, std::size_t i, double v) {
  auto& law = u.actuator.transmission;
  if (law && elastic::own_input_unit(*law, i) == "m") law = elastic::with_lead(law, i, v);
}

void set_resolution(Unit& u, double v) { u.memory.resolution.fill(static_cast<std::uint8_t>(v)); }

void set_limit_low(Unit& u, double v) { u.memory.limit_low.fill(static_cast<std::int32_t>(v)); }
void set_limit_high(Unit& u, double v) { u.memory.limit_high.fill(static_cast<std::int32_t>(v)); }

/// Before the other firmware keys: they overwrite what the model's program begins with.
void set_model(Unit& u, double v) {
  u.program.model = v == 0 ? firmware::Model::maker_pro : firmware::Model::advanced;
  u.memory = firmware::initial_memory(u.program.model);
}

constexpr std::string_view kPosition = "position_servo", kTorque = "torque_servo", kServos = "position_servo|torque_servo";

// Bounds are what the models accept and a real actuator could have; a type narrows them to what its device could have.
constexpr Parameter kTable[] = {
    {"drive.supply_V", "V", Kind::number, 0, 100, "", "supply voltage of the bridge", Need::required, "", "",
     [](Unit& u, double v) { u.actuator.supply_V = v; }},
    {"drive.dead_band", "1", Kind::number, 0, 0.99, "", "controller output below which the bridge gives nothing, 1 = full output",
     Need::required, "", "", nullptr, [](Unit& u, std::size_t i, double v) { u.actuator.side[i].bridge.dead_band = v; }},
    {"drive.off_mode", "", Kind::word, 0, 0, "brake|coast",
     "motors off: terminals shorted (brake) or open (coast); a modulated enable pin leaves them open", Need::defaulted, "brake",
     "assumption: unknown for the qbmove; shorted terminals are usual for such bridges", nullptr,
     [](Unit& u, std::size_t i, double v) { u.actuator.side[i].bridge.brake_when_off = v == 0; }},
    {"drive.pwm_pin", "", Kind::word, 0, 0, "input|enable",
     "pin of the bridge that the PWM modulates: shorted (input) or open (enable) for the rest of its period", Need::defaulted,
     "input", "NMMI/qbmove-maker-pro from v4.0.2 on (docs/lab/firmware-history.md)", nullptr,
     [](Unit& u, std::size_t i, double v) {
       u.actuator.side[i].bridge.pin = v == 0 ? drive::PwmPin::input : drive::PwmPin::enable;
     }},
    {"drive.pwm_period_s", "s", Kind::number, 0, 1e-3, "",
     "period of the PWM, of effect with pwm_pin enable; 0: far below the winding's L/R", Need::defaulted, "0",
     "fast switching: no ripple", nullptr, [](Unit& u, std::size_t i, double v) { u.actuator.side[i].bridge.period_s = v; }},
    {"drive.switch_Ohm", "Ω", Kind::number, 0, 100, "", "the bridge's two switches in the current's path", Need::defaulted, "0",
     "in drive.resistance_Ohm, if at all", nullptr,
     [](Unit& u, std::size_t i, double v) { u.actuator.side[i].bridge.switch_Ohm = v; }},
    {"drive.diode_V", "V", Kind::number, 0, 5, "", "drop of one of the bridge's diodes, passed with pwm_pin enable only",
     Need::defaulted, "0", "ideal diodes", nullptr,
     [](Unit& u, std::size_t i, double v) { u.actuator.side[i].bridge.diode_V = v; }},
    {"drive.inertia_kgm2", "kg·m²", Kind::number, 1e-9, 100, "", "rotor and gears, at the motor's shaft", Need::required, "", "",
     nullptr, [](Unit& u, std::size_t i, double v) { u.actuator.side[i].motor.inertia_kgm2 = v; }},
    {"drive.viscous_Nms_per_rad", "N·m·s/rad", Kind::number, 0, 100, "", "viscous friction b, at the motor's shaft", Need::required,
     "", "", nullptr, [](Unit& u, std::size_t i, double v) { u.actuator.side[i].motor.viscous_Nms_per_rad = v; }},
    {"drive.torque_constant_Nm_per_A", "N·m/A", Kind::number, 1e-6, 100, "", "torque per current, at the motor's shaft",
     Need::required, "", "", nullptr,
     [](Unit& u, std::size_t i, double v) { u.actuator.side[i].motor.torque_constant_Nm_per_A = v; }},
    {"drive.back_emf_Vs_per_rad", "V·s/rad", Kind::number, 0, 100, "", "voltage per speed, at the motor's shaft", Need::required,
     "", "", nullptr, [](Unit& u, std::size_t i, double v) { u.actuator.side[i].motor.back_emf_Vs_per_rad = v; }},
    {"drive.resistance_Ohm", "Ω", Kind::number, 1e-3, 1e4, "", "winding and wiring", Need::required, "", "", nullptr,
     [](Unit& u, std::size_t i, double v) { u.actuator.side[i].motor.resistance_Ohm = v; }},
    {"drive.inductance_H", "H", Kind::number, 1e-7, 100, "",
     "winding; left out: the current follows voltage and speed at once; with pwm_pin enable it shapes the current within a period",
     Need::optional, "", "", nullptr, [](Unit& u, std::size_t i, double v) { u.actuator.side[i].motor.inductance_H = v; }},
    {"drive.gear_ratio", "1", Kind::number, 1e-3, 1e5, "", "motor turns per pulley turn, n", Need::defaulted, "1", kPulleySide,
     nullptr, [](Unit& u, std::size_t i, double v) { u.actuator.side[i].gearbox.ratio = v; }},
    {"drive.friction_Nm", "N·m", Kind::number, 0, 1000, "", "Coulomb friction of motor and gearbox, at the motor's shaft",
     Need::required, "", "", nullptr, [](Unit& u, std::size_t i, double v) { u.actuator.side[i].gearbox.friction.coulomb_Nm = v; }},
    {"drive.presliding_rad", "rad", Kind::number, 0, 1, "", "displacement before that friction slides, at the pulley",
     Need::required, "", "", nullptr,
     [](Unit& u, std::size_t i, double v) { u.actuator.side[i].gearbox.friction.presliding_rad = v; }},
    {"drive.load_loss", "1", Kind::number, 0, 10, "", "friction that the gearbox adds per load torque, 1/η − 1", Need::defaulted,
     "0", "loss given as a constant only", nullptr,
     [](Unit& u, std::size_t i, double v) { u.actuator.side[i].gearbox.load_loss = v; }},
    {"drive.back_loss", "1", Kind::number, 0, 10, "",
     "the same where the load drives the motor back, 1 − η; left out: as drive.load_loss", Need::optional, "", "", nullptr,
     [](Unit& u, std::size_t i, double v) { u.actuator.side[i].gearbox.back_loss = v; }},
    {"drive.lead_m_per_rad", "m/rad", Kind::number, 1e-7, 10, "",
     "travel of the law's input per radian of the pulley, where that input is a travel: a screw, a rack, a winch", Need::optional,
     "", "", nullptr, set_lead},
    {"drive.polarity", "", Kind::word, 0, 0, "-1|1", "-1: motor wired against its encoder", Need::defaulted, "1",
     "motor and encoder turn the same way", nullptr,
     [](Unit& u, std::size_t i, double v) { u.actuator.side[i].polarity = v == 0 ? -1 : 1; }},
    {"shaft.friction_Nm",
     "N·m",
     Kind::number,
     0,
     1000,
     "",
     "Coulomb friction of the output shaft",
     Need::required,
     "",
     "",
     [](Unit& u, double v) { u.actuator.shaft_friction.coulomb_Nm = v; },
     nullptr,
     false,
     {},
     "rad"},
    {"shaft.presliding_rad",
     "rad",
     Kind::number,
     0,
     1,
     "",
     "displacement before that friction slides",
     Need::required,
     "",
     "",
     [](Unit& u, double v) { u.actuator.shaft_friction.presliding_rad = v; },
     nullptr,
     false,
     {},
     "rad"},
    {"shaft.inertia_kgm2",
     "kg·m²",
     Kind::number,
     1e-7,
     1000,
     "",
     "what turns with the shaft, where the simulator can't tell its effective inertia",
     Need::required,
     "",
     "",
     [](Unit& u, double v) { u.actuator.shaft_inertia_kgm2 = v; },
     nullptr,
     false,
     {},
     "rad"},
    {"shaft.friction_N",
     "N",
     Kind::number,
     0,
     1e6,
     "",
     "a linear actuator's: Coulomb friction of its output",
     Need::required,
     "",
     "",
     [](Unit& u, double v) { u.actuator.shaft_friction.coulomb_Nm = v; },
     nullptr,
     false,
     {},
     "m"},
    {"shaft.presliding_m",
     "m",
     Kind::number,
     0,
     0.1,
     "",
     "a linear actuator's: displacement before that friction slides",
     Need::required,
     "",
     "",
     [](Unit& u, double v) { u.actuator.shaft_friction.presliding_rad = v; },
     nullptr,
     false,
     {},
     "m"},
    {"shaft.mass_kg",
     "kg",
     Kind::number,
     1e-6,
     1e5,
     "",
     "a linear actuator's: what slides with its output, where the simulator can't tell its effective mass",
     Need::required,
     "",
     "",
     [](Unit& u, double v) { u.actuator.shaft_inertia_kgm2 = v; },
     nullptr,
     false,
     {},
     "m"},
    {"tendon.friction", "1", Kind::number, 0, 0.99, "", "loss torque per spring torque, μ", Need::defaulted, "0", "ideal tendons",
     [](Unit& u, double v) { u.actuator.tendon.friction = v; }},
    {"tendon.presliding_J", "J", Kind::number, 0, 10, "", "change of a spring's energy before that friction slides",
     Need::defaulted, "0", "slides at once", [](Unit& u, double v) { u.actuator.tendon.presliding_J = v; }},
    {"tendon.damping_s", "s", Kind::number, 0, 0.1, "", "damper of the bristle that presliding bends, over its stiffness",
     Need::defaulted, "0", "no damper", [](Unit& u, double v) { u.actuator.tendon.damping_s = v; }},
    {"sensor.encoder_bits", "bit", Kind::integer, 1, 16, "", "resolution of the encoders, 2^bits per turn", Need::defaulted, "12",
     kSensor, set_bits, [](Unit& u, std::size_t i, double v) { u.actuator.side[i].encoder.bits = static_cast<int>(v); }},
    {"sensor.encoder_zero_rad", "rad", Kind::number, -3.2, 3.2, "", "reading of an encoder = angle + zero", Need::defaulted, "0",
     "ideal calibration", set_zero, [](Unit& u, std::size_t i, double v) { u.actuator.side[i].encoder.zero_rad = v; }},
    {"sensor.shaft_zero_rad", "rad", Kind::number, -3.2, 3.2, "", "added to the shaft's reading alone", Need::defaulted, "0",
     "ideal calibration", [](Unit& u, double v) { u.actuator.shaft_zero_rad = v; }},
    {"sensor.shaft_turn_m",
     "m",
     Kind::number,
     1e-6,
     10,
     "",
     "a linear actuator's: travel that its output's encoder counts as a turn, so 2^bits counts",
     Need::required,
     "",
     "",
     [](Unit& u, double v) { u.actuator.shaft_scale = 2.0 * kPi / v; },
     nullptr,
     false,
     {},
     "m"},
    {"control.current_max_A", "A", Kind::number, 1e-3, 1e4, "", "largest current of each motor", Need::required, "", "",
     [](Unit& u, double v) { u.servo->current_max_A = v; }, nullptr, false, kServos},
    {"control.speed_filter_s", "s", Kind::number, 0, 0.1, "", "time constant of the filter behind the differences of an encoder",
     Need::defaulted, "0", "no filter", [](Unit& u, double v) { u.servo->speed_filter_s = v; }, nullptr, false, kServos},
    {"control.reference_max_rad", "rad", Kind::number, 1e-3, 1000, "", "largest magnitude of a motor's reference, at the pulley",
     Need::required, "", "", [](Unit& u, double v) { u.servo->reference_max_rad = v; }, nullptr, false, kPosition},
    {"control.position_gain_per_s", "1/s", Kind::number, 1e-3, 1000, "", "wanted speed per position error", Need::required, "", "",
     [](Unit& u, double v) { u.servo->position.gain_per_s = v; }, nullptr, false, kPosition},
    {"control.speed_max_rad_per_s", "rad/s", Kind::number, 1e-3, 1e4, "", "largest wanted speed, at the pulley", Need::required, "",
     "", [](Unit& u, double v) { u.servo->position.speed_max_rad_per_s = v; }, nullptr, false, kPosition},
    {"control.speed_gain_Nms_per_rad", "N·m·s/rad", Kind::number, 1e-6, 1e5, "", "torque per speed error, at the pulley",
     Need::required, "", "", [](Unit& u, double v) { u.servo->position.speed_gain_Nms_per_rad = v; }, nullptr, false, kPosition},
    {"control.speed_integral_Nm_per_rad", "N·m/rad", Kind::number, 0, 1e6, "", "torque per speed error integrated, at the pulley",
     Need::required, "", "", [](Unit& u, double v) { u.servo->position.integral_Nm_per_rad = v; }, nullptr, false, kPosition},
    {"control.torque_gain", "1", Kind::number, 0, 1000, "", "motor torque per torque error", Need::required, "", "",
     [](Unit& u, double v) { u.servo->torque.gain = v; }, nullptr, false, kTorque},
    {"control.torque_integral_per_s", "1/s", Kind::number, 0, 1e5, "", "motor torque per torque error integrated", Need::required,
     "", "", [](Unit& u, double v) { u.servo->torque.integral_per_s = v; }, nullptr, false, kTorque},
    {"control.torque_dead_zone_Nm", "N·m", Kind::number, 0, 1000, "",
     "torque error that isn't integrated: what the encoders can't tell", Need::required, "", "",
     [](Unit& u, double v) { u.servo->torque.dead_zone_Nm = v; }, nullptr, false, kTorque, "rad"},
    {"control.motor_damping_Nms_per_rad", "N·m·s/rad", Kind::number, 0, 1e4, "", "motor torque against its speed, at the pulley",
     Need::required, "", "", [](Unit& u, double v) { u.servo->torque.motor_damping_Nms_per_rad = v; }, nullptr, false, kTorque},
    {"control.stiffness_Nm_per_rad", "N·m/rad", Kind::number, 0, 1e6, "", "of the joint about its equilibrium, at preset 0",
     Need::required, "", "", [](Unit& u, double v) { u.servo->torque.stiffness_Nm_per_rad = v; }, nullptr, false, kTorque, "rad"},
    {"control.damping_Nms_per_rad", "N·m·s/rad", Kind::number, 0, 1e4, "", "of the joint", Need::required, "", "",
     [](Unit& u, double v) { u.servo->torque.damping_Nms_per_rad = v; }, nullptr, false, kTorque, "rad"},
    {"control.force_dead_zone_N", "N", Kind::number, 0, 1e6, "",
     "a linear actuator's: force error that isn't integrated: what the encoders can't tell", Need::required, "", "",
     [](Unit& u, double v) { u.servo->torque.dead_zone_Nm = v; }, nullptr, false, kTorque, "m"},
    {"control.stiffness_N_per_m", "N/m", Kind::number, 0, 1e9, "",
     "a linear actuator's: of the output about its equilibrium, at preset 0", Need::required, "", "",
     [](Unit& u, double v) { u.servo->torque.stiffness_Nm_per_rad = v; }, nullptr, false, kTorque, "m"},
    {"control.damping_Ns_per_m", "N·s/m", Kind::number, 0, 1e7, "", "a linear actuator's: of the output", Need::required, "", "",
     [](Unit& u, double v) { u.servo->torque.damping_Nms_per_rad = v; }, nullptr, false, kTorque, "m"},
    {"firmware.model", "", Kind::word, 0, 0, "maker_pro|advanced", "which program the unit runs", Need::defaulted, "maker_pro",
     "the program of most published units", set_model},
    {"firmware.dialect", "", Kind::word, 0, 0, "6|7", "which messages it speaks: firmware 6, or 7 as its public client expects",
     Need::defaulted, "6", "the published firmware is 6.1",
     [](Unit& u, double v) { u.program.dialect = v == 0 ? bus::Dialect::six : bus::Dialect::seven; }},
    {"firmware.generation", "", Kind::word, 0, 0, "6.1|4|3|2",
     "maker pro: which years' control loop (docs/explanation/4-firmware.md); all else is 6.1", Need::defaulted, "6.1",
     "the program that users own", [](Unit& u, double v) { u.program.generation = static_cast<firmware::Generation>(v); }},
    {"firmware.kp_pct_per_tick", "%/tick", Kind::number, -100, 100, "", "proportional gain, % PWM per raw tick (65536 per turn)",
     Need::defaulted, "0.1", kFirmware, [](Unit& u, double v) { u.memory.position.p = fixed_16_16(v); }},
    {"firmware.ki_pct_per_tick", "%/tick", Kind::number, -100, 100, "", "integral gain, each 1 ms sample", Need::defaulted, "0",
     kFirmware, [](Unit& u, double v) { u.memory.position.i = fixed_16_16(v); }},
    {"firmware.kd_pct_per_tick", "%/tick", Kind::number, -100, 100, "", "derivative gain on the measurement, each 1 ms sample",
     Need::defaulted, "0.8", kFirmware, [](Unit& u, double v) { u.memory.position.d = fixed_16_16(v); }},
    {"firmware.limit_low_raw", "raw", Kind::integer, -8388608, 8388607, "", "lowest reference of both motors, 65536 per turn",
     Need::defaulted, "-30000", kFirmware, set_limit_low},
    {"firmware.limit_high_raw", "raw", Kind::integer, -8388608, 8388607, "", "highest reference of both motors, 65536 per turn",
     Need::defaulted, "30000", kFirmware, set_limit_high},
    {"firmware.limits_on", "", Kind::toggle, 0, 1, "", "references are clamped to the limits", Need::defaulted, "true", kFirmware,
     [](Unit& u, double v) { u.memory.limits_on = v != 0 ? 1 : 0; }},
    {"firmware.max_stiffness_raw", "raw", Kind::integer, 0, 32767, "",
     "largest preset of the position-and-stiffness command, 65536 per turn", Need::defaulted, "6000", kFirmware,
     [](Unit& u, double v) { u.memory.max_stiffness = static_cast<std::uint16_t>(v); }},
    {"firmware.resolution", "bit", Kind::integer, 0, 8, "", "right shift from raw to reported ticks, motors and shaft",
     Need::defaulted, "1", kFirmware, set_resolution},
    {"firmware.supply_limit", "", Kind::toggle, 0, 1, "", "duty limited by supply voltage: 6.4 … 10.6 V are left at the motor",
     Need::defaulted, "true", kFirmware, [](Unit& u, double v) { u.program.supply_table = v != 0; }},
    {"firmware.repair_layout_134", "", Kind::toggle, 0, 1, "", "replies 134 and 137 with their values two bytes apart",
     Need::defaulted, "false", kDefect, [](Unit& u, double v) { u.program.repairs.layout_134 = v != 0; }},
    {"firmware.repair_list_checksum", "", Kind::toggle, 0, 1, "", "the parameter list's checksum over all of it", Need::defaulted,
     "false", kDefect, [](Unit& u, double v) { u.program.repairs.list_checksum = v != 0; }},
    {"firmware.repair_list_mode_5", "", Kind::toggle, 0, 1, "", "the list's text of mode 5 cut to its place", Need::defaulted,
     "false", kDefect, [](Unit& u, double v) { u.program.repairs.list_mode_5 = v != 0; }},
    {"firmware.repair_acknowledge_set_parameter", "", Kind::toggle, 0, 1, "", "setting a parameter is acknowledged",
     Need::defaulted, "false", kDefect, [](Unit& u, double v) { u.program.repairs.acknowledge_set_parameter = v != 0; }},
    {"firmware.repair_watchdog_stops_motors", "", Kind::toggle, 0, 1, "",
     "the watchdog switches the motors off, not only the reported flag", Need::defaulted, "false", kDefect,
     [](Unit& u, double v) { u.program.repairs.watchdog_stops_motors = v != 0; }},
    {"firmware.repair_watchdog_short_periods", "", Kind::toggle, 0, 1, "", "watchdog periods 1 and 2 last at least one clock",
     Need::defaulted, "false", kDefect, [](Unit& u, double v) { u.program.repairs.watchdog_short_periods = v != 0; }},
    {"firmware.repair_startup_activation_reported", "", Kind::toggle, 0, 1, "", "with start-up activation the flag reads on",
     Need::defaulted, "false", kDefect, [](Unit& u, double v) { u.program.repairs.startup_activation_reported = v != 0; }},
    {"firmware.repair_activation_with_references", "", Kind::toggle, 0, 1, "",
     "the motors go on when the references are where they stand", Need::defaulted, "false", kDefect,
     [](Unit& u, double v) { u.program.repairs.activation_with_references = v != 0; }},
    {"firmware.repair_double_loop_current_derivative", "", Kind::toggle, 0, 1, "", "modes 3 and 5 have a derivative of the current",
     Need::defaulted, "false", kDefect, [](Unit& u, double v) { u.program.repairs.double_loop_current_derivative = v != 0; }},
    {"firmware.repair_jump_check_in_16_bits", "", Kind::toggle, 0, 1, "", "jumps of exactly 32768 and 49152 raw are held back, too",
     Need::defaulted, "false", kDefect, [](Unit& u, double v) { u.program.repairs.jump_check_in_16_bits = v != 0; }},
    {"firmware.repair_short_frames_refused", "", Kind::toggle, 0, 1, "", "requests that are too short are ignored", Need::defaulted,
     "false", kDefect, [](Unit& u, double v) { u.program.repairs.short_frames_refused = v != 0; }},
    {"firmware.repair_info_gains", "", Kind::toggle, 0, 1, "", "the info text of mode 5 has the gains in force", Need::defaulted,
     "false", kDefect, [](Unit& u, double v) { u.program.repairs.info_gains = v != 0; }},
    {"firmware.repair_calibration_both_motors", "", Kind::toggle, 0, 1, "", "calibration sees the second motor's current",
     Need::defaulted, "false", kDefect, [](Unit& u, double v) { u.program.repairs.calibration_both_motors = v != 0; }},
    {"firmware.repair_pwm_rate_per_motor", "", Kind::toggle, 0, 1, "", "advanced: the duty's rate limit keeps one memory per motor",
     Need::defaulted, "false", kDefect, [](Unit& u, double v) { u.program.repairs.pwm_rate_per_motor = v != 0; }},
    {"firmware.repair_zeros_reset_samples", "", Kind::toggle, 0, 1, "", "advanced: SET_ZEROS resets the last samples",
     Need::defaulted, "false", kDefect, [](Unit& u, double v) { u.program.repairs.zeros_reset_samples = v != 0; }},
    {"limits.preset_max", kPresetUnit, Kind::number, 0, 1e5, "",
     "largest accepted magnitude of the preset; absent where the law has no preset", Need::required, "", "",
     [](Unit& u, double v) { u.preset_max = v; }},
    {"physics.substep_max_s", "s", Kind::number, 1e-6, 1e-3, "", "longest physics segment inside a step of the simulator",
     Need::defaulted, "0.001", "one firmware tick", [](Unit& u, double v) { u.substep_max_s = v; }},
    // Behind all that it moves from a slide to a joint.
    {"shaft.pinion_m",
     "m",
     Kind::number,
     1e-4,
     10,
     "",
     "a linear actuator's: radius of a pinion, on which its output as a rack turns a joint; left out: its joint slides",
     Need::optional,
     "",
     "",
     [](Unit& u, double v) { u = device::at_pinion(std::move(u), v); },
     nullptr,
     false,
     {},
     "m"},
};

constexpr std::string_view group_of(std::string_view key) noexcept { return key.substr(0, key.find('.')); }

constexpr std::size_t kRows = std::size(kTable);
constexpr std::size_t kSided = [] {
  std::size_t n = 0;
  for (const Parameter& p : kTable) n += p.set_side != nullptr ? 1 : 0;
  return n;
}();

/// "drive.friction_Nm" → "drive_2.friction_Nm"
struct SecondKey {
  std::array<char, 48> text{};
  std::size_t size = 0;
  constexpr void add(std::string_view part) noexcept {
    for (const char c : part) text[size++] = c;
  }
  [[nodiscard]] constexpr std::string_view view() const noexcept { return {text.data(), size}; }
};
constexpr auto kSecondKeys = [] {
  std::array<SecondKey, kSided> keys{};
  std::size_t n = 0;
  for (const Parameter& p : kTable) {
    if (p.set_side == nullptr) continue;
    keys[n].add(group_of(p.key));
    keys[n].add("_2");
    keys[n++].add(p.key.substr(group_of(p.key).size()));
  }
  return keys;
}();

constexpr auto kAll = [] {
  std::array<Parameter, kRows + kSided> all{};
  std::size_t to = 0, key = 0;
  for (std::size_t begin = 0, end = 0; begin < kRows; begin = end) {
    while (end < kRows && group_of(kTable[end].key) == group_of(kTable[begin].key)) all[to++] = kTable[end++];
    for (std::size_t i = begin; i < end; ++i) {
      if (kTable[i].set_side == nullptr) continue;
      Parameter& p = all[to++] = kTable[i];
      p.key = kSecondKeys[key++].view();
      p.need = Need::optional;
      p.default_value = p.default_source = {};
      p.second = true;
    }
  }
  return all;
}();

}  // namespace

void Parameter::apply(device::UnitConfig& to, double value) const {
  if (second) {
    set_side(to, 1, value);
  } else if (set != nullptr) {
    set(to, value);
  } else {
    for (std::size_t i = 0; i < to.actuator.side.size(); ++i) set_side(to, i, value);
  }
}

namespace {

std::string linear_keys() {
  std::string out;
  for (const Parameter& p : kTable)
    if (p.shaft == "m" && p.need == Need::required) out += (out.empty() ? "" : ", ") + std::string(p.key);
  return out;
}

}  // namespace

std::string why_absent(const Parameter& p, const device::UnitConfig& unit) {
  const elastic::Transmission& law = *unit.actuator.transmission;
  if (p.unit == kPresetUnit && unit.preset_unit().empty()) return "the law has no preset: leave this out";
  if (!p.shaft.empty() && p.shaft != law.shaft_unit())
    return p.shaft == "m" ? "is of linear actuators, and the law's shaft turns: leave this out"
                          : "the law's shaft slides: numbers in m, N and kg are " + linear_keys();
  if (p.second && law.motor_count() < 2) return "the law has one motor: leave this out";
  if (p.key.substr(p.key.find('.') + 1) != "lead_m_per_rad") return {};
  bool travels = false;
  for (std::size_t i = p.second ? 1 : 0; i < static_cast<std::size_t>(law.motor_count()); ++i)
    travels = travels || elastic::own_input_unit(law, i) == "m";
  return travels ? "" : "what this motor moves in the law is an angle: leave this out";
}

std::span<const Parameter> parameters() noexcept { return kAll; }

std::string_view controllers_of(const Parameter& p) noexcept {
  if (p.key.substr(0, 9) == "firmware.") return "qbmove";
  return p.controllers.empty() ? kControllers : p.controllers;
}

std::int32_t fixed_16_16(double gain) noexcept { return static_cast<std::int32_t>(gain * 65536.0); }

}  // namespace vsa::config
