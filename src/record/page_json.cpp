// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The header of the page's data: names, geometry, which arrays there are. web/src/data.js reads it.
#include "record/page_json.hpp"

#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "vsa/record/page.hpp"

namespace vsa::record {
namespace {

std::string number(double value) {
  if (!std::isfinite(value)) return "null";
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string number(float value) {
  if (!std::isfinite(value)) return "null";
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// [ f(a), f(b), … ]
template <class Range, class F>
std::string array(const Range& range, F&& f) {
  std::string out = "[";
  for (const auto& item : range) {
    if (out.size() > 1) out += ',';
    out += f(item);
  }
  return out + ']';
}

template <class Range>
std::string numbers(const Range& range) {
  return array(range, [](auto v) { return number(v); });
}

std::string pose(const engine::Pose& p) {
  return '[' + number(p.position[0]) + ',' + number(p.position[1]) + ',' + number(p.position[2]) + ',' + number(p.quaternion[0]) +
         ',' + number(p.quaternion[1]) + ',' + number(p.quaternion[2]) + ',' + number(p.quaternion[3]) + ']';
}

std::string_view kind_name(engine::Shape::Kind kind) {
  using K = engine::Shape::Kind;
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
  std::size_t index(const engine::Shape& shape) {
    const auto [at, fresh] = known_.try_emplace({shape.vertices, shape.indices}, known_.size());
    if (fresh) {
      // Indices as floats stay exact up to 2^24 corners.
      const std::vector<float> indices(shape.indices.begin(), shape.indices.end());
      (text_ += text_.empty() ? "" : ",") +=
          "{\"vertices\":\"" + base64(shape.vertices) + "\",\"indices\":\"" + base64(indices) + "\"}";
    }
    return at->second;
  }
  [[nodiscard]] std::string text() const { return '[' + text_ + ']'; }

 private:
  std::map<std::pair<std::vector<float>, std::vector<std::uint32_t>>, std::size_t> known_;
  std::string text_;
};

std::string visual(const engine::Shape& s, Geometries& geometries) {
  std::string out = "{\"kind\":\"" + std::string(kind_name(s.kind)) + "\",\"pose\":" + pose(s.pose) +
                    ",\"size\":" + numbers(s.size) + ",\"rgba\":" + numbers(s.rgba);
  if (!s.vertices.empty()) out += ",\"geometry\":" + std::to_string(geometries.index(s));
  return out + '}';
}

std::string link(const engine::LinkInfo& l, const engine::Pose* fixed, Geometries& geometries) {
  std::string out = "{\"name\":" + json_string(l.name) + ",\"model\":" + json_string(l.model) + ",\"mass_kg\":" + number(l.mass_kg);
  if (fixed != nullptr) out += ",\"pose\":" + pose(*fixed);
  return out + ",\"visuals\":" + array(l.visuals, [&](const auto& s) { return visual(s, geometries); }) + '}';
}

std::string actuator(const ActuatorInfo& a) {
  return "{\"name\":" + json_string(a.name) + ",\"joint\":" + json_string(a.joint) + ",\"preset\":" + json_string(a.preset) +
         ",\"preset_unit\":" + json_string(a.preset_unit) + ",\"motors\":" + std::to_string(a.motors) +
         ",\"links\":" + array(a.links, [](std::size_t i) { return std::to_string(i); }) + '}';
}

}  // namespace

std::string page_header(const RunInfo& info, const PageText& text, const std::vector<engine::Pose>& first) {
  Geometries geometries;
  std::string links = "[";
  for (std::size_t i = 0; i < info.links.size(); ++i) {
    const engine::Pose* fixed = info.links[i].is_static && i < first.size() ? &first[i] : nullptr;
    (links += i > 0 ? ",\n" : "") += link(info.links[i], fixed, geometries);
  }
  links += ']';
  const auto robot = [](const RobotInfo& r) {
    return "{\"model\":" + json_string(r.model) + ",\"actuators\":" + array(r.actuators, actuator) + '}';
  };
  const auto statistic = [](const Statistic& s) { return '[' + json_string(s.label) + ',' + json_string(s.value) + ']'; };
  return "\"format\":1,\n\"title\":" + json_string(text.title) + ",\n\"world\":" + json_string(info.world) +
         ",\n\"step_s\":" + number(info.step_s) +
         ",\n\"notes\":" + array(text.notes, [](const auto& n) { return json_string(n); }) +
         ",\n\"summary\":" + array(text.summary, statistic) + ",\n\"robots\":" + array(info.robots, robot) +
         ",\n\"links\":" + links + ",\n\"geometries\":" + geometries.text();
}

}  // namespace vsa::record
