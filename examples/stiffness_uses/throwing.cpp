// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "throwing.hpp"

#include <algorithm>
#include <cmath>

#include "vsa/engine/world.hpp"

namespace vsa::stiffness_uses {
namespace {

constexpr double kSettle_s = 2.5, kAfter_s = 1.5;

struct Moment {
  double link_rad = 0, link_rad_per_s = 0, motor_rad_per_s = 0, equilibrium_rad = 0;
};

Moment now(const engine::World& world) {
  const host::ActuatorReading r = world.read("shaft");
  return {world.joint_angle("qbmove_bench_throw::shaft"), world.joint_speed("qbmove_bench_throw::shaft"),
          (r.motor_speed_rad_per_s[0] + r.motor_speed_rad_per_s[1]) / 2, r.equilibrium_rad};
}

}  // namespace

ThrowRun run_throw(const ThrowPlan& plan) {
  engine::World world = engine::World::load("bench_throw.sdf");
  ThrowRun run;
  run.preset_rad = plan.preset_rad;
  run.swing_back_s = plan.swing_back_s;
  world.command("shaft", 0, plan.preset_rad);
  world.run(kSettle_s);
  run.attained_rad = world.read("shaft").preset;
  const double start_s = world.time_s(), forward_s = start_s + plan.swing_back_s, supply_before = world.ledger().supply;
  const double elastic_before = world.ledger().elastic;
  const bool back = plan.swing_back_s > 0;
  if (back) world.command("shaft", -plan.swing_rad, plan.preset_rad);
  bool forward = false;
  while (world.time_s() < forward_s + kAfter_s) {
    if (!forward && world.time_s() >= forward_s - 1e-9) {
      world.command("shaft", plan.swing_rad, plan.preset_rad);
      forward = true;
    }
    world.step();
    const Moment m = now(world);
    run.motor_rad_per_s = std::max(run.motor_rad_per_s, std::abs(m.motor_rad_per_s));
    if (forward) run.spring_J = std::max(run.spring_J, world.ledger().elastic - elastic_before);
    if (forward && m.link_rad_per_s > run.link_rad_per_s) {
      run.link_rad_per_s = m.link_rad_per_s;
      run.supply_J = world.ledger().supply - supply_before;
      run.kinetic_J = world.energy().kinetic;
      run.release_deg = m.link_rad * 180 / kPi;
    }
    if (!plan.trace) continue;
    run.trace.time_s.push_back(world.time_s() - start_s);
    run.trace.equilibrium_rad.push_back(m.equilibrium_rad);
    run.trace.link_rad.push_back(m.link_rad);
    run.trace.link_rad_per_s.push_back(m.link_rad_per_s);
    run.trace.motor_rad_per_s.push_back(m.motor_rad_per_s);
  }
  run.imbalance_J = world.ledger().imbalance();
  return run;
}

std::vector<ThrowRun> sweep_throw(ThrowPlan plan, const std::vector<double>& swing_back_s) {
  std::vector<ThrowRun> runs;
  for (const double t_s : swing_back_s) {
    plan.swing_back_s = t_s;
    runs.push_back(run_throw(plan));
  }
  return runs;
}

const ThrowRun& best_of(const std::vector<ThrowRun>& runs) {
  return *std::max_element(runs.begin(), runs.end(),
                           [](const auto& a, const auto& b) { return a.link_rad_per_s < b.link_rad_per_s; });
}

}  // namespace vsa::stiffness_uses
