// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The URDF is mended as for libsdformat (urdf_file.hpp), given to urdfdom, and what that makes of it lumped and described.
#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>

#include "sdf/newer_sdf.hpp"
#include "sdf/plugin_places.hpp"
#include "sdf/urdf_plainly.hpp"
#include "sdf/urdfdom_console.hpp"
#include "sdf/urdfdom_reading.hpp"
#include "sdf/xml_place.hpp"
#include "vsa/scoped_name.hpp"
#include "vsa/sdf/feature.hpp"

namespace vsa::reader {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

constexpr const char* kAllowed = "a URDF file, or MJCF named .xml or .mjcf";

/// Null, and a problem, where it isn't that of a URDF.
XMLElement* robot_of(tinyxml2::XMLDocument& xml, const SdfSource& source, Problems& problems) {
  const auto read = source.path.empty() ? xml.Parse(source.text.data(), source.text.size()) : xml.LoadFile(source.path.c_str());
  if (read != tinyxml2::XML_SUCCESS) {
    const std::string place = xml.ErrorLineNum() > 0 ? fmt::format("{}:{}", source.label(), xml.ErrorLineNum()) : source.label();
    problems.add({place, "", "", std::string("isn't XML that can be read: ") + xml.ErrorName(), kAllowed});
    return nullptr;
  }
  XMLElement* root = xml.RootElement();
  if (root != nullptr && (is(*root, "sdf") || is(*root, "gazebo") || is(*root, "world") || is(*root, "model"))) {
    problems.add({source.label(), "", "", sdf_feature().missing(),
                  "URDF; MJCF, NAME.xml or, beside NAME.sdf, what vsa export --mjcf wrote of it elsewhere"});
    return nullptr;
  }
  if (root == nullptr || !is(*root, "robot")) {
    problems.add(
        {source.label(), root == nullptr ? "" : fmt::format("<{}>", root->Name()), "", "isn't readable as URDF", kAllowed});
    return nullptr;
  }
  return root;
}

/// Where a <robot>'s <origin>, which mend_urdf has judged, puts it.
Pose3 origin_of(const XMLElement& robot) {
  const XMLElement* origin = robot.FirstChildElement("origin");
  if (origin == nullptr) return {};
  const Vec3 xyz = three_numbers(origin->Attribute("xyz")).value_or(Vec3()),
             rpy = three_numbers(origin->Attribute("rpy")).value_or(Vec3());
  urdf::Rotation turn;
  turn.setFromRPY(rpy.X(), rpy.Y(), rpy.Z());
  return {xyz, {turn.w, turn.x, turn.y, turn.z}};
}

/// What libsdformat would refuse in the SDF that it makes of them.
void check_name_of(UrdfReading& r, const std::string& key, const std::string& name) {
  const bool reserved = name.size() >= 4 && name.compare(0, 2, "__") == 0 && name.compare(name.size() - 2, 2, "__") == 0;
  if (name.empty() || reserved)
    r.problems.add({r.file, key, name, "is no name that SDF allows", "one that isn't empty and doesn't stand in __ … __"});
}

void check_names(UrdfReading& r, const std::string& robot) {
  check_name_of(r, "robot@name", robot);
  for (const std::string& link : r.urdf.links) check_name_of(r, "link@name", link);
  for (const UrdfJoint& j : r.urdf.joints) {
    check_name_of(r, "joint@name", j.name);
    const bool taken = std::find(r.urdf.links.begin(), r.urdf.links.end(), j.name) != r.urdf.links.end();
    if (!j.lumped && taken && r.urdf.lumped_into(j.name) == j.name)
      r.problems.add({r.file, "joint@name", j.name, "is a link's name, too", "names that no link and joint share"});
  }
}

void read_robot(const XMLElement& robot, const urdf::ModelInterface& model, UrdfReading& r) {
  for (const XMLElement* g = robot.FirstChildElement("gazebo"); g != nullptr; g = g->NextSiblingElement("gazebo"))
    r.extensions[UrdfReading::attribute(g, "reference").value_or("")].push_back(g);
  r.out.name = "default";
  ModelScope scope;
  scope.name = scope.top = model.getName();
  check_names(r, model.getName());
  read_gazebo_robot(r, scope);
  if (robot.FirstChildElement("origin") != nullptr) scope.pose = origin_of(robot);
  const std::vector<UrdfLump> lumps = lump_links(r, model, scope.pose);
  for (const UrdfLump& lump : lumps) read_urdf_link(r, lump, scope);
  for (std::size_t i = 0; i < lumps.size(); ++i) read_urdf_joint(r, lumps[i], scope, i);
  if (lumps.empty() && r.problems.empty()) r.problems.add({r.file, "", "", "holds no model with a link", "a <link>"});
  if (scope.is_static) return;
  for (const UrdfJoint& j : r.urdf.joints)
    if (j.mimic)
      r.mimics.push_back({r.file, scoped_name(scope.name, j.name), scoped_name(scope.name, j.mimic->leader), j.mimic->multiplier,
                          j.mimic->offset});
}

}  // namespace

description::World read_urdf_plainly(const SdfSource& source, const ReadOptions& options, const Finder& finder, SeenFiles& seen,
                                     std::vector<std::string>& warnings, Problems& problems) {
  description::World out;
  if (!is_there(source, problems)) return out;
  if (!source.path.empty()) seen.reads(source.path);
  tinyxml2::XMLDocument xml;
  XMLElement* robot = robot_of(xml, source, problems);
  const std::string file = source.label();
  if (robot == nullptr || has_more_than_root(*robot, file, problems) || is_unexpanded(*robot, file, problems)) return out;
  Notes notes;
  const fs::path base = source.path.empty() ? fs::current_path() : fs::absolute(source.path).parent_path();
  UrdfReading r{{out, problems, notes, finder, seen, file, base, options.engine, options.concave, options.impossible_inertia}};
  check_plugin_places(*robot, file, problems);
  r.urdf = mend_urdf(*robot, file, 0, notes, problems);
  if (!problems.empty()) return out;
  tinyxml2::XMLPrinter printer;
  xml.Print(&printer);
  std::vector<UrdfMessage> said;
  const std::shared_ptr<urdf::ModelInterface> model = parse_urdf(printer.CStr(), said);
  for (const UrdfMessage& m : said) {
    if (m.error) problems.add({file, "", "", m.text, ""});
    if (!m.error) notes.add(m.text, file);
  }
  if (!model && problems.empty()) problems.add({file, "", "", "isn't readable as URDF", kAllowed});
  if (!model || !problems.empty()) return out;
  read_robot(*robot, *model, r);
  if (problems.empty()) find_direction_frames(r);
  if (problems.empty()) finish_joints(r);
  if (problems.empty()) close_loops(r);
  warnings = notes.texts();
  return out;
}

}  // namespace vsa::reader
