// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/config/plugin_xml.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <cmath>

#include "config/met.hpp"
#include "config/older_plugins.hpp"
#include "config/xml_reader.hpp"
#include "vsa/config/plugin_draft.hpp"
#include "vsa/config/text.hpp"

namespace vsa::config {
namespace {

using tinyxml2::XMLElement;

constexpr double kMaxAngle = 1e6;  // what a command may be depends on the firmware's limits, checked with the type
constexpr double kMinBaud = 9600, kMaxBaud = 10e6;
constexpr double kMaxCycle_s = 10;
constexpr std::size_t kLongestPort = 100;  // a socket or link name has at most 107 bytes
constexpr double kMinRate_Hz = 1e-3, kMaxRate_Hz = 1000;
constexpr double kMaxRecordRate_Hz = 1e6;

class Parser {
 public:
  Parser(std::string_view where, Problems& problems) : where_(where), xml_(where, problems) {}

  RobotDraft parse(const XMLElement& root) {
    RobotDraft robot;
    if (is_older_plugin(root)) {
      answer_older_plugin(root, xml_);
      robot.answered = true;
      return robot;
    }
    if (std::string(root.Name()) != "plugin") xml_.add(root.Name(), "", "is not a plug-in element", "plugin");
    xml_.check_attributes(root, "plugin", {"name", "filename"}, {"state_rate_Hz", "substeps"});
    for (const char* child : {"state_rate_Hz", "substeps"}) xml_.child_as_attribute(root, "plugin", child);
    const std::string name = xml_.attribute(root, "name").value_or("");
    if (name != kPluginName) xml_.add("plugin@name", '"' + name + '"', "is not this plug-in", std::string(kPluginName));
    xml_.check_children(root, "plugin", {"actuator", "bus", "state_rate_Hz", "substeps", "record", "view"});
    for (const XMLElement* e = root.FirstChildElement("bus"); e; e = e->NextSiblingElement("bus")) robot.buses.push_back(bus(*e));
    int index = 0;
    for (const XMLElement* e = root.FirstChildElement("actuator"); e; e = e->NextSiblingElement("actuator")) {
      robot.actuators.push_back(actuator(*e, ++index));
    }
    if (const XMLElement* e = xml_.only(root, "plugin", "state_rate_Hz")) {
      xml_.check_attributes(*e, "state_rate_Hz", {});
      const auto rate = xml_.number("state_rate_Hz", xml_.text(*e, "state_rate_Hz"), kMinRate_Hz, kMaxRate_Hz, "Hz");
      robot.state_rate_Hz = rate.value_or(robot.state_rate_Hz);
    }
    if (const XMLElement* e = xml_.only(root, "plugin", "substeps")) {
      xml_.check_attributes(*e, "substeps", {});
      robot.substeps = xml_.integer("substeps", xml_.text(*e, "substeps"), 1, host::kMostSubsteps);
    }
    if (const XMLElement* e = xml_.only(root, "plugin", "record")) robot.record = record(*e);
    if (const XMLElement* e = xml_.only(root, "plugin", "view")) robot.view_port = view(*e);
    robot.notices = std::move(notices_);
    return robot;
  }

 private:
  host::RecordConfig record(const XMLElement& e) {
    host::RecordConfig out;
    xml_.check_attributes(e, "record", {"directory", "rate_Hz"});
    xml_.check_children(e, "record", {});
    out.directory = xml_.attribute(e, "directory").value_or("");
    if (out.directory.empty())
      xml_.add("record@directory", "", xml_.attribute(e, "directory") ? "is empty" : "is missing", "where the files go");
    if (const auto rate = xml_.attribute(e, "rate_Hz"))
      out.rate_Hz = xml_.number("record@rate_Hz", *rate, kMinRate_Hz, kMaxRecordRate_Hz, "Hz").value_or(out.rate_Hz);
    return out;
  }

  std::uint16_t view(const XMLElement& e) {
    xml_.check_attributes(e, "view", {"port"});
    xml_.check_children(e, "view", {});
    const auto port = xml_.integer("view@port", xml_.attribute(e, "port").value_or("0"), 0, 65535);
    return static_cast<std::uint16_t>(port.value_or(0));
  }

  /// Text of a child that must be there; empty where it isn't, and reported.
  std::string required_text(const XMLElement& e, const std::string& path, const char* name) {
    if (const auto attribute = xml_.child_as_attribute(e, path, name)) return *attribute;
    const XMLElement* child = xml_.only(e, path, name);
    const std::string key = path + "/" + name;
    std::string text;
    if (child != nullptr) {
      xml_.check_attributes(*child, key, {});
      text = xml_.text(*child, key);
    }
    if (text.empty()) xml_.add(key, "", child ? "is empty" : "is missing");
    return text;
  }

  /// <preset> is what <type> was called: understood for one more release.
  std::string type_text(const XMLElement& e, const std::string& path) {
    if (const auto attribute = xml_.attribute(e, "preset")) {
      xml_.add(attribute_path(path, "preset"), '"' + *attribute + '"', "is an element, not an attribute",
               "<type>" + *attribute + "</type>");
      return *attribute;
    }
    if (e.FirstChildElement("preset") == nullptr) return required_text(e, path, "type");
    if (e.FirstChildElement("type") != nullptr)
      xml_.add(path + "/preset", "", "is an old name of type, which is given too", "one <type>");
    if (notices_.empty()) met_old_spelling(where_ + ": " + renamed_text("<preset>", "<type>"), notices_);
    return required_text(e, path, "preset");
  }

  ActuatorDraft actuator(const XMLElement& e, int index) {
    ActuatorDraft draft;
    const std::string numbered = "actuator[" + std::to_string(index) + "]";
    const auto given = xml_.attribute(e, "name");
    draft.path = given && !given->empty() ? "actuator[" + *given + "]" : numbered;
    xml_.check_attributes(e, draft.path, {"name"}, {"joint", "type", "preset", "bus"});
    xml_.check_children(e, draft.path, {"joint", "type", "bus", "initial", "override"},
                        [](std::string_view tag) { return tag == "preset" || is_older_tag(tag); });
    draft.joint = required_text(e, draft.path, "joint");
    draft.type = type_text(e, draft.path);
    draft.name = given ? *given : draft.joint;
    if (given) {
      draft.name_ok = xml_.check_name(draft.path + "@name", draft.name);
    } else if (!draft.joint.empty()) {
      draft.name_ok = xml_.check_name(draft.path + "/joint (as the actuator's name; give it a name attribute)", draft.name);
    }
    draft.bus = xml_.child_as_attribute(e, draft.path, "bus").value_or("");
    if (const XMLElement* child = xml_.only(e, draft.path, "bus")) place_on_bus(*child, draft);
    if (const XMLElement* child = xml_.only(e, draft.path, "initial")) initial(*child, draft);
    for (const XMLElement* o = e.FirstChildElement("override"); o; o = o->NextSiblingElement("override")) add_override(*o, draft);
    take_older_tags(e, draft);
    return draft;
  }

  void take_older_tags(const XMLElement& e, ActuatorDraft& draft) {
    OlderTags older = read_older_tags(e, draft.path, xml_);
    draft.motor_at_pulley = older.motor_at_pulley;
    for (OlderTags::Taken& t : older.taken) {
      const auto same = [&](const Override& o) { return o.key == t.override.key; };
      if (std::any_of(draft.overrides.begin(), draft.overrides.end(), same)) {
        xml_.add(element_path(draft.path, t.tag), t.override.value, t.override.key + " is given twice", "one of the two");
        continue;
      }
      draft.tag_of.emplace(t.override.key, t.tag);
      draft.overrides.push_back(std::move(t.override));
    }
  }

  void place_on_bus(const XMLElement& e, ActuatorDraft& draft) {
    const std::string path = draft.path + "/bus";
    xml_.check_attributes(e, path, {"id"});
    draft.bus = xml_.text(e, path);
    if (const auto id = xml_.attribute(e, "id")) {
      draft.id = xml_.integer(path + "@id", *id, 1, kMaxId);
      draft.id_ok = draft.id.has_value();
    }
  }

  /// The preset's attribute carries the unit of the preset's law, which isn't known yet: any "preset_…" is kept.
  void initial(const XMLElement& e, ActuatorDraft& draft) {
    const std::string path = draft.path + "/initial";
    std::vector<std::string> known{"equilibrium_rad", "equilibrium_m", "preset_rad"};
    for (const tinyxml2::XMLAttribute* a = e.FirstAttribute(); a != nullptr; a = a->Next()) {
      const std::string name = a->Name();
      if (name.compare(0, kPresetPrefix.size(), kPresetPrefix) != 0) continue;
      if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
      if (!draft.initial_preset_key.empty()) xml_.add(attribute_path(path, name), a->Value(), "the preset is given more than once");
      draft.initial_preset_key = name;
      draft.initial_preset =
          xml_.number(attribute_path(path, name), std::string(trim(a->Value())), -kMaxAngle, kMaxAngle, "").value_or(0);
    }
    xml_.check_attributes(e, path, known);
    xml_.check_children(e, path, {});
    for (const std::string key : {"equilibrium_rad", "equilibrium_m"}) {
      const auto text = xml_.attribute(e, key.c_str());
      if (!text) continue;
      if (draft.equilibrium_given) xml_.add(attribute_path(path, key), *text, "the equilibrium is given more than once");
      draft.equilibrium_given = true;
      draft.equilibrium_key = key;
      const std::string unit = key.substr(key.rfind('_') + 1);
      draft.initial_equilibrium = xml_.number(attribute_path(path, key), *text, -kMaxAngle, kMaxAngle, unit).value_or(0);
    }
  }

  void add_override(const XMLElement& e, ActuatorDraft& draft) {
    const std::string path = draft.path + "/override";
    xml_.check_attributes(e, path, {"key", "value"});
    xml_.check_children(e, path, {});
    const auto key = xml_.attribute(e, "key"), value = xml_.attribute(e, "value");
    if (!key) xml_.add(path + "@key", "", "is missing", "a parameter such as drive.friction_Nm");
    if (!value) xml_.add(path + "@value", "", "is missing");
    if (key && value) draft.overrides.push_back({*key, *value});
  }

  /// A name for a link, or a whole path; characters that every shell and client takes as they are.
  void check_port(const std::string& path, const std::string& port) {
    const auto good = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
    };
    const bool whole = !port.empty() && port.front() == '/';
    const std::string_view name = std::string_view(port).substr(port.rfind('/') + 1);
    const bool chars = std::all_of(port.begin(), port.end(), [&](char c) { return good(c) || (whole && c == '/'); });
    if (chars && !name.empty() && name != "." && name != ".." && port.size() <= kLongestPort) return;
    xml_.add(path, '"' + port + '"', "can't be the name of a serial port",
             "1 … " + std::to_string(kLongestPort) + " letters, digits, and _ - . (or an absolute path of such names)");
  }

  BusDraft bus(const XMLElement& e) {
    BusDraft draft;
    draft.name = xml_.attribute(e, "name").value_or("");
    draft.path = "bus[" + draft.name + "]";
    xml_.check_attributes(e, draft.path, {"name", "baud", "cycle_s"}, {"serial_port"});
    xml_.child_as_attribute(e, draft.path, "serial_port");
    xml_.check_children(e, draft.path, {"serial_port"});
    xml_.check_name(draft.path + "@name", draft.name);
    if (const auto text = xml_.attribute(e, "baud")) {
      const auto baud = xml_.integer(draft.path + "@baud", *text, static_cast<int>(kMinBaud), static_cast<int>(kMaxBaud));
      draft.baud_Hz = baud ? *baud : draft.baud_Hz;
    }
    const auto cycle = xml_.attribute(e, "cycle_s");
    if (cycle && *cycle != "auto") {
      draft.cycle_s = parse_number(*cycle);
      if (!draft.cycle_s || *draft.cycle_s <= 0 || *draft.cycle_s > kMaxCycle_s) {
        xml_.add(draft.path + "@cycle_s", '"' + *cycle + '"', "must be auto or a time",
                 "auto, or seconds from the bus's wire time to " + number_text(kMaxCycle_s));
        draft.cycle_s.reset();
      }
    }
    if (const XMLElement* port = xml_.only(e, draft.path, "serial_port")) {
      const std::string path = draft.path + "/serial_port";
      xml_.check_attributes(*port, path, {"any_rate"});
      draft.serial_port = xml_.text(*port, path);
      check_port(path, *draft.serial_port);
      const std::string any_rate = xml_.attribute(*port, "any_rate").value_or("false");
      draft.any_rate = any_rate == "true";
      if (!draft.any_rate && any_rate != "false")
        xml_.add(path + "@any_rate", '"' + any_rate + '"', "must be a switch", "true, false");
    }
    return draft;
  }

  std::string where_;
  XmlReader xml_;
  std::vector<std::string> notices_;
};

void replace(RobotDraft& robot, const Replacement& replacement) {
  for (ActuatorDraft& a : robot.actuators) {
    if (replacement.type) {
      a.type = *replacement.type;
      a.overrides.clear();
      a.tag_of.clear();
      a.motor_at_pulley = false;
    }
    for (const Override& o : replacement.overrides) {
      a.tag_of.erase(o.key);
      std::erase_if(a.overrides, [&](const Override& own) { return own.key == o.key; });
    }
    for (const Override& o : replacement.overrides) a.flag_of[o.key] = replacement.flag;
    a.overrides.insert(a.overrides.end(), replacement.overrides.begin(), replacement.overrides.end());
    a.replaced = replacement.type || !replacement.overrides.empty();
  }
}

}  // namespace

host::RobotConfig parse_plugin(std::string_view xml, std::string_view where, const TypeLibrary& types,
                               const Replacement& replacement) {
  Problems problems;
  tinyxml2::XMLDocument document;
  const bool parsed = !xml.empty() && document.Parse(xml.data(), xml.size()) == tinyxml2::XML_SUCCESS;
  const XMLElement* root = parsed ? document.RootElement() : nullptr;
  if (root == nullptr) {
    const std::string line = parsed || xml.empty() ? "" : ", line " + std::to_string(document.ErrorLineNum());
    throw InputError(Problem{std::string(where), "plugin", "", "is not well-formed XML" + line, "one <plugin> element"});
  }
  if (root->NextSiblingElement() != nullptr) {
    problems.add(
        {std::string(where), root->NextSiblingElement()->Name(), "", "a second element at the top", "one <plugin> element"});
  }
  RobotDraft draft = Parser(where, problems).parse(*root);
  replace(draft, replacement);
  host::RobotConfig config = finish(draft, where, types, problems);
  problems.throw_if_any();
  return config;
}

void check_one_step(const host::RobotConfig& config, std::string_view where, Problems& problems) {
  if (const int n = config.substeps.value_or(1); n > 1)
    problems.add({std::string(where), "substeps", std::to_string(n),
                  "this simulator makes its steps itself: set <physics><max_step_size> to the step divided by " + std::to_string(n),
                  "1, or no <substeps>"});
}

void check_start(const host::ActuatorConfig& actuator, const std::string& key, std::string_view where, Problems& problems) {
  const auto& law = *actuator.unit.actuator.transmission;
  const auto x = law.references({actuator.initial_equilibrium_rad, actuator.initial_preset});
  for (std::size_t i = 0; i < static_cast<std::size_t>(law.motor_count()); ++i) {
    const auto [low, high] = actuator.unit.reference_range_raw(static_cast<int>(i));
    const double raw = x[i] * kRawPerTurn / (2 * kPi);
    if (raw >= low - 0.5 && raw <= high + 0.5) continue;
    const auto rad = [](double value) { return std::round(value * 1e6) / 1e6; };
    constexpr double kRadPerRaw = 2 * kPi / kRawPerTurn;
    problems.add({std::string(where), key, number_text(rad(x[i])) + " rad",
                  "reference of motor " + std::to_string(i + 1) + " is beyond " +
                      (actuator.unit.servo ? "control.reference_max_rad" : "the firmware's limits"),
                  range_text(rad(low * kRadPerRaw), rad(high * kRadPerRaw)) + " rad"});
  }
}

void check_joints(const host::RobotConfig& config, const std::vector<std::string>& joints, std::string_view where,
                  Problems& problems) {
  for (const host::ActuatorConfig& a : config.actuators) {
    if (std::find(joints.begin(), joints.end(), a.joint) != joints.end()) continue;
    problems.add({std::string(where), "actuator[" + a.name + "]/joint", '"' + a.joint + '"',
                  "the model has no such joint" + did_you_mean(a.joint, joints),
                  joints.empty() ? "the model has none that an actuator can drive" : join(joints)});
  }
  check_motor_joints(config, joints, where, problems);
}

}  // namespace vsa::config
