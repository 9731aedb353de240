// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/record/mcap.hpp"

#include <algorithm>
#include <exception>

#include "record/mcap_bytes.hpp"
#include "vsa/record/run_data.hpp"

namespace vsa::record {
namespace {

/// Identifiers begin at 1: a schema's must not be 0.
std::uint64_t id_of(std::size_t index) { return index + 1; }

/// First and last time of messages; both 0 where there is none, as the specification asks.
struct Span {
  std::uint64_t first_ns = 0, last_ns = 0, messages = 0;
  void add(std::uint64_t time_ns) {
    first_ns = messages == 0 ? time_ns : std::min(first_ns, time_ns);
    last_ns = std::max(last_ns, time_ns);
    ++messages;
  }
  void add(const Span& other) {
    if (other.messages == 0) return;
    first_ns = messages == 0 ? other.first_ns : std::min(first_ns, other.first_ns);
    last_ns = std::max(last_ns, other.last_ns);
    messages += other.messages;
  }
};

struct ChannelInChunk {
  McapBytes index;  // Array<Tuple<Timestamp, uint64>>
  std::uint64_t messages = 0;
};

struct Chunk {
  McapBytes records;
  Span span;
  std::vector<ChannelInChunk> channels;
};

McapBytes schemas(const McapContents& c) {
  McapBytes out;
  for (std::size_t i = 0; i < c.schemas.size(); ++i) {
    const McapSchema& s = c.schemas[i];
    out.record(McapOp::schema, McapBytes().u16(id_of(i)).string(s.name).string("jsonschema").string(s.text));
  }
  return out;
}

McapBytes channels(const McapContents& c) {
  McapBytes out;
  for (std::size_t i = 0; i < c.channels.size(); ++i) {
    const McapChannel& ch = c.channels[i];
    out.record(McapOp::channel, McapBytes().u16(id_of(i)).u16(id_of(ch.schema)).string(ch.topic).string("json").map(ch.metadata));
  }
  return out;
}

}  // namespace

struct McapWriter::Impl {
  OutputFile file;
  McapContents contents;
  // Of what is in the file:
  std::uint64_t size = 0;
  Crc32 crc;
  Span span;
  std::vector<std::uint64_t> messages;  // of each channel
  std::uint32_t chunks = 0;
  McapBytes chunk_indexes, metadata_indexes;  // for the summary
  // Not yet:
  Chunk chunk;
  std::vector<std::uint32_t> sequence;  // of each channel's next message
  bool closed = false;

  Impl(std::filesystem::path path, McapContents c) : file(std::move(path)), contents(std::move(c)) { begin(); }

  void append(const McapBytes& piece) {
    file.append(piece.bytes());
    crc.process_bytes(piece.bytes().data(), piece.size());
    size += piece.size();
  }

  void begin_chunk() {
    chunk = {};
    chunk.channels.resize(contents.channels.size());
    if (chunks == 0) chunk.records.raw(schemas(contents).bytes()).raw(channels(contents).bytes());
  }

  void begin() {
    size = 0;
    crc.reset();
    span = {};
    messages.assign(contents.channels.size(), 0);
    sequence.assign(contents.channels.size(), 0);
    chunks = 0;
    chunk_indexes.clear();
    metadata_indexes.clear();
    begin_chunk();
    McapBytes head;
    head.raw(kMcapMagic).record(McapOp::header, McapBytes().string("").string(contents.library));
    for (const McapMetadata& m : contents.metadata) {
      const std::uint64_t start = head.size();
      head.record(McapOp::metadata, McapBytes().string(m.name).map(m.values));
      metadata_indexes.record(McapOp::metadata_index, McapBytes().u64(start).u64(head.size() - start).string(m.name));
    }
    append(head);
  }

  void add(std::size_t channel, std::uint64_t time_ns, std::string_view json) {
    ChannelInChunk& in_chunk = chunk.channels[channel];
    in_chunk.index.u64(time_ns).u64(chunk.records.size());
    ++in_chunk.messages;
    constexpr std::uint64_t kFixed = 2 + 4 + 8 + 8;
    chunk.records.u8(static_cast<std::uint8_t>(McapOp::message)).u64(kFixed + json.size());
    chunk.records.u16(id_of(channel)).u32(sequence[channel]++).u64(time_ns).u64(time_ns).raw(json);
    chunk.span.add(time_ns);
  }

  [[nodiscard]] bool chunk_is_full(std::uint64_t now_ns) const {
    if (chunk.span.messages == 0) return false;
    return chunk.records.size() >= contents.chunk_bytes ||
           now_ns >= chunk.span.first_ns + static_cast<std::uint64_t>(contents.chunk_ns);
  }

  /// Whatever comes of it, a new chunk begins.
  void write_chunk() {
    if (chunk.span.messages == 0) return;
    const Chunk done = std::move(chunk);
    McapBytes piece;
    piece.record(McapOp::chunk, McapBytes()
                                    .u64(done.span.first_ns)
                                    .u64(done.span.last_ns)
                                    .u64(done.records.size())
                                    .u32(crc32_of(done.records.bytes()))
                                    .string("")
                                    .sized_64(done.records.bytes()));
    const std::uint64_t chunk_length = piece.size();
    McapBytes offsets;  // Map<uint16, uint64>
    for (std::size_t i = 0; i < done.channels.size(); ++i) {
      if (done.channels[i].messages == 0) continue;
      offsets.u16(id_of(i)).u64(size + piece.size());
      piece.record(McapOp::message_index, McapBytes().u16(id_of(i)).sized_32(done.channels[i].index.bytes()));
    }
    const std::uint64_t start = size;
    try {
      append(piece);
    } catch (...) {
      begin_chunk();
      throw;
    }
    ++chunks;
    chunk_indexes.record(McapOp::chunk_index, McapBytes()
                                                  .u64(done.span.first_ns)
                                                  .u64(done.span.last_ns)
                                                  .u64(start)
                                                  .u64(chunk_length)
                                                  .sized_32(offsets.bytes())
                                                  .u64(piece.size() - chunk_length)
                                                  .string("")
                                                  .u64(done.records.size())
                                                  .u64(done.records.size()));
    span.add(done.span);
    for (std::size_t i = 0; i < messages.size(); ++i) messages[i] += done.channels[i].messages;
    begin_chunk();
  }

  [[nodiscard]] McapBytes statistics() const {
    McapBytes counts;  // Map<uint16, uint64>
    for (std::size_t i = 0; i < messages.size(); ++i) {
      if (messages[i] > 0) counts.u16(id_of(i)).u64(messages[i]);
    }
    constexpr std::uint64_t kAttachments = 0;
    return McapBytes()
        .u64(span.messages)
        .u16(chunks > 0 ? contents.schemas.size() : 0)
        .u32(chunks > 0 ? contents.channels.size() : 0)
        .u32(kAttachments)
        .u32(contents.metadata.size())
        .u32(chunks)
        .u64(span.first_ns)
        .u64(span.last_ns)
        .sized_32(counts.bytes());
  }

  void write_summary() {
    McapBytes tail;
    tail.record(McapOp::data_end, McapBytes().u32(crc.checksum()));
    const std::uint64_t summary_in_tail = tail.size();
    McapBytes offsets;
    const auto group = [&](McapOp op, const McapBytes& records) {
      if (records.empty()) return;
      offsets.record(McapOp::summary_offset,
                     McapBytes().u8(static_cast<std::uint8_t>(op)).u64(size + tail.size()).u64(records.size()));
      tail.raw(records.bytes());
    };
    if (chunks > 0) {  // the summary repeats what the data has
      group(McapOp::schema, schemas(contents));
      group(McapOp::channel, channels(contents));
    }
    group(McapOp::statistics, McapBytes().record(McapOp::statistics, statistics()));
    group(McapOp::chunk_index, chunk_indexes);
    group(McapOp::metadata_index, metadata_indexes);
    const std::uint64_t offsets_start = size + tail.size();
    tail.raw(offsets.bytes());
    // The CRC covers the footer up to the field before it.
    constexpr std::uint64_t kFooter = 8 + 8 + 4;
    tail.u8(static_cast<std::uint8_t>(McapOp::footer)).u64(kFooter).u64(size + summary_in_tail).u64(offsets_start);
    tail.u32(crc32_of(std::string_view(tail.bytes()).substr(summary_in_tail)));
    tail.raw(kMcapMagic);
    append(tail);
  }

  void close() {
    if (std::exchange(closed, true)) return;
    std::exception_ptr lost;
    try {
      write_chunk();
    } catch (const RecordError&) {
      lost = std::current_exception();
    }
    write_summary();
    file.close();
    if (lost) std::rethrow_exception(lost);
  }
};

McapWriter::McapWriter(std::filesystem::path file, McapContents contents)
    : impl_(std::make_unique<Impl>(std::move(file), std::move(contents))) {}

McapWriter::~McapWriter() {
  try {
    impl_->close();
  } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): a destructor can't tell; close() can
  }
}

void McapWriter::write(std::size_t channel, std::int64_t time_ns, std::string_view json) {
  const auto now_ns = static_cast<std::uint64_t>(time_ns);
  if (impl_->chunk_is_full(now_ns)) impl_->write_chunk();
  impl_->add(channel, now_ns, json);
}

void McapWriter::restart() {
  impl_->file.restart();
  impl_->begin();
}

void McapWriter::close() { impl_->close(); }

const std::filesystem::path& McapWriter::path() const noexcept { return impl_->file.path(); }

}  // namespace vsa::record
