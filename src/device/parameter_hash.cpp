// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Each struct is taken apart into all its members: one more, and this doesn't compile until it is named here.
#include "vsa/device/parameter_hash.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "vsa/state.hpp"
#include "vsa/state_io.hpp"

namespace vsa::device {
namespace {

class Numbers {
 public:
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void add(T v) { list_.push_back(static_cast<double>(v)); }
  template <class T>
  void add(const std::optional<T>& v) {
    add(v.has_value());
    add(v.value_or(T{}));
  }
  void add(const drive::MotorParams& p) {
    const auto& [inertia, viscous, torque_constant, back_emf, resistance, inductance] = p;
    all(inertia, viscous, torque_constant, back_emf, resistance, inductance);
  }
  void add(const drive::FrictionParams& p) {
    const auto& [coulomb, presliding] = p;
    all(coulomb, presliding);
  }
  void add(const drive::GearboxParams& p) {
    const auto& [ratio, friction, load_loss, back_loss] = p;
    all(ratio, friction, load_loss, back_loss);
  }
  void add(const drive::BridgeParams& p) {
    const auto& [dead_band, brake, pin, period, switches, diode] = p;
    all(dead_band, brake, pin, period, switches, diode);
  }
  void add(const sensor::EncoderParams& p) {
    const auto& [bits, zero] = p;
    all(bits, zero);
  }
  void add(const actuator::TendonParams& p) {
    const auto& [friction, presliding, damping] = p;
    all(friction, presliding, damping);
  }
  void add(const actuator::SideParams& p) {
    const auto& [motor, gearbox, bridge, encoder, polarity] = p;
    all(motor, gearbox, bridge, encoder, polarity);
  }
  void add(const actuator::ActuatorParams& p) {
    const auto& [law, side, supply, shaft_friction, tendon, encoder, zero, scale, inertia] = p;
    add(*law);
    for (std::size_t i = 0; i < p.sides(); ++i) add(side[i]);
    all(supply, shaft_friction, tendon, encoder, zero, scale, inertia);
  }
  void add(const firmware::Repairs& p) {
    const auto& [layout_134, list_checksum, list_mode_5, acknowledge, watchdog_stops, watchdog_short, startup, activation,
                 derivative, jump, short_frames, info_gains, calibration, pwm_rate, zeros] = p;
    all(layout_134, list_checksum, list_mode_5, acknowledge, watchdog_stops, watchdog_short, startup, activation, derivative, jump,
        short_frames, info_gains, calibration, pwm_rate, zeros);
  }
  void add(const firmware::ProgramParams& p) {
    const auto& [model, dialect, repairs, generation, supply_table, row_write, loop_time, cycle_time] = p;
    all(model, dialect, repairs, generation, supply_table, row_write, loop_time, cycle_time);
  }
  void add(firmware::Memory p) {
    p.id = 0;
    const std::size_t before = list_.size();
    list_.resize(before + state::size_of<firmware::Memory>());
    state::Writer writer{std::span(list_).subspan(before)};
    state::walk_fields(writer, p);
  }
  void add(const control::PositionServoParams& p) {
    const auto& [gain, speed_max, speed_gain, integral] = p;
    all(gain, speed_max, speed_gain, integral);
  }
  void add(const control::TorqueServoParams& p) {
    const auto& [gain, integral, dead_zone, motor_damping, stiffness, damping] = p;
    all(gain, integral, dead_zone, motor_damping, stiffness, damping);
  }
  void add(const control::ServoParams& p) {
    const auto& [kind, current_max, filter, reference_max, position, torque] = p;
    all(kind, current_max, filter, reference_max, position, torque);
  }
  void add(const UnitConfig& p) {
    const auto& [physics, program, memory, preset_max, substep_max, servo] = p;
    all(physics, program, memory, preset_max, substep_max, servo);
  }
  [[nodiscard]] std::uint64_t hash() const noexcept { return state_hash(list_); }

 private:
  template <class... A>
  void all(const A&... members) {
    (add(members), ...);
  }

  /// At places all over ±0.5 and ±3 of shaft and inputs, spread by the multiples of three numbers.
  void add(const elastic::Transmission& law) {
    constexpr int kPlaces = 256;
    constexpr std::array<double, 3> kSteps{0.8191725134, 0.6710436067, 0.5497004779};  // g⁻¹, g⁻², g⁻³ with g⁴ = g + 1
    all(law.motor_count(), law.spring_count());
    for (int k = 0; k < kPlaces; ++k) {
      const auto at = [&](std::size_t axis) {
        const double multiple = k * kSteps[axis];
        return (k % 2 == 0 ? 1.0 : 6.0) * (multiple - std::floor(multiple) - 0.5);
      };
      const elastic::Positions place{at(0), {at(1), at(2)}};
      const elastic::Response here = law.evaluate(place);
      const std::array<double, 2> references = law.references({place.q, place.x[0]});
      all(here.energy, here.torque, here.curvature.qq);
      for (std::size_t i = 0; i < static_cast<std::size_t>(law.motor_count()); ++i) all(here.load[i], references[i]);
    }
  }

  std::vector<double> list_;
};

}  // namespace

std::uint64_t parameter_hash(const UnitConfig& config) {
  Numbers numbers;
  numbers.add(config);
  return numbers.hash();
}

}  // namespace vsa::device
