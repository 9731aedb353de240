// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A model of a Gazebo with its robot, as recordings and the live page see it.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "vsa/host/simulation.hpp"
#include "vsa/seat/seat.hpp"

namespace vsa::plugins {

struct ModelLinks {
  std::vector<scene::LinkInfo> infos;
  std::function<void(std::span<scene::Pose>)> poses;  ///< fills one an entry of infos: where they are now
  std::vector<std::string> notices;                   ///< what isn't shown
};

class ModelScene final : public host::Simulation {
 public:
  ModelScene(std::string world, double step_s, seat::Seat& seat, ModelLinks links)
      : world_(std::move(world)), step_s_(step_s), seat_(seat), links_(std::move(links)) {}

  void set_time(std::int64_t time_ns) noexcept { time_ns_ = time_ns; }

  [[nodiscard]] const std::string& name() const override { return world_; }
  [[nodiscard]] double step_s() const override { return step_s_; }
  [[nodiscard]] std::int64_t time_ns() const override { return time_ns_; }
  [[nodiscard]] const std::vector<std::string>& warnings() const override { return links_.notices; }
  [[nodiscard]] std::size_t robot_count() const override { return 1; }
  [[nodiscard]] host::Robot& robot(std::size_t) override { return seat_.robot(); }
  [[nodiscard]] const host::Robot& robot(std::size_t) const override { return seat_.robot(); }
  [[nodiscard]] const std::string& robot_model(std::size_t) const override { return seat_.model(); }
  [[nodiscard]] const std::vector<scene::LinkInfo>& links() const override { return links_.infos; }
  void poses(std::span<scene::Pose> out) const override { links_.poses(out); }

 private:
  std::string world_;
  double step_s_;
  seat::Seat& seat_;
  ModelLinks links_;
  std::int64_t time_ns_ = 0;
};

}  // namespace vsa::plugins
