// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One actuator between an importer's shaft and its commands: device::Unit, without a line. Commands come as if SET_INPUTS had just
// arrived; the program takes them at its next tick, of 1 ms by the unit's own clock, which begins at 0.
//
// A communication step [t, t + h] begins with the shaft's angle q and speed v at t. COUPLING, one of two:
//   prescribed  the importer moves the shaft: until the next communication point it goes q + v s + a s²/2, s = 0 … h, with a its
//               shaft_acceleration, 0 unless it is told (an error of a h²/2 in the angle then); commands are held. The step is cut
//               at the firmware's ticks, so that no piece is longer than 1 ms, and any h > 0 goes.
//   implicit    the unit foresees how the shaft will move, with the inertia J = load_inertia_kg_m2 behind it, and solves for it
//               (host/robot.hpp with B = 1/J). For an importer that steps this FMU first, applies `mean_torque` over the same step
//               and integrates v' = v + h·a, q' = q + h·v'. Then nothing grows at any step and stiffness. h up to 16 ms.
//
// OUTPUTS are those of the communication point reached, the shaft where the importer sets it, or until then where it was foreseen:
// torque, deflection and stiffness follow shaft_angle at once (∂torque/∂shaft_angle is a directional derivative). mean_torque is the
// mean over the last step.
//
// An importer that holds a torque over its own step feeds a swing: with x = h √(σ/J), σ = −∂torque/∂shaft_angle, one undamped
// spring grows by e^{πx/2} in amplitude per swing (docs/howto/fmu.md). Beyond x = kExplicitLimit the model says so once.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/fmu/model.hpp"

namespace vsa::fmu {

/// Who moves the shaft within a communication step: the importer, or the unit's own foresight with the inertia behind it.
enum class Coupling { prescribed, implicit };

/// What an FMU begins with, unless its importer says otherwise.
struct UnitStart {
  std::vector<config::Override> set{};        ///< values of the type
  std::optional<Coupling> coupling{};         ///< none: prescribed
  std::optional<double> load_inertia_kgm2{};  ///< 0 … 1e6; none: 0, unknown
};

/// h √(σ/J) beyond which explicit coupling is warned of.
inline constexpr double kExplicitLimit = 0.3;
/// An angle or a speed that no shaft has, rad and rad/s.
inline constexpr double kFarthest = 1e6;

/// One actuator behind FMI: parameters, commands and the shaft's motion in; torque, stiffness and motors out.
class UnitModel final : public Model {
 public:
  /// Throws InputError as TypeFile::make.
  UnitModel(config::TypeFile file, UnitStart start, Names names);
  ~UnitModel() override;

  [[nodiscard]] const config::ActuatorType& type() const noexcept;  ///< with the parameters that the importer set
  [[nodiscard]] bool has_derivatives() const noexcept override { return true; }
  /// Of torque, deflection and stiffness by shaft_angle; every other is 0. N·m/rad, 1, N·m/rad². That of the stiffness is a
  /// difference over 2·10⁻⁵ rad, since laws give no third derivative.
  [[nodiscard]] double derivative(Reference output, Reference input) const override;

 private:
  struct Places;
  struct Run;
  void begin_own() override;
  void step_own(std::int64_t dt_ns) override;
  void input_changed(Reference variable) override;
  void evaluate(std::span<double> values) override;
  [[nodiscard]] std::size_t own_size() const override;
  void save_own(std::span<double> out) const override;
  void restore_own(std::span<const double> in) override;

  [[nodiscard]] config::ActuatorType made() const;
  [[nodiscard]] std::unique_ptr<Run> new_run() const;
  [[nodiscard]] bool implicit() const;
  void send_commands();
  void warn_of_step(double h_s);
  double walk(std::int64_t dt_ns);

  config::TypeFile file_;
  std::vector<config::Override> set_;
  config::ActuatorType type_;
  std::unique_ptr<Places> places_;
  std::unique_ptr<Run> run_;
};

}  // namespace vsa::fmu
