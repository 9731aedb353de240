// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// <gazebo> of a URDF without libsdformat, which copies into its SDF what it doesn't know: of SDF's elements those below are honoured
// or told of, and any other is refused. By what a <gazebo> belongs to:
//   LINK    turnGravityOff, gravity, selfCollide, self_collide, kinematic, velocity_decay; collision, with a <surface>; mu1, mu2, fdir1,
//           kp, kd, maxVel, minDepth, maxContacts, laserRetro, which go into each of the link's collisions
//   JOINT   springReference, springStiffness
//   none    static, plugin, pose, self_collide
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string_view>

#include "sdf/urdfdom_reading.hpp"
#include "sdf/xml_place.hpp"
#include "vsa/config/text.hpp"

namespace vsa::reader {
namespace {

using tinyxml2::XMLElement;

using Names = std::string_view;  ///< with blanks between

struct Known {
  std::string_view path;
  Names children;
};
/// SDF's <surface>; what its readers refuse by value is here, too.
constexpr std::array<Known, 9> kSurface{
    {{"surface", "bounce friction contact soft_contact"},
     {"surface/bounce", "restitution_coefficient threshold"},
     {"surface/friction", "ode bullet torsional"},
     {"surface/friction/ode", "mu mu2 fdir1 slip1 slip2"},
     {"surface/friction/bullet", "friction friction2 fdir1 rolling_friction"},
     {"surface/friction/torsional", "coefficient use_patch_radius patch_radius surface_radius ode"},
     {"surface/contact",
      "collide_without_contact collide_without_contact_bitmask collide_bitmask category_bitmask poissons_ratio elastic_modulus ode "
      "bullet"},
     {"surface/contact/ode", "soft_cfm soft_erp kp kd max_vel min_depth"},
     {"surface/contact/bullet", "soft_cfm soft_erp kp kd split_impulse split_impulse_penetration_threshold"}}};

/// What mend_gazebo_elements has judged, or what is taken below.
constexpr Names kOfUrdfLinks =
    "turnGravityOff selfCollide mu1 mu2 fdir1 kp kd maxVel minDepth dampingFactor maxContacts laserRetro collision visual inertial "
    "pose";
constexpr Names kOfSdfLinks = "gravity self_collide kinematic velocity_decay must_be_base_link light enable_wind";
constexpr Names kOfJoints =
    "springReference springStiffness preserveFixedJoint disableFixedJointLumping axis parent child pose inertial";
constexpr Names kOfRobots = "static plugin pose self_collide enable_wind allow_auto_disable material canonicalBody";

bool has(Names names, std::string_view word) {
  const std::vector<std::string> all = config::split(names, ' ');
  return std::find(all.begin(), all.end(), word) != all.end();
}

bool of_others(std::string_view name) { return name.find(':') != std::string_view::npos; }

void refuse(UrdfReading& r, const XMLElement& e, const std::vector<std::string>& allowed) {
  r.problems.add({line_of(e, r.file), path_of(e), UrdfReading::text(&e),
                  "isn't known of a URDF's <gazebo> to a build without libsdformat" + config::did_you_mean(e.Name(), allowed),
                  config::join(allowed)});
}

void check_surface(UrdfReading& r, const XMLElement& e, const std::string& path) {
  const auto* const known = std::find_if(kSurface.begin(), kSurface.end(), [&](const Known& k) { return k.path == path; });
  if (known == kSurface.end()) return;
  for (const XMLElement* k = e.FirstChildElement(); k != nullptr; k = k->NextSiblingElement()) {
    if (of_others(k->Name())) continue;
    if (!has(known->children, k->Name())) {
      refuse(r, *k, config::split(known->children, ' '));
    } else {
      check_surface(r, *k, path + "/" + k->Name());
    }
  }
}

XMLElement* copy_into(XMLElement& to, const XMLElement& e) { return to.InsertEndChild(e.DeepClone(to.GetDocument()))->ToElement(); }

XMLElement& child_of(XMLElement& e, const char* name) {
  XMLElement* found = e.FirstChildElement(name);
  return found != nullptr ? *found : *e.InsertNewChildElement(name);
}

/// The last counts; across several <gazebo> of what is one link here it is told.
void set(UrdfReading& r, XMLElement& e, const char* name, const std::string& value, const std::string& link) {
  if (XMLElement* old = e.FirstChildElement(name)) {
    if (UrdfReading::text(old) != value) r.notes.add(fmt::format("of several <{}> for one link the last counts", name), link);
    e.DeleteChild(old);
  }
  e.InsertNewChildElement(name)->SetText(value.c_str());
}

struct Setting {
  const char *urdf, *group, *sdf;
};
/// Without a group: of the collision itself.
constexpr std::array<Setting, 9> kSettings{{{"mu1", "friction", "mu"},
                                            {"mu2", "friction", "mu2"},
                                            {"fdir1", "friction", "fdir1"},
                                            {"kp", "contact", "kp"},
                                            {"kd", "contact", "kd"},
                                            {"maxVel", "contact", "max_vel"},
                                            {"minDepth", "contact", "min_depth"},
                                            {"maxContacts", nullptr, "max_contacts"},
                                            {"laserRetro", nullptr, "laser_retro"}}};
/// Of a <collision>: those of SDF's that are taken.
constexpr Names kOfCollisions = "surface max_contacts laser_retro";

/// Of several in one <gazebo> the last.
const XMLElement* last_of(const XMLElement& gazebo, const char* name) { return gazebo.LastChildElement(name); }

std::vector<const XMLElement*> extensions_of(const UrdfReading& r, const std::string& reference) {
  const auto it = r.extensions.find(reference);
  return it == r.extensions.end() ? std::vector<const XMLElement*>() : it->second;
}

/// SDF's: x y z roll pitch yaw.
Pose3 pose_in(UrdfReading& r, const XMLElement& e) {
  std::vector<double> n;
  const std::string text = UrdfReading::text(&e);
  std::istringstream words(text);
  for (std::string word; words >> word;) n.push_back(config::parse_number(word).value_or(kInfinite));
  const bool finite = std::all_of(n.begin(), n.end(), [](double x) { return std::isfinite(x); });
  if (e.FirstAttribute() == nullptr && n.size() == 6 && finite) {
    urdf::Pose pose;
    pose.position = urdf::Vector3(n[0], n[1], n[2]);
    pose.rotation.setFromRPY(n[3], n[4], n[5]);
    return pose_of(pose);
  }
  r.problems.add({line_of(e, r.file), path_of(e), text, "isn't six numbers alone", "x y z roll pitch yaw, without attributes"});
  return {};
}

}  // namespace

std::unique_ptr<tinyxml2::XMLDocument> gazebo_collision(UrdfReading& r, const std::string& link) {
  auto out = std::make_unique<tinyxml2::XMLDocument>();
  XMLElement& collision = *out->InsertEndChild(out->NewElement("collision"))->ToElement();
  for (const XMLElement* gazebo : extensions_of(r, link)) {
    for (const XMLElement* c = gazebo->FirstChildElement("collision"); c != nullptr; c = c->NextSiblingElement("collision")) {
      for (const XMLElement* e = c->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
        if (!has(kOfCollisions, e->Name())) continue;  // gazebo_link judges the others
        if (XMLElement* before = collision.FirstChildElement(e->Name())) collision.DeleteChild(before);
        copy_into(collision, *e);
      }
    }
    for (const Setting& s : kSettings)
      if (const XMLElement* e = last_of(*gazebo, s.urdf))
        set(r, s.group == nullptr ? collision : child_of(child_of(child_of(collision, "surface"), s.group), "ode"), s.sdf,
            UrdfReading::text(e), link);
  }
  return out;
}

std::unique_ptr<tinyxml2::XMLDocument> gazebo_link(UrdfReading& r, const UrdfLump& lump) {
  auto out = std::make_unique<tinyxml2::XMLDocument>();
  XMLElement& link = *out->InsertEndChild(out->NewElement("link"))->ToElement();
  const std::string& name = lump.parts.front().link->name;
  for (const UrdfPart& part : lump.parts) {
    for (const XMLElement* gazebo : extensions_of(r, part.link->name)) {
      if (const XMLElement* e = last_of(*gazebo, "turnGravityOff"))
        set(r, link, "gravity", UrdfReading::flag(e) ? "false" : "true", name);
      if (const XMLElement* e = last_of(*gazebo, "selfCollide"))
        set(r, link, "self_collide", UrdfReading::flag(e) ? "1" : "0", name);
      if (const XMLElement* e = last_of(*gazebo, "dampingFactor"))
        for (const char* part_of : {"linear", "angular"})
          set(r, child_of(link, "velocity_decay"), part_of, UrdfReading::text(e), name);
      for (const XMLElement* e = gazebo->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
        const std::string_view what = e->Name();
        if (has(kOfSdfLinks, what)) {
          if (what == "enable_wind" && UrdfReading::flag(e)) r.notes.add("wind is left out", name);
          copy_into(link, *e);
        } else if (what == "visual") {
          r.notes.add("what a <gazebo> says of a link's looks is left out", place_of(*e, r.file));
        } else if (what == "collision") {
          for (const XMLElement* k = e->FirstChildElement(); k != nullptr; k = k->NextSiblingElement()) {
            if (of_others(k->Name())) continue;
            has(kOfCollisions, k->Name()) ? check_surface(r, *k, k->Name()) : refuse(r, *k, config::split(kOfCollisions, ' '));
          }
        } else if (!has(kOfUrdfLinks, what) && !of_others(what)) {
          refuse(r, *e, config::split(std::string(kOfUrdfLinks) + " " + std::string(kOfSdfLinks), ' '));
        }
      }
    }
  }
  return out;
}

void read_gazebo_joint(UrdfReading& r, const std::string& joint, const std::string& key, Axis* axis) {
  for (const XMLElement* gazebo : extensions_of(r, joint)) {
    for (const XMLElement* e = gazebo->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const std::string_view what = e->Name();
      if (what == "physics") {
        r.notes.add("<physics> of joints is left out", key);
      } else if (!has(kOfJoints, what) && !of_others(what) && !has(kOfUrdfLinks, what)) {
        refuse(r, *e, config::split(kOfJoints, ' '));
      }
    }
    if (axis == nullptr) continue;
    const auto spring = [&](const char* name, double least, double most, double& to) {
      if (const XMLElement* e = last_of(*gazebo, name))
        to = r.in_range(config::parse_number(UrdfReading::text(e)).value_or(0), 0, least, most, r.file, key + "/" + name);
    };
    spring("springStiffness", 0, kInfinite, axis->stiffness);
    spring("springReference", -kOpenSide, kOpenSide, axis->rest);
  }
}

void read_gazebo_robot(UrdfReading& r, ModelScope& scope) {
  if (const auto all = extensions_of(r, ""); !all.empty() && r.child(all.front(), "pose") != nullptr)
    scope.pose = pose_in(r, *r.child(all.front(), "pose"));
  for (const XMLElement* gazebo : extensions_of(r, "")) {
    if (const XMLElement* e = last_of(*gazebo, "static")) scope.is_static = UrdfReading::flag(e);
    if (const XMLElement* e = r.child(gazebo, "self_collide")) scope.self_collide = UrdfReading::flag(e);
    for (const XMLElement* e = gazebo->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      if (is(*e, "enable_wind") && UrdfReading::flag(e)) r.notes.add("wind is left out", scope.name);
      if (!has(kOfRobots, e->Name()) && !of_others(e->Name())) refuse(r, *e, config::split(kOfRobots, ' '));
    }
  }
  for (const XMLElement* gazebo : extensions_of(r, "")) {
    for (const XMLElement* e = gazebo->FirstChildElement("plugin"); e != nullptr; e = e->NextSiblingElement("plugin")) {
      tinyxml2::XMLPrinter printer;
      e->Accept(&printer);
      PluginElement plugin{
          r.attribute(e, "name").value_or(""), r.attribute(e, "filename").value_or(""), printer.CStr(), {}, r.file};
      for (const XMLElement* a = e->FirstChildElement("actuator"); a != nullptr; a = a->NextSiblingElement("actuator"))
        if (const XMLElement* joint = r.child(a, "joint"); joint != nullptr && joint->GetText() != nullptr)
          plugin.joints.emplace_back(config::trim(joint->GetText()));
      take_plugin(r, plugin, scope);
    }
  }
}

}  // namespace vsa::reader
