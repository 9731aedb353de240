// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "impact.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "vsa/engine/world.hpp"
#include "vsa/units.hpp"

namespace vsa::stiffness_uses {
namespace {

using engine::Contact;
using engine::Pose;
using engine::World;

constexpr double kSettle_s = 2.5;  // for the presets, with the ball held
constexpr double kApart_s = 0.2;
constexpr double kMean_s = 0.05;
constexpr double kStill_rad = kPi / 180;
constexpr const char* kCord = "pendulum::cord";
constexpr const char* kShoulder = "frank::right_shoulder";

// As in models/robots.toml, [pendulum].
constexpr double kMass = 1.0, kCordLength = 0.6, kRadius = 0.05, kRaised_rad = 24 * kPi / 180, kGravity = 9.81;
constexpr double kInertia = kMass * (kCordLength * kCordLength + 0.4 * kRadius * kRadius);

std::array<double, 3> cross(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

std::size_t link_index(const World& world, const std::string& name) {
  const auto& links = world.links();
  const auto it = std::find_if(links.begin(), links.end(), [&](const auto& l) { return l.name == name; });
  return static_cast<std::size_t>(it - links.begin());
}

/// The ball, its cord's pivot and the contact's torque about it.
class Ball {
 public:
  explicit Ball(const World& world) : link_(link_index(world, "pendulum::ball")), poses_(world.links().size()) {
    world.poses(poses_);
    pivot_ = poses_[link_].position;
    const auto& q = poses_[link_].quaternion;  // the cord's axis is the link's y and keeps its direction
    axis_ = {2 * (q[1] * q[2] - q[0] * q[3]), 1 - 2 * (q[1] * q[1] + q[3] * q[3]), 2 * (q[2] * q[3] + q[0] * q[1])};
  }
  /// Of the last step, about the cord's axis; the sum of the contacts' forces goes to force_N.
  double torque(const World& world, double& force_N) {
    world.contacts(contacts_);
    double torque = 0;
    std::array<double, 3> sum{};
    for (const Contact& c : contacts_) {
      if (c.link != link_ && c.other != link_) continue;
      const double sign = c.link == link_ ? 1 : -1;
      std::array<double, 3> arm{}, force{};
      for (std::size_t i = 0; i < 3; ++i) {
        arm[i] = c.position[i] - pivot_[i];
        force[i] = sign * c.force_N[i];
        sum[i] += force[i];
      }
      const auto moment = cross(arm, force);
      torque += moment[0] * axis_[0] + moment[1] * axis_[1] + moment[2] * axis_[2];
    }
    force_N = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    return torque;
  }

 private:
  std::size_t link_;
  std::vector<Pose> poses_;
  std::vector<Contact> contacts_;
  std::array<double, 3> pivot_{}, axis_{};
};

double ball_energy(const World& world) {
  const double angle = world.joint_angle(kCord) - kRaised_rad, speed = world.joint_speed(kCord);
  return kInertia * speed * speed / 2 + kMass * kGravity * kCordLength * (1 - std::cos(angle));
}

World ready(double preset_rad) {
  World world = World::load("frank_ball.sdf");
  for (const char* joint : {"right_shoulder", "right_elbow"}) world.command(joint, 0, preset_rad);
  const auto steps = std::llround(kSettle_s / world.step_s());
  for (std::int64_t i = 0; i < steps; ++i) {
    world.set_joint(kCord, 0, 0);
    world.step();
  }
  world.set_joint(kCord, 0, 0);
  return world;
}

/// Since when the shoulder is within 1° of where it ends.
double settled(const ImpactTrace& trace, double hit_s) {
  const double end = trace.shoulder_deg.back();
  std::size_t i = trace.shoulder_deg.size();
  while (i > 0 && std::abs(trace.shoulder_deg[i - 1] - end) * kPi / 180 < kStill_rad) --i;
  return i == 0 ? 0 : std::max(0.0, trace.time_s[i - 1] - hit_s);
}

/// The largest mean of a signal over a window.
class LargestMean {
 public:
  explicit LargestMean(std::size_t samples) : samples_(samples) {}
  double add(double value) {
    window_.push_back(value);
    sum_ += value;
    if (window_.size() > samples_) {
      sum_ -= window_.front();
      window_.pop_front();
    }
    largest_ = std::max(largest_, sum_ / static_cast<double>(samples_));
    return largest_;
  }

 private:
  std::size_t samples_;
  std::deque<double> window_;
  double sum_ = 0, largest_ = 0;
};

/// Of the ball just before a step.
struct BallState {
  double angle_rad = 0, speed_rad_per_s = 0, energy_J = 0;
};

BallState ball_state(const World& world) {
  return {world.joint_angle(kCord) - kRaised_rad, world.joint_speed(kCord), ball_energy(world)};
}

/// From the first touch until ball and hand have been apart for kApart_s.
class Encounter {
 public:
  Encounter(ImpactRun& run, double dt) : run_(run), dt_(dt), push_(static_cast<std::size_t>(std::llround(kMean_s / dt))) {}
  [[nodiscard]] double hit_s() const { return hit_s_; }

  void step(double t_s, const BallState& before, const BallState& after, double torque, double force) {
    if (hit_s_ < 0 && force > 0) {
      hit_s_ = t_s;
      energy_J_ = before.energy_J;
      run_.ball_speed_m_per_s = before.speed_rad_per_s * kCordLength;
      momentum_ = -kInertia * before.speed_rad_per_s;
    }
    if (hit_s_ < 0 || over_) return;
    impulse_ += torque * dt_;
    momentum_ += kMass * kGravity * kCordLength * std::sin(before.angle_rad) * dt_;
    if (force > 0) last_s_ = t_s;
    run_.peak_N = std::max(run_.peak_N, force);
    run_.push_N = push_.add(force);
    over_ = t_s - last_s_ >= kApart_s - dt_ / 2;
    finish(after);
  }

 private:
  /// As if it ended here; the last call stands.
  void finish(const BallState& ball) {
    run_.ball_after_m_per_s = ball.speed_rad_per_s * kCordLength;
    run_.absorbed_J = energy_J_ - ball.energy_J;
    run_.contact_s = last_s_ - hit_s_;
    run_.impulse_Ns = -impulse_ / kCordLength;
    run_.momentum_Ns = -(momentum_ + kInertia * ball.speed_rad_per_s) / kCordLength;
  }

  ImpactRun& run_;
  double dt_;
  LargestMean push_;
  double hit_s_ = -1, last_s_ = -1, impulse_ = 0, momentum_ = 0, energy_J_ = 0;
  bool over_ = false;
};

}  // namespace

ImpactRun run_impact(double preset_rad, double duration_s) {
  World world = ready(preset_rad);
  Ball ball(world);
  ImpactRun run;
  run.preset_rad = preset_rad;
  run.attained_rad = world.read("right_shoulder").preset;
  run.stiffness_Nm_per_rad = world.read("right_shoulder").stiffness_Nm_per_rad;
  const double rest_rad = world.joint_angle(kShoulder), start_s = world.time_s(), dt = world.step_s();
  Encounter encounter(run, dt);
  const auto steps = std::llround(duration_s / dt);
  for (std::int64_t i = 0; i < steps; ++i) {
    const BallState before = ball_state(world);
    world.step();
    double force = 0;
    const double torque = ball.torque(world, force), t_s = world.time_s() - start_s;
    encounter.step(t_s, before, ball_state(world), torque, force);
    const double shoulder_deg = (world.joint_angle(kShoulder) - rest_rad) * 180 / kPi;
    run.shoulder_deg = std::max(run.shoulder_deg, std::abs(shoulder_deg));
    run.trace.time_s.push_back(t_s);
    run.trace.force_N.push_back(force);
    run.trace.shoulder_deg.push_back(shoulder_deg);
  }
  run.settle_s = settled(run.trace, encounter.hit_s());
  return run;
}

}  // namespace vsa::stiffness_uses
