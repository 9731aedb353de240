// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Facts of the tags: public NMMI/ROS-Gazebo-compliant-actuators-plugin, commit 5987fec (compliant_plugin.cpp and the InitParams of
// viactors_plugins), public Richi90/ROS-Gazebo-plugin-qbmove, commit ee062c2, public nickparnenzini/qbmove_plugin and qbmove_snake.
#include "config/older_plugins.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "config/older_tags.hpp"
#include "vsa/config/older_plugin.hpp"
#include "vsa/config/plugin_xml.hpp"
#include "vsa/config/text.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::config {
namespace {

using tinyxml2::XMLElement;

/// The toolbox's friction is a spring of 1000 N·m/rad that slides at tauFric: the model used here, with this presliding.
constexpr double kToolboxBristle_Nm_per_rad = 1000;

constexpr std::string_view kShaft2015 = "output_shaft_joint";
constexpr std::array<std::string_view, 2> kMotors2015{"motor1_joint", "motor2_joint"};
constexpr std::string_view kModel2015 = "model_qbmove_";

bool starts(std::string_view text, std::string_view with) { return text.substr(0, with.size()) == with; }

std::string override_text(const Override& o) { return "<override key=\"" + o.key + "\" value=\"" + o.value + "\"/>"; }

class Reader {
 public:
  Reader(const XMLElement& e, const std::string& path, XmlReader& xml) : e_(e), path_(path), xml_(xml) {}

  OlderTags read() {
    for (const XMLElement* child = e_.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      const OlderTag* tag = find_older_tag(child->Name());
      if (tag == nullptr || child != e_.FirstChildElement(child->Name())) continue;
      static_cast<void>(xml_.only(e_, path_, child->Name()));
      take(*tag, *child);
    }
    return std::move(out_);
  }

 private:
  void take(const OlderTag& tag, const XMLElement& child) {
    const std::string path = element_path(path_, child.Name());
    xml_.check_attributes(child, path, {});
    const std::string value = xml_.text(child, path);
    switch (tag.meaning) {
      case Meaning::same:
        add(tag, child.Name(), value);
        return;
      case Meaning::of_both_motors:
      case Meaning::friction_of_both_motors:
        take_pair(tag, child.Name(), value);
        return;
      case Meaning::mode:
        if (value != "6") xml_.add(path, value, std::string(tag.why), std::string(tag.instead));
        return;
      case Meaning::angle_limit:
      case Meaning::another:
        xml_.add(path, value, std::string(tag.why), instead(tag, value));
    }
  }

  static std::string instead(const OlderTag& tag, const std::string& value) {
    const auto angle = tag.meaning == Meaning::angle_limit ? parse_number(value) : std::nullopt;
    if (!angle) return std::string(tag.instead);
    return override_text({std::string(tag.key), number_text(std::round(*angle * kRawPerTurn / (2 * kPi)))});
  }

  /// What a tag overrides is of both motors, so mot_1_… and mot_2_… must agree (a difference is drive_2's); the one-motor actuators'
  /// mot_… stands alone.
  void take_pair(const OlderTag& tag, const std::string& name, const std::string& value) {
    const std::string path = element_path(path_, name);
    out_.motor_at_pulley = true;
    const bool first = starts(name, "mot_1_"), second = starts(name, "mot_2_");
    if (first || second) {
      const std::string other = (first ? "mot_2_" : "mot_1_") + name.substr(6);
      const XMLElement* partner = e_.FirstChildElement(other.c_str());
      if (partner == nullptr) {
        xml_.add(path, value, "a tag sets both motors here, and " + other + " is missing",
                 other + " of the same value; overrides of drive_2.… for unlike motors");
        return;
      }
      const auto one = parse_number(value), two = parse_number(xml_.text(*partner, element_path(path_, other)));
      if (one && two && *one != *two) {
        if (first)
          xml_.add(path, value, "a tag sets both motors here, and " + other + " differs",
                   "equal values; overrides of drive.… and drive_2.… for unlike motors");
        return;
      }
      if (second && one) return;  // taken with the first
    }
    add(tag, name, value);
  }

  void add(const OlderTag& tag, const std::string& name, const std::string& value) {
    const auto number = parse_number(value);
    if (!number) {
      xml_.add(element_path(path_, name), '"' + value + '"', "must be a finite number");
      return;
    }
    out_.taken.push_back({name, {std::string(tag.key), value}});
    if (tag.meaning == Meaning::friction_of_both_motors)
      out_.taken.push_back({name, {"drive.presliding_rad", number_text(*number / kToolboxBristle_Nm_per_rad)}});
  }

  const XMLElement& e_;
  const std::string& path_;
  XmlReader& xml_;
  OlderTags out_;
};

std::string file_of(const XMLElement& root) {
  const char* file = root.Attribute("filename");
  const std::string name = file == nullptr ? "" : file;
  return name.substr(name.rfind('/') + 1);
}

/// The type that stands for an older library; where the library was renamed already, its spring tells.
std::string type_of(const XMLElement& root, bool of_2015) {
  const std::string file = file_of(root);
  if (of_2015) return "qbmove_maker_pro_6_1";
  if (file == "libbavs_plugin.so" || root.FirstChildElement("spring_k_e") != nullptr) return "bavs_example";
  if (file == "libawas_ii_plugin.so" || root.FirstChildElement("spring_Ks") != nullptr) return "awas_2_example";
  const bool one_spring = root.FirstChildElement("spring_k") != nullptr || root.FirstChildElement("stiffness") != nullptr;
  return file == "libsea_plugin.so" || one_spring ? "sea_example" : "qbmove_advanced";
}

std::string actuator_text(const std::string& joint, const std::string& type, const OlderTags& tags, const std::string& name = "") {
  std::string text = name.empty() ? "<actuator>" : "<actuator name=\"" + name + "\">";
  text += "<joint>" + joint + "</joint><type>" + type + "</type>";
  for (const OlderTags::Taken& t : tags.taken) text += override_text(t.override);
  return text + "</actuator>";
}

/// The joint that an element of 2015 drove: its model's output_shaft_joint, or that of the submodel that a tag names.
const XMLElement* tag_of_2015(const XMLElement& root) {
  for (const XMLElement* c = root.FirstChildElement(); c != nullptr; c = c->NextSiblingElement()) {
    if (starts(c->Name(), kModel2015)) return c;
  }
  return nullptr;
}

}  // namespace

bool is_older_tag(std::string_view name) { return find_older_tag(name) != nullptr; }

OlderTags read_older_tags(const XMLElement& e, const std::string& path, XmlReader& xml) { return Reader(e, path, xml).read(); }

bool is_surely_older_plugin(const XMLElement& root) {
  if (std::string_view(root.Name()) != "plugin" || root.FirstChildElement("actuator") != nullptr) return false;
  constexpr std::string_view kFiles[] = {"libqbmove_plugin.so",  "libsea_plugin.so",      "libbavs_plugin.so",
                                         "libawas_ii_plugin.so", "libadvanced_plugin.so", "libqbmove_multiple.so"};
  if (std::find(std::begin(kFiles), std::end(kFiles), file_of(root)) != std::end(kFiles)) return true;
  for (const XMLElement* c = root.FirstChildElement(); c != nullptr; c = c->NextSiblingElement()) {
    const std::string_view name = c->Name();
    const bool anybodys = name == "namespace" || name == "stiffness";
    if ((is_older_tag(name) && !anybodys) || starts(name, kModel2015)) return true;
  }
  return false;
}

bool is_older_plugin(const XMLElement& root) {
  const bool has_actuator = root.FirstChildElement("actuator") != nullptr;
  return is_surely_older_plugin(root) ||
         (std::string_view(root.Name()) == "plugin" && !has_actuator && root.FirstChildElement("joint") != nullptr);
}

bool is_older_plugin(std::string_view xml) {
  tinyxml2::XMLDocument document;
  return !xml.empty() && document.Parse(xml.data(), xml.size()) == tinyxml2::XML_SUCCESS && document.RootElement() != nullptr &&
         is_surely_older_plugin(*document.RootElement());
}

void answer_older_plugin(const XMLElement& root, XmlReader& xml) {
  const XMLElement* joint = root.FirstChildElement("joint");
  const XMLElement* submodel = tag_of_2015(root);
  const bool of_2015 = submodel != nullptr || (joint == nullptr && root.FirstChildElement() == nullptr);
  const OlderTags tags = read_older_tags(root, "plugin", xml);
  std::string name, driven = joint != nullptr && joint->GetText() != nullptr ? std::string(trim(joint->GetText())) : "JOINT";
  if (of_2015) {
    driven = std::string(kShaft2015);
    if (submodel != nullptr && submodel->GetText() != nullptr) name = std::string(trim(submodel->GetText()));
    driven = scoped_name(name, driven);
  }
  xml.add(
      "plugin", file_of(root),
      of_2015
          ? "is the plug-in of 2015, one a module; here one <plugin> lists all the model's actuators, whose units share a bus"
          : "is the 2021 toolbox's form, one per joint; here one <plugin> lists all the model's actuators, whose units share a bus",
      "<plugin name=\"" + std::string(kPluginName) + "\" filename=\"libvsa-robot.so\">" +
          actuator_text(driven, type_of(root, of_2015), tags, name) + "</plugin>, and see docs/howto/migration.md");
}

void check_motor_joints(const host::RobotConfig& config, const std::vector<std::string>& joints, std::string_view where,
                        Problems& problems) {
  const auto there = [&](const std::string& name) { return std::find(joints.begin(), joints.end(), name) != joints.end(); };
  for (const host::ActuatorConfig& a : config.actuators) {
    const std::string_view scope = scope_of(a.joint), last = name_within(a.joint);
    const std::string shaft = scoped_name(scope, kShaft2015);
    const std::string key = "actuator[" + a.name + "]/joint";
    for (const std::string_view motor : kMotors2015) {
      const std::string motor_joint = scoped_name(scope, motor);
      if (last == motor && there(shaft))
        problems.add({std::string(where), key, '"' + a.joint + '"',
                      "is a motor of the plug-in of 2015: the motors are in the unit here", shaft});
      if (last == kShaft2015 && there(motor_joint))
        problems.add({std::string(where), key, '"' + a.joint + '"',
                      "the model still has " + motor_joint + " of 2015, which would swing freely: the motors are in the unit here",
                      "a model without the motors' joints and links"});
    }
  }
}

}  // namespace vsa::config
