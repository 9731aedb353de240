// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// MCAP's serialisation (mcap.dev/spec, "Serialization" and "Records"), field by field: integers little-endian; a string is a uint32
// length and UTF-8; arrays and maps have their length in bytes in front, also as uint32; a record is an opcode, a uint64 length and
// its content.
#pragma once

#include <boost/crc.hpp>
#include <cstdint>
#include <string>
#include <string_view>

#include "vsa/record/mcap.hpp"

namespace vsa::record {

enum class McapOp : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

inline constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};

/// The CRC32 of the specification is the one of Ethernet and zlib.
using Crc32 = boost::crc_32_type;

/// Content under way; each call appends one field.
class McapBytes {
 public:
  McapBytes& u8(std::uint8_t v) { return integer(v, 1); }
  McapBytes& u16(std::uint64_t v) { return integer(v, 2); }
  McapBytes& u32(std::uint64_t v) { return integer(v, 4); }
  McapBytes& u64(std::uint64_t v) { return integer(v, 8); }
  McapBytes& raw(std::string_view bytes);
  McapBytes& string(std::string_view text);           ///< mended where it isn't UTF-8
  McapBytes& sized_32(std::string_view bytes);        ///< an array's, a map's or a schema's bytes
  McapBytes& sized_64(std::string_view bytes);        ///< a chunk's records
  McapBytes& map(const McapMap& entries);             ///< Map<string, string>
  McapBytes& record(McapOp op, const McapBytes& of);  ///< a whole record

  [[nodiscard]] const std::string& bytes() const noexcept { return bytes_; }
  [[nodiscard]] std::size_t size() const noexcept { return bytes_.size(); }
  [[nodiscard]] bool empty() const noexcept { return bytes_.empty(); }
  void clear() noexcept { bytes_.clear(); }

 private:
  McapBytes& integer(std::uint64_t value, int bytes);
  std::string bytes_;
};

[[nodiscard]] std::uint32_t crc32_of(std::string_view bytes);

}  // namespace vsa::record
