// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/firmware/info.hpp"

#include "firmware/text_writer.hpp"
#include "vsa/firmware/arithmetic.hpp"

namespace vsa::firmware {
namespace {

constexpr std::string_view kEnd = "\r\n";

constexpr std::array<std::string_view, 6> kModes{
    "Position\r\n", "PWM\r\n", "Current\r\n", "Position and current\r\n", "Deflection\r\n", "Deflection and current\r\n"};

bool advanced(const InfoSource& s) noexcept { return s.model == Model::advanced; }

std::int64_t ticks(std::int32_t raw, int resolution) noexcept { return shift_right(raw, resolution); }
std::int64_t ticks_16(std::int32_t raw, int resolution) noexcept { return cut_16(shift_right(raw, resolution)); }

void device(TextWriter& out, const InfoSource& s) noexcept {
  out << kEnd << "Firmware version: " << (advanced(s) ? "QBADV v6.1.6" : "QBMMP v6.1.0") << ".\r\n\r\n";
  out << "DEVICE INFO\r\nID: " << std::int64_t{s.memory.current.id} << kEnd;
  out << "Number of sensors: 3\r\nPWM Limit: " << std::int64_t{s.loop.limit_pct} << kEnd << kEnd;
}

std::string_view reference_kind(std::uint8_t mode) noexcept {
  constexpr std::array<std::string_view, 6> kinds{
      " - Position: ", " - Pwm: ", " - Currents: ", " - Position: ", " - Deflection ", " - Deflection "};
  return mode < kinds.size() ? kinds[mode] : std::string_view{};
}

std::int64_t reference(const InfoSource& s, int i) noexcept {
  const int resolution = s.memory.current.resolution[i];
  const std::int32_t ref = s.loop.ref_old[i];
  if (!advanced(s)) return ticks_16(ref, resolution);
  switch (ControlMode{s.memory.stored.control_mode}) {
    case ControlMode::current:
      return cut_16(s.loop.orders_old.current_mA[i]);
    case ControlMode::pwm:
      return cut_16(s.loop.orders_old.pwm[i]);
    case ControlMode::deflection:
    case ControlMode::deflection_current:
      return shift_right(cut_16(wrap_add(ref, s.loop.meas[2])), resolution);
    default:
      return negate_16(cut_16(shift_right(ref, resolution)));
  }
}

void motors(TextWriter& out, const InfoSource& s) noexcept {
  out << "MOTOR INFO\r\nMotor references" << (advanced(s) ? reference_kind(s.memory.stored.control_mode) : ": ");
  for (int i = 0; i < 2; ++i) out << reference(s, i) << " ";
  const Orders& orders = advanced(s) ? s.loop.orders : s.loop.orders_old;
  out << kEnd << "Motor enabled: " << ((orders.onoff & 3) != 0 ? "YES" : "NO") << kEnd;
}

void measurements(TextWriter& out, const InfoSource& s) noexcept {
  out << "\r\nMEASUREMENTS INFO\r\nSensor value:\r\n";
  for (int i = 0; i < 3; ++i) {
    const int resolution = s.memory.current.resolution[i];
    const std::int64_t shown = advanced(s) ? std::int64_t{cut_16(wrap_sub(0, shift_right(s.loop.meas[i], resolution)))}
                                           : ticks_16(s.loop.meas_old[i], resolution);
    out << std::int64_t{i + 1} << " -> " << shown << kEnd;
  }
  out << "Voltage (mV): " << std::int64_t{s.loop.supply.value} << kEnd;
  const auto& current = advanced(s) ? s.loop.current : s.loop.current_old;
  for (int i = 0; i < 2; ++i) out << "Current " << std::int64_t{i + 1} << " (mA): " << std::int64_t{current[i].value} << kEnd;
}

void gains(TextWriter& out, std::string_view title, const Gains& k) noexcept {
  const auto number = [](std::int32_t v) { return static_cast<float>(v) / 65536.0F; };
  out << title << "P -> " << number(k.p) << kEnd << "I -> " << number(k.i) << kEnd << "D -> " << number(k.d) << kEnd;
}

void control(TextWriter& out, const InfoSource& s) noexcept {
  const Memory& m = s.memory.current;
  const ControlMode mode{m.control_mode};
  const bool both = advanced(s) || s.repairs.info_gains;
  const bool twice = mode == ControlMode::position_current || (both && mode == ControlMode::deflection_current);
  out << "\r\nDEVICE PARAMETERS\r\n";
  gains(out, "PID Controller:\r\n", twice ? m.double_position : m.position);
  gains(out, "Current PID Controller:\r\n", twice ? m.double_current : m.current);
  out << kEnd << "Startup activation: " << (m.startup_activation == 3 ? "YES" : "NO") << kEnd;
  if (m.input_mode < 2) out << "Input mode: " << (m.input_mode == 0 ? "USB" : "Sensor 3") << kEnd;
  out << "Control Mode: " << (m.control_mode < kModes.size() ? kModes[m.control_mode] : std::string_view{});
}

void sensors(TextWriter& out, const Memory& m, bool shaft_negated) noexcept {
  out << "Sensor resolution:\r\n";
  for (int i = 0; i < 3; ++i) out << std::int64_t{i + 1} << " -> " << std::int64_t{m.resolution[i]} << kEnd;
  out << "Measurement Offset:\r\n";
  for (int i = 0; i < 3; ++i) {
    const std::int32_t offset = shaft_negated && i == 2 ? wrap_sub(0, m.offset[i]) : m.offset[i];
    out << std::int64_t{i + 1} << " -> " << ticks(offset, m.resolution[i]) << kEnd;
  }
  out << "Measurement Multiplier:\r\n";
  for (int i = 0; i < 3; ++i) out << std::int64_t{i + 1} << " -> " << m.multiplier[i] << kEnd;
}

void limits(TextWriter& out, const InfoSource& s) noexcept {
  const Memory& m = s.memory.stored;
  out << "Position limit active: " << std::int64_t{m.limits_on} << kEnd;
  for (int i = 0; i < 2; ++i) {
    out << "Position limit motor " << std::int64_t{i + 1} << ": inf -> " << ticks(m.limit_low[i], m.resolution[i]);
    out << "  sup -> " << ticks(m.limit_high[i], m.resolution[i]) << kEnd;
  }
  out << "Max stiffness: " << std::int64_t{shift_right(cut_16(m.max_stiffness), m.resolution[0])} << kEnd;
  out << "Current limit: " << std::int64_t{m.current_limit_mA} << kEnd;
  if (advanced(s)) out << "Max pwm rate: " << std::int64_t{m.max_pwm_rate} << kEnd;
  out << "debug: " << std::int64_t{s.loop_time_us} << kEnd;
}

}  // namespace

std::string_view info_text(const InfoSource& source, std::span<char> buffer) noexcept {
  TextWriter out{buffer};
  device(out, source);
  motors(out, source);
  measurements(out, source);
  control(out, source);
  sensors(out, source.memory.current, advanced(source));
  limits(out, source);
  return out.text();
}

}  // namespace vsa::firmware
