// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The snake on flat ground in gz-sim, still or crawling as models/gaits/sidewind.toml says (Table II of the paper).
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "gz_world.hpp"

namespace vsa::test {

inline constexpr double kGaitPeriod_s = 2 * 3.14159265358979 / 4.71;

/// y_n(t) = A r(t) sin(4.71 t + n π/5 + δ): 60° about the odd modules' upright axes, 20° and δ = 90° about the even ones'.
[[nodiscard]] inline double sidewind_rad(int n, double t_s) {
  const bool upright = n % 2 == 1;
  const double ramp = t_s < 2.0 ? t_s / 2.0 : 1.0;
  return (upright ? 60 : 20) * kDegree * ramp * std::sin(4.71 * t_s + n * 36 * kDegree + (upright ? 0 : 90 * kDegree));
}

class SnakeWorld {
 public:
  /// `model` in place of the committed one; it has that one's <plugin>.
  explicit SnakeWorld(bool crawls, const std::string& physics = physics_of("snake_flat"),
                      std::string model = model_text("qbmove_snake", "snake", "0 0 0.0335 0 0 0"))
      : own_(model, "snake"), world(sdf_text(world_text(model_text("terrain_flat", "ground") + model, {.physics = physics}))) {
    world.probes[0]->before = [this, crawls](const sim::UpdateInfo& info, sim::EntityComponentManager& ecm) {
      if (crawls && info.iterations > 1 && info.iterations % 10 == 1) command(std::chrono::duration<double>(info.simTime).count());
      own_.before_step(info, ecm);
    };
  }

  SnakeWorld(const SnakeWorld&) = delete;
  SnakeWorld& operator=(const SnakeWorld&) = delete;

  [[nodiscard]] host::Robot& robot() { return own_.robot(); }

  /// Mean place of the links, which are alike.
  [[nodiscard]] std::array<double, 3> center() const {
    plugins::math::Vector3d sum;
    const sim::Entity model = *sim::entitiesFromScopedName("snake", world.ecm()).begin();
    const auto links = world.ecm().EntitiesByComponents(components::ParentEntity(model), components::Link());
    for (const sim::Entity link : links) sum += sim::worldPose(link, world.ecm()).Pos();
    sum /= static_cast<double>(links.size());
    return {sum.X(), sum.Y(), sum.Z()};
  }

  /// Runs for so many gait periods; the way of its center from each to the next, in all.
  double crawl(int periods) {
    double path = 0;
    auto from = center();
    for (int i = 0; i < periods; ++i) {
      world.run(static_cast<int>(std::lround(1e3 * kGaitPeriod_s)));
      const auto to = center();
      path += std::hypot(to[0] - from[0], to[1] - from[1]);
      from = to;
    }
    return path;
  }

  [[nodiscard]] std::vector<double> angles() {
    std::vector<double> out;
    for (std::size_t i = 0; i < robot().size(); ++i) out.push_back(robot().read(i).shaft_rad);
    return out;
  }

 private:
  void command(double t_s) {
    for (std::size_t i = 0; i < robot().size(); ++i) robot().command(i, sidewind_rad(static_cast<int>(i), t_s), 35 * kDegree);
  }

  OwnRobot own_;

 public:
  SimWorld world;
};

}  // namespace vsa::test
