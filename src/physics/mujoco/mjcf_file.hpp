// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A world from MJCF: MuJoCo's model of it, and what the file beside it says.
#pragma once

#include <map>
#include <optional>

#include "physics/description.hpp"
#include "physics/mujoco/bodies.hpp"
#include "physics/mujoco/model.hpp"

namespace tinyxml2 {
class XMLElement;
}

namespace vsa::physics {

struct MjcfFile final : description::Native {
  ModelPtr model;
  LinkObjects objects;
};

/// NAME.vsa.xml, not yet compared with the MJCF.
struct Beside {
  struct Link {
    scene::LinkInfo info;
    bool weightless = false;
    std::vector<std::string> geoms;  ///< of each visual: the heightmap that it shows, or empty
  };
  struct Joint {
    std::string name, parent, child;  ///< parent, child: empty: the world
    description::Joint::Kind kind = description::Joint::Kind::fixed;
    std::optional<double> start;
    bool closes = false;  ///< a loop; then also:
    Vec3 place, axis;     ///< in the world; of a hinge
  };
  /// Of a geom: mu along, mu2 across; of: the body in whose axes `along` is, empty: the world.
  struct Friction {
    std::string geom, of;
    std::array<double, 3> along{};
    double mu = 0, mu2 = 0;
  };
  std::string world_name;
  std::vector<Friction> frictions;
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<description::Plugin> plugins;
};

/// `model`: the MJCF's, for plugins that say none.
[[nodiscard]] Beside read_beside(const std::string& text, const std::string& file, const std::string& model, Problems& problems);
[[nodiscard]] std::string write_beside(const description::World& world);

/// The bodies of a model as links, and the joints; objects of both. Without what `beside` says its own words stand for themselves.
void describe(const mjModel& model, const std::string& file, const Beside& beside, description::World& out, LinkObjects& objects,
              Problems& problems);

/// A problem for each kind of number in a model that holds one that isn't finite.
void check_finite(const mjModel& model, const std::string& file, Problems& problems);

/// How many equalities of a model hold a joint that closes a loop between two bodies: welds, or connects at its place or on its axis.
[[nodiscard]] int closures_of(const mjModel& model, const mjData& at_start, const description::Joint& joint, int parent, int child);

/// A model's name leads those of topics, which carry no blanks, no @, ~ and :=.
[[nodiscard]] std::string speakable(std::string name);

/// Of MuJoCo's own: its name, or "number 3"; the control nearest to 0 that it takes.
[[nodiscard]] std::string actuator_name(const mjModel& model, int actuator);
[[nodiscard]] double control_of(const mjModel& model, int actuator);

/// What else of the model acts on the joints of `out`.
void describe_forces(const mjModel& model, const LinkObjects& objects, description::World& out);

/// What geoms of a body look like.
[[nodiscard]] std::vector<scene::Shape> visuals_of(const mjModel& model, int body);
/// A geom's triangles, or its form. False where it can't be shown.
[[nodiscard]] bool show(const mjModel& model, int geom, scene::Shape& shape);

}  // namespace vsa::physics
