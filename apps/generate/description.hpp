// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What models/robots.toml says, checked. Units are in the names.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "vsa/errors.hpp"

namespace vsa::generate {

using Range = std::array<double, 2>;
using Size = std::array<double, 3>;

struct ModuleSpec {
  double edge_m, mass_kg, flange_mass_kg, flange_radius_m, flange_thickness_m, chamfer_m, contact_radius_m, friction,
      bracket_mass_kg;
};
struct ActuatorSpec {
  std::string type, plugin_file;
  double initial_preset_rad, baud_Hz, state_rate_Hz;
};
struct BenchSpec {
  double height_m, load_mass_kg, load_lever_m, load_radius_m, load_length_m;
};
struct PoleSpec {
  BenchSpec bench;
  double mass_kg, radius_m, length_m;
};
struct SnakeSpec {
  int modules;
  double pitch_m, tail_mass_kg, initial_preset_rad, clearance_m;
  std::string bus;
};
struct FrankSpec {
  double toe_in_deg, shoulder_height_m, shoulder_half_width_m, upper_arm_m, forearm_m, torso_mass_kg;
  Size torso_size_m;
  double head_pan_height_m, head_tilt_m, head_mass_kg;
  Size head_size_m;
  double stand_mass_kg;
  Size stand_size_m;
  double foot_radius_m, initial_preset_rad;
  std::string bus;
};
struct GripperSpec {
  double opening_m, approach_m, pad_at_m;
  Size pad_size_m;
  double finger_mass_kg, friction;
};
struct TableSpec {
  double reach_m, top_height_m, size_m, baton_mass_kg, baton_across_m, baton_height_m;
};
struct PendulumSpec {
  double ball_mass_kg, ball_radius_m, cord_m, raised_deg, gap_m;
};
struct BenchObjectSpec {
  double stiffness_N_per_m, damping_Ns_per_m, face_mass_kg, travel_m;
};
struct ManipulatorSpec {
  double base_height_m, shoulder_m, upper_arm_m, forearm_m, tip_mass_kg, initial_preset_rad;
  std::string bus;
};
struct WorldSpec {
  double step_s, gravity_m_per_s2;
};
struct RubbleSpec {
  std::uint32_t seed;
  int boxes;
  Range height_m, side_m, step_size_m, patch_size_m;
  std::vector<double> steps_m;
  double step_gap_m, travel_deg, patch_from_m;
};
struct Wave {
  double height_m, wavelength_m, direction_deg, phase_deg;
};
struct HillsSpec {
  int samples;
  double size_m;
  Range flat_radius_m;
  std::vector<Wave> waves;
};

struct Description {
  ModuleSpec module;
  ActuatorSpec actuator;
  BenchSpec bench;
  SnakeSpec snake;
  FrankSpec frank;
  GripperSpec gripper;
  TableSpec table;
  PendulumSpec pendulum;
  BenchObjectSpec bench_object;
  BenchSpec throwing;
  PoleSpec pole;
  ManipulatorSpec manipulator;
  WorldSpec world;
  RubbleSpec rubble;
  HillsSpec hills;
};

/// Throws InputError with every missing, unknown or impossible key at once.
[[nodiscard]] Description read_description(const std::filesystem::path& file);

/// Adds a problem for each part that such numbers leave no room.
void check_shapes(const std::string& file, const Description& description, Problems& problems);

}  // namespace vsa::generate
