// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A MuJoCo without plug-ins (2.2.2) that steps the plug-in's units: what the plug-in's functions would do is hung to its callbacks.
//   mjcb_sensor, stage of positions   observe, read        compute(SENSOR)
//   mjcb_control                      compute              compute(ACTUATOR); MuJoCo 3 calls that a little later, from mj_fwdActuation
//   mjcb_act_bias                     the forces
//   after mj_step                     advance
// An MJCF for the plug-in becomes one with user actuators and user sensors in its place.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>
#include <vector>

#include "units.hpp"

namespace vsa::mujoco::test {

struct Deleter {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
  void operator()(mjData* d) const { mj_deleteData(d); }
};

/// A model and its units, never stepped.
class Rig {
 public:
  /// Of an MJCF with the plug-in's elements. Throws InputError, std::runtime_error where MuJoCo refuses it.
  explicit Rig(const std::string& mjcf, const std::vector<std::pair<std::string, std::string>>& files = {});

  [[nodiscard]] mjModel& model() const { return *model_; }
  [[nodiscard]] const Units& units() const { return *units_; }

 private:
  std::unique_ptr<mjModel, Deleter> model_;
  std::unique_ptr<Units> units_;
};

/// An mjData of it, with what MuJoCo 3 would keep in plugin_state and plugin_data.
class Data {
 public:
  explicit Data(const Rig& rig);
  Data(const Data& other);  ///< as mj_copyData
  Data& operator=(const Data&) = delete;

  [[nodiscard]] mjData& d() const { return *data_; }
  [[nodiscard]] const std::vector<double>& plugin_state() const { return state_; }
  [[nodiscard]] std::span<const double> sensor(std::size_t unit) const;
  void key(int id);  ///< mj_resetDataKeyframe
  void reset();      ///< mj_resetData
  void step();
  void forward();
  /// Everything that decides the future.
  [[nodiscard]] std::vector<double> all() const;
  void set_all(const std::vector<double>& all);
  std::vector<std::string> told;  ///< by report

 private:
  const Rig* rig_;
  std::unique_ptr<mjData, Deleter> data_;
  std::unique_ptr<Units> units_;
  std::vector<double> state_;
};

/// One joint about y, of 0.002 kg·m², with the unit `config` says; `joint`: more attributes of it, `actuators`: other ones.
struct One {
  std::string config = R"(<config key="type" value="qbmove_maker_pro_6_1"/>)";
  std::string joint = R"(type="hinge")";
  std::string actuators = R"(<plugin name="e" joint="elbow" plugin="vsasim.unit" instance="elbow"/>
      <plugin name="p" joint="elbow" plugin="vsasim.unit" instance="elbow"/>)";
  std::string more_instances{};
  std::string option = R"(timestep="0.001" gravity="0 0 0")";
};
[[nodiscard]] std::string mjcf_of(const One& one = {});

}  // namespace vsa::mujoco::test
