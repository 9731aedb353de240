// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A running world as recordings, pages and whoever else looks at it see it, whatever simulates it. Optional: what its simulator
// can't do isn't offered by those that stand on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vsa/host/robot.hpp"
#include "vsa/scene/energy.hpp"
#include "vsa/scene/link.hpp"
#include "vsa/scene/touch.hpp"
#include "vsa/units.hpp"

namespace vsa::host {

/// What recordings, live pages and recorded runs need of a simulator: implement it and they work with yours. Read between steps,
/// by the thread that steps.
class Simulation {
 public:
  virtual ~Simulation() = default;

  [[nodiscard]] virtual const std::string& name() const = 0;             ///< the world's
  [[nodiscard]] virtual double step_s() const = 0;                       ///< of the simulator, s
  [[nodiscard]] virtual std::int64_t time_ns() const = 0;                ///< simulated, since its start
  [[nodiscard]] double time_s() const { return seconds_of(time_ns()); }  ///< the same in s, as records have it
  /// What a reader of its pages must know: parts of the description that are left out, say.
  [[nodiscard]] virtual const std::vector<std::string>& warnings() const = 0;

  [[nodiscard]] virtual std::size_t robot_count() const = 0;  ///< robots of actuators in it
  /// From 0 to robot_count() − 1; else InputError.
  [[nodiscard]] virtual Robot& robot(std::size_t index) = 0;
  /// The same to look at.
  [[nodiscard]] virtual const Robot& robot(std::size_t index) const = 0;
  [[nodiscard]] virtual const std::string& robot_model(std::size_t index) const = 0;  ///< scoped model name

  [[nodiscard]] virtual const std::vector<scene::LinkInfo>& links() const = 0;  ///< in an order that doesn't change
  virtual void poses(std::span<scene::Pose> out) const = 0;                     ///< one an entry of links()
  /// None where the simulator doesn't tell it.
  [[nodiscard]] virtual std::optional<scene::Energy> body_energy() const { return std::nullopt; }
  [[nodiscard]] virtual bool has_contacts() const { return false; }  ///< whether contacts() tells any
  /// Of the last step. Clears `out` first.
  virtual void contacts(std::vector<scene::Contact>& out) const { out.clear(); }

  /// Whether pull() does anything.
  [[nodiscard]] virtual bool has_hands() const { return false; }
  /// From the next step on these hands pull, and no others; none lets go.
  // NOLINTNEXTLINE(performance-unnecessary-value-param): who can pull keeps them
  virtual void pull(std::vector<scene::Pull> /*pulls*/) {}
  [[nodiscard]] virtual std::span<const scene::Pull> hands() const { return {}; }  ///< those that pull now

 protected:
  Simulation() = default;
  Simulation(const Simulation&) = default;
  Simulation& operator=(const Simulation&) = default;
  Simulation(Simulation&&) = default;
  Simulation& operator=(Simulation&&) = default;
};

}  // namespace vsa::host
