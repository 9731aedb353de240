// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The numbers of an actuator: two sides, which are alike in most, and what they share.
//
// A side is a motor with its gearbox, its bridge and the encoder on its driving pulley. All of it is told by the pulley's angle φ:
// that is what the encoder reads, what the firmware's references mean and what friction's presliding counts. Where the law's input
// is a travel, the law is taken through elastic/travel.hpp, which makes it one of pulleys.
//
// A linear actuator is one whose law's shaft slides: its shaft's numbers are in m, N and kg where those of others are in rad, N·m and
// kg·m².
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "vsa/drive/bridge.hpp"
#include "vsa/drive/motor.hpp"
#include "vsa/elastic/transmission.hpp"
#include "vsa/sensor/sensors.hpp"

namespace vsa::actuator {

/// Friction proportional to the springs' tension, in the energy's own coordinate (actuator.hpp).
struct TendonParams {
  double friction = 0;      ///< μ, loss torque per spring torque, [0, 1)
  double presliding_J = 0;  ///< w_max: how much a spring's energy changes before that friction slides, ≥ 0; above 0 where μ is
  double damping_s = 0;     ///< T_d: the bristle's damper over its stiffness, ≥ 0
  bool operator==(const TendonParams&) const = default;
};
/// 0 ≤ μ < 1, and a presliding where there is friction.
void validate(const TendonParams& params, std::string_view where, Problems& problems);

/// One side of an actuator: a motor with its gearbox, its bridge and the encoder on its driving pulley.
struct SideParams {
  drive::MotorParams motor{};       ///< at the motor's shaft
  drive::GearboxParams gearbox{};   ///< between motor and pulley
  drive::BridgeParams bridge{};     ///< at its terminals
  sensor::EncoderParams encoder{};  ///< on the driving pulley
  int polarity = 1;                 ///< −1: motor wired against the sense that the program expects
  bool operator==(const SideParams&) const = default;
};
/// Keys as those of a file's [drive] and [sensor]; `number` is what these tables have behind their names: "" or "_2".
void validate(const SideParams& params, std::string_view where, std::string_view number, Problems& problems);

/// All parameters of an actuator's physics: two sides, the law between them and the shaft, what rubs there. Of a linear actuator
/// the shaft's numbers are in m, N and kg.
struct ActuatorParams {
  std::shared_ptr<const elastic::Transmission> transmission;  ///< its inputs are the pulleys' angles
  std::array<SideParams, 2> side;                             ///< a law with one motor ignores side[1]
  double supply_V = 12.0;                                     ///< of both bridges, ≥ 0; source of the default unknown
  drive::FrictionParams shaft_friction;                       ///< of the output shaft, beside the gearboxes'
  TendonParams tendon;                                        ///< of the springs
  sensor::EncoderParams shaft_encoder;                        ///< on the output shaft
  double shaft_zero_rad = 0;                                  ///< and this added to the shaft's reading
  double shaft_scale = 1;                       ///< radians of the shaft's encoder per unit of the shaft; 1: turns with it
  double shaft_inertia_kgm2 = drive::kMissing;  ///< used as 1/A where a host can't tell the inverse inertia

  void set_both(const SideParams& alike) { side = {alike, alike}; }  ///< sides that are alike
  /// Sides that count: one for each motor.
  [[nodiscard]] std::size_t sides() const noexcept {
    return transmission ? static_cast<std::size_t>(transmission->motor_count()) : side.size();
  }
  /// The law's shaft slides.
  [[nodiscard]] bool linear() const noexcept { return transmission && transmission->shaft_unit() == "m"; }
  bool operator==(const ActuatorParams&) const = default;
};
/// Adds what no actuator could have: numbers that aren't finite or outside what the models need, no transmission. What both sides
/// have wrong is told once.
void validate(const ActuatorParams& params, std::string_view where, Problems& problems);

/// The output shaft's friction as the coupling needs it: with a bristle. A presliding of 0 is taken as kLeastPresliding_rad, a
/// hundredth of an encoder's count or less, so that what holds the shaft has a slope.
inline constexpr double kLeastPresliding_rad = 1e-5;
/// With that bristle.
[[nodiscard]] drive::FrictionParams shaft_friction(const ActuatorParams& params) noexcept;

}  // namespace vsa::actuator
