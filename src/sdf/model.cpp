// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <sdf/Joint.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>

#include "sdf/read_context.hpp"
#include "vsa/config/older_plugin.hpp"
#include "vsa/config/plugin_xml.hpp"
#include "vsa/config/text.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::reader {
namespace {

/// libsdformat 12's Model has no Plugins(): they are read from the element tree.
void read_plugins(ReadContext& c, const sdf::ElementPtr& element, const ModelScope& scope) {
  for (sdf::ElementPtr p = child(element, "plugin"); p; p = p->GetNextElement("plugin")) {
    const std::string name = p->GetAttribute("name") ? p->GetAttribute("name")->GetAsString() : std::string{};
    if (name != config::kPluginName) {
      const bool older = config::is_older_plugin(p->ToString(""));
      const std::string file = p->GetAttribute("filename") ? p->GetAttribute("filename")->GetAsString() : std::string{};
      if (!older && file.find("vsa-robot") != std::string::npos) {
        c.notes.add(fmt::format("a plugin of our library has another name and is left out: did you mean {}?", config::kPluginName),
                    scope.name + "/plugin[" + name + "]");
        continue;
      }
      c.notes.add(older ? "plugins of older actuator toolboxes are left out (vsa doctor WORLD writes them anew)"
                        : "foreign plugins are left out",
                  scope.name + "/plugin[" + name + "]");
    } else if (scope.is_static) {
      c.problem(p, scope.name + "/plugin[" + name + "]", "", "its model is static, so its joints can't move",
                "a model that isn't static");
    } else {
      c.out.plugins.push_back({scope.name, scope.top, p->ToString("")});
      for (sdf::ElementPtr a = child(p, "actuator"); a; a = a->GetNextElement("actuator"))
        if (const sdf::ElementPtr joint = child(a, "joint"); joint && joint->GetValue())
          c.driven.insert(scoped_name(scope.name, config::trim(joint->GetValue()->GetAsString())));
    }
  }
}

Pose3 model_pose(ReadContext& c, const sdf::Model& model, const ModelScope* outer, const std::string& name) {
  SdfPose3 pose;
  // A model outside a world has no frame to resolve in.
  if (outer == nullptr && !model.SemanticPose().Resolve(pose).empty()) return model.RawPose();
  return (outer == nullptr ? Pose3() : outer->pose) * c.resolve(model.SemanticPose(), "", model.Element(), name);
}

}  // namespace

void read_model(ReadContext& c, const sdf::Model& model, const ModelScope* outer) {
  ModelScope scope;
  scope.name = scoped_name(outer == nullptr ? "" : outer->name, model.Name());
  scope.top = outer == nullptr ? model.Name() : outer->top;
  scope.pose = model_pose(c, model, outer, scope.name);
  c.model_poses[scope.name] = scope.pose;
  scope.is_static = model.Static() || (outer != nullptr && outer->is_static);
  scope.self_collide = child(model.Element(), "self_collide") || outer == nullptr ? model.SelfCollide() : outer->self_collide;
  if (model.EnableWind()) c.notes.add("wind is left out", scope.name);
  if (child(model.Element(), "gripper")) c.notes.add("grippers are left out", scope.name);
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) read_link(c, *model.LinkByIndex(i), scope);
  // Joints may name links of models nested in this one: those come first.
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) read_model(c, *model.ModelByIndex(i), &scope);
  for (std::uint64_t i = 0; i < model.JointCount(); ++i) read_joint(c, *model.JointByIndex(i), scope);
  read_plugins(c, model.Element(), scope);
  check_urdf(c, model, scope);
}

}  // namespace vsa::reader
