// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What an element's <record> and <view> order, in any Gazebo.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "model_scene.hpp"
#include "vsa/record/recorder.hpp"
#include "vsa/view/live_view.hpp"

namespace vsa::plugins {

class ModelWatch {
 public:
  using Report = seat::Seat::Report;

  /// None where the robot's element orders nothing: then `links` isn't called. Throws InputError that names the element where the
  /// files can't be written or the port can't be had.
  [[nodiscard]] static std::unique_ptr<ModelWatch> make(const std::string& where, const std::string& world, double step_s,
                                                        seat::Seat& seat, const std::function<ModelLinks()>& links, Report report);
  ~ModelWatch();  ///< writes the replay page
  ModelWatch(const ModelWatch&) = delete;
  ModelWatch& operator=(const ModelWatch&) = delete;

  /// Before every step, when seat.in() is filled: `time_ns` is that of this moment, at which the last step ended.
  void before_step(std::int64_t time_ns);
  void paused();  ///< while the world stands: pages are served

 private:
  ModelWatch(ModelScene scene, seat::Seat& seat, Report report);
  void start_record(const std::string& where, const host::RecordConfig& config);
  void start_view(const std::string& where, std::uint16_t port);
  void end_record() noexcept;

  seat::Seat& seat_;
  ModelScene scene_;
  Report report_;
  std::string directory_;
  std::optional<record::RunRecord> record_;
  record::Sample sample_;
  std::optional<view::LiveView> view_;
};

}  // namespace vsa::plugins
