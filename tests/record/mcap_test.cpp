// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/record/mcap.hpp"

#include <gtest/gtest.h>

#include "record/mcap_reader.hpp"
#include "record/scratch.hpp"
#include "vsa/record/run_data.hpp"

namespace vsa::record {
namespace {

namespace fs = std::filesystem;
constexpr std::int64_t kMs = 1'000'000;

McapContents contents() {
  return {"test 1",
          {{"Position", R"({"type":"object"})"}, {"Energy", R"({"type":"object"})"}},
          {{0, "/a", {{"preset", "soft"}}}, {1, "/b"}},
          {{"run", {{"world", "bench"}, {"seed", "7"}}}}};
}

std::string bytes(std::initializer_list<int> values) {
  std::string out;
  for (const int v : values) out += static_cast<char>(v);
  return out;
}

mcap_reader::File read(const fs::path& file) { return mcap_reader::read(slurp(file)); }

TEST(McapReader, HasTheCrcOfTheSpecification) { EXPECT_EQ(mcap_reader::crc32("123456789"), 0xCBF43926U); }

TEST(McapReader, RefusesAFileOfWhichOneBitChanged) {
  const Scratch dir;
  {
    McapWriter w(dir.path() / "f", contents());
    w.write(0, 0, "{}");
    w.close();
  }
  const std::string good = slurp(dir.path() / "f");
  ASSERT_TRUE(mcap_reader::read(good).whole);
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string spoilt = good;
    spoilt[i] = static_cast<char>(spoilt[i] ^ 0x10);
    bool whole = false;
    try {
      whole = mcap_reader::read(spoilt).whole;
    } catch (const std::exception&) {
      continue;
    }
    EXPECT_FALSE(whole) << "byte " << i;
  }
}

TEST(McapWriter, WritesTheBytesOfTheSpecification) {
  const Scratch dir;
  McapWriter w(dir.path() / "f", {"lib", {}, {}, {{"m", {{"k", "v"}}}}});
  w.close();
  std::string expected = bytes({0x89, 'M', 'C', 'A', 'P', 0x30, '\r', '\n'});
  expected += bytes({0x01, 11, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 'l', 'i', 'b'});  // no profile
  expected += bytes({0x0C, 19, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 'm', 10, 0, 0, 0, 1, 0, 0, 0, 'k', 1, 0, 0, 0, 'v'});
  const std::string file = slurp(dir.path() / "f");
  ASSERT_EQ(file.substr(0, expected.size()), expected);
  const std::string data_end = file.substr(expected.size(), 13);
  EXPECT_EQ(data_end.substr(0, 9), bytes({0x0F, 4, 0, 0, 0, 0, 0, 0, 0}));
  const std::uint32_t crc = mcap_reader::crc32(expected);
  EXPECT_EQ(data_end.substr(9), bytes({int(crc & 255U), int(crc >> 8U & 255U), int(crc >> 16U & 255U), int(crc >> 24U)}));
  EXPECT_EQ(file.substr(file.size() - 37, 9), bytes({0x02, 20, 0, 0, 0, 0, 0, 0, 0})) << "footer of 20 bytes, then magic";
  EXPECT_EQ(file.substr(file.size() - 8), expected.substr(0, 8));
  EXPECT_TRUE(mcap_reader::read(file).whole);
}

TEST(McapWriter, GivesBackWhatWasWrittenInOrder) {
  const Scratch dir;
  McapWriter w(dir.path() / "f", contents());
  for (std::int64_t t = 0; t < 10; ++t) {
    w.write(0, t * kMs, "{\"x\":" + std::to_string(t) + "}");
    if (t % 2 == 0) w.write(1, t * kMs, "{}");
  }
  w.close();
  const auto file = read(dir.path() / "f");
  EXPECT_TRUE(file.whole);
  ASSERT_EQ(file.messages.size(), 15u);
  EXPECT_EQ(file.chunks, 1u);
  EXPECT_EQ(file.on("/a").at(9), "{\"x\":9}");
  EXPECT_EQ(file.on("/b").size(), 5u);
  EXPECT_EQ(file.messages.back().log_time, 9'000'000u);
  EXPECT_EQ(file.messages.back().publish_time, 9'000'000u);
  EXPECT_EQ(file.messages.back().sequence, 9u);
  EXPECT_EQ(file.channels.at(1).metadata.at("preset"), "soft");
  EXPECT_EQ(file.channels.at(1).encoding, "json");
  EXPECT_EQ(file.schemas.at(2).name, "Energy");
  EXPECT_EQ(file.schemas.at(2).encoding, "jsonschema");
  EXPECT_EQ(file.metadata.at("run").at("seed"), "7");
}

TEST(McapWriter, EndsAChunkByItsSizeAndByItsAge) {
  const Scratch dir;
  McapContents c = contents();
  c.chunk_bytes = 1000;
  McapWriter by_size(dir.path() / "size", c);
  for (int i = 0; i < 30; ++i) by_size.write(0, i, std::string(200, ' '));
  by_size.close();
  EXPECT_EQ(read(dir.path() / "size").chunks, 7u)
      << "5 messages of 231 bytes a chunk, 4 in the first, which has the definitions too";
  McapWriter by_age(dir.path() / "age", contents());
  for (int i = 0; i < 300; ++i) by_age.write(0, i * 10 * kMs, "{}");
  by_age.close();
  EXPECT_EQ(read(dir.path() / "age").chunks, 3u);
}

TEST(McapWriter, MakesTheSameBytesOfTheSameMessages) {
  const Scratch dir;
  for (const char* name : {"a", "b"}) {
    McapWriter w(dir.path() / name, contents());
    for (int i = 0; i < 500; ++i) w.write(static_cast<std::size_t>(i % 2), i * 10 * kMs, "{}");
    w.close();
  }
  EXPECT_EQ(slurp(dir.path() / "a"), slurp(dir.path() / "b"));
}

TEST(McapWriter, StartsOverAsIfNothingHadBeenWritten) {
  const Scratch dir;
  McapWriter w(dir.path() / "f", contents());
  for (int i = 0; i < 500; ++i) w.write(0, i * 10 * kMs, "{\"x\":1}");
  w.restart();
  w.write(1, 0, "{}");
  w.close();
  McapWriter fresh(dir.path() / "fresh", contents());
  fresh.write(1, 0, "{}");
  fresh.close();
  EXPECT_EQ(slurp(dir.path() / "f"), slurp(dir.path() / "fresh"));
}

TEST(McapWriter, LeavesWholeChunksWhenTheProgramIsKilled) {
  const Scratch dir;
  McapWriter w(dir.path() / "f", contents());
  for (int i = 0; i < 250; ++i) w.write(0, i * 10 * kMs, "{}");
  const auto file = read(dir.path() / "f");  // as a kill at this moment leaves it
  EXPECT_FALSE(file.whole);
  EXPECT_EQ(file.messages.size(), 200u) << "two chunks of a second each; the third is still in memory";
}

TEST(McapWriter, IsWholeEvenWhereNobodyClosedIt) {
  const Scratch dir;
  { McapWriter(dir.path() / "f", contents()).write(0, 0, "{}"); }
  const auto file = read(dir.path() / "f");
  EXPECT_TRUE(file.whole);
  EXPECT_EQ(file.messages.size(), 1u);
}

TEST(McapWriter, IsWholeWithoutAnyMessage) {
  const Scratch dir;
  McapWriter(dir.path() / "f", contents()).close();
  EXPECT_TRUE(read(dir.path() / "f").whole);
}

TEST(McapWriter, SaysAtOnceThatTheDiskIsFull) {
  const std::string message = message_of<RecordError>([] { McapWriter("/dev/full", contents()); });
  EXPECT_EQ(message, "/dev/full: can't write: No space left on device");
}

TEST(McapWriter, KeepsTheChunksBeforeTheDiskWasFullAndClosesThemWhole) {
  const Scratch dir;
  McapContents c = contents();
  c.chunk_bytes = 4000;
  McapWriter w(dir.path() / "f", c);
  const std::string message = message_of<RecordError>([&] {
    const FileSizeLimit disk(20'000);
    for (int i = 0; i < 1000; ++i) w.write(0, i * kMs, std::string(200, ' '));
  });
  EXPECT_NE(message.find("f: can't write: File too large"), std::string::npos) << message;
  {
    const FileSizeLimit disk(20'000);
    w.close();
  }
  const auto file = read(dir.path() / "f");
  EXPECT_TRUE(file.whole);
  EXPECT_GT(file.chunks, 2u);
  EXPECT_EQ(file.messages.back().sequence + 1, file.messages.size()) << "what is there has no gap";
}

TEST(McapWriter, TellsThatNotEvenTheSummaryFits) {
  const Scratch dir;
  McapWriter w(dir.path() / "f", contents());
  w.write(0, 0, "{}");
  const FileSizeLimit disk(150);
  EXPECT_NE(message_of<RecordError>([&] { w.close(); }).find("File too large"), std::string::npos);
  EXPECT_FALSE(read(dir.path() / "f").whole);
}

TEST(McapWriter, MendsNamesThatAreNotUtf8) {
  const Scratch dir;
  McapContents c = contents();
  c.channels[0].topic = "/a\xff";
  McapWriter(dir.path() / "f", c).write(0, 0, "{}");
  EXPECT_EQ(read(dir.path() / "f").channels.at(1).topic, "/a\uFFFD");
}

}  // namespace
}  // namespace vsa::record
