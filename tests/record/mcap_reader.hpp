// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A reader of MCAP written from the specification's tables alone (mcap.dev/spec), for the tests of the writer; it shares no code
// with it. It goes from front to back, checks every length and CRC32, and collects what it finds.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vsa::record::mcap_reader {

struct Record {
  std::uint64_t at = 0;  ///< of the opcode, from the start of what was read
  std::uint64_t length = 0;
  int op = 0;
  std::string content;
};

struct Message {
  int channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0, publish_time = 0;
  std::string data;
};

struct Schema {
  std::string name, encoding, data;
  bool operator==(const Schema&) const = default;
};

struct Channel {
  int schema = 0;
  std::string topic, encoding;
  std::map<std::string, std::string> metadata;
  bool operator==(const Channel&) const = default;
};

struct File {
  std::vector<Record> records;  ///< top level, in order
  std::map<int, Schema> schemas;
  std::map<int, Channel> channels;
  std::vector<Message> messages;
  std::map<std::string, std::map<std::string, std::string>> metadata;
  std::uint64_t chunks = 0;
  bool whole = false;  ///< data end, footer and magic are there, and the summary tells the truth

  [[nodiscard]] std::vector<std::string> on(const std::string& topic) const;
};

/// The bit-by-bit CRC32 of IEEE 802.3.
[[nodiscard]] std::uint32_t crc32(std::string_view bytes);

/// Throws std::runtime_error with what breaks the specification. A file that stops between two records is read as far as it goes.
[[nodiscard]] File read(std::string_view bytes);

}  // namespace vsa::record::mcap_reader
