// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "plugged.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "../mujoco/motion.hpp"

namespace vsa::mujoco::test {
namespace {

namespace fs = std::filesystem;

/// Before main(): the plug-in must be there before a model needs it.
const bool loaded = [] {
  mj_loadPluginLibrary(VSA_MUJOCO_PLUGIN);
  return true;
}();

ModelPtr load_file(const std::string& path, std::string& error) {
  std::array<char, 1000> text{};
  ModelPtr m(mj_loadXML(path.c_str(), nullptr, text.data(), static_cast<int>(text.size())));
  error = text.data();
  return m;
}

}  // namespace

std::string output_of(const std::string& command) {
  std::string out;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return out;
  std::array<char, 4096> part{};
  while (const std::size_t n = fread(part.data(), 1, part.size(), pipe)) out.append(part.data(), n);
  return pclose(pipe) == 0 ? out : "";
}

const mjModel& exported(const std::string& world) {
  static std::map<std::string, ModelPtr> all;
  ModelPtr& at = all[world];
  if (at) return *at;
  const fs::path folder = fs::path(VSA_BINARY_DIR) / "tests/mujoco3";
  if (output_of(std::string(VSA_PROGRAM) + " export --mjcf " + world + " --plugin --out " + folder.string()).empty())
    throw std::runtime_error("vsa export failed");
  std::string error;
  at = load_file((folder / (world + "_plugin.xml")).string(), error);
  if (!at) throw std::runtime_error(error);
  return *at;
}

ModelPtr load(const std::string& mjcf, std::string& error) {
  const auto vfs = std::make_unique<mjVFS>();
  mj_defaultVFS(vfs.get());
  mj_addBufferVFS(vfs.get(), "model.xml", mjcf.data(), static_cast<int>(mjcf.size()));
  std::array<char, 1000> text{};
  ModelPtr m(mj_loadXML("model.xml", vfs.get(), text.data(), static_cast<int>(text.size())));
  mj_deleteVFS(vfs.get());
  error = text.data();
  return m;
}

void step(const mjModel& m, mjData& d, int number, double phase) {
  if (number % kCommandEvery == 0) {
    for (int u = 0; u < static_cast<int>(m.nu) / 2; ++u) {
      const Command c = command_at(static_cast<std::size_t>(u), d.time + phase);
      d.ctrl[2 * u] = c.equilibrium;
      d.ctrl[2 * u + 1] = c.preset;
    }
  }
  mj_step(&m, &d);
}

std::vector<double> state_of(const mjModel& m, const mjData& d) {
  const int what = mjSTATE_INTEGRATION;
  std::vector<double> out(static_cast<std::size_t>(mj_stateSize(&m, what)));
  mj_getState(&m, &d, out.data(), what);
  return out;
}

void set_state(const mjModel& m, mjData& d, const std::vector<double>& state) {
  mj_setState(&m, &d, state.data(), mjSTATE_INTEGRATION);
}

std::string one_joint(const std::string& config, const std::string& actuators, const std::string& option,
                      const std::string& more_instances) {
  return R"(<mujoco model="one"><compiler angle="radian"/><option timestep="0.001" gravity="0 0 0" )" + option +
         R"(/><extension><plugin plugin="vsasim.unit"><instance name="elbow">)" + config + "</instance>" + more_instances +
         R"(</plugin></extension><worldbody><body name="arm"><joint name="elbow" axis="0 1 0" damping="0.01"/>
         <inertial pos="0 0 0" mass="0.2" diaginertia="0.002 0.002 0.002"/></body></worldbody><actuator>)" +
         actuators + R"(</actuator><sensor><plugin name="elbow" plugin="vsasim.unit" instance="elbow"/></sensor></mujoco>)";
}

}  // namespace vsa::mujoco::test
