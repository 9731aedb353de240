// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "classic_world.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <gazebo/common/SystemPaths.hh>
#include <stdexcept>

namespace vsa::test {
namespace {

int free_port() {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (bind(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) throw std::runtime_error("no free port");
  getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size);
  close(fd);
  return ntohs(address.sin_port);
}

int worlds_made = 0;

}  // namespace

void start_server() {
  setenv("GAZEBO_MASTER_URI", ("http://127.0.0.1:" + std::to_string(free_port())).c_str(), 1);
  setenv("GAZEBO_IP", "127.0.0.1", 1);
  setenv("GAZEBO_MODEL_DATABASE_URI", "", 1);
  setenv("IGN_IP", "127.0.0.1", 1);
  setenv("IGN_PARTITION", ("vsa_test_" + std::to_string(getpid())).c_str(), 1);
  gazebo::setupServer(std::vector<std::string>{});
  gazebo::common::Console::SetQuiet(false);
  // Not through the environment: the library read that when it was loaded.
  gazebo::common::SystemPaths::Instance()->AddModelPaths(VSA_SOURCE_DIR "/models");
  gazebo::common::SystemPaths::Instance()->AddPluginPaths(VSA_CLASSIC_PLUGIN_DIR);
}

std::string temporary_directory() {
  const char* set = std::getenv("TMPDIR");
  return set != nullptr && *set != '\0' ? set : "/tmp";
}

std::string world_sdf(const std::string& name, const std::string& inside, bool gravity) {
  return "<sdf version='1.7'><world name='" + name + "'><gravity>0 0 " + (gravity ? "-9.81" : "0") +
         "</gravity><physics name='step' type='ode'><max_step_size>0.001</max_step_size>"
         "<real_time_update_rate>0</real_time_update_rate></physics>" +
         inside + "</world></sdf>";
}

std::string include(const std::string& model, const std::string& name, const std::string& pose) {
  return "<include><uri>model://" + model + "</uri><name>" + name + "</name><pose>" + pose + "</pose></include>";
}

std::string read_file(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("can't read " + path);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string model_text(const std::string& model) {
  const std::string file = read_file(VSA_SOURCE_DIR "/models/" + model + "/model.sdf");
  const auto begin = file.find("<model"), end = file.find("</sdf>");
  return file.substr(begin, end - begin);
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  if (at == std::string::npos) throw std::runtime_error("there is no " + what);
  return text.replace(at, what.size(), with);
}

std::string without(std::string text, const std::string& from, const std::string& to) {
  const auto a = text.find(from), b = text.find(to, a);
  if (a == std::string::npos || b == std::string::npos) throw std::runtime_error("there is no " + from + " … " + to);
  return text.erase(a, b + to.size() - a);
}

bool long_run() { return std::getenv("VSA_TEST_LONG") != nullptr; }

ClassicWorld::ClassicWorld(const std::string& sdf, const std::string& engine) {
  std::string text = sdf;
  const auto at = text.find("type='ode'");
  if (engine != "ode" && at != std::string::npos) text.replace(at, 10, "type='" + engine + "'");
  // A name of its own: requests to remove the models of the last world may still be under way, and would reach a world of that
  // name.
  const std::string name = "<world name='";
  if (const auto world_at = text.find(name); world_at != std::string::npos) {
    text.insert(world_at + name.size(), "w" + std::to_string(worlds_made++) + "_");
  }
  const std::string file = temporary_directory() + "/vsa_" + std::to_string(getpid()) + ".world";
  std::ofstream(file) << text;
  world = gazebo::loadWorld(file);
  std::remove(file.c_str());
  if (!world) throw std::runtime_error("Gazebo didn't load the world");
  // Plug-ins are loaded in the first step after the sensors are ready; a server's own loop would say so.
  world->_SetSensorsInitialized(true);
}

ClassicWorld::~ClassicWorld() {
  world.reset();
  gazebo::physics::remove_worlds();
}

gazebo::physics::JointPtr ClassicWorld::joint(const std::string& model, const std::string& name) const {
  const auto found = world->ModelByName(model);
  const auto joint = found ? found->GetJoint(name) : nullptr;
  if (!joint) throw std::runtime_error("no joint " + name + " in " + model);
  return joint;
}

double ClassicWorld::angle(const std::string& model, const std::string& name) const { return joint(model, name)->Position(0); }

std::vector<double> ClassicWorld::record(const std::string& model, int steps) {
  std::vector<double> out;
  const auto shaft = joint(model);
  // Not runWorld() a step at a time: it starts and joins threads.
  const auto connection = gazebo::event::Events::ConnectWorldUpdateEnd([&] { out.push_back(shaft->Position(0)); });
  run(steps);
  return out;
}

bool ClassicWorld::run_until(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    run(20);
  }
  return true;
}

std::unique_ptr<plugins::ClassicRobot> load_robot(const gazebo::physics::WorldPtr& world, const std::string& model) {
  const sdf::SDFPtr parsed(new sdf::SDF);
  sdf::init(parsed);
  if (!sdf::readString("<sdf version='1.7'>" + model + "</sdf>", parsed)) throw std::runtime_error("Gazebo can't read the model");
  const auto element = parsed->Root()->GetElement("model");
  auto plugin = std::make_unique<plugins::ClassicRobot>();
  plugin->Load(world->ModelByName(element->Get<std::string>("name")), element->GetElement("plugin"));
  return plugin;
}

RobotWorld::RobotWorld(const std::string& name, const std::string& model, const std::string& engine, const std::string& others,
                       bool gravity)
    : ClassicWorld(world_sdf(name, others + without(model, "<plugin", "</plugin>"), gravity), engine),
      plugin_(load_robot(world, model)) {
  if (plugin_->seat() == nullptr) throw std::runtime_error("the plug-in didn't load");
  if (world->Physics()->GetType() != engine) throw std::runtime_error("Gazebo has no " + engine);
}

void RobotWorld::reset() {
  world->Reset();
  plugin_->Reset();
}

}  // namespace vsa::test
