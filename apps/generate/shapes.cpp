// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Of numbers that are all within their bounds, which make a part without size, or one that starts inside another.
#include <fmt/format.h>

#include <utility>

#include "description.hpp"
#include "gripper.hpp"

namespace vsa::generate {
namespace {

class Fit {
 public:
  Fit(std::string file, Problems& problems) : file_(std::move(file)), problems_(problems) {}

  /// A part that is as large as `large` exceeds `small`; both with the keys that they follow from.
  void above(const char* keys, double large, const std::string& than, double small, const char* part) {
    if (large > small) return;
    problems_.add({file_, keys, fmt::format("{:.6g}", large), fmt::format("no room for {}", part),
                   fmt::format("more than {} = {:.6g}", than, small)});
  }

 private:
  std::string file_;
  Problems& problems_;
};

void check_arms(Fit& fit, const Description& d) {
  const double bracket = d.module.edge_m / 2 + kTurningRoom;
  const std::string turning = fmt::format("module.edge_m / 2 + {}", kTurningRoom);
  fit.above("frank.upper_arm_m", d.frank.upper_arm_m, turning, bracket, "the tube");
  fit.above("frank.forearm_m", d.frank.forearm_m, turning, bracket, "the tube");
  fit.above("manipulator.upper_arm_m", d.manipulator.upper_arm_m, turning, bracket, "the tube");
  fit.above("manipulator.forearm_m", d.manipulator.forearm_m, turning, bracket, "the tube");
  fit.above("manipulator.shoulder_m", d.manipulator.shoulder_m, "module.edge_m", d.module.edge_m, "the turret's tube");
  fit.above("manipulator.base_height_m", d.manipulator.base_height_m, "module.edge_m / 2 + 0.012", d.module.edge_m / 2 + 0.012,
            "the post");
}

void check_frank(Fit& fit, const Description& d) {
  const FrankSpec& f = d.frank;
  fit.above("frank.head_tilt_m", f.head_tilt_m, "module.edge_m", d.module.edge_m, "the neck's tube");
  fit.above("frank.head_pan_height_m", f.head_pan_height_m, "shoulder_height_m + 0.04 + module.edge_m / 2",
            f.shoulder_height_m + 0.04 + d.module.edge_m / 2, "the collar");
  fit.above("frank.shoulder_height_m + 0.04", f.shoulder_height_m + 0.04, "torso_size_m[2] + stand_size_m[2] + foot_radius_m",
            f.torso_size_m[2] + f.stand_size_m[2] + f.foot_radius_m, "the stand's column");
  fit.above("frank.shoulder_height_m", f.shoulder_height_m,
            "upper_arm_m + forearm_m + gripper.pad_at_m + gripper.pad_size_m[2] / 2",
            f.upper_arm_m + f.forearm_m + d.gripper.pad_at_m + d.gripper.pad_size_m[2] / 2, "the hand above the ground");
}

void check_gripper(Fit& fit, const Description& d) {
  const GripperSpec& g = d.gripper;
  const auto& [thick, wide, tall] = g.pad_size_m;
  fit.above("gripper.pad_size_m[1]", wide, "pad_size_m[0]", thick, "the pad's second row of contacts");
  fit.above("gripper.pad_size_m[2]", tall, "pad_size_m[0]", thick, "the pad's row of contacts");
  fit.above("gripper.opening_m / 2", g.opening_m / 2, "approach_m", g.approach_m, "the moving finger");
  fit.above("module.edge_m / 2 + 0.009", d.module.edge_m / 2 + 0.009, "gripper.opening_m / 2 + approach_m + pad_size_m[0]",
            g.opening_m / 2 + g.approach_m + thick, "the fixed finger's bend");
  fit.above("gripper.opening_m", g.opening_m, fmt::format("bench_object.travel_m + {}", kFaceThickness),
            d.bench_object.travel_m + kFaceThickness, "the soft object's back");
}

}  // namespace

void check_shapes(const std::string& file, const Description& d, Problems& problems) {
  Fit fit(file, problems);
  const ModuleSpec& m = d.module;
  fit.above("module.edge_m / 2", m.edge_m / 2, "chamfer_m", m.chamfer_m, "the housing between its chamfers");
  fit.above("snake.pitch_m", d.snake.pitch_m, "module.edge_m - 0.008", m.edge_m - 0.008, "the flange between two modules");
  fit.above("snake.pitch_m", d.snake.pitch_m, "module.contact_radius_m", m.contact_radius_m,
            "the contact between a module and the next but one");
  check_arms(fit, d);
  check_frank(fit, d);
  check_gripper(fit, d);
}

}  // namespace vsa::generate
