// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// PNG (ISO/IEC 15948): signature, then chunks of length, type, data and CRC-32. Inside IDAT a zlib stream (RFC 1950) of stored
// deflate blocks (RFC 1951) of at most 65535 bytes.
#include "png.hpp"

#include <algorithm>
#include <cassert>
#include <string_view>

namespace vsa::generate {
namespace {

void put_be32(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>((value >> shift) & 0xffU);
}

void put_le16(std::string& out, std::uint32_t value) {
  out += static_cast<char>(value & 0xffU);
  out += static_cast<char>((value >> 8) & 0xffU);
}

std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xffffffffU;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
  }
  return ~crc;
}

std::uint32_t adler32(std::string_view bytes) {
  std::uint32_t a = 1, b = 0;
  for (const char c : bytes) {
    a = (a + static_cast<unsigned char>(c)) % 65521U;
    b = (b + a) % 65521U;
  }
  return (b << 16) | a;
}

void put_chunk(std::string& out, const std::string& type, const std::string& data) {
  put_be32(out, static_cast<std::uint32_t>(data.size()));
  out += type + data;
  put_be32(out, crc32(type + data));
}

std::string stored_zlib(const std::string& raw) {
  std::string out{'\x78', '\x01'};
  for (std::size_t at = 0; at < raw.size();) {
    const std::size_t n = std::min<std::size_t>(raw.size() - at, 65535);
    out += static_cast<char>(at + n == raw.size() ? 1 : 0);
    put_le16(out, static_cast<std::uint32_t>(n));
    put_le16(out, ~static_cast<std::uint32_t>(n));
    out.append(raw, at, n);
    at += n;
  }
  put_be32(out, adler32(raw));
  return out;
}

}  // namespace

std::string grey_png(int width, int height, const std::vector<std::uint8_t>& pixels) {
  assert(pixels.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::string header;
  put_be32(header, static_cast<std::uint32_t>(width));
  put_be32(header, static_cast<std::uint32_t>(height));
  header += std::string{'\x08', '\0', '\0', '\0', '\0'};  // 8 bits, grey, deflate, adaptive filters, not interlaced
  std::string raw;
  for (int y = 0; y < height; ++y) {
    raw += '\0';  // filter: none
    const auto row = pixels.begin() + static_cast<std::ptrdiff_t>(y) * width;
    raw.append(row, row + width);
  }
  std::string out = "\x89PNG\r\n\x1a\n";
  put_chunk(out, "IHDR", header);
  put_chunk(out, "IDAT", stored_zlib(raw));
  put_chunk(out, "IEND", "");
  return out;
}

}  // namespace vsa::generate
