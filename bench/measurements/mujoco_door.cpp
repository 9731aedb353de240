// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What the MuJoCo plug-in adds: the snake's step in the embedded engine, and in the same MuJoCo with the plug-in's units beside it
// (tests/mujoco/rig.hpp), told the same; and in MuJoCo alone, which is given the torques that the engine's actuators had and begins
// every turn where the engine does. They move alike, so turns of a few steps by each are the same work at the same time on the same busy machine: processor time, and of the ratios
// medians over the turns.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <vector>

#include "mujoco/motion.hpp"
#include "mujoco/rig.hpp"
#include "vsa/engine/mjcf.hpp"
#include "vsa/engine/world.hpp"

namespace {

using namespace vsa;
constexpr int kTurns = 400, kSteps = 50;

template <class Step>
double us_per_step(Step&& step) {
  const std::clock_t begin = std::clock();
  for (int k = 0; k < kSteps; ++k) step(k);
  return 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / kSteps;
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

/// Two commands a unit, now and then.
template <class Tell>
void tell(int step, std::size_t units, double time_s, Tell&& one) {
  if (step % mujoco::test::kCommandEvery != 0) return;
  for (std::size_t i = 0; i < units; ++i) one(i, mujoco::test::command_at(i, time_s));
}

/// mj_step() of the same file and nothing else.
class Alone {
 public:
  Alone(const std::filesystem::path& file, const engine::World& world) {
    std::array<char, 1000> error{};
    model_.reset(mj_loadXML(file.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
    if (model_ == nullptr) throw std::runtime_error(error.data());
    data_.reset(mj_makeData(model_.get()));
    mj_resetDataKeyframe(model_.get(), data_.get(), 0);
    for (const engine::ActuatorRef& ref : world.actuators()) {
      const int joint = mj_name2id(model_.get(), mjOBJ_JOINT,
                                   ("qbmove_snake::" + world.robot(ref.robot).config().actuators[ref.index].joint).c_str());
      if (joint < 0) throw std::runtime_error("a joint isn't found");
      dof_.push_back(model_->jnt_dofadr[joint]);
    }
  }
  /// Goes where the world is: positions, speeds and accelerations are the first of its numbers after time and steps.
  void follow(const engine::World& world) {
    state_.resize(world.state_size());
    world.save(state_);
    const double* at = std::next(state_.data(), 4);
    mju_copy(data_->qpos, at, model_->nq);
    mju_copy(data_->qvel, at + model_->nq, model_->nv);
    mju_copy(data_->qacc_warmstart, at + model_->nq + model_->nv, model_->nv);
  }
  void step(const double* torques) {
    for (std::size_t i = 0; i < dof_.size(); ++i) data_->qfrc_applied[dof_[i]] = torques[i];
    mj_step(model_.get(), data_.get());
  }
  [[nodiscard]] double speed(std::size_t actuator) const { return data_->qvel[dof_[actuator]]; }

 private:
  std::unique_ptr<mjModel, mujoco::test::Deleter> model_;
  std::unique_ptr<mjData, mujoco::test::Deleter> data_;
  std::vector<int> dof_;
  std::vector<double> state_;
};

std::filesystem::path file() { return std::filesystem::path(VSA_SOURCE_DIR) / "models/worlds/snake_flat.xml"; }

void step_told(engine::World& world, int k) {
  tell(k, world.actuators().size(), world.time_s(),
       [&](std::size_t i, auto c) { world.command(world.actuators()[i], c.equilibrium, c.preset); });
  world.step();
}

void plug_in() {
  engine::World world = engine::World::load(file());
  const std::string mjcf = engine::export_plugin_mjcf(file()).file.bytes;
  std::string blind = mjcf;  // without sensors
  blind.erase(blind.find("<sensor>"), blind.find("</sensor>") + 9 - blind.find("<sensor>"));
  const mujoco::test::Rig rig(mjcf), blind_rig(blind);
  mujoco::test::Data data(rig), blind_data(blind_rig);
  data.key(0);
  blind_data.key(0);
  const std::size_t n = world.actuators().size();
  const auto in_mujoco = [&](mujoco::test::Data& d, int k) {
    tell(k, n, d.d().time, [&](std::size_t i, auto c) {
      d.d().ctrl[2 * i] = c.equilibrium;
      d.d().ctrl[2 * i + 1] = c.preset;
    });
    d.step();
  };
  std::array<std::vector<double>, 3> us, ratio;
  for (int turn = 0; turn < kTurns; ++turn) {
    const std::array<double, 3> now{us_per_step([&](int k) { step_told(world, k); }),
                                    us_per_step([&](int k) { in_mujoco(blind_data, k); }),
                                    us_per_step([&](int k) { in_mujoco(data, k); })};
    for (std::size_t i = 0; i < now.size(); ++i) {
      us[i].push_back(now[i]);
      ratio[i].push_back(now[i] / now[0]);
    }
  }
  std::printf("snake_flat, %zu units, MuJoCo %s, us a step, medians of %d turns:\n", n, mj_versionString(), kTurns);
  const std::array<const char*, 3> what{"embedded engine", "plug-in's units", "and 12 sensors"};
  for (std::size_t i = 0; i < what.size(); ++i)
    std::printf("  %-16s %.1f (%+.1f %%)\n", what[i], median(us[i]), 100 * (median(ratio[i]) - 1));
}

void mujoco_alone() {
  engine::World world = engine::World::load(file()), ahead = world.clone();
  Alone alone(file(), world);
  const std::size_t n = world.actuators().size();
  std::vector<double> torques(n * kSteps), us_alone, ratio;
  double off = 0;
  for (int turn = 0; turn < kTurns; ++turn) {
    alone.follow(world);
    for (std::size_t k = 0; k < kSteps; ++k) {
      step_told(ahead, static_cast<int>(k));
      for (std::size_t i = 0; i < n; ++i) torques[k * n + i] = ahead.read(ahead.actuators()[i]).mean_torque_Nm;
    }
    const double engine = us_per_step([&](int k) { step_told(world, k); });
    us_alone.push_back(us_per_step([&](int k) { alone.step(&torques[static_cast<std::size_t>(k) * n]); }));
    ratio.push_back(engine / us_alone.back());
    for (std::size_t i = 0; i < n; ++i)
      off = std::max(off, std::abs(alone.speed(i) - world.read(world.actuators()[i]).shaft_speed_rad_per_s));
  }
  std::printf("MuJoCo alone, given the same torques: %.1f us a step, the embedded engine's is %.3f times that\n", median(us_alone),
              median(ratio));
  std::printf("  at the end of a turn speeds of their joints differ by %.2g rad/s at most\n", off);
}

}  // namespace

int main() {
  plug_in();
  mujoco_alone();
}
