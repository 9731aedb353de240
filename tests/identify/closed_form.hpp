// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A model that needs no simulator: the symmetric sinh pair in closed form, with what a drive and a shaft take from it.
//
//   2k cosh(a (p − d)) sinh(a (δ − z)) = τ − f rising, τ + f falling
//
// k: elastic.k1_Nm = elastic.k2_Nm, d: shortfall of the preset (stands for drive.dead_band), f: shaft.friction_Nm, z:
// sensor.encoder_zero_rad
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "vsa/identify/task.hpp"

namespace vsa::test {

constexpr double kA_per_rad = 6.85;
constexpr const char* kFour = "elastic.k1_Nm=elastic.k2_Nm,drive.dead_band,shaft.friction_Nm,sensor.encoder_zero_rad";
inline const std::vector<double> kTruth{0.025, 0.07, 0.03, 0.009};

inline double deflection(const std::vector<double>& v, double preset, double torque, bool rising) {
  const double load = rising ? torque - v[2] : torque + v[2];
  return std::asinh(load / (2 * v[0] * std::cosh(kA_per_rad * (preset - v[1])))) / kA_per_rad + v[3];
}

inline experiment::Branches closed_form(const std::vector<double>& v, double preset) {
  experiment::Branches b;
  for (int i = -28; i <= 28; ++i) {
    const double torque = i * 0.05;
    b.torque_Nm.push_back(torque);
    b.rising_rad.push_back(deflection(v, preset, torque, true));
    b.falling_rad.push_back(deflection(v, preset, torque, false));
    b.sd_rising_rad.push_back(0.003);
    b.sd_falling_rad.push_back(0.003);
  }
  return b;
}

inline config::TypeLibrary shipped() { return config::TypeLibrary({std::filesystem::path(VSA_SOURCE_DIR) / "actuators"}); }
/// The paper's parameters: a type that identification doesn't write.
inline config::ActuatorType paper_type() { return shipped().load("qbmove_maker_pro_datasheet"); }

inline identify::Task task_of(std::vector<identify::Parameter> parameters, const std::vector<double>& presets,
                              const std::vector<experiment::Branches>& data) {
  identify::Task task;
  task.parameters = std::move(parameters);
  for (std::size_t i = 0; i < presets.size(); ++i) {
    task.observations.push_back({"recording " + std::to_string(i), presets[i], data[i], identify::scatter_weight(data[i])});
  }
  task.model = [presets](const std::vector<double>& values, std::size_t o) { return closed_form(values, presets[o]); };
  return task;
}

/// Errors of one branch: stationary, standard deviation `sd`, correlation ρ between neighbours.
inline void add_errors(std::vector<double>& branch, double sd, double rho, std::mt19937& random) {
  std::normal_distribution<double> normal;
  double error = sd * normal(random);
  for (double& v : branch) {
    v += error;
    error = rho * error + sd * std::sqrt(1 - rho * rho) * normal(random);
  }
}

/// A recording of a sweep as the unit would give it: torque from the shaft's encoder, deflection on the encoders' lattice, noise.
inline experiment::LoadRecording quantised_recording(const std::vector<double>& v, double preset, double noise_rad, unsigned seed) {
  constexpr double kLattice_rad = 2 * std::numbers::pi / 8192, kShaft_rad = 2 * std::numbers::pi / 4096;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, std::max(noise_rad, 1e-9));
  experiment::LoadRecording r;
  r.preset = preset;
  for (int i = 0; i < 5000; ++i) {
    const double phase = 2 * std::numbers::pi * i / 2000.0;
    const double torque = 1.47 * std::sin(std::round(1.6 * std::sin(phase) / kShaft_rad) * kShaft_rad);
    r.torque_Nm.push_back(torque);
    r.deflection_rad.push_back(
        std::round((deflection(v, preset, torque, std::cos(phase) > 0) + (noise_rad > 0 ? normal(random) : 0.0)) / kLattice_rad) *
        kLattice_rad);
  }
  return r;
}

}  // namespace vsa::test
