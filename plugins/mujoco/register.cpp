// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The plug-in vsasim.unit as MuJoCo calls it (3.2 and later). All units of a model are one robot (units.hpp), which the model's first
// instance has: MuJoCo calls the instances in the model's order, in compute() before it sums the actuators' forces, in advance()
// after it has moved positions and speeds. So the first one solves for all, and the others have nothing to do.
//
//   nstate    the model has no names and no tree yet: only the configuration is looked at; what is wrong with it init() says
//   init      builds the units, or makes them like those of another mjData of this model that lives
//   compute   sensors (before MuJoCo's own of velocity), forces; pure
//   advance   commits. Not where actuation is disabled: then units stand still
//
// No exception leaves: what is wrong goes to mju_warning as one line, which MuJoCo puts behind its own error where a model is loaded.
#include <dlfcn.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bind.hpp"
#include "engine.hpp"
#include "units.hpp"
#include "versions.hpp"
#include "vsa/config/installed.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::mujoco {
namespace {

constexpr const char* kName = "vsasim.unit";

int slot_of_plugin() {
  int slot = -1;
  return engine().mjp_getPlugin(kName, &slot) == nullptr ? -1 : slot;
}

/// The instances of this plug-in, in the model's order.
std::vector<int> instances_of(const mjModel& m) {
  const int slot = slot_of_plugin();
  std::vector<int> out;
  for (int i = 0; i < static_cast<int>(m.nplugin); ++i)
    if (m.plugin[i] == slot) out.push_back(i);
  return out;
}

UnitSpec spec_of(const mjModel& m, int instance, std::string name) {
  UnitSpec out{std::move(name), {}};
  for (const char* key : kKeys) {
    const char* value = engine().mj_getPluginConfig(&m, instance, key);
    if (value != nullptr && *value != '\0') out.said.emplace(key, value);
  }
  return out;
}

/// An instance within its only actuator has no name: the actuator's then.
std::string name_of(const mjModel& m, int instance, const std::vector<int>& actuators) {
  const char* name = mj_id2name(&m, mjOBJ_PLUGIN, instance);
  if ((name == nullptr || *name == '\0') && !actuators.empty()) name = mj_id2name(&m, mjOBJ_ACTUATOR, actuators.front());
  return name == nullptr || *name == '\0' ? "unit_" + std::to_string(instance) : name;
}

std::vector<Unit> units_of(const mjModel& m, const std::vector<int>& instances) {
  std::vector<Unit> out;
  for (const int i : instances) {
    Unit unit;
    for (int a = 0; a < actuator_count(m); ++a)
      if (m.actuator_plugin[a] == i) unit.actuators.push_back(a);
    unit.spec = spec_of(m, i, name_of(m, i, unit.actuators));
    out.push_back(std::move(unit));
  }
  return out;
}

std::string one_line(const std::exception& error) {
  const auto* input = dynamic_cast<const InputError*>(&error);
  if (input == nullptr) return std::string(kName) + ": " + error.what();
  std::string out;
  for (const Problem& p : input->problems()) out += (out.empty() ? "" : "; ") + p.text();
  return out;
}

/// Whose line it is stands first: a program may have many plug-ins.
void warn(std::string_view line) {
  while (line.starts_with(": ")) line.remove_prefix(2);  // of the robot, which has no name here
  const std::string text = line.starts_with(kName) ? std::string(line) : kName + (": " + std::string(line));
  engine().mju_warning("%s", text.c_str());
}

/// What an mjData has of the units.
struct Robot {
  std::shared_ptr<const Units> pattern;  // kept alive, so that the next mjData of this model is made from it
  std::unique_ptr<Units> units;
  int head = 0;                                      // the instance that has the state
  std::vector<std::pair<int, std::size_t>> sensors;  // address in sensordata, unit
  bool failed = false;                               // told
};

Robot* robot_of(const mjData& d, int instance) {
  return reinterpret_cast<Robot*>(d.plugin_data[instance]);  // NOLINT(performance-no-int-to-ptr): MuJoCo's way
}

/// Units that were never stepped, for mjData of one model to be made from: the types' files are read once, and an edited type is of
/// effect in the next model that is compiled, not between two mjData of one (unless another was compiled in between). A binary
/// model isn't compiled: it gets the units of a model like it, while an mjData of that lives.
class Patterns {
 public:
  std::shared_ptr<const Units> get(const mjModel& m, const std::vector<Unit>& units) {
    const std::lock_guard lock(mutex_);
    std::weak_ptr<const Units>& at = all_[key_of(m, units)];
    std::shared_ptr<const Units> out = at.lock();
    if (out) check(m, units);
    if (!out) at = out = std::make_shared<const Units>(m, units);
    std::erase_if(all_, [](const auto& one) { return one.second.expired(); });
    return out;
  }

  /// A model is being compiled, and its types' files may have changed. What lives keeps its units.
  void forget() {
    const std::lock_guard lock(mutex_);
    all_.clear();
  }

 private:
  /// What Units asks of a model, where it gets those of another: neither gears nor ranges are in the key. Their number is.
  static void check(const mjModel& m, const std::vector<Unit>& units) {
    Problems problems;
    check_options(m, problems);
    for (const Unit& u : units) static_cast<void>(joint_of(m, u, u.actuators.size(), problems));
    problems.throw_if_any();
  }

  /// All that units are made of.
  static std::string key_of(const mjModel& m, const std::vector<Unit>& units) {
    std::string key = config::number_text(m.opt.timestep) + ' ' + std::to_string(m.opt.integrator);
    for (const Unit& u : units) {
      key += '\n' + u.spec.name;
      for (const auto& [name, value] : u.spec.said) key += '\t' + name + '=' + value;
      for (const int a : u.actuators) {
        const int joint = m.actuator_trnid[2 * a];
        key += "\tactuator " + std::to_string(a) + " joint " + std::to_string(joint);
        if (m.actuator_trntype[a] != mjTRN_JOINT) continue;  // refused
        key += ' ' + joint_name(m, joint) + " type " + std::to_string(m.jnt_type[joint]) + " at " +
               std::to_string(m.jnt_qposadr[joint]) + " from " + config::number_text(m.qpos0[m.jnt_qposadr[joint]]);
        for (int dof = m.jnt_dofadr[joint]; dof >= 0; dof = m.dof_parentid[dof]) key += ' ' + std::to_string(dof);
      }
    }
    return key;
  }

  std::mutex mutex_;
  std::map<std::string, std::weak_ptr<const Units>> all_;
};

Patterns& patterns = *new Patterns;  // never destroyed: a program may delete its data after this library's statics

std::vector<std::pair<int, std::size_t>> sensors_of(const mjModel& m, const std::vector<int>& instances) {
  std::vector<std::pair<int, std::size_t>> out;
  for (int s = 0; s < static_cast<int>(m.nsensor); ++s)
    for (std::size_t u = 0; u < instances.size(); ++u)
      if (m.sensor_plugin[s] == instances[u]) out.emplace_back(m.sensor_adr[s], u);
  return out;
}

std::span<double> state_of(const mjModel& m, mjData& d, const Robot& robot) {
  return {d.plugin_state + m.plugin_stateadr[robot.head], robot.units->state_size()};
}

int number_of_states(const mjModel* m, int instance) {
  try {
    const std::vector<int> instances = instances_of(*m);
    if (instances.front() != instance) return 0;
    patterns.forget();
    std::vector<UnitSpec> specs;
    for (const int i : instances) specs.push_back(spec_of(*m, i, "unit_" + std::to_string(i)));
    return static_cast<int>(Units::state_size(specs, static_cast<std::size_t>(m->nv)));
  } catch (const std::exception&) {
    return 0;  // init() says why, with names
  }
}

int number_of_readings(const mjModel*, int, int) { return static_cast<int>(kReadings); }

int init(const mjModel* m, mjData* d, int instance) {
  d->plugin_data[instance] = 0;
  try {
    const std::vector<int> instances = instances_of(*m);
    if (instances.front() != instance) return 0;
    auto robot = std::make_unique<Robot>();
    robot->pattern = patterns.get(*m, units_of(*m, instances));
    robot->units = robot->pattern->clone();
    robot->units->report_to(warn);
    robot->head = instance;
    robot->sensors = sensors_of(*m, instances);
    if (const auto room = static_cast<std::size_t>(m->plugin_statenum[instance]); room != robot->units->state_size())
      throw InputError(
          {kName, "state", std::to_string(room), "a type's file was changed since the model was loaded", "load it again"});
    d->plugin_data[instance] = reinterpret_cast<uintptr_t>(robot.release());
    return 0;
  } catch (const std::exception& error) {
    warn(one_line(error));
  }
  return -1;
}

void destroy(mjData* d, int instance) {
  delete robot_of(*d, instance);
  d->plugin_data[instance] = 0;
}

void copy(mjData* to, const mjModel*, const mjData* from, int instance) {
  Robot *const robot = robot_of(*to, instance), *const other = robot_of(*from, instance);
  if (robot == nullptr || other == nullptr) return;
  try {
    robot->units->copy_step(*other->units);
  } catch (const std::exception& error) {
    warn(one_line(error));
  }
}

void reset(const mjModel*, mjtNum* state, void* data, int) {
  if (const auto* robot = static_cast<Robot*>(data)) robot->units->reset({state, robot->units->state_size()});
}

void sense(const mjModel& m, mjData& d, Robot& robot, bool works) {
  if (robot.sensors.empty()) return;
  if (works) robot.units->observe(d, state_of(m, d, robot));
  for (const auto& [address, unit] : robot.sensors) {
    const std::span<double> out(d.sensordata + address, kReadings);
    if (works) robot.units->read(unit, out);
    if (!works) std::fill(out.begin(), out.end(), 0.0);
  }
}

/// The first actuator carries the torque, the second only its control.
void drive(const mjModel& m, mjData& d, Robot& robot, bool works) {
  if (works) robot.units->compute(m, d, state_of(m, d, robot));
  for (std::size_t u = 0; u < robot.units->size(); ++u) {
    const std::vector<int>& actuators = robot.units->unit(u).actuators;
    for (const int a : actuators) d.actuator_force[force_address(m, a)] = 0;
    if (works) d.actuator_force[force_address(m, actuators.front())] = robot.units->torque(u);
  }
}

void compute(const mjModel* m, mjData* d, int instance, int capability) {
  Robot* const robot = robot_of(*d, instance);
  if (robot == nullptr) return;
  const auto act = capability == mjPLUGIN_SENSOR ? sense : drive;
  try {
    act(*m, *d, *robot, true);
    robot->failed = false;
  } catch (const std::exception& error) {  // a state that no units have
    if (!robot->failed) warn(one_line(error));
    robot->failed = true;
    act(*m, *d, *robot, false);
  }
}

void advance(const mjModel* m, mjData* d, int instance) {
  Robot* const robot = robot_of(*d, instance);
  if (robot == nullptr || (m->opt.disableflags & mjDSBL_ACTUATION) != 0) return;
  try {
    robot->units->advance(*m, *d, state_of(*m, *d, *robot));
  } catch (const std::exception& error) {
    warn(one_line(error));
  }
}

/// Below the prefix that this library was installed to; in a build tree there is none, and the source tree has the data.
void find_data() {
  static std::string directory;
  Dl_info self{};
  if (dladdr(reinterpret_cast<const void*>(&find_data), &self) == 0 || self.dli_fname == nullptr) return;
  std::error_code none;
  std::filesystem::path folder = std::filesystem::weakly_canonical(self.dli_fname, none).parent_path();  // of a link: its target's
  for (int up = 0; up < 4; ++up, folder = folder.parent_path()) {
    if (!std::filesystem::is_directory(folder / "share/vsa/actuators", none)) continue;
    directory = (folder / "share/vsa").string();
    config::loaded_with(directory.c_str());
    return;
  }
}

void register_plugin() {
  mjpPlugin plugin{};
  plugin.name = kName;
  plugin.nattribute = static_cast<int>(kKeys.size());
  plugin.attributes = kKeys.data();
  plugin.capabilityflags = mjPLUGIN_ACTUATOR | mjPLUGIN_SENSOR;
  plugin.needstage = mjSTAGE_POS;
  plugin.nstate = number_of_states;
  plugin.nsensordata = number_of_readings;
  plugin.init = init;
  plugin.destroy = destroy;
  plugin.copy = copy;
  plugin.reset = reset;
  plugin.compute = compute;
  plugin.advance = advance;
  engine().mjp_registerPlugin(&plugin);
}

/// Why the plug-in isn't there; empty: it is.
constinit const std::string* problem = nullptr;

/// Before this library's other initialisations, so it works with what needs none.
__attribute__((constructor)) void loaded() {
  problem = new std::string(find_engine());
  if (!problem->empty()) {
    std::fprintf(stderr, "%s\n", problem->c_str());
    return;
  }
  find_data();
  register_plugin();
}

}  // namespace
}  // namespace vsa::mujoco

extern "C" {
/// The version of MuJoCo that this library is for: "3.2.3".
__attribute__((visibility("default"))) const char* vsa_mujoco_for() {
  static const std::string text = vsa::mujoco::version_text(mjVERSION_HEADER);
  return text.c_str();
}
/// Why vsasim.unit isn't registered, as one line; empty: it is.
__attribute__((visibility("default"))) const char* vsa_mujoco_problem() { return vsa::mujoco::problem->c_str(); }
}
