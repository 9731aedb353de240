// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/heightmap_file.hpp"

#include <fmt/format.h>
#include <lodepng.h>

#include <algorithm>
#include <sstream>

#include "vsa/files.hpp"

namespace vsa::reader {
namespace {

namespace fs = std::filesystem;

constexpr unsigned kMaxSide = 8193;

[[noreturn]] void no_image(const fs::path& file, const std::string& message) {
  throw InputError(Problem{file.string(), "", "", message, kImageFormats});
}

/// The next number of a PGM header; comments run from # to the line's end.
unsigned header_number(const fs::path& file, std::istringstream& in) {
  std::string comment;
  while (in >> std::ws && in.peek() == '#') std::getline(in, comment);
  unsigned value = 0;
  if (!(in >> value)) no_image(file, "broken PGM header");
  return value;
}

GreyImage pgm(const std::string& data, const fs::path& file) {
  std::istringstream in(data);
  in.ignore(2);
  GreyImage image;
  const unsigned width = header_number(file, in), height = header_number(file, in), max = header_number(file, in);
  if (width == 0 || height == 0 || width > kMaxSide || height > kMaxSide || max == 0 || max > 65535)
    no_image(file, "broken PGM header");
  if (in.tellg() < 0) no_image(file, "PGM ends too early");  // right behind its header
  image.width = width;
  image.height = height;
  const std::size_t start = static_cast<std::size_t>(in.tellg()) + 1, bytes = max > 255 ? 2 : 1;
  const std::size_t count = image.width * image.height;
  if (data.size() < start + count * bytes) no_image(file, "PGM ends too early");
  image.pixels.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto* p = reinterpret_cast<const unsigned char*>(data.data()) + start + i * bytes;
    image.pixels.push_back(bytes == 2 ? p[0] * 256u + p[1] : p[0]);
  }
  return image;
}

GreyImage png(const std::string& data, const fs::path& file) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(data.data());
  unsigned width = 0, height = 0;
  lodepng::State state;
  state.info_raw.colortype = LCT_RGB;
  const auto check = [&](unsigned error) {
    if (error != 0) no_image(file, std::string("broken PNG: ") + lodepng_error_text(error));
  };
  check(lodepng_inspect(&width, &height, &state, bytes, data.size()));
  const std::size_t bytes_each = state.info_png.color.bitdepth > 8 ? 2 : 1;
  state.info_raw.bitdepth = 8 * static_cast<unsigned>(bytes_each);
  if (width > kMaxSide || height > kMaxSide) no_image(file, fmt::format("is {} × {} pixels: too large", width, height));
  std::vector<unsigned char> rgb;
  check(lodepng::decode(rgb, width, height, state, bytes, data.size()));
  GreyImage image{width, height, {}};
  image.pixels.reserve(image.width * image.height);
  for (std::size_t i = 0; i < rgb.size(); i += 3 * bytes_each) {
    image.pixels.push_back(bytes_each == 2 ? rgb[i] * 256u + rgb[i + 1] : rgb[i]);  // big-endian
  }
  return image;
}

}  // namespace

GreyImage read_grey_image(const fs::path& file) {
  const auto data = read_file(file);
  if (!data) no_image(file, "can't be read");
  if (data->rfind("P5", 0) == 0) return pgm(*data, file);
  if (data->rfind("\x89PNG\r\n\x1a\n", 0) == 0) return png(*data, file);
  no_image(file, "isn't an image that can be read");
}

Heightmap read_heightmap(const fs::path& file, const Vec3& size, const Vec3& centre) {
  const GreyImage image = read_grey_image(file);
  if (image.width < 2 || image.height < 2) no_image(file, fmt::format("is {} × {} pixels: too small", image.width, image.height));
  Heightmap map;
  map.rows = image.height;
  map.columns = image.width;
  map.extent_x = size.X();
  map.extent_y = size.Y();
  map.centre = centre;
  const unsigned brightest = std::max(1u, *std::max_element(image.pixels.begin(), image.pixels.end()));
  map.heights.reserve(image.pixels.size());
  for (std::size_t r = 0; r < map.rows; ++r) {
    const std::size_t picture_row = map.rows - 1 - r;
    for (std::size_t c = 0; c < map.columns; ++c) {
      map.heights.push_back(size.Z() * image.pixels[picture_row * map.columns + c] / brightest);
    }
  }
  return map;
}

}  // namespace vsa::reader
