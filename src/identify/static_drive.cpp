// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "vsa/device/duty.hpp"
#include "vsa/drive/pwm_cycle.hpp"
#include "vsa/firmware/controller.hpp"
#include "vsa/firmware/program.hpp"
#include "vsa/identify/quasi_static.hpp"
#include "vsa/units.hpp"

namespace vsa::identify {
namespace {

constexpr std::int32_t kFarthest_raw = 65535;  // beyond it no two positions of a unit are apart

/// A motor's program at rest with a position error that doesn't change: the duty in percent, with the sign of its torque.
class Loop {
 public:
  Loop(const device::UnitConfig& unit, std::size_t motor)
      : unit_(unit),
        motor_(motor),
        controller_(firmware::Program(unit.program).controller()),
        limit_pct_(unit.supply_limited()
                       ? firmware::supply_limit_pct(sensor::supply_from_adc(sensor::supply_adc(unit.actuator.supply_V)),
                                                    unit.program.generation)
                       : 100) {}

  /// `error_raw` in the sense of the shaft.
  [[nodiscard]] int duty_pct(std::int32_t error_raw) const {
    firmware::ControllerState s;
    s.supply_seen = true;
    s.limit_pct = limit_pct_;
    s.ref[motor_] = unit_.program.model == firmware::Model::advanced ? -error_raw : error_raw;  // it counts the other way
    controller_.drive_motor({unit_.memory, unit_.memory}, s, static_cast<int>(motor_));
    return unit_.actuator.side[motor_].polarity * s.duty[motor_];
  }
  [[nodiscard]] int limit_pct() const noexcept { return limit_pct_; }

  /// The smallest error whose duty is `pct` or more.
  [[nodiscard]] std::int32_t riser(int pct, std::int32_t farthest) const {
    std::int32_t low = -farthest, high = farthest;
    while (high - low > 1) {
      const std::int32_t middle = low + (high - low) / 2;
      (duty_pct(middle) < pct ? low : high) = middle;
    }
    return high;
  }
  /// An error at which the loop gives all it has; beyond it an old program's products would overflow.
  [[nodiscard]] std::int32_t saturating() const {
    std::int32_t error = 1;
    while (error < kFarthest_raw && std::abs(duty_pct(error)) < limit_pct_) error *= 2;
    return std::min(error, kFarthest_raw);
  }

 private:
  const device::UnitConfig& unit_;
  std::size_t motor_;
  firmware::Controller controller_;
  std::int32_t limit_pct_;
};

/// Torque at the pulley of a standing motor, N·m.
double torque_of(const actuator::SideParams& side, double supply_V, int duty_pct, int limit_pct) {
  const drive::MotorParams motor = drive::at_pulley(side.motor, side.gearbox.ratio);
  const double output = limit_pct > 0 ? duty_pct / static_cast<double>(limit_pct) : 0.0;
  const double duty = drive::bridge_duty(side.bridge, output, limit_pct / device::kDutyScale);
  const drive::PwmCycle cycle(side.bridge, supply_V, motor.resistance_Ohm, motor.inductance_H.value_or(0.0), duty);
  return motor.torque_constant_Nm_per_A * cycle.mean(0.0).current;
}

}  // namespace

std::optional<std::string> unsupported(const device::UnitConfig& unit) {
  if (unit.servo) return "its controller is a servo";
  const firmware::Memory& m = unit.memory;
  if (m.control_mode != static_cast<std::uint8_t>(firmware::ControlMode::position)) return "its control mode isn't position";
  if (m.input_mode != 0) return "its references come from an encoder";
  if (m.position.i != 0) return "its position loop has an integral gain";
  for (std::size_t motor = 0; motor < unit.actuator.sides(); ++motor) {
    const Loop loop(unit, motor);
    const std::int32_t far = loop.saturating();
    if (loop.duty_pct(far) <= loop.duty_pct(-far)) return "its position loop doesn't drive towards the reference";
  }
  return std::nullopt;
}

StaticDrive::StaticDrive(const device::UnitConfig& unit, std::size_t motor) {
  const Loop loop(unit, motor);
  const actuator::SideParams& side = unit.actuator.side[motor];
  const double supply_V = unit.actuator.supply_V;
  const std::int32_t far = loop.saturating();
  const int least = loop.duty_pct(-far), most = loop.duty_pct(far);
  double below = torque_of(side, supply_V, least, loop.limit_pct());
  error_rad_.push_back(radians(Raw{-far - 1}));
  torque_Nm_.push_back(below);
  for (int pct = least + 1; pct <= most; ++pct) {
    const double torque = torque_of(side, supply_V, pct, loop.limit_pct());
    const double error = radians(Raw{loop.riser(pct, far)});
    if (error > error_rad_.back()) {
      error_rad_.push_back(error);
      torque_Nm_.push_back(0.5 * (below + torque));
    }
    below = torque;
  }
  error_rad_.push_back(radians(Raw{far + 1}));
  torque_Nm_.push_back(below);
}

double StaticDrive::torque_Nm(double error_rad) const noexcept {
  if (error_rad <= error_rad_.front()) return torque_Nm_.front();
  if (error_rad >= error_rad_.back()) return torque_Nm_.back();
  const auto next =
      static_cast<std::size_t>(std::upper_bound(error_rad_.begin(), error_rad_.end(), error_rad) - error_rad_.begin());
  const double share = (error_rad - error_rad_[next - 1]) / (error_rad_[next] - error_rad_[next - 1]);
  return torque_Nm_[next - 1] + share * (torque_Nm_[next] - torque_Nm_[next - 1]);
}

}  // namespace vsa::identify
