// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One emulated unit: firmware tick (1 kHz, sample and hold) and physics, driven by a host's steps.
//
// A host step [t, t + dt) is cut at every firmware tick and at substep_max_s. At a tick, the encoders are sampled on the path first
// predicted, the position loop runs, and the bridge holds its voltage until the next tick. Each tick happens once; the physics
// between them is then solved for the path that the shaft really takes (host/robot.hpp), with those voltages. Only ticks inside
// a step depend on the prediction, whose error is of second order in the step.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "vsa/actuator/actuator.hpp"
#include "vsa/firmware/position_loop.hpp"

namespace vsa::device {

inline constexpr int kMaxTicksPerStep = 17;  ///< host steps up to 16 ms

struct UnitConfig {
  actuator::ActuatorParams actuator;
  firmware::LoopParams loop;
  int polarity = 1;              ///< −1: motor wiring reversed against the encoder (qbmove advanced, with negative gains)
  double preset_max = 0.785;     ///< accepted |preset|
  int max_stiffness_raw = 6000;  ///< the unit's own bound on the preset of a position-and-stiffness command
  double substep_max_s = 1e-3;   ///< longest physics segment, (0, 1 ms]
  bool operator==(const UnitConfig&) const = default;
};

/// What the bridges hold from one tick to the next.
struct Held {
  std::array<double, 2> voltage;
  drive::Terminal terminal;
};

struct UnitState {
  actuator::ActuatorState actuator;
  firmware::LoopState loop;
  Held held{{}, drive::Terminal::driven};
  bool supply_on = true;
  // what was promised to the host in the last step
  double start_y = 0;
  double applied_torque = 0;
  double path_work = 0;
  double last_speed = 0;
  double last_dt = 0;
  bool started = false;
};

/// What the bus brought between the last tick and this one.
struct TickMail {
  bool has_inputs = false;
  std::array<Ticks, 2> inputs{};
};

struct ShaftIn {
  double angle = 0;            ///< q at the step's start, rad
  double speed = 0;            ///< v, rad/s
  double inverse_inertia = 0;  ///< A, 1/(kg·m²); 0: the shaft's motion is prescribed
};

class Unit {
 public:
  explicit Unit(UnitConfig config);
  [[nodiscard]] const UnitConfig& config() const noexcept { return config_; }

  /// At rest on its references for (equilibrium, preset), motors on, with the shaft where it is.
  [[nodiscard]] UnitState initial(double equilibrium_rad, double preset, double shaft_rad) const noexcept;

  /// One host step; returns the mean torque on the shaft (spring and shaft friction). mail[k] belongs to the step's k-th tick.
  double step(UnitState& state, std::int64_t t_ns, std::int64_t dt_ns, const ShaftIn& in, std::span<const TickMail> mail) noexcept;

  /// Motor references of a command as the bus carries them; the preset is clamped to preset_max, the rest to 16 bits.
  [[nodiscard]] std::array<Ticks, 2> inputs_for(double equilibrium_rad, double preset) const noexcept;

  [[nodiscard]] static int ticks_in(std::int64_t t_ns, std::int64_t dt_ns) noexcept;
  [[nodiscard]] actuator::Actuator& physics() noexcept { return actuator_; }
  [[nodiscard]] const actuator::Actuator& physics() const noexcept { return actuator_; }

 private:
  struct Step {
    std::int64_t t_ns, dt_ns;
    double angle, speed;  // of the shaft, as the host has it
    double dy;            // prediction of its path
  };
  void run_ticks(UnitState& state, const Step& step, std::span<const TickMail> mail, std::span<Held> held) noexcept;
  void tick(UnitState& state, double shaft, const TickMail& mail) noexcept;

  UnitConfig config_;
  drive::Friction shaft_friction_;
  actuator::Actuator actuator_;
};

}  // namespace vsa::device
