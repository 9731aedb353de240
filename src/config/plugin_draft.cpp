// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/config/plugin_draft.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "config/build.hpp"
#include "vsa/config/plugin_xml.hpp"
#include "vsa/config/text.hpp"

namespace vsa::config {
namespace {

// Endings that topics add to an actuator's name: "J_preset" is a channel of J.
constexpr std::string_view kReservedEndings[] = {"_preset", "_motor_1", "_motor_2"};

std::shared_ptr<const host::Settings> settings(const std::vector<Override>& overrides) {
  auto out = std::make_shared<host::Settings>();
  for (const Override& o : overrides) out->emplace_back(o.key, o.value);
  return out;
}

class Finisher {
 public:
  Finisher(const RobotDraft& draft, std::string_view where, const TypeLibrary& types, Problems& problems)
      : draft_(draft), where_(where), types_(types), problems_(problems) {}

  host::RobotConfig finish() {
    config_.state_rate_Hz = draft_.state_rate_Hz;
    config_.substeps = draft_.substeps;
    config_.record = draft_.record;
    config_.view_port = draft_.view_port;
    config_.notices = draft_.notices;
    for (const std::string& n : types_.notices()) config_.notices.push_back(n);
    if (draft_.actuators.empty() && !draft_.answered) add("plugin", "", "has no actuator", "at least one <actuator>");
    make_buses();
    for (const ActuatorDraft& a : draft_.actuators) config_.actuators.push_back(make(a));
    check_names();
    if (!lost_) {
      give_ids();
      check_cycles();
    }
    check_ports();
    return std::move(config_);
  }

 private:
  void add(std::string key, std::string value, std::string message, std::string allowed = {}) {
    problems_.add({std::string(where_), std::move(key), std::move(value), std::move(message), std::move(allowed)});
  }

  void make_buses() {
    std::set<std::string> seen;
    for (const BusDraft& b : draft_.buses) {
      if (!seen.insert(b.name).second) add(b.path + "@name", '"' + b.name + '"', "two buses have this name", "unique names");
      config_.buses.push_back({b.name, b.baud_Hz, b.cycle_s, b.serial_port, b.any_rate});
    }
    if (draft_.buses.empty()) config_.buses.emplace_back().name = kDefaultBus;
    used_.resize(config_.buses.size());
  }

  host::ActuatorConfig make(const ActuatorDraft& a) {
    host::ActuatorConfig out;
    out.name = a.name;
    out.joint = a.joint;
    out.type = a.type;
    out.initial_equilibrium_rad = a.initial_equilibrium;
    out.initial_preset = a.initial_preset;
    out.equilibrium_given = a.equilibrium_given;
    find_bus(a, out);
    if (const ActuatorType* type = a.type.empty() ? nullptr : load(a)) {
      out.unit = type->unit;
      if (!a.overrides.empty()) out.changed = settings(a.overrides);
      check_initial(a, out);
      if (a.motor_at_pulley && type->unit.actuator.side[0].gearbox.ratio != 1)
        add(a.path + "/type", '"' + a.type + '"', "has a gearbox, and the toolbox's motor values are at the pulley",
            "a type with drive.gear_ratio 1, or <override>s at the motor's shaft");
    }
    return out;
  }

  void find_bus(const ActuatorDraft& a, host::ActuatorConfig& out) {
    std::vector<std::string> names;
    for (const host::BusConfig& b : config_.buses) names.push_back(b.name);
    if (a.bus.empty()) {
      if (names.size() == 1) return;
      add(a.path + "/bus", "", "must say which bus", join(names));
      lost_ = true;
      return;
    }
    const auto at = std::find(names.begin(), names.end(), a.bus);
    const bool declared = !draft_.buses.empty() && at != names.end();
    if (declared) out.bus = static_cast<std::size_t>(at - names.begin());
    if (!declared) {
      lost_ = true;
      add(a.path + "/bus", '"' + a.bus + '"', "no such bus",
          draft_.buses.empty() ? "declare it: <bus name=\"" + a.bus + "\"/>" : join(names));
    }
  }

  /// Robots have many equal units: each type is read once, and its problems are told once.
  const ActuatorType* load(const ActuatorDraft& a) {
    std::string key = a.type;
    for (const Override& o : a.overrides) key += '\n' + o.key + '\t' + o.value;
    const auto [entry, fresh] = cache_.try_emplace(key);
    if (fresh) {
      try {
        entry->second = types_.load(a.type, a.overrides);
        for (const std::string& n : entry->second->notices) config_.notices.push_back(n);
      } catch (const InputError& error) {
        for (const Problem& p : error.problems()) report_type(a, p);
      }
    }
    return entry->second ? &*entry->second : nullptr;
  }

  void report_type(const ActuatorDraft& a, const Problem& p) {
    const bool from_override = p.key.compare(0, kOverrideMark.size(), kOverrideMark) == 0;
    const std::string key = from_override ? p.key.substr(kOverrideMark.size()) : "";
    if (const auto tag = a.tag_of.find(key); tag != a.tag_of.end()) {
      add(a.path + "/" + tag->second, p.value, key + ": " + p.message, p.allowed);
    } else if (const auto flag = a.flag_of.find(key); flag != a.flag_of.end()) {
      // The robot's file is right; of several types one may lack the key.
      problems_.add(
          {"", flag->second + " " + key, p.value, p.message + " (actuator " + a.name + ", type " + a.type + ")", p.allowed});
    } else if (from_override) {
      add(a.path + "/override[" + key + "]", p.value, p.message, p.allowed);
    } else if (p.key == "type" && p.file.empty()) {
      add(a.path + "/type", p.value, p.message, p.allowed);
    } else {
      add(a.path + "/type", '"' + a.type + '"', p.text());
    }
  }

  void check_initial(const ActuatorDraft& a, host::ActuatorConfig& out) {
    const std::string path = a.path + "/initial@";
    const std::string unit(out.unit.preset_unit()), right = preset_attribute(unit);
    if (a.replaced) {
      const double limit = out.unit.preset_max;
      out.initial_preset = a.initial_preset_key == right ? std::clamp(a.initial_preset, -limit, limit) : 0.0;
    } else if (!a.initial_preset_key.empty() && a.initial_preset_key != right) {
      add(path + a.initial_preset_key, number_text(a.initial_preset),
          right.empty() ? "this actuator has no preset: leave it out" : "is not this actuator's preset", right);
    } else if (std::abs(a.initial_preset) > out.unit.preset_max) {
      add(path + a.initial_preset_key, number_text(a.initial_preset), "is larger than the preset's limits.preset_max",
          range_text(-out.unit.preset_max, out.unit.preset_max) + " " + unit);
    }
    check_start(out, a.path + "/initial", where_, problems_);
    const bool slides = out.unit.actuator.linear(), in_m = a.equilibrium_key == "equilibrium_m";
    if (!a.equilibrium_key.empty() && slides != in_m && !a.replaced)
      add(path + a.equilibrium_key, number_text(a.initial_equilibrium),
          slides ? "this actuator's shaft slides" : "this actuator's shaft turns", slides ? "equilibrium_m" : "equilibrium_rad");
  }

  void check_names() {
    std::map<std::string, std::string> names, joints;
    for (const ActuatorDraft& a : draft_.actuators) {
      if (a.name_ok && !names.emplace(a.name, a.path).second)
        add(a.path, '"' + a.name + '"', "two actuators have this name", "unique names");
      const auto [at, fresh] = joints.emplace(a.joint, a.path);
      if (!a.joint.empty() && !fresh)
        add(a.path + "/joint", '"' + a.joint + '"', at->second + " drives this joint already", "one actuator a joint");
    }
    for (const auto& [name, path] : names) {
      for (std::string_view ending : kReservedEndings) {
        const std::string clash = name + std::string(ending);
        if (names.count(clash) != 0)
          add(names[clash], '"' + clash + '"', "is a channel of " + path + " in the topics", "another name");
      }
    }
  }

  /// Given ids first; the others get the lowest free ones of their bus, in the order of the file.
  void give_ids() {
    for (std::size_t i = 0; i < draft_.actuators.size(); ++i) {
      const ActuatorDraft& a = draft_.actuators[i];
      if (!a.id) continue;
      const auto [at, fresh] = used_[config_.actuators[i].bus].emplace(*a.id, a.path);
      if (!fresh)
        add(a.path + "/bus@id", std::to_string(*a.id), at->second + " has this id on the same bus", "unique ids on a bus");
      config_.actuators[i].id = *a.id;
    }
    for (std::size_t i = 0; i < draft_.actuators.size(); ++i) {
      const ActuatorDraft& a = draft_.actuators[i];
      if (a.id || !a.id_ok) continue;
      auto& used = used_[config_.actuators[i].bus];
      int id = 1;
      while (used.count(id) != 0) ++id;
      if (id > kMaxId) add(a.path + "/bus", "", "the bus is full", "at most " + std::to_string(kMaxId) + " units on a bus");
      used.emplace(id, a.path);
      config_.actuators[i].id = id;
    }
  }

  void check_ports() {
    std::map<std::string, std::string> ports;
    for (const BusDraft& bus : draft_.buses) {
      if (!bus.serial_port) continue;
      const auto [at, fresh] = ports.emplace(*bus.serial_port, bus.path);
      if (!fresh) add(bus.path + "/serial_port", '"' + *bus.serial_port + '"', at->second + " has this port", "one bus a port");
    }
  }

  void check_cycles() {
    for (std::size_t b = 0; b < draft_.buses.size(); ++b) {
      const BusDraft& bus = draft_.buses[b];
      const auto on_it = [b](const host::ActuatorConfig& a) { return a.bus == b; };
      const auto talks = [b](const host::ActuatorConfig& a) { return a.bus == b && !a.unit.servo; };
      const int units = static_cast<int>(std::count_if(config_.actuators.begin(), config_.actuators.end(), talks));
      if (std::none_of(config_.actuators.begin(), config_.actuators.end(), on_it))
        add(bus.path, "", "no actuator is on this bus", "at least one");
      const std::int64_t wire_ns = bus::wire_time_ns(units, bus.baud_Hz);
      if (!bus.cycle_s || std::llround(*bus.cycle_s * 1e9) >= wire_ns) continue;
      add(bus.path + "@cycle_s", number_text(*bus.cycle_s),
          "is shorter than the time on the wire of " + std::to_string(units) + " units",
          "auto, or at least " + number_text(static_cast<double>(wire_ns) / 1e9) + " s");
    }
  }

  const RobotDraft& draft_;
  std::string_view where_;
  const TypeLibrary& types_;
  Problems& problems_;
  host::RobotConfig config_;
  bool lost_ = false;  // an actuator's bus is unknown: who shares a bus can't be judged
  std::vector<std::map<int, std::string>> used_;
  std::map<std::string, std::optional<ActuatorType>> cache_;
};

}  // namespace

std::string preset_attribute(std::string_view unit) {
  if (unit.empty()) return "";
  return std::string(kPresetPrefix) + "_" + std::string(unit_word(unit));
}

host::RobotConfig finish(const RobotDraft& draft, std::string_view where, const TypeLibrary& types, Problems& problems) {
  return Finisher(draft, where, types, problems).finish();
}

}  // namespace vsa::config
