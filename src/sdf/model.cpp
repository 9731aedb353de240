// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <sdf/Joint.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>

#include "sdf/read_context.hpp"
#include "vsa/config/text.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::reader {
namespace {

/// libsdformat 12's Model has no Plugins(): they are read from the element tree.
void read_plugins(ReadContext& c, const sdf::ElementPtr& element, const ModelScope& scope) {
  for (sdf::ElementPtr p = child(element, "plugin"); p; p = p->GetNextElement("plugin")) {
    PluginElement plugin{ReadContext::attribute(p, "name").value_or(""),
                         ReadContext::attribute(p, "filename").value_or(""),
                         p->ToString(""),
                         {},
                         c.file_of(p)};
    for (sdf::ElementPtr a = child(p, "actuator"); a; a = a->GetNextElement("actuator"))
      if (const sdf::ElementPtr joint = child(a, "joint"); joint && joint->GetValue())
        plugin.joints.emplace_back(config::trim(joint->GetValue()->GetAsString()));
    take_plugin(c, plugin, scope);
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
