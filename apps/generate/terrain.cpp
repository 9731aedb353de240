// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Ground to crawl over: flat, steps and rubble (boxes), rolling hills (a heightmap).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generate.hpp"
#include "module.hpp"
#include "png.hpp"
#include "vsa/units.hpp"

namespace vsa::generate {
namespace {

constexpr double kDegree = kPi / 180;

/// Numerical Recipes' linear congruential generator: the same layout on every machine.
class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed) {}
  double between(double low, double high) {
    state_ = state_ * 1664525U + 1013904223U;
    return low + (high - low) * (static_cast<double>(state_ >> 8) / 16777216.0);
  }

 private:
  std::uint32_t state_;
};

/// Exact ground of the hills before it is lifted: waves, faded out towards the start.
double ground(const HillsSpec& spec, double x, double y) {
  double sum = 0;
  for (const Wave& w : spec.waves) {
    const double along = x * std::cos(w.direction_deg * kDegree) + y * std::sin(w.direction_deg * kDegree);
    sum += w.height_m * std::sin(2 * kPi / w.wavelength_m * along + w.phase_deg * kDegree);
  }
  const double s =
      std::clamp((std::hypot(x, y) - spec.flat_radius_m[0]) / (spec.flat_radius_m[1] - spec.flat_radius_m[0]), 0.0, 1.0);
  return sum * s * s * (3 - 2 * s);
}

void plane(Xml& xml, double friction) {
  const auto geometry = [&] { xml.open("geometry").open("plane").leaf("normal", "0 0 1").leaf("size", "100 100").close().close(); };
  xml.open("collision", {{"name", "ground"}});
  geometry();
  write_surface(xml, friction);
  xml.close();
  xml.open("visual", {{"name", "ground"}});
  geometry();
  xml.open("material").leaf("ambient", "0.72 0.70 0.66 1").leaf("diffuse", "0.72 0.70 0.66 1").close();
  xml.close();
}

std::string static_model(const std::string& name, void (*body)(Xml&, const Description&), const Description& d) {
  Xml xml = begin_sdf();
  xml.open("model", {{"name", name}}).leaf("static", "true");
  xml.open("link", {{"name", "link"}});
  body(xml, d);
  xml.close().close().close();
  return xml.text();
}

void flat_body(Xml& xml, const Description& d) { plane(xml, d.module.friction); }

void rubble_body(Xml& xml, const Description& d) {
  plane(xml, d.module.friction);
  const auto blocks = rubble(d.rubble);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Block& b = blocks[i];
    const std::string name = fmt::format("block_{}", i);
    const double shade = 0.42 + 0.04 * static_cast<double>(i % 5);
    xml.open("collision", {{"name", name}});
    xml.pose({b.x, b.y, b.height / 2, 0, 0, b.yaw});
    xml.open("geometry").open("box").leaf("size", numbers({b.length, b.width, b.height})).close().close();
    write_surface(xml, d.module.friction);
    xml.close();
    box_visual(xml, name, {b.x, b.y, b.height / 2, 0, 0, b.yaw}, {b.length, b.width, b.height},
               {shade + 0.06, shade, shade - 0.06});
  }
}

void hills_body(Xml& xml, const Description& d) {
  const Hills h = hills(d.hills);
  const auto geometry = [&] {
    xml.open("geometry").open("heightmap");
    xml.leaf("uri", "model://terrain_hills/height.png");
    xml.leaf("size", numbers({d.hills.size_m, d.hills.size_m, h.height_m}));
    xml.leaf("pos", "0 0 0");
    xml.close().close();
  };
  xml.open("collision", {{"name", "ground"}});
  geometry();
  write_surface(xml, d.module.friction);
  xml.close();
  xml.open("visual", {{"name", "ground"}});
  geometry();
  xml.close();
}

}  // namespace

std::vector<Block> rubble(const RubbleSpec& spec) {
  Random random(spec.seed);
  const double yaw = spec.travel_deg * kDegree, c = std::cos(yaw), s = std::sin(yaw);
  std::vector<Block> blocks;
  const auto place = [&](double along, double across, double turn, double length, double width, double height) {
    blocks.push_back({along * c - across * s, along * s + across * c, yaw + turn, length, width, height});
  };
  for (int i = 0; i < spec.boxes; ++i) {
    const double along = spec.patch_from_m + random.between(0, spec.patch_size_m[0]);
    const double across = random.between(-0.5, 0.5) * spec.patch_size_m[1];
    const double turn = random.between(0, kPi / 2);
    const double length = random.between(spec.side_m[0], spec.side_m[1]);
    const double width = random.between(spec.side_m[0], spec.side_m[1]);
    place(along, across, turn, length, width, random.between(spec.height_m[0], spec.height_m[1]));
  }
  double along = spec.patch_from_m + spec.patch_size_m[0] + spec.step_gap_m;
  for (const double height : spec.steps_m) {
    place(along + spec.step_size_m[0] / 2, 0, 0, spec.step_size_m[0], spec.step_size_m[1], height);
    along += spec.step_size_m[0] + spec.step_gap_m;
  }
  return blocks;
}

Hills hills(const HillsSpec& spec) {
  const auto n = static_cast<std::size_t>(spec.samples);
  const double cell = spec.size_m / (spec.samples - 1);
  const auto at = [&](std::size_t i) { return static_cast<double>(i) * cell - spec.size_m / 2; };
  std::vector<double> exact(n * n);
  Hills result;
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t col = 0; col < n; ++col) {
      const double x = at(col), y = -at(row), step = 1e-4;  // the picture's first row is the ground's far side, +y
      exact[row * n + col] = ground(spec, x, y);
      const double dx = (ground(spec, x + step, y) - ground(spec, x - step, y)) / (2 * step);
      const double dy = (ground(spec, x, y + step) - ground(spec, x, y - step)) / (2 * step);
      result.steepest_rad = std::max(result.steepest_rad, std::atan(std::hypot(dx, dy)));
    }
  }
  const auto [low, high] = std::minmax_element(exact.begin(), exact.end());
  result.height_m = std::max(*high - *low, 1e-3);
  result.start_m = -*low;
  // The whole range 0 … 255 is used: some hosts scale by the picture's own extremes.
  for (const double z : exact) result.pixels.push_back(static_cast<std::uint8_t>(std::lround((z - *low) / result.height_m * 255)));
  return result;
}

void add_terrain(Files& files, const Description& d) {
  add_model(files, "terrain_flat", "Flat ground", static_model("terrain_flat", flat_body, d));
  add_model(files, "terrain_rubble", "Boxes and low steps on flat ground", static_model("terrain_rubble", rubble_body, d));
  add_model(files, "terrain_hills", "Rolling hills", static_model("terrain_hills", hills_body, d));
  files["terrain_hills/height.png"] = grey_png(d.hills.samples, d.hills.samples, hills(d.hills).pixels);
}

}  // namespace vsa::generate
