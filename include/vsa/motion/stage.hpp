// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a gait plays on: actuators that can be commanded, and a clock. engine::World is one; another simulator's adapter is these six
// functions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace vsa::motion {

/// What an actuator was last told.
struct Commanded {
  double equilibrium_rad = 0,  ///< rad
      preset = 0;              ///< in the law's unit
};

/// What a gait moves: actuators of one simulator, and its clock.
class Stage {
 public:
  virtual ~Stage() = default;

  [[nodiscard]] virtual std::int64_t time_ns() const = 0;  ///< simulated; going back is a reset
  /// The number that the stage knows an actuator by. Throws InputError with the names that there are.
  [[nodiscard]] virtual std::size_t find_actuator(std::string_view name) const = 0;
  [[nodiscard]] virtual const std::string& model_of(std::size_t actuator) const = 0;  ///< scoped name, for steering
  /// What isn't given stays.
  virtual void send(std::size_t actuator, std::optional<double> equilibrium_rad, std::optional<double> preset) = 0;
  [[nodiscard]] virtual Commanded commanded(std::size_t actuator) const = 0;                     ///< last, by whoever did
  [[nodiscard]] virtual std::array<double, 3> center_of_mass(std::string_view model) const = 0;  ///< for steering, m
};

}  // namespace vsa::motion
