// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A World for Python. While one thread steps it, without the GIL, everything else but commands is refused in the others.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gil.hpp"
#include "vsa/engine/world.hpp"
#include "vsa/record/recorder.hpp"

namespace vsa::python {

class PyWorld {
 public:
  explicit PyWorld(engine::World world);

  /// Throws Python's RuntimeError while another thread steps. To be asked after the arguments are converted, and after anything
  /// else that runs Python or makes its objects: another thread may begin to step then.
  [[nodiscard]] engine::World& get();
  /// work(World&, OthersRun&) without the GIL; all but commands is refused meanwhile.
  template <class Work>
  auto alone(Work&& work) {
    engine::World& world = get();
    const Mark stepping(stepping_);
    OthersRun others;
    return work(world, others);
  }
  /// For what C++ allows from any thread.
  [[nodiscard]] engine::World& any_thread() noexcept { return world_; }

  void step(std::size_t n);
  void run(double duration_s);
  void reset();
  void sample();  ///< into the recordings under way: the world was put somewhere

  using Recorder = std::shared_ptr<record::Recorder>;
  void attach(const Recorder& recorder) { recorders_.push_back(recorder); }  ///< samples after each step from now on
  void detach(const Recorder& recorder);

  /// As command() takes them: "joint_1", or "model/joint_1" where several models have it.
  [[nodiscard]] const std::vector<std::string>& actuator_names() const noexcept { return actuator_names_; }
  /// By name or by index into actuators(). InputError, IndexError, TypeError.
  [[nodiscard]] const engine::ActuatorRef& actuator(const py::object& which);
  /// Joints with one axis, in the world's order.
  [[nodiscard]] const std::vector<std::string>& joint_names() const noexcept { return joint_names_; }
  [[nodiscard]] const std::vector<engine::JointHandle>& joints() const noexcept { return joints_; }

 private:
  engine::World world_;
  bool stepping_ = false;  // read and written with the GIL
  std::vector<Recorder> recorders_;
  std::vector<std::string> actuator_names_, joint_names_;
  std::vector<engine::JointHandle> joints_;
};

using WorldClass = py::class_<PyWorld, std::shared_ptr<PyWorld>>;

void bind_world_actuators(WorldClass& c);
void bind_world_parameters(WorldClass& c);
void bind_world_bodies(py::module_& m, WorldClass& c);
void bind_world_dynamics(WorldClass& c);
void bind_world_state(WorldClass& c);
void bind_recorder(py::module_& m, WorldClass& c);

}  // namespace vsa::python
