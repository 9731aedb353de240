// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "record/mcap_bytes.hpp"

#include "vsa/page/json.hpp"

namespace vsa::record {

McapBytes& McapBytes::integer(std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) bytes_ += static_cast<char>((value >> (8 * i)) & 0xFFU);
  return *this;
}

McapBytes& McapBytes::raw(std::string_view bytes) {
  bytes_ += bytes;
  return *this;
}

McapBytes& McapBytes::string(std::string_view text) { return sized_32(page::well_formed(text)); }

McapBytes& McapBytes::sized_32(std::string_view bytes) { return u32(bytes.size()).raw(bytes); }

McapBytes& McapBytes::sized_64(std::string_view bytes) { return u64(bytes.size()).raw(bytes); }

McapBytes& McapBytes::map(const McapMap& entries) {
  McapBytes content;
  for (const auto& [key, value] : entries) content.string(key).string(value);
  return sized_32(content.bytes());
}

McapBytes& McapBytes::record(McapOp op, const McapBytes& of) {
  return u8(static_cast<std::uint8_t>(op)).u64(of.size()).raw(of.bytes());
}

std::uint32_t crc32_of(std::string_view bytes) {
  Crc32 crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

}  // namespace vsa::record
