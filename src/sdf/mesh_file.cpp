// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstring>
#include <locale>
#include <map>
#include <optional>
#include <sstream>

#include "vsa/bits.hpp"
#include "vsa/files.hpp"

namespace vsa::reader {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void no_mesh(const fs::path& file, const std::string& message, const std::string& allowed = {}) {
  throw InputError(Problem{file.string(), "", "", message, allowed});
}

std::string extension(const fs::path& file) {
  std::string text = file.extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string read_all(const fs::path& file) {
  auto text = read_file(file);
  if (!text) no_mesh(file, "can't be read");
  return std::move(*text);
}

/// Joins equal corners, so that STL's loose triangles share vertices.
class Welder {
 public:
  explicit Welder(Mesh& mesh) : mesh_(mesh) {}
  std::uint32_t add(const Vec3& v) {
    const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
    const auto [it, added] = index_.try_emplace({v.X(), v.Y(), v.Z()}, next);
    if (added) mesh_.vertices.push_back(v);
    return it->second;
  }

 private:
  Mesh& mesh_;
  std::map<std::array<double, 3>, std::uint32_t> index_;
};

template <typename T>
T take(const std::string& data, std::size_t at) {
  std::array<char, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), data.data() + at, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
  return bits_as<T>(bytes);
}

constexpr std::size_t kStlHeader = 84, kStlFacet = 50;

/// How many facets a binary STL has, whatever some programs append; none: it isn't one.
std::optional<std::size_t> facets_of_binary_stl(const std::string& data) {
  if (data.size() < kStlHeader) return std::nullopt;
  const std::size_t facets = take<std::uint32_t>(data, 80), whole = kStlHeader + kStlFacet * facets;
  const bool text = data.compare(0, 5, "solid") == 0 && data.find("facet") != std::string::npos;
  return data.size() == whole || (data.size() > whole && facets > 0 && !text) ? std::optional(facets) : std::nullopt;
}

Mesh binary_stl(const std::string& data, std::size_t facets) {
  Mesh mesh;
  Welder weld(mesh);
  for (std::size_t at = kStlHeader; at < kStlHeader + kStlFacet * facets; at += kStlFacet) {
    std::array<std::uint32_t, 3> t{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t p = at + 12 * (corner + 1);
      t[corner] = weld.add({static_cast<double>(take<float>(data, p)), static_cast<double>(take<float>(data, p + 4)),
                            static_cast<double>(take<float>(data, p + 8))});
    }
    mesh.triangles.push_back(t);
  }
  return mesh;
}

Mesh text_stl(const fs::path& file, const std::string& data) {
  Mesh mesh;
  Welder weld(mesh);
  std::istringstream in(data);
  in.imbue(std::locale::classic());
  std::vector<std::uint32_t> corners;
  for (std::string word; in >> word;) {
    if (word != "vertex") continue;
    double x = 0, y = 0, z = 0;
    if (!(in >> x >> y >> z)) no_mesh(file, "broken STL: a vertex without three numbers");
    corners.push_back(weld.add({x, y, z}));
  }
  if (corners.size() % 3 != 0) no_mesh(file, "broken STL: the number of vertices isn't a multiple of 3");
  for (std::size_t i = 0; i < corners.size(); i += 3) mesh.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
  return mesh;
}

/// "7", "7/1", "7//3", "-1": the vertex, from 0.
std::uint32_t obj_index(const fs::path& file, const std::string& word, std::size_t count) {
  long index = 0;
  std::istringstream in(word);
  if (!(in >> index)) no_mesh(file, "broken OBJ: face corner \"" + word + "\"");
  const long resolved = index < 0 ? static_cast<long>(count) + index : index - 1;
  if (resolved < 0 || resolved >= static_cast<long>(count))
    no_mesh(file, "broken OBJ: face corner \"" + word + "\" names no vertex");
  return static_cast<std::uint32_t>(resolved);
}

Mesh obj(const fs::path& file, const std::string& data) {
  Mesh mesh;
  std::istringstream in(data);
  in.imbue(std::locale::classic());
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::string word;
    words >> word;
    if (word == "v") {
      double x = 0, y = 0, z = 0;
      if (!(words >> x >> y >> z)) no_mesh(file, "broken OBJ: a vertex without three numbers");
      mesh.vertices.emplace_back(x, y, z);
    } else if (word == "f") {
      std::vector<std::uint32_t> corners;
      while (words >> word) corners.push_back(obj_index(file, word, mesh.vertices.size()));
      if (corners.size() < 3) no_mesh(file, "broken OBJ: a face with fewer than three corners");
      for (std::size_t i = 2; i < corners.size(); ++i) mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
  }
  return mesh;
}

}  // namespace

bool mesh_format_known(const fs::path& file) {
  const std::string e = extension(file);
  return e == ".stl" || e == ".obj" || e == ".dae";
}

Mesh read_mesh(const fs::path& file, const Vec3& scale) {
  if (!mesh_format_known(file)) no_mesh(file, "this mesh format isn't read", kMeshFormats);
  const std::string e = extension(file), data = read_all(file);
  const std::optional<std::size_t> facets = facets_of_binary_stl(data);
  Mesh mesh = e == ".dae"   ? read_collada(file)
              : e == ".obj" ? obj(file, data)
              : facets      ? binary_stl(data, *facets)
                            : text_stl(file, data);
  if (mesh.triangles.empty()) no_mesh(file, "holds no triangles");
  for (Vec3& v : mesh.vertices) {
    v = v * scale;
    if (!v.IsFinite()) no_mesh(file, "has a vertex that isn't finite");
  }
  return mesh;
}

}  // namespace vsa::reader
