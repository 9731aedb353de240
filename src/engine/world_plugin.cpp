// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A world's robots as elements of MuJoCo's plug-in vsasim.unit (plugins/mujoco/unit_spec.hpp has its keys).
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/world_cache.hpp"
#include "engine/world_check.hpp"
#include "vsa/config/find_file.hpp"
#include "vsa/config/text.hpp"
#include "vsa/engine/mjcf.hpp"
#include "vsa/files.hpp"
#include "vsa/physics/mjcf.hpp"

namespace vsa::engine {
namespace {

std::string in_quotes(const std::string& text) { return '"' + physics::escaped(text) + '"'; }

class Writer {
 public:
  Writer(const World& world, std::string mjcf) : world_(world), mjcf_(std::move(mjcf)) {}

  /// The MJCF with the elements before its end.
  std::string text(std::vector<std::string>& notes, const std::string& file) {
    for (std::size_t r = 0; r < world_.robot_count(); ++r) note(r, notes);
    for (const JointInfo& joint : world_.joints())
      if (joint.actuator) joint_of_[*joint.actuator] = joint.name;
    for (std::size_t i = 0; i < world_.actuators().size(); ++i) add(i);
    const std::size_t end = mjcf_.rfind("</mujoco>");
    if (end == std::string::npos) throw InputError({file, "mujoco", "", "has no end", "</mujoco>"});
    const bool others = mjcf_.find("<actuator>") != std::string::npos;
    if (others) notes.push_back("the MJCF has actuators of its own, whose controls come before: no key \"start\"");
    const bool taken = has_key_start();
    if (taken)
      notes.push_back("the MJCF has a key \"start\" of its own, which has no controls of these actuators: it stays as it is");
    return mjcf_.substr(0, end) + "<extension>\n<plugin plugin=\"vsasim.unit\">\n" + instances_ +
           "</plugin>\n</extension>\n<actuator>\n" + actuators_ + "</actuator>\n<sensor>\n" + sensors_ + "</sensor>\n" +
           (others || taken ? "" : start()) + mjcf_.substr(end);
  }

 private:
  [[nodiscard]] bool has_key_start() const {
    for (std::size_t at = mjcf_.find("<key "); at != std::string::npos; at = mjcf_.find("<key ", at + 1)) {
      const std::size_t end = std::min(mjcf_.find('>', at), mjcf_.size());
      if (physics::gives_attribute(std::string_view(mjcf_).substr(at, end - at), "name", "start")) return true;
    }
    return false;
  }

  void note(std::size_t robot, std::vector<std::string>& notes) const {
    const host::RobotConfig& c = world_.robot(robot).config();
    const auto left_out = [&](const char* what) {
      notes.push_back(world_.robot_model(robot) + ": " + what + " isn't for MuJoCo: left out");
    };
    if (c.record) left_out("<record>");
    if (c.view_port) left_out("<view>");
    const auto has_port = [](const host::BusConfig& b) { return b.serial_port.has_value(); };
    if (std::any_of(c.buses.begin(), c.buses.end(), has_port)) left_out("<serial_port>");
  }

  /// As the MJCF calls it: with its models, where they are in the name.
  std::string joint_name(std::size_t actuator, const host::ActuatorConfig& config) const {
    const std::string& full = joint_of_.at(actuator);
    return mjcf_.find("name=" + in_quotes(full)) != std::string::npos ? full : config.joint;
  }

  void add(std::size_t index) {
    const ActuatorRef& ref = world_.actuators()[index];
    const host::RobotConfig& robot = world_.robot(ref.robot).config();
    const host::ActuatorConfig& a = robot.actuators[ref.index];
    const std::string joint = joint_name(index, a);
    instances_ += "<instance name=" + in_quotes(joint) + ">" + configuration(ref, a, robot.buses[a.bus]) + "</instance>\n";
    sensors_ += fmt::format("<plugin name={0} plugin=\"vsasim.unit\" instance={0}/>\n", in_quotes(joint));
    if (a.unit.is(control::ServoKind::motor_voltages)) {
      for (int m = 1; m <= a.unit.actuator.transmission->motor_count(); ++m) actuator(joint, fmt::format("_motor_{}", m), 0);
    } else {
      actuator(joint, "", a.initial_equilibrium_rad);
      if (!a.unit.preset_unit().empty()) actuator(joint, "_preset", a.initial_preset);
    }
  }

  std::string configuration(const ActuatorRef& ref, const host::ActuatorConfig& a, const host::BusConfig& bus) const {
    std::string out;
    const auto config = [&](const char* key, const std::string& value) {
      out += fmt::format("<config key=\"{}\" value={}/>", key, in_quotes(value));
    };
    config("type", a.type);
    if (a.changed && !a.changed->empty()) {
      std::vector<std::string> words;
      for (const auto& [key, value] : *a.changed) words.push_back(key + "=" + value);
      config("override", config::join(words, " "));
    }
    config("equilibrium", config::number_text(a.initial_equilibrium_rad));
    if (!a.unit.preset_unit().empty()) config("preset", config::number_text(a.initial_preset));
    config("bus", world_.robot_count() > 1 ? world_.robot_model(ref.robot) + "::" + bus.name : bus.name);
    config("id", std::to_string(a.id));
    config("baud", std::to_string(static_cast<long>(bus.baud_Hz)));
    if (bus.cycle_s) config("cycle_s", config::number_text(*bus.cycle_s));
    return out;
  }

  void actuator(const std::string& joint, const std::string& ending, double control) {
    actuators_ += fmt::format("<plugin name={0} joint={1} plugin=\"vsasim.unit\" instance={1}/>\n", in_quotes(joint + ending),
                              in_quotes(joint));
    controls_.push_back(control);
  }

  std::string start() const {
    std::vector<double> state(world_.state_size()), positions;
    world_.save(state);
    const StateLayout layout = world_.state_layout();
    std::size_t at = 0;
    for (const StateEntry& e : layout.entries()) {
      if (e.name.starts_with("physics/") && e.name.ends_with(".position"))
        positions.insert(positions.end(), &state[at], &state[at] + e.count);
      at += e.count;
    }
    return fmt::format("<keyframe>\n<key name=\"start\" qpos=\"{}\" ctrl=\"{}\"/>\n</keyframe>\n", fmt::join(positions, " "),
                       fmt::join(controls_, " "));
  }

  const World& world_;
  std::string mjcf_, instances_, actuators_, sensors_;
  std::map<std::size_t, std::string> joint_of_;  // by actuator
  std::vector<double> controls_;
};

std::string mjcf_text(const std::filesystem::path& path, const WorldOptions& options) {
  const std::filesystem::path own = mjcf_of(path);
  WorldOptions of_file = options;
  of_file.actuator = {};  // those are the plug-in's
  if (own.empty()) return export_mjcf(path, of_file).front().bytes;
  std::optional<std::string> text = read_file(own);
  if (!text) throw InputError({own.string(), "", "", "can't be read", "a file"});
  return *std::move(text);
}

void note_frictions(const description::World& world, std::vector<std::string>& notes) {
  for (const description::Link& link : world.links) {
    for (const description::Collision& shape : link.collisions)
      if (shape.surface.mu2)
        notes.push_back(shape.name + ": <fdir1> isn't told to MuJoCo, which takes the larger of both coefficients");
  }
}

/// MuJoCo from 2.3.1 on leaves a body alone that has gravcomp.
std::string without_gravity(std::string mjcf, const description::World& world, std::vector<std::string>& notes) {
  for (const description::Link& link : world.links) {
    if (!link.weightless) continue;
    const std::string body = "<body name=" + in_quotes(link.name);
    if (const std::size_t at = mjcf.find(body); at != std::string::npos)
      mjcf.insert(at + body.size(), " gravcomp=\"1\"");
    else
      notes.push_back("link " + link.name + " is without gravity, which MuJoCo isn't told: give its body gravcomp=\"1\"");
  }
  return mjcf;
}

}  // namespace

PluginMjcf export_plugin_mjcf(const std::filesystem::path& file, const WorldOptions& options, std::string mjcf) {
  const std::filesystem::path path = config::find_file(file.string(), "world", "models/worlds", ".sdf");
  Problems problems;
  check_file_is_exported(options, false, problems);
  problems.throw_if_any();
  const World world = World::load(path, options);
  if (world.robot_count() == 0) throw InputError({path.string(), "plugin", "", "there is no robot in it", "a vsa::Robot"});
  if (world.substeps() > 1)
    throw InputError({path.string(), "substeps", std::to_string(world.substeps()), "MuJoCo makes its steps itself",
                      "no <substeps>, and a step of that length"});
  PluginMjcf out;
  out.file.name = path.stem().string() + "_plugin.xml";
  if (mjcf.empty()) mjcf = mjcf_text(path, options);
  const std::shared_ptr<ReadWorld> read = read_world({path, {}}, options, problems);
  problems.throw_if_any();
  note_frictions(*read->world, out.notes);
  mjcf = without_gravity(std::move(mjcf), *read->world, out.notes);
  out.file.bytes = Writer(world, std::move(mjcf)).text(out.notes, path.string());
  return out;
}

}  // namespace vsa::engine
