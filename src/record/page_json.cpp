// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The header of the page's data: names, geometry, which arrays there are. web/src/data.js reads it.
#include "record/page_json.hpp"

#include <map>
#include <utility>

namespace vsa::record {
namespace {

using page::Json;

template <class Range>
Json numbers(const Range& range) {
  Json out = Json::array();
  for (const auto v : range) out.push_back(page::number(v));
  return out;
}

template <class Range, class F>
Json each(const Range& range, F&& f) {
  Json out = Json::array();
  for (const auto& item : range) out.push_back(f(item));
  return out;
}

Json pose(const scene::Pose& p) {
  Json out = numbers(p.position);
  for (const double v : p.quaternion) out.push_back(page::number(v));
  return out;
}

std::string_view kind_name(scene::Shape::Kind kind) {
  using K = scene::Shape::Kind;
  switch (kind) {
    case K::box:
      return "box";
    case K::sphere:
      return "sphere";
    case K::cylinder:
      return "cylinder";
    case K::capsule:
      return "capsule";
    case K::plane:
      return "plane";
    case K::mesh:
      return "mesh";
    case K::heightmap:
      return "heightmap";
  }
  return "box";
}

/// Triangles are written once, however many links show them.
class Geometries {
 public:
  std::size_t index(const scene::Shape& shape) {
    const auto [at, fresh] = known_.try_emplace({shape.vertices, shape.indices}, known_.size());
    if (fresh) {
      // Indices as floats stay exact up to 2^24 corners.
      const std::vector<float> indices(shape.indices.begin(), shape.indices.end());
      json_.push_back({{"vertices", page::base64(shape.vertices)}, {"indices", page::base64(indices)}});
    }
    return at->second;
  }
  [[nodiscard]] const Json& json() const { return json_; }

 private:
  std::map<std::pair<std::vector<float>, std::vector<std::uint32_t>>, std::size_t> known_;
  Json json_ = Json::array();
};

Json visual(const scene::Shape& s, Geometries& geometries) {
  Json out{{"kind", kind_name(s.kind)}, {"pose", pose(s.pose)}, {"size", numbers(s.size)}, {"rgba", numbers(s.rgba)}};
  if (!s.vertices.empty()) out["geometry"] = geometries.index(s);
  return out;
}

Json link(const scene::LinkInfo& l, const scene::Pose* fixed, Geometries& geometries) {
  Json out{{"name", l.name}, {"model", l.model}, {"mass_kg", page::number(l.mass_kg)}};
  if (fixed != nullptr) out["pose"] = pose(*fixed);
  out["visuals"] = each(l.visuals, [&](const auto& s) { return visual(s, geometries); });
  return out;
}

Json actuator_json(const ActuatorInfo& a) {
  return {{"name", a.name},     {"joint", a.joint},   {"type", a.type},  {"preset_unit", a.preset_unit},
          {"linear", a.linear}, {"motors", a.motors}, {"links", a.links}};
}

}  // namespace

Json page_header(const RunInfo& info, const PageText& text, const std::vector<scene::Pose>& first) {
  Geometries geometries;
  Json links = Json::array();
  for (std::size_t i = 0; i < info.links.size(); ++i) {
    const scene::Pose* fixed = info.links[i].is_static && i < first.size() ? &first[i] : nullptr;
    links.push_back(link(info.links[i], fixed, geometries));
  }
  const auto robot = [](const RobotInfo& r) { return Json{{"model", r.model}, {"actuators", each(r.actuators, actuator_json)}}; };
  const auto statistic = [](const Statistic& s) { return Json::array({s.label, s.value}); };
  return {{"format", 2},
          {"title", text.title},
          {"world", info.world},
          {"step_s", page::number(info.step_s)},
          {"notes", text.notes},
          {"summary", each(text.summary, statistic)},
          {"robots", each(info.robots, robot)},
          {"links", std::move(links)},
          {"geometries", geometries.json()}};
}

}  // namespace vsa::record
