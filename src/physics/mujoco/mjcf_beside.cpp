// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// NAME.vsa.xml: read and written in one place. Numbers are written so that they read back the same.
#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <type_traits>

#include "physics/mujoco/mjcf.hpp"
#include "physics/mujoco/mjcf_file.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::physics {
namespace {

using description::Plugin;
using scene::Shape;
using tinyxml2::XMLElement;
using Kind = Joint::Kind;

constexpr std::array<std::pair<Shape::Kind, const char*>, 7> kShapes{{{Shape::Kind::box, "box"},
                                                                      {Shape::Kind::sphere, "sphere"},
                                                                      {Shape::Kind::cylinder, "cylinder"},
                                                                      {Shape::Kind::capsule, "capsule"},
                                                                      {Shape::Kind::plane, "plane"},
                                                                      {Shape::Kind::mesh, "mesh"},
                                                                      {Shape::Kind::heightmap, "heightmap"}}};
constexpr std::array<std::pair<Kind, const char*>, 5> kKinds{
    {{Kind::fixed, "fixed"}, {Kind::hinge, "hinge"}, {Kind::slide, "slide"}, {Kind::ball, "ball"}, {Kind::universal, "universal"}}};

template <class Value, std::size_t N>
std::string names_of(const std::array<std::pair<Value, const char*>, N>& table) {
  std::string out;
  for (const auto& [value, name] : table) out += (out.empty() ? "" : ", ") + std::string(name);
  return out;
}

template <class Value, std::size_t N>
const char* name_in(const std::array<std::pair<Value, const char*>, N>& table, Value value) {
  for (const auto& [known, name] : table)
    if (known == value) return name;
  return "";
}

/// Finite numbers between blanks; false where something else is among them.
template <class Number>
bool numbers(std::string_view text, std::vector<Number>& out) {
  const char *at = text.data(), *const end = at + text.size();
  constexpr std::string_view kBlank = " \t\n\r";
  while (true) {
    while (at != end && kBlank.find(*at) != std::string_view::npos) ++at;
    if (at == end) return true;
    Number value{};
    const auto [after, error] = std::from_chars(at, end, value);
    if (error != std::errc() || (after != end && kBlank.find(*after) == std::string_view::npos)) return false;
    if constexpr (std::is_floating_point_v<Number>)
      if (!std::isfinite(value)) return false;
    out.push_back(value);
    at = after;
  }
}

class Reader {
 public:
  Reader(const std::string& file, const std::string& model, Problems& problems) : file_(file), model_(model), problems_(problems) {}

  Beside read(const std::string& text) {
    tinyxml2::XMLDocument document;
    if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
      problem("", "", document.ErrorStr(), "an XML file");
      return {};
    }
    const XMLElement* root = document.RootElement();
    if (root == nullptr || std::string_view(root->Name()) != "vsa") {
      problem("", root == nullptr ? "" : root->Name(), "isn't the element that is looked for", "<vsa>");
      return {};
    }
    for (const tinyxml2::XMLNode* n = root->NextSibling(); n != nullptr; n = n->NextSibling())
      if (n->ToElement() != nullptr || n->ToText() != nullptr)
        problem("", n->Value(), "stands outside the file's first element", "one <vsa>");
    for (const XMLElement* e = root->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) part(*e);
    return std::move(out_);
  }

 private:
  void problem(std::string key, std::string value, std::string message, std::string allowed) {
    problems_.add({file_, std::move(key), std::move(value), std::move(message), std::move(allowed)});
  }
  static std::string attribute(const XMLElement& e, const char* name) {
    const char* text = e.Attribute(name);
    return text == nullptr ? "" : text;
  }
  void only(const XMLElement& e, std::initializer_list<std::string_view> attributes) {
    for (const tinyxml2::XMLAttribute* a = e.FirstAttribute(); a != nullptr; a = a->Next())
      if (std::find(attributes.begin(), attributes.end(), a->Name()) == attributes.end())
        problem(std::string(e.Name()) + "@" + a->Name(), a->Value(), "isn't known here",
                fmt::format("{}", fmt::join(attributes, ", ")));
  }
  bool flag(const XMLElement& e, const char* name, bool otherwise) {
    const std::string text = e.Attribute(name) == nullptr ? otherwise ? "true" : "false" : attribute(e, name);
    if (text != "true" && text != "false") problem(std::string(e.Name()) + "@" + name, text, "isn't that", "true, false");
    return text == "true";
  }

  void part(const XMLElement& e) {
    const std::string_view name = e.Name();
    if (name == "world") {
      only(e, {"name"});
      out_.world_name = attribute(e, "name");
    } else if (name == "link") {
      link(e);
    } else if (name == "joint") {
      joint(e);
    } else if (name == "friction") {
      friction(e);
    } else if (name == "robot") {
      robot(e);
    } else if (name == "plugin") {
      plugin(e, model_, model_);
    } else {
      problem(std::string(name), "", "isn't known here", "world, link, joint, friction, robot, plugin");
    }
  }

  void link(const XMLElement& e) {
    Beside::Link out;
    only(e, {"name", "model", "static", "mass_kg", "gravity"});
    out.info.name = attribute(e, "name");
    out.info.model = e.Attribute("model") != nullptr ? attribute(e, "model") : std::string(outermost(out.info.name));
    out.info.is_static = flag(e, "static", false);
    out.weightless = !flag(e, "gravity", true);
    if (out.info.is_static && out.weightless)
      problem("link@gravity", out.info.name, "is static and has no weight", "no gravity=\"false\", or a link that moves");
    if (e.Attribute("mass_kg") != nullptr) out.info.mass_kg = all<double>(e, "mass_kg", 1)[0];
    for (const XMLElement* v = e.FirstChildElement(); v != nullptr; v = v->NextSiblingElement()) {
      if (std::string_view(v->Name()) != "visual") {
        problem(std::string("link/") + v->Name(), "", "isn't known here", "visual");
        continue;
      }
      out.info.visuals.push_back(visual(*v));
      out.geoms.push_back(attribute(*v, "geom"));
    }
    out_.links.push_back(std::move(out));
  }

  /// `count` numbers of an attribute; zeros and a problem where it hasn't them.
  template <class Number>
  std::vector<Number> all(const XMLElement& e, const char* name, std::size_t count) {
    std::vector<Number> out;
    const std::string text = attribute(e, name);
    if (!numbers(text, out) || out.size() != count) {
      problem(std::string(e.Name()) + "@" + name, text, "isn't that", fmt::format("{} number{}", count, count == 1 ? "" : "s"));
    }
    out.resize(count);
    return out;
  }

  template <class Value, std::size_t N>
  Value named(const XMLElement& e, const char* name, const std::array<std::pair<Value, const char*>, N>& table) {
    const std::string text = attribute(e, name);
    for (const auto& [value, known] : table)
      if (text == known) return value;
    problem(std::string(e.Name()) + "@" + name, text, "isn't known", names_of(table));
    return table.front().first;
  }

  Shape visual(const XMLElement& e) {
    Shape out;
    only(e, {"shape", "pose", "size", "rgba", "geom"});
    out.kind = named(e, "shape", kShapes);
    const std::vector<float> rgba = all<float>(e, "rgba", 4);
    std::copy_n(rgba.begin(), 4, out.rgba.begin());
    if (e.Attribute("geom") != nullptr) return out;
    const std::vector<double> pose = all<double>(e, "pose", 7), size = all<double>(e, "size", 3);
    std::copy_n(pose.begin(), 3, out.pose.position.begin());
    std::copy_n(pose.begin() + 3, 4, out.pose.quaternion.begin());
    std::copy_n(size.begin(), 3, out.size.begin());
    const auto list = [&](const char* name, auto& to) {
      const XMLElement* child = e.FirstChildElement(name);
      const char* text = child == nullptr ? nullptr : child->GetText();
      if (text != nullptr && !numbers(text, to)) problem(std::string("visual/") + name, "", "holds something else", "numbers");
    };
    list("vertices", out.vertices);
    list("triangles", out.indices);
    const std::size_t corners = out.vertices.size() / 3;
    for (const std::uint32_t i : out.indices) {
      if (i >= corners) problem("visual/triangles", fmt::format("{}", i), "names no vertex", fmt::format("below {}", corners));
    }
    return out;
  }

  Vec3 vector(const XMLElement& e, const char* name) {
    const std::vector<double> v = all<double>(e, name, 3);
    return {v[0], v[1], v[2]};
  }

  Vec3 unit_vector(const XMLElement& e, const char* name) {
    const Vec3 v = vector(e, name);
    if (!(std::abs(std::hypot(v.X(), v.Y(), v.Z()) - 1) < 1e-6))
      problem(std::string(e.Name()) + "@" + name, attribute(e, name), "isn't that", "a unit vector");
    return v;
  }

  void joint(const XMLElement& e) {
    only(e, {"name", "kind", "parent", "child", "start", "closes", "place", "axis"});
    Beside::Joint out;
    out.name = attribute(e, "name");
    out.parent = attribute(e, "parent");
    out.child = attribute(e, "child");
    out.kind = named(e, "kind", kKinds);
    if (e.Attribute("start") != nullptr) out.start = all<double>(e, "start", 1)[0];
    out.closes = flag(e, "closes", false);
    if (out.closes) out.place = vector(e, "place");
    if (out.closes && out.kind == Kind::hinge) out.axis = unit_vector(e, "axis");
    if (out.closes && (out.kind == Kind::slide || out.kind == Kind::universal))
      problem("joint@closes", out.name, "can't close a loop", "a fixed, hinge or ball joint");
    out_.joints.push_back(std::move(out));
  }

  void friction(const XMLElement& e) {
    only(e, {"geom", "mu", "mu2", "along", "of"});
    Beside::Friction out{attribute(e, "geom"), attribute(e, "of"), {}, all<double>(e, "mu", 1)[0], all<double>(e, "mu2", 1)[0]};
    const Vec3 along = unit_vector(e, "along");
    out.along = {along.X(), along.Y(), along.Z()};
    if (!(out.mu >= 0 && out.mu2 >= 0 && std::isfinite(out.mu + out.mu2) && out.mu + out.mu2 > 0))
      problem("friction@mu, mu2", fmt::format("{}, {}", out.mu, out.mu2), "out of range", "finite, 0 or more, not both 0");
    const auto same = [&](const Beside::Friction& other) { return other.geom == out.geom; };
    if (std::any_of(out_.frictions.begin(), out_.frictions.end(), same))
      problem("friction@geom", out.geom, "has several", "one <friction> a geom");
    out_.frictions.push_back(std::move(out));
  }

  void robot(const XMLElement& e) {
    only(e, {"model", "top_model"});
    const std::string model = attribute(e, "model");
    const XMLElement* inner = e.FirstChildElement("plugin");
    if (inner == nullptr || model.empty()) return problem("robot", model, "lacks its model or its <plugin>", "both");
    plugin(*inner, model, e.Attribute("top_model") != nullptr ? attribute(e, "top_model") : std::string(outermost(model)));
  }

  void plugin(const XMLElement& e, const std::string& model, const std::string& top) {
    tinyxml2::XMLPrinter printer;
    e.Accept(&printer);
    out_.plugins.push_back({model, top, printer.CStr()});
  }

  const std::string& file_;
  const std::string& model_;
  Problems& problems_;
  Beside out_;
};

/// A terrain's triangles are the MJCF's heightmap.
std::string terrain(const Shape& s, const Link& link) {
  const auto is_map = [](const Collision& c) { return c.geometry.kind == Geometry::Kind::heightmap; };
  const auto it = std::find_if(link.collisions.begin(), link.collisions.end(), is_map);
  if (s.kind != Shape::Kind::heightmap || it == link.collisions.end()) return {};
  return fmt::format("    <visual shape=\"heightmap\" geom=\"{}\" rgba=\"{}\"/>\n", escaped(it->name), fmt::join(s.rgba, " "));
}

std::string written(const Shape& s) {
  const auto& p = s.pose.position;
  const auto& q = s.pose.quaternion;
  std::string out =
      fmt::format("    <visual shape=\"{}\" pose=\"{} {} {} {} {} {} {}\" size=\"{}\" rgba=\"{}\"", name_in(kShapes, s.kind), p[0],
                  p[1], p[2], q[0], q[1], q[2], q[3], fmt::join(s.size, " "), fmt::join(s.rgba, " "));
  if (s.vertices.empty() && s.indices.empty()) return out + "/>\n";
  return out + fmt::format(">\n      <vertices>{}</vertices>\n      <triangles>{}</triangles>\n    </visual>\n",
                           fmt::join(s.vertices, " "), fmt::join(s.indices, " "));
}

}  // namespace

Beside read_beside(const std::string& text, const std::string& file, const std::string& model, Problems& problems) {
  return Reader(file, model, problems).read(text);
}

std::string write_beside(const description::World& world) {
  std::string out = fmt::format("<vsa>\n  <world name=\"{}\"/>\n", escaped(world.name));
  for (std::size_t l = 0; l < world.infos.size(); ++l) {
    const scene::LinkInfo& info = world.infos[l];
    out += fmt::format("  <link name=\"{}\" model=\"{}\"", escaped(info.name), escaped(info.model));
    if (info.is_static) out += fmt::format(" static=\"true\" mass_kg=\"{}\"", info.mass_kg);
    if (world.links[l].weightless && !info.is_static) out += " gravity=\"false\"";
    out += ">\n";
    for (const Shape& shape : info.visuals) {
      const std::string shared = terrain(shape, world.links[l]);
      out += shared.empty() ? written(shape) : shared;
    }
    out += "  </link>\n";
  }
  const MjcfNames names{world, true};
  for (const FrictionDirection& d : directions_of(world)) {
    if (d.mu < kSmallestMu && d.mu2 < kSmallestMu) continue;  // a geom that has none
    out += fmt::format("  <friction geom=\"{}\" mu=\"{}\" mu2=\"{}\" along=\"{}\"", escaped(names.geom(d.link, d.collision)), d.mu,
                       d.mu2, fmt::join(d.along, " "));
    if (d.of) out += fmt::format(" of=\"{}\"", escaped(names.body(*d.of)));
    out += "/>\n";
  }
  const auto link = [&](std::optional<std::size_t> l) { return l ? escaped(world.links[*l].name) : std::string{}; };
  for (const Joint& j : world.joints) {
    out += fmt::format("  <joint name=\"{}\" kind=\"{}\" parent=\"{}\" child=\"{}\"", escaped(j.name), name_in(kKinds, j.kind),
                       link(j.parent), link(j.child));
    if (j.one_axis() && j.axes[0].start) out += fmt::format(" start=\"{}\"", *j.axes[0].start);
    const auto vector = [](const Vec3& v) { return fmt::format("{} {} {}", v.X(), v.Y(), v.Z()); };
    if (j.closes) out += fmt::format(" closes=\"true\" place=\"{}\"", vector(j.pose.Pos()));
    if (j.closes && j.kind == Kind::hinge) out += fmt::format(" axis=\"{}\"", vector(j.axes[0].xyz));
    out += "/>\n";
  }
  for (const Plugin& p : world.plugins) {
    out += fmt::format("  <robot model=\"{}\" top_model=\"{}\">\n{}</robot>\n", escaped(p.model), escaped(p.top_model), p.xml);
  }
  return out + "</vsa>\n";
}

}  // namespace vsa::physics
