// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "record/mcap_reader.hpp"

#include <algorithm>

#include "record/mcap_cursor.hpp"

namespace vsa::record::mcap_reader {
namespace {

using Times = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

std::vector<Record> split(std::string_view bytes, std::uint64_t from) {
  std::vector<Record> out;
  Cursor c(bytes);
  c.take(from);
  while (!c.done() && !(c.left() == 8 && !out.empty() && out.back().op == 2)) {
    Record r;
    r.at = bytes.size() - c.left();
    r.op = static_cast<int>(c.number(1));
    r.content = std::string(c.take(c.number(8)));
    r.length = 9 + r.content.size();
    out.push_back(std::move(r));
  }
  return out;
}

struct Chunk {
  std::uint64_t first = 0, last = 0, at = 0, length = 0, size = 0, index_length = 0;
  std::map<int, Times> index;             // worked out from the messages
  std::map<int, std::uint64_t> index_at;  // of the index records behind the chunk
};

class Reader {
 public:
  File file;

  explicit Reader(std::string_view bytes) : bytes_(bytes) {
    need(bytes.substr(0, 8) == std::string_view("\x89MCAP0\r\n", 8), "no magic");
    file.records = split(bytes, 8);
    need(!file.records.empty() && file.records.front().op == 1, "no header");
    for (const Record& r : file.records) take(r);
  }

 private:
  void take(const Record& r) {
    Cursor c(r.content);
    switch (r.op) {
      case 0x01:
        need(c.text().empty(), "a profile that isn't well known");
        need(!c.text().empty(), "no library");
        break;
      case 0x03:
      case 0x04:
        need(in_summary_, "schemas and channels stand in chunks");
        definition(r);
        break;
      case 0x06:
        chunk(r);
        break;
      case 0x07:
        message_index(r);
        break;
      case 0x08:
        chunk_index(r);
        break;
      case 0x0B:
        statistics(r);
        break;
      case 0x0C:
        metadata(r);
        break;
      case 0x0D:
        metadata_index(r);
        break;
      case 0x0E:
        summary_offset(r);
        break;
      case 0x0F:
        need(c.number(4) == crc32(bytes_.substr(0, r.at)), "data section: CRC");
        in_summary_ = true;
        summary_at_ = r.at + r.length;
        break;
      case 0x02:
        footer(r);
        break;
      default:
        need(false, "unknown opcode " + std::to_string(r.op));
    }
  }

  void definition(const Record& r) {
    Cursor c(r.content);
    const int id = c.id();
    need(id != 0, "id 0");
    if (r.op == 0x03) {
      Schema s{c.text(), c.text(), c.text()};
      const auto [at, fresh] = file.schemas.emplace(id, s);
      need(fresh != in_summary_ && at->second == s, "schema " + s.name + ": once in the data, the same in the summary");
    } else {
      const int schema = c.id();
      Channel ch{schema, c.text(), c.text(), c.texts()};
      need(file.schemas.count(schema) == 1, "a channel before its schema");
      const auto [at, fresh] = file.channels.emplace(id, ch);
      need(fresh != in_summary_ && at->second == ch, "channel " + ch.topic + ": once in the data, the same in the summary");
    }
    need(c.done(), "more than the definition");
  }

  void metadata(const Record& r) {
    Cursor c(r.content);
    const std::string name = c.text();
    file.metadata[name] = c.texts();
    metadata_at_.push_back({r.at, r.length, name});
  }

  void metadata_index(const Record& r) {
    const MetadataAt& of = metadata_at_.at(metadata_indexes_++);
    Cursor c(r.content);
    need(c.number(8) == of.at && c.number(8) == of.length && c.text() == of.name, "metadata index");
  }

  void chunk(const Record& r) {
    need(!in_summary_, "a chunk in the summary");
    Cursor c(r.content);
    Chunk chunk;
    chunk.first = c.number(8);
    chunk.last = c.number(8);
    chunk.size = c.number(8);
    chunk.at = r.at;
    chunk.length = r.length;
    const std::uint64_t crc = c.number(4);
    need(c.text().empty(), "compressed");
    const std::string_view inside = c.take(c.number(8));
    need(c.done() && inside.size() == chunk.size && crc == crc32(inside), "chunk: size or CRC");
    std::vector<std::uint64_t> times;
    for (const Record& inner : split(inside, 0)) {
      if (inner.op != 0x05) {
        need(inner.op == 0x03 || inner.op == 0x04, "a record that may not be in a chunk");
        definition(inner);
        continue;
      }
      Cursor m(inner.content);
      Message message{m.id(), static_cast<std::uint32_t>(m.number(4)), m.number(8), m.number(8), {}};
      message.data = std::string(m.take(m.left()));
      need(file.channels.count(message.channel) == 1, "a message before its channel");
      times.push_back(message.log_time);
      chunk.index[message.channel].emplace_back(message.log_time, inner.at);
      file.messages.push_back(std::move(message));
    }
    need(!times.empty(), "an empty chunk");
    need(chunk.first == *std::min_element(times.begin(), times.end()), "chunk: first time");
    need(chunk.last == *std::max_element(times.begin(), times.end()), "chunk: last time");
    chunks_.push_back(std::move(chunk));
    ++file.chunks;
  }

  void message_index(const Record& r) {
    need(!chunks_.empty(), "an index before any chunk");
    Chunk& chunk = chunks_.back();
    need(r.at == chunk.at + chunk.length + chunk.index_length, "an index that isn't behind its chunk");
    Cursor c(r.content);
    const int channel = c.id();
    Cursor inside(c.take(c.number(4)));
    Times times;
    while (!inside.done()) {
      const std::uint64_t time = inside.number(8);
      times.emplace_back(time, inside.number(8));
    }
    need(chunk.index.count(channel) == 1 && chunk.index[channel] == times, "message index");
    need(chunk.index_at.emplace(channel, r.at).second, "two indexes of one channel");
    chunk.index_length += r.length;
  }

  void chunk_index(const Record& r) {
    const Chunk& chunk = chunks_.at(chunk_indexes_++);
    Cursor c(r.content);
    need(c.number(8) == chunk.first && c.number(8) == chunk.last, "chunk index: times");
    need(c.number(8) == chunk.at && c.number(8) == chunk.length, "chunk index: place");
    need(c.numbers() == chunk.index_at && chunk.index_at.size() == chunk.index.size(), "chunk index: message indexes");
    need(c.number(8) == chunk.index_length && c.text().empty(), "chunk index: length of indexes");
    need(c.number(8) == chunk.size && c.number(8) == chunk.size && c.done(), "chunk index: sizes");
  }

  void statistics(const Record& r) {
    Cursor c(r.content);
    std::uint64_t first = 0, last = 0;
    std::map<int, std::uint64_t> counts;
    for (const Message& m : file.messages) {
      first = counts.empty() ? m.log_time : std::min(first, m.log_time);
      last = std::max(last, m.log_time);
      ++counts[m.channel];
    }
    need(c.number(8) == file.messages.size(), "statistics: messages");
    need(c.number(2) == file.schemas.size() && c.number(4) == file.channels.size(), "statistics: definitions");
    need(c.number(4) == 0 && c.number(4) == file.metadata.size() && c.number(4) == file.chunks, "statistics: records");
    need(c.number(8) == first && c.number(8) == last && c.numbers() == counts && c.done(), "statistics: times and counts");
  }

  void summary_offset(const Record& r) {
    if (offsets_at_ == 0) offsets_at_ = r.at;
    Cursor c(r.content);
    const int op = static_cast<int>(c.number(1));
    const std::uint64_t start = c.number(8), length = c.number(8);
    std::uint64_t found_start = 0, found_length = 0;
    for (const Record& other : file.records) {
      if (other.at < summary_at_ || other.op != op) continue;
      if (found_length == 0) found_start = other.at;
      found_length += other.length;
    }
    need(found_length > 0 && start == found_start && length == found_length, "summary offset");
  }

  void footer(const Record& r) {
    need(chunk_indexes_ == chunks_.size() && metadata_indexes_ == metadata_at_.size(), "something isn't indexed");
    Cursor c(r.content);
    need(c.number(8) == summary_at_ && c.number(8) == offsets_at_, "footer: places");
    const std::uint64_t crc_at = r.at + 9 + 16;
    need(c.number(4) == crc32(bytes_.substr(summary_at_, crc_at - summary_at_)) && c.done(), "footer: CRC");
    need(bytes_.substr(r.at + r.length) == bytes_.substr(0, 8), "no magic at the end");
    file.whole = true;
  }

  struct MetadataAt {
    std::uint64_t at, length;
    std::string name;
  };
  std::string_view bytes_;
  bool in_summary_ = false;
  std::uint64_t summary_at_ = 0, offsets_at_ = 0;
  std::vector<Chunk> chunks_;
  std::vector<MetadataAt> metadata_at_;
  std::size_t chunk_indexes_ = 0, metadata_indexes_ = 0;
};

}  // namespace

std::vector<std::string> File::on(const std::string& topic) const {
  std::vector<std::string> out;
  for (const Message& m : messages) {
    if (channels.at(m.channel).topic == topic) out.push_back(m.data);
  }
  return out;
}

std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

File read(std::string_view bytes) { return Reader(bytes).file; }

}  // namespace vsa::record::mcap_reader
