// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Heightmaps and meshes.
#include <lodepng.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "engine/worlds.hpp"

namespace vsa::engine::testing {
namespace {

std::string ball(const std::string& pose) {
  return "<model name='ball'><pose>" + pose + " 0 0 0</pose><link name='l'>" + inertial(1, 0.001) +
         "<collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link></model>";
}

std::string terrain(const std::filesystem::path& image) {
  return "<model name='terrain'><static>true</static><link name='l'><collision name='c'><geometry><heightmap><uri>" +
         image.string() + "</uri><size>8 4 2</size><pos>1 0 0.5</pos></heightmap></geometry></collision></link></model>";
}

/// 9 × 5 pixels of 16 bits; all at a quarter of the brightest but for the top right corner's 3 × 2 pixels.
std::string pgm16() {
  std::string out = "P5\n# made by a test\n9 5\n65535\n";
  for (int r = 0; r < 5; ++r) {
    for (int c = 0; c < 9; ++c) {
      const unsigned v = r < 2 && c > 5 ? 40000 : 10000;
      out += static_cast<char>(v >> 8);
      out += static_cast<char>(v & 255);
    }
  }
  return out;
}

TEST(Terrain, ASphereRestsAtTheHeightThatThePictureSays) {
  const TempDir dir("heightmap");
  const auto image = dir.write("hills.pgm", pgm16());
  // The brightest pixel is 2 m high, the rest 0.5 m; the map lies 0.5 m up and its centre at x = 1, so it reaches from −3 to 5.
  World low = World::load_string(world(terrain(image) + ball("-2 -1 1.2")));
  low.run(1.0);
  EXPECT_NEAR(pose_of(low, "ball::l").position[2], 0.5 + 0.5 + 0.1, 2e-3);
  // Top right: large x, large y.
  World high = World::load_string(world(terrain(image) + ball("4.5 1.5 2.7")));
  high.run(1.0);
  EXPECT_NEAR(pose_of(high, "ball::l").position[2], 0.5 + 2 + 0.1, 2e-3);
  EXPECT_GT(high.contact_count(), 0);
}

TEST(Terrain, AHeightmapsPictureIsItsTriangles) {
  const TempDir dir("heightmap-shape");
  const World w = World::load_string(world(terrain(dir.write("hills.pgm", pgm16()))));
  const Shape& s = w.links()[0].visuals.at(0);
  EXPECT_EQ(s.kind, Shape::Kind::heightmap);
  EXPECT_EQ(s.vertices.size(), 9u * 5u * 3u);
  EXPECT_EQ(s.indices.size(), 8u * 4u * 6u);
  EXPECT_FLOAT_EQ(s.vertices[0], -3);  // x
  EXPECT_FLOAT_EQ(s.vertices[1], -2);  // y
  EXPECT_FLOAT_EQ(s.vertices[2], 1);   // 0.5 + 2·10000/40000
  EXPECT_FLOAT_EQ(s.vertices.back(), 2.5);
}

TEST(Terrain, APngOfEightOrSixteenBitsHasTheSameGround) {
  const TempDir dir("heightmap-png");
  const auto floor_of = [](const std::filesystem::path& image) {
    return World::load_string(world(terrain(image))).links()[0].visuals.at(0).vertices;
  };
  const std::string raw = pgm16().substr(pgm16().size() - 90), shallow = [&] {
    std::string high_bytes;
    for (std::size_t i = 0; i < raw.size(); i += 2) high_bytes += raw[i];
    return high_bytes;
  }();
  const auto png = [&](const std::string& pixels, unsigned bits) {
    std::vector<unsigned char> out;
    EXPECT_EQ(lodepng::encode(out, reinterpret_cast<const unsigned char*>(pixels.data()), 9, 5, LCT_GREY, bits), 0u);
    return dir.write("hills" + std::to_string(bits) + ".png", std::string(out.begin(), out.end()));
  };
  const auto pgm = floor_of(dir.write("hills.pgm", pgm16()));
  EXPECT_EQ(floor_of(png(raw, 16)), pgm);
  constexpr int kUpper = 10000 / 256, kMostUpper = 40000 / 256;  // a picture of eight bits has only these
  EXPECT_NEAR(floor_of(png(shallow, 8))[2], 0.5 + 2.0 * kUpper / kMostUpper, 1e-6);
}

TEST(Terrain, BrokenAndMissingPicturesAreNamed) {
  const TempDir dir("heightmap-bad");
  for (const char* bytes : {"P5\n9 5\n65535\nshort", "P5 2 2 255", "P5\nx", "hello", "\x89PNG\r\n\x1a\nbroken"}) {
    const std::string text = problems_of(world(terrain(dir.write("bad.pgm", bytes))));
    EXPECT_NE(text.find("terrain::l/collision[c]/geometry/heightmap/uri"), std::string::npos) << text;
  }
  EXPECT_NE(problems_of(world(terrain(dir.path() / "none.pgm"))).find("file not found"), std::string::npos);
}

/// A prism over a polygon (counter-clockwise), from z = 0 to 1, as OBJ; with or without its lid.
std::string prism(const std::vector<std::array<double, 2>>& corners, bool lid = true) {
  std::string v, f, bottom = "f", top = "f";
  const std::size_t n = corners.size();
  for (const auto& c : corners) {
    for (const char* z : {" 0\n", " 1\n"}) v += "v " + std::to_string(c[0]) + " " + std::to_string(c[1]) + z;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t a = 2 * i + 1, b = 2 * ((i + 1) % n) + 1;
    f += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + 1) + " " + std::to_string(a + 1) + "\n";
    bottom += " " + std::to_string(2 * (n - 1 - i) + 1);
    top += " " + std::to_string(2 * i + 2);
  }
  return v + f + bottom + "\n" + (lid ? top + "\n" : "");
}

std::string mesh_body(const std::filesystem::path& file, const std::string& scale = "1 1 1") {
  return "<model name='m'><pose>0 0 0.1 0 0 0</pose><link name='l'>" + inertial(1, 0.1, "0.5 0.5 0.5 0 0 0") +
         "<collision name='c'><geometry><mesh><uri>" + file.string() + "</uri><scale>" + scale +
         "</scale></mesh></geometry></collision></link></model>";
}

TEST(Meshes, AConvexMeshStandsOnTheGroundWhereItsVerticesAre) {
  const TempDir dir("mesh");
  const auto cube = dir.write("cube.obj", prism({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  World w = World::load_string(world(ground() + mesh_body(cube, "1 1 0.5")));
  w.run(1.0);
  EXPECT_NEAR(pose_of(w, "m::l").position[2], 0, 2e-3);
  EXPECT_NEAR(pose_of(w, "m::l").position[0], 0, 5e-3);
}

TEST(Meshes, ConcaveAndOpenMeshesAreRefused) {
  const TempDir dir("mesh-bad");
  const auto notch = dir.write("notch.obj", prism({{0, 0}, {2, 0}, {1, 0.5}, {2, 2}, {0, 2}}));
  const std::string concave = problems_of(world(mesh_body(notch)));
  EXPECT_NE(concave.find("m::l/collision[c]/geometry/mesh/uri"), std::string::npos) << concave;
  EXPECT_NE(concave.find("concave"), std::string::npos) << concave;
  const auto cup = dir.write("cup.obj", prism({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, false));
  EXPECT_NE(problems_of(world(mesh_body(cup))).find("isn't closed"), std::string::npos);
  EXPECT_NE(problems_of(world(mesh_body(dir.path() / "none.obj"))).find("file not found"), std::string::npos);
  EXPECT_NE(problems_of(world(mesh_body(dir.write("x.dae", "")))).find(".stl, .obj"), std::string::npos);
  EXPECT_NE(problems_of(world(mesh_body(dir.write("bad.obj", "v 0 0 0\nf 1 2 3\n")))).find("names no vertex"), std::string::npos);
}

TEST(Meshes, StlAsTextIsReadToo) {
  const TempDir dir("stl");
  const auto facet = [](const std::string& a, const std::string& b, const std::string& c) {
    return "facet normal 0 0 0\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c + "\nendloop\nendfacet\n";
  };
  const std::string o = "0 0 0", x = "1 0 0", y = "0 1 0", z = "0 0 1";
  const auto tetra =
      dir.write("t.stl", "solid t\n" + facet(o, y, x) + facet(o, x, z) + facet(o, z, y) + facet(x, y, z) + "endsolid t\n");
  const World w = World::load_string(world(mesh_body(tetra)));
  EXPECT_EQ(w.links()[0].visuals.at(0).vertices.size(), 12u);
  EXPECT_EQ(w.links()[0].visuals.at(0).indices.size(), 12u);
}

/// Some programs write their own words behind the facets.
TEST(Meshes, ABinaryStlMayHaveBytesBehindItsFacets) {
  const TempDir dir("stl_tail");
  std::string whole(80, ' ');
  const auto put = [&](auto value) { whole.append(reinterpret_cast<const char*>(&value), sizeof value); };
  const std::array<std::array<float, 3>, 4> corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  put(std::uint32_t{4});
  for (const auto& facet : {std::array{0, 2, 1}, std::array{0, 1, 3}, std::array{0, 3, 2}, std::array{1, 2, 3}}) {
    for (int normal = 0; normal < 3; ++normal) put(0.0F);
    for (const int c : facet)
      for (const float x : corner[static_cast<std::size_t>(c)]) put(x);
    put(std::uint16_t{0});
  }
  const auto vertices = [&](const std::string& bytes) {
    return World::load_string(world(mesh_body(dir.write("b.stl", bytes)))).links()[0].visuals.at(0).vertices.size();
  };
  EXPECT_EQ(vertices(whole + "made by a program"), vertices(whole));
}

}  // namespace
}  // namespace vsa::engine::testing
