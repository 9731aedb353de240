// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "model_links.hpp"

#include <gazebo/physics/Inertial.hh>
#include <gazebo/physics/Link.hh>
#include <gazebo/physics/Model.hh>
#include <utility>

#include "link_shapes.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::plugins {
namespace {

using gazebo::physics::LinkPtr;
using gazebo::physics::ModelPtr;

void collect(const ModelPtr& model, std::vector<LinkPtr>& out) {
  for (const LinkPtr& link : model->GetLinks()) out.push_back(link);
  for (const ModelPtr& nested : model->NestedModels()) collect(nested, out);
}

}  // namespace

std::vector<LinkPtr> all_links(const ModelPtr& model) {
  std::vector<LinkPtr> out;
  collect(model, out);
  return out;
}

ModelLinks model_links(const ModelPtr& model) {
  ModelLinks out;
  std::vector<LinkPtr> links = all_links(model);
  int left_out = 0;
  for (const LinkPtr& link : links) {
    const std::string name = link->GetScopedName();
    out.infos.push_back({name, std::string(outermost(name)), link->GetInertial()->Mass(), model->IsStatic(),
                         link_shapes(link->GetSDF(), left_out)});
  }
  out.notices = left_out_notice(left_out);
  out.poses = [links = std::move(links)](std::span<scene::Pose> poses) {
    for (std::size_t i = 0; i < links.size() && i < poses.size(); ++i) {
      const auto& pose = links[i]->WorldPose();
      const auto& p = pose.Pos();
      const auto& q = pose.Rot();
      poses[i] = {{p.X(), p.Y(), p.Z()}, {q.W(), q.X(), q.Y(), q.Z()}};
    }
  };
  return out;
}

}  // namespace vsa::plugins
