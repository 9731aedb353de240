// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "png.hpp"

#include <lodepng.h>

#include <cassert>
#include <stdexcept>

namespace vsa::generate {

std::string grey_png(int width, int height, const std::vector<std::uint8_t>& pixels) {
  assert(pixels.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  lodepng::State how;
  how.info_raw.colortype = how.info_png.color.colortype = LCT_GREY;
  how.encoder.auto_convert = 0;
  how.encoder.filter_strategy = LFS_ZERO;
  how.encoder.zlibsettings.btype = 0;  // stored
  std::vector<std::uint8_t> out;
  const unsigned error = lodepng::encode(out, pixels, static_cast<unsigned>(width), static_cast<unsigned>(height), how);
  if (error != 0) throw std::runtime_error(std::string("can't make a PNG: ") + lodepng_error_text(error));
  return {out.begin(), out.end()};
}

}  // namespace vsa::generate
