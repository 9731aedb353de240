// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "gz_world.hpp"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sdf/sdf.hh>
#include <stdexcept>

#include "support/heap.hpp"

#ifdef VSA_GZ_TRANSPORT
#define VSA_SIM_LIBRARY "gz-sim"
#define VSA_SIM_CLASS "gz::sim::systems::"
#define VSA_PATH_VARIABLE "GZ_SIM_SYSTEM_PLUGIN_PATH"
#define VSA_CONFIG_VARIABLE "GZ_SIM_SERVER_CONFIG_PATH"
#else
#define VSA_SIM_LIBRARY "ignition-gazebo"
#define VSA_SIM_CLASS "ignition::gazebo::systems::"
#define VSA_PATH_VARIABLE "IGN_GAZEBO_SYSTEM_PLUGIN_PATH"
#define VSA_CONFIG_VARIABLE "IGN_GAZEBO_SERVER_CONFIG_PATH"
#endif

namespace vsa::test {
namespace {

/// "UserCommands" → "user-commands"
std::string dashed(const std::string& name) {
  std::string out;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') {
      if (!out.empty()) out += '-';
      out += static_cast<char>(c - 'A' + 'a');
    } else {
      out += c;
    }
  }
  return out;
}

sim::Entity joint_entity(const sim::EntityComponentManager& ecm, const std::string& model, const std::string& joint) {
  const auto found = sim::entitiesFromScopedName(model + "::" + joint, ecm);
  return found.empty() ? sim::kNullEntity : *found.begin();
}

template <class Component>
double first_number(const sim::EntityComponentManager& ecm, const std::string& model, const std::string& joint) {
  const sim::Entity entity = joint_entity(ecm, model, joint);
  if (entity == sim::kNullEntity) return std::nan("");
  const auto* component = ecm.Component<Component>(entity);
  return component == nullptr || component->Data().empty() ? 0.0 : component->Data().front();
}

template <class Component>
void put(sim::EntityComponentManager& ecm, const std::string& model, const std::string& joint, double value) {
  ecm.CreateComponent(joint_entity(ecm, model, joint), Component({value}));
}

}  // namespace

void prepare() {
  setenv(VSA_PATH_VARIABLE, VSA_SIM_PLUGIN_DIR, 1);
  setenv(VSA_CONFIG_VARIABLE, "", 1);  // from Ionic on its systems come to worlds that name their own, too
  for (const char* name : {"IGN_IP", "GZ_IP"}) setenv(name, "127.0.0.1", 1);
  const std::string partition = "vsa_test_" + std::to_string(getpid());
  for (const char* name : {"IGN_PARTITION", "GZ_PARTITION"}) setenv(name, partition.c_str(), 0);
  // Discovery of its own, too: processes of other partitions connect to every service that they hear of, and after one has ended
  // they connect to its process again (gz-transport, NodeShared::OnNewSrvDisconnection), 66 kB each time.
  const int port = 20'000 + 2 * (getpid() % 6'000);
  for (const char* name : {"IGN_DISCOVERY_MSG_PORT", "GZ_DISCOVERY_MSG_PORT"}) setenv(name, std::to_string(port).c_str(), 0);
  for (const char* name : {"IGN_DISCOVERY_SRV_PORT", "GZ_DISCOVERY_SRV_PORT"}) setenv(name, std::to_string(port + 1).c_str(), 0);
}

std::string read_file(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("can't read " + path);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  if (at == std::string::npos) throw std::runtime_error("not there: " + what);
  return text.replace(at, what.size(), with);
}

std::string model_text(const std::string& model, const std::string& name, const std::string& pose) {
  const std::string file = read_file(VSA_SOURCE_DIR "/models/" + model + "/model.sdf");
  const auto begin = file.find("<model"), end = file.find("</sdf>");
  std::string text = replaced(file.substr(begin, end - begin), '"' + model + '"', '"' + name + '"');
  return text.insert(text.find('>') + 1, "<pose>" + pose + "</pose>");
}

std::string without_plugin(std::string model) {
  const auto from = model.find("<plugin");
  return model.erase(from, model.find("</plugin>") + 9 - from);
}

std::string bench(const std::string& name, const std::string& pose) { return model_text("qbmove_bench_load", name, pose); }

std::string world_text(const std::string& inside, const WorldText& world) {
  std::string text = "<world name='" + world.name + "'><gravity>0 0 " + (world.gravity ? "-9.81" : "0") + "</gravity>";
  text += !world.physics.empty() ? world.physics
                                 : "<physics name='step' type='dart'><max_step_size>" + std::to_string(world.step_s) +
                                       "</max_step_size><real_time_factor>0</real_time_factor></physics>";
  for (const std::string& system : world.systems) {
    text += "<plugin filename='" VSA_SIM_LIBRARY "-" + dashed(system) + "-system' name='" VSA_SIM_CLASS + system + "'/>";
  }
  return text + inside + "</world>";
}

std::string sdf_text(const std::string& content) { return "<sdf version='1.7'>" + content + "</sdf>"; }

std::string physics_of(const std::string& world) {
  const std::string file = read_file(VSA_SOURCE_DIR "/models/worlds/" + world + ".sdf"), end = "</physics>";
  const auto begin = file.find("<physics");
  const std::string physics = file.substr(begin, file.find(end) + end.size() - begin);
  return replaced(physics, "<real_time_factor>1<", "<real_time_factor>0<");
}

SimWorld::SimWorld(const std::string& sdf, unsigned worlds) {
  prepare();
  sim::ServerConfig config;
  config.SetSdfString(sdf);
  server = std::make_unique<sim::Server>(config);
  for (unsigned i = 0; i < worlds; ++i) {
    probes.push_back(std::make_shared<Probe>());
    if (!server->AddSystem(probes.back(), i).value_or(false)) throw std::runtime_error("gz-sim didn't load the world");
  }
}

double SimWorld::angle(const std::string& model, const std::string& joint, unsigned world) const {
  return first_number<components::JointPosition>(ecm(world), model, joint);
}

double SimWorld::speed(const std::string& model, const std::string& joint) const {
  return first_number<components::JointVelocity>(ecm(), model, joint);
}

void SimWorld::set_speed(const std::string& model, double rad_per_s, const std::string& joint) {
  put<components::JointVelocityReset>(ecm(), model, joint, rad_per_s);
}

void SimWorld::set_angle(const std::string& model, double rad, const std::string& joint) {
  put<components::JointPositionReset>(ecm(), model, joint, rad);
}

std::vector<double> SimWorld::record(const std::string& model, int steps) {
  std::vector<double> out;
  probes[0]->after = [&](const sim::UpdateInfo&, const sim::EntityComponentManager&) { out.push_back(angle(model)); };
  run(steps);
  probes[0]->after = nullptr;
  return out;
}

OwnRobot::OwnRobot(std::string& model, std::string name) : name_(std::move(name)) {
  sdf::SDFPtr parsed(new sdf::SDF);
  sdf::init(parsed);
  if (!sdf::readString(sdf_text(model), parsed)) throw std::runtime_error("no SDF: " + name_);
  element_ = parsed->Root()->GetElement("model")->GetElement("plugin");
  model = without_plugin(model);
}

void OwnRobot::before_step(const sim::UpdateInfo& info, sim::EntityComponentManager& ecm) {
  if (!configured_) {
    configured_ = true;
    system_.Configure(*sim::entitiesFromScopedName(name_, ecm).begin(), element_, ecm, events_);
    if (system_.seat() == nullptr) throw std::runtime_error("the plug-in didn't load");
    if (first) first(robot());
  }
  system_.PreUpdate(info, ecm);
}

bool run_until(SimWorld& w, const std::function<bool()>& condition, int steps) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    w.run(steps);
  }
  return true;
}

void let_the_host_fill_its_pools() {
  constexpr int kBlock = 5'000;
  SimWorld w(sdf_text(world_text(model_text("terrain_flat", "ground"))));
  w.run(kBlock);
  long before = heap_in_use_kB();
  for (int i = 0; i < 60; ++i) {
    w.run(kBlock);
    const long now = heap_in_use_kB();
    if (now - before < may_grow_kB(kBlock)) return;
    before = now;
  }
}

long threads_of_this_process() {
  std::ifstream in("/proc/self/status");
  std::string word;
  while (in >> word && word != "Threads:") {
  }
  long value = 0;
  in >> value;
  return value;
}

}  // namespace vsa::test
