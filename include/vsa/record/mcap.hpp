// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Writes MCAP, the container of ROS 2 bags and of Foxglove (mcap.dev/spec, major version 0), with JSON messages. It knows nothing
// of robots (run_log.hpp does). In the file, one behind the other:
//
//   magic  Header  Metadata …                              at once
//   Chunk  Message Index …                                 a chunk at a time; the first one holds all schemas and channels
//   Data End                                               on close, with the CRC32 of everything before
//   Schemas  Channels  Statistics  Chunk Indexes  Metadata Indexes  Summary Offsets  Footer  magic      on close
//
// Chunks aren't compressed: nothing to install, and the same messages give the same bytes whatever a library's version.
// A chunk with its indexes, and all that close() writes, go out with one write each. So a file whose program was killed ends with a
// whole chunk: no index, but a reader that goes from front to back finds every message of it (`mcap recover` makes the index).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vsa::record {

using McapMap = std::vector<std::pair<std::string, std::string>>;  ///< keys once each

/// The form of a channel's messages.
struct McapSchema {
  std::string name;  ///< "vsasim.Energy"
  std::string text;  ///< JSON Schema
};

/// A topic, whose messages have one schema.
struct McapChannel {
  std::size_t schema = 0;  ///< into McapContents::schemas
  std::string topic;       ///< "/world/W/energy"
  McapMap metadata{};      ///< for readers; may be empty
};

/// A record of texts beside the messages.
struct McapMetadata {
  std::string name;  ///< "vsasim.run"
  McapMap values;    ///< keys once each
};

/// All that is known before the first message. Texts that aren't UTF-8 are mended. At most 65535 schemas and channels.
struct McapContents {
  std::string library;                    ///< who wrote the file
  std::vector<McapSchema> schemas;        ///< those of the channels
  std::vector<McapChannel> channels;      ///< by whose index write() is called
  std::vector<McapMetadata> metadata{};   ///< written first
  std::size_t chunk_bytes = 262'144;      ///< a chunk that has as many is written, …
  std::int64_t chunk_ns = 1'000'000'000;  ///< … or one whose first message is older than that
};

/// Writes one MCAP file, messages in the order they come.
class McapWriter {
 public:
  /// Creates or replaces the file. Throws RecordError.
  McapWriter(std::filesystem::path file, McapContents contents);
  ~McapWriter();  ///< closes; what goes wrong then isn't told
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// A message of channels[channel], now at `time_ns` ≥ 0. Throws RecordError when a chunk can't be written; that chunk is lost,
  /// those before it stay and close() still makes the file whole if there is room for the summary.
  void write(std::size_t channel, std::int64_t time_ns, std::string_view json);
  /// Back to a file without messages.
  void restart();
  /// Writes what is left and the summary. Nothing may be written afterwards. Throws RecordError.
  void close();

  [[nodiscard]] const std::filesystem::path& path() const noexcept;  ///< as it was given

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsa::record
