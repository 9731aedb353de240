// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One world a file. Models come by model:// URI, so that every host finds them on its model path.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "generate.hpp"
#include "vsa/units.hpp"

namespace vsa::generate {
namespace {

struct Placed {
  std::string model;
  std::array<double, 6> pose;
};

void write_light(Xml& xml) {
  xml.open("light", {{"name", "sun"}, {"type", "directional"}});
  xml.leaf("cast_shadows", "true");
  xml.leaf("pose", "0 0 10 0 0 0");
  xml.leaf("diffuse", "0.8 0.8 0.8 1").leaf("specular", "0.2 0.2 0.2 1");
  xml.leaf("direction", "-0.5 0.3 -0.9");
  xml.close();
}

/// For gz-sim, which has DART whatever the type says: a chain that lies still has dozens of contacts, and of what DART offers this
/// pair alone keeps up with real time there (docs/howto/gazebo.md).
void write_dart(Xml& xml) {
  xml.open("dart").leaf("collision_detector", "bullet");
  xml.open("solver").leaf("solver_type", "pgs").close();
  xml.close();
}

std::string world(const Description& d, const std::string& name, const std::vector<Placed>& models) {
  Xml xml = begin_sdf();
  xml.open("world", {{"name", name}});
  xml.leaf("gravity", numbers({0, 0, -d.world.gravity_m_per_s2}));
  xml.open("physics", {{"name", "step"}, {"type", "ode"}});
  xml.leaf("max_step_size", d.world.step_s);
  xml.leaf("real_time_factor", 1.0);
  xml.leaf("real_time_update_rate", 1 / d.world.step_s);
  write_dart(xml);
  xml.close();
  write_light(xml);
  for (const Placed& placed : models) {
    const auto& p = placed.pose;
    xml.open("include");
    xml.leaf("uri", "model://" + placed.model);
    xml.pose({p[0], p[1], p[2], p[3], p[4], p[5]});
    xml.close();
  }
  xml.close().close();
  return xml.text();
}

using Put = std::function<void(const std::string&, const std::vector<Placed>&)>;

/// The right arm's upright plane holds what the right hand meets.
void add_frank_worlds(const Put& put, const Description& d) {
  const FrankSpec& f = d.frank;
  const double toe = f.toe_in_deg * kPi / 180;
  const auto in_plane = [&](double from_shoulder, double z) -> std::array<double, 6> {
    return {from_shoulder * std::cos(toe), -f.shoulder_half_width_m + from_shoulder * std::sin(toe), z, 0, 0, toe};
  };
  put("frank", {{"terrain_flat", {}}, {"frank", {}}});
  put("frank_table", {{"terrain_flat", {}},
                      {"frank", {}},
                      {"frank_table", in_plane(d.table.reach_m, 0)},
                      {"baton", in_plane(d.table.reach_m, d.table.top_height_m + d.table.baton_height_m / 2)}});
  const double hand = f.shoulder_height_m - f.upper_arm_m - f.forearm_m;
  const double ball = hand_front_m(d) + d.pendulum.ball_radius_m + d.pendulum.gap_m;
  put("frank_ball", {{"terrain_flat", {}}, {"frank", {}}, {"pendulum", in_plane(ball, hand + d.pendulum.cord_m)}});
  for (const char* object : {"hard", "soft"}) {
    // Pitched by −90° the finger points along the world's +x and the gripper's axis upwards.
    put(std::string("gripper_") + object,
        {{"terrain_flat", {}},
         {"qbmove_gripper", {0, 0, d.bench.height_m, 0, -kPi / 2, 0}},
         {std::string("object_") + object, {d.gripper.pad_at_m, -d.gripper.approach_m, d.bench.height_m, 0, 0, 0}}});
  }
}

}  // namespace

Xml begin_sdf() {
  Xml xml;
  xml.comment("Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0");
  xml.comment("Written by vsa-generate from models/robots.toml: change that, not this.");
  xml.open("sdf", {{"version", "1.7"}});
  return xml;
}

void add_model(Files& files, const std::string& name, const std::string& title, const std::string& sdf) {
  files[name + "/model.sdf"] = sdf;
  Xml xml;
  xml.open("model");
  xml.leaf("name", title).leaf("version", "1.0");
  xml.leaf("sdf", "model.sdf", {{"version", "1.7"}});
  xml.open("author").leaf("name", "The vsasim authors").leaf("email", "none").close();
  xml.leaf("description", title + ". Generated from models/robots.toml; see docs/reference/models.md.");
  xml.close();
  files[name + "/model.config"] = xml.text();
}

void add_worlds(Files& files, const Description& d) {
  const double lying = d.module.edge_m / 2 + d.snake.clearance_m;
  // The snake's contacts are spheres, which may be larger than its housings.
  const double snake = std::max(d.module.edge_m / 2, 2 * d.module.contact_radius_m) + d.snake.clearance_m;
  const double quarter = kPi / 2;
  const auto put = [&](const std::string& name, const std::vector<Placed>& models) {
    files["worlds/" + name + ".sdf"] = world(d, name, models);
  };
  put("snake_flat", {{"terrain_flat", {}}, {"qbmove_snake", {0, 0, snake, 0, 0, 0}}});
  put("snake_rubble", {{"terrain_rubble", {}}, {"qbmove_snake", {0, 0, snake, 0, 0, 0}}});
  // One grey level of the heightmap more, so that its rounding can't put the start into the ground.
  const Hills h = hills(d.hills);
  put("snake_hills", {{"terrain_hills", {}}, {"qbmove_snake", {0, 0, h.start_m + h.height_m / 255 + snake, 0, 0, 0}}});
  // Rolled by −90°, the shaft lies along the world's +y and the lever, along the module's +y, hangs straight down.
  put("bench_load", {{"terrain_flat", {}}, {"qbmove_bench_load", {0, 0, d.bench.height_m, -quarter, 0, 0}}});
  put("bench_free", {{"terrain_flat", {}}, {"qbmove_bench_free", {0, 0, d.bench.height_m, 0, 0, 0}}});
  put("bench_throw", {{"terrain_flat", {}}, {"qbmove_bench_throw", {0, 0, d.throwing.height_m, 0, 0, 0}}});
  put("bench_pole", {{"terrain_flat", {}}, {"qbmove_bench_pole", {0, 0, d.pole.bench.height_m, 0, 0, 0}}});
  put("manipulator_3r", {{"terrain_flat", {}}, {"qbmove_manipulator_3r", {}}});
  add_frank_worlds(put, d);
  put("module", {{"terrain_flat", {}}, {"qbmove", {0, 0, lying, 0, 0, 0}}});
}

Files generate(const Description& d) {
  Files files;
  add_robots(files, d);
  add_frank(files, d);
  add_manipulator(files, d);
  add_props(files, d);
  add_terrain(files, d);
  add_worlds(files, d);
  return files;
}

}  // namespace vsa::generate
