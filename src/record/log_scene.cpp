// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Poses and shapes in Foxglove's well-known schemas (docs.foxglove.dev, "Message schemas": FrameTransforms, SceneUpdate). Viewers
// know them by their names; the schemas here describe the part of them that is written, and lists that are always empty without
// their items.
#include "record/log_messages.hpp"
#include "record/number_text.hpp"
#include "record/schema.hpp"

namespace vsa::record {
namespace {

using page::Json;
using scene::Pose;
using scene::Shape;
using schema::array_of;
using schema::object;
using schema::of_type;

constexpr std::int64_t kSecond = 1'000'000'000;

std::string time_text(std::int64_t time_ns) {
  return "{\"sec\":" + std::to_string(time_ns / kSecond) + ",\"nsec\":" + std::to_string(time_ns % kSecond) + '}';
}

template <class Number>
void xyz(std::string& out, Number x, Number y, Number z) {
  out += "{\"x\":";
  put(out, x);
  out += ",\"y\":";
  put(out, y);
  out += ",\"z\":";
  put(out, z);
  out += '}';
}

/// From w x y z.
void rotation(std::string& out, const std::array<double, 4>& q) {
  xyz(out, q[1], q[2], q[3]);
  out.back() = ',';
  out += "\"w\":";
  put(out, q[0]);
  out += '}';
}

std::string pose_text(const Pose& p) {
  std::string out = "{\"position\":";
  xyz(out, p.position[0], p.position[1], p.position[2]);
  out += ",\"orientation\":";
  rotation(out, p.quaternion);
  return out + '}';
}

std::string color_text(const std::array<float, 4>& rgba) {
  std::string out;
  for (std::size_t i = 0; i < 4; ++i) {
    out += i == 0 ? "{\"" : ",\"";
    out += std::string(1, "rgba"[i]) + "\":";
    put(out, rgba[i]);
  }
  return out + '}';
}

/// The primitives of one link, each list in JSON without its brackets.
struct Primitives {
  std::string cubes, spheres, cylinders, triangles;

  static void add(std::string& list, const std::string& primitive) { (list += list.empty() ? "" : ",") += primitive; }

  static std::string solid(const Shape& s, const Pose& pose, double x, double y, double z, std::string_view more = {}) {
    std::string out = "{\"pose\":" + pose_text(pose) + ",\"size\":";
    xyz(out, x, y, z);
    return out + std::string(more) + ",\"color\":" + color_text(s.rgba) + '}';
  }
  static std::string cylinder(const Shape& s) {
    return solid(s, s.pose, 2 * s.size[0], 2 * s.size[0], s.size[1], ",\"bottom_scale\":1,\"top_scale\":1");
  }

  static std::string triangle_list(const Shape& s, const Pose& pose, const std::vector<float>& corners,
                                   const std::vector<std::uint32_t>& indices) {
    std::string out = "{\"pose\":" + pose_text(pose) + ",\"points\":[";
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      if (i > 0) out += ',';
      xyz(out, corners[i], corners[i + 1], corners[i + 2]);
    }
    out += "],\"color\":" + color_text(s.rgba) + ",\"colors\":[],\"indices\":[";
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (i > 0) out += ',';
      put(out, indices[i]);
    }
    return out + "]}";
  }

  /// The two ends of a capsule: its axis is the shape's z, size = radius, length between the ends' centres.
  void add_capsule_ends(const Shape& s) {
    const auto& [w, x, y, z] = s.pose.quaternion;
    const std::array<double, 3> axis{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
    for (const double half : {-s.size[1] / 2, s.size[1] / 2}) {
      Pose end = s.pose;
      for (std::size_t i = 0; i < 3; ++i) end.position[i] += half * axis[i];
      add(spheres, solid(s, end, 2 * s.size[0], 2 * s.size[0], 2 * s.size[0]));
    }
  }

  void add_plane(const Shape& s) {
    const auto x = static_cast<float>(s.size[0] / 2), y = static_cast<float>(s.size[1] / 2);
    add(triangles, triangle_list(s, s.pose, {-x, -y, 0, x, -y, 0, x, y, 0, -x, y, 0}, {0, 1, 2, 0, 2, 3}));
  }

  void add(const Shape& s) {
    using K = Shape::Kind;
    switch (s.kind) {
      case K::box:
        return add(cubes, solid(s, s.pose, s.size[0], s.size[1], s.size[2]));
      case K::sphere:
        return add(spheres, solid(s, s.pose, 2 * s.size[0], 2 * s.size[0], 2 * s.size[0]));
      case K::cylinder:
        return add(cylinders, cylinder(s));
      case K::capsule:
        add(cylinders, cylinder(s));
        return add_capsule_ends(s);
      case K::plane:
        return add_plane(s);
      case K::mesh:
      case K::heightmap:  // corners in the link's frame
        if (!s.vertices.empty()) add(triangles, triangle_list(s, {}, s.vertices, s.indices));
    }
  }
};

std::string entity(const scene::LinkInfo& link, const std::string& time) {
  const std::string name = page::json_string(link.name);
  Primitives p;
  for (const Shape& s : link.visuals) p.add(s);
  return "{\"timestamp\":" + time + ",\"frame_id\":" + name + ",\"id\":" + name +
         ",\"lifetime\":{\"sec\":0,\"nsec\":0},\"frame_locked\":true,\"metadata\":[],\"cubes\":[" + p.cubes + "],\"spheres\":[" +
         p.spheres + "],\"cylinders\":[" + p.cylinders + "],\"triangles\":[" + p.triangles +
         "],\"arrows\":[],\"lines\":[],\"texts\":[],\"models\":[]}";
}

Json instant(std::string_view title) { return object(title, {{"sec", of_type("integer")}, {"nsec", of_type("integer")}}); }

Json vector_schema(std::string_view title, std::string_view axes) {
  Json fields = Json::object();
  for (const char axis : axes) fields[std::string(1, axis)] = of_type("number");
  return object(title, fields);
}

}  // namespace

std::string transforms_schema() {
  const Json one = object("foxglove.FrameTransform", {{"timestamp", instant("time")},
                                                      {"parent_frame_id", of_type("string")},
                                                      {"child_frame_id", of_type("string")},
                                                      {"translation", vector_schema("foxglove.Vector3", "xyz")},
                                                      {"rotation", vector_schema("foxglove.Quaternion", "xyzw")}});
  return object("foxglove.FrameTransforms", {{"transforms", array_of(one)}}).dump();
}

void transforms_message(std::string& out, std::int64_t time_ns, const std::vector<LogLink>& links, const std::vector<Pose>& poses) {
  const std::string time = time_text(time_ns);
  out = "{\"transforms\":[";
  const std::size_t before = out.size();
  for (const LogLink& link : links) {
    const Pose& pose = poses[link.index];
    if (!finite(pose)) continue;
    if (out.size() > before) out += ',';
    ((((out += "{\"timestamp\":") += time) += R"(,"parent_frame_id":"world","child_frame_id":)") += link.name) +=
        ",\"translation\":";
    xyz(out, pose.position[0], pose.position[1], pose.position[2]);
    out += ",\"rotation\":";
    rotation(out, pose.quaternion);
    out += '}';
  }
  out += "]}";
}

std::string scene_schema() {
  const Json text = of_type("string"), number = of_type("number");
  const Json xyz_schema = vector_schema("foxglove.Vector3", "xyz"), color = vector_schema("foxglove.Color", "rgba");
  const Json pose =
      object("foxglove.Pose", {{"position", xyz_schema}, {"orientation", vector_schema("foxglove.Quaternion", "xyzw")}});
  const auto solid = [&](std::string_view title) {
    return object(title, {{"pose", pose}, {"size", xyz_schema}, {"color", color}});
  };
  const Json cylinder =
      object("foxglove.CylinderPrimitive",
             {{"pose", pose}, {"size", xyz_schema}, {"bottom_scale", number}, {"top_scale", number}, {"color", color}});
  const Json triangles = object("foxglove.TriangleListPrimitive", {{"pose", pose},
                                                                   {"points", array_of(vector_schema("foxglove.Point3", "xyz"))},
                                                                   {"color", color},
                                                                   {"colors", array_of(color)},
                                                                   {"indices", array_of(of_type("integer"))}});
  const auto none = [](std::string_view title) { return array_of(object(title, Json::object())); };
  const Json pair = object("foxglove.KeyValuePair", {{"key", text}, {"value", text}});
  const Json one = object("foxglove.SceneEntity", {{"timestamp", instant("time")},
                                                   {"frame_id", text},
                                                   {"id", text},
                                                   {"lifetime", instant("duration")},
                                                   {"frame_locked", of_type("boolean")},
                                                   {"metadata", array_of(pair)},
                                                   {"cubes", array_of(solid("foxglove.CubePrimitive"))},
                                                   {"spheres", array_of(solid("foxglove.SpherePrimitive"))},
                                                   {"cylinders", array_of(cylinder)},
                                                   {"triangles", array_of(triangles)},
                                                   {"arrows", none("foxglove.ArrowPrimitive")},
                                                   {"lines", none("foxglove.LinePrimitive")},
                                                   {"texts", none("foxglove.TextPrimitive")},
                                                   {"models", none("foxglove.ModelPrimitive")}});
  return object("foxglove.SceneUpdate", {{"deletions", none("foxglove.SceneEntityDeletion")}, {"entities", array_of(one)}}).dump();
}

std::string scene_message(std::int64_t time_ns, const std::vector<scene::LinkInfo>& links) {
  const std::string time = time_text(time_ns);
  std::string out;
  for (const scene::LinkInfo& link : links) {
    if (!link.visuals.empty()) (out += out.empty() ? "" : ",") += entity(link, time);
  }
  return "{\"deletions\":[],\"entities\":[" + out + "]}";
}

}  // namespace vsa::record
