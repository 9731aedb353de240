// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cstdint>

#include "record/utf8.hpp"
#include "vsa/record/page.hpp"

namespace vsa::record {
namespace {

std::string escaped(unsigned char c) {
  constexpr std::string_view kHex = "0123456789abcdef";
  return std::string("\\u00") + kHex[c >> 4U] + kHex[c & 15U];
}

}  // namespace

std::string json_string(std::string_view text) {
  std::string out = "\"";
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const std::string_view piece = text.substr(i, length);
    const auto c = static_cast<unsigned char>(text[i]);
    if (length == 0) {
      out += "\\ufffd";
    } else if (c < 0x20 || c == '<' || c == '>' || c == '&' || c == 0x7F) {
      out += escaped(c);
    } else if (c == '"' || c == '\\') {
      (out += '\\') += static_cast<char>(c);
    } else if (piece == "\u2028" || piece == "\u2029") {
      out += piece == "\u2028" ? "\\u2028" : "\\u2029";
    } else {
      out += piece;
    }
    i += length == 0 ? 1 : length;
  }
  return out + '"';
}

std::string base64(const std::vector<float>& values) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t bytes = values.size() * 4;
  const auto byte = [&](std::size_t i) -> std::uint32_t {
    return i < bytes ? (std::bit_cast<std::uint32_t>(values[i / 4]) >> (8 * (i % 4))) & 0xFFU : 0U;
  };
  std::string out;
  out.reserve((bytes + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes; i += 3) {
    const std::uint32_t three = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
    out += kDigits[three >> 18U];
    out += kDigits[(three >> 12U) & 63U];
    out += i + 1 < bytes ? kDigits[(three >> 6U) & 63U] : '=';
    out += i + 2 < bytes ? kDigits[three & 63U] : '=';
  }
  return out;
}

}  // namespace vsa::record
