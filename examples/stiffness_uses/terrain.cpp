// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "terrain.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>

#include "vsa/engine/world.hpp"
#include "vsa/motion/gait.hpp"
#include "vsa/units.hpp"

namespace vsa::stiffness_uses {
namespace {

using engine::World;

constexpr const char* kSnake = "qbmove_snake";
constexpr double kGravity = 9.81;

double mass_of(const World& world) {
  double mass = 0;
  for (const auto& link : world.links()) mass += link.model == kSnake ? link.mass_kg : 0;
  return mass;
}

/// Means of the centre of mass over gait periods, and the way from one to the next.
struct Track {
  std::array<double, 2> sum{}, first{}, last{};
  int count = 0, periods = 0;
  double path_m = 0;

  void add(const std::array<double, 3>& center, int window) {
    sum[0] += center[0], sum[1] += center[1];
    if (++count < window) return;
    const std::array<double, 2> mean{sum[0] / count, sum[1] / count};
    if (periods++ == 0) first = mean;
    if (periods > 1) path_m += std::hypot(mean[0] - last[0], mean[1] - last[1]);
    last = mean;
    sum = {};
    count = 0;
  }
};

double largest_contact(const World& world, std::vector<engine::Contact>& contacts) {
  world.contacts(contacts);
  double largest = 0;
  for (const auto& c : contacts) largest = std::max(largest, std::hypot(c.force_N[0], c.force_N[1], c.force_N[2]));
  return largest;
}

}  // namespace

TerrainRun run_terrain(const TerrainPlan& plan) {
  World world = World::load("snake_" + plan.ground + ".sdf");
  const auto file = config::find_data("models/gaits/" + plan.gait + ".toml");
  motion::Gait gait = motion::Gait::load(file.value_or(plan.gait));
  const double yaw_deg = plan.starts == 1 ? 0.0 : -2.0 + 4.0 * plan.start / (plan.starts - 1);
  world.displace_model(kSnake, yaw_deg * kPi / 180, {0, 0, 0});
  TerrainRun run{plan.ground, plan.gait, plan.start};
  if (!gait.params().groups.empty()) run.preset_deg = gait.params().groups[0].preset_rad * 180 / kPi;
  const double period_s = 2 * kPi / gait.params().frequency_rad_per_s;
  const int window = static_cast<int>(std::lround(period_s / world.step_s()));
  Track track;
  std::vector<engine::Contact> contacts;
  std::vector<double> forces;
  const auto steps = std::llround(plan.duration_s / world.step_s());
  for (std::int64_t i = 0; i < steps; ++i) {
    gait.apply(world);
    world.step();
    track.add(world.center_of_mass(kSnake), window);
    forces.push_back(largest_contact(world, contacts));
  }
  run.path_m = track.path_m;
  run.net_m = std::hypot(track.last[0] - track.first[0], track.last[1] - track.first[1]);
  const double moving_s = (track.periods - 1) * window * world.step_s();
  run.speed_m_per_s = run.path_m / moving_s;
  run.net_speed_m_per_s = run.net_m / moving_s;
  run.supply_J = world.ledger().supply;
  run.cost_of_transport = run.supply_J * moving_s / plan.duration_s / (mass_of(world) * kGravity * std::max(run.net_m, 1e-9));
  std::sort(forces.begin(), forces.end());
  run.force_peak_N = forces.back();
  run.force_99_N = forces[static_cast<std::size_t>(0.99 * static_cast<double>(forces.size() - 1))];
  return run;
}

std::vector<TerrainRun> run_terrains(const std::vector<TerrainPlan>& plans, int jobs) {
  std::vector<TerrainRun> runs(plans.size());
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex lock;
  const auto work = [&] {
    for (std::size_t i = next++; i < plans.size(); i = next++) {
      try {
        runs[i] = run_terrain(plans[i]);
      } catch (...) {
        const std::scoped_lock guard(lock);
        failure = std::current_exception();
      }
    }
  };
  std::vector<std::thread> threads;
  for (int j = 0; j < std::max(jobs, 1); ++j) threads.emplace_back(work);
  for (auto& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
  return runs;
}

}  // namespace vsa::stiffness_uses
