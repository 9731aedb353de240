// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The whole program against the public firmware's command handling: random frames, byte for byte (data/PROVENANCE.md).
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "scenario.hpp"
#include "vsa/firmware/program.hpp"

namespace {

using namespace vsa::firmware;
using namespace vsa::firmware::test;
using Bytes = std::vector<std::uint8_t>;

Bytes bytes_of(const std::string& hex) {
  Bytes out;
  for (std::size_t i = 0; hex != "-" && i + 1 < hex.size(); i += 2)
    out.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return out;
}

/// As the file has it: hex up to 40 bytes, else size and FNV-1a.
std::string text_of(const Bytes& bytes) {
  if (bytes.empty()) return "-";
  std::string out;
  char part[32];
  if (bytes.size() > 40) {
    std::uint32_t hash = 0x811C9DC5U;
    for (const std::uint8_t b : bytes) hash = (hash ^ b) * 0x01000193U;
    std::snprintf(part, sizeof part, "#%zu:%08x", bytes.size(), hash);
    return part;
  }
  for (const std::uint8_t b : bytes) {
    std::snprintf(part, sizeof part, "%02x", b);
    out += part;
  }
  return out;
}

/// The recording had no EEPROM time, and no main loop that could look at the watchdog.
class Replay {
 public:
  explicit Replay(Model model) : program_(params(model)), state_(program_.fresh(0)), scenario_(model, 0) {
    // An EEPROM of zeros: the program's initial values leave this one alone.
    for (Memory* m : {&state_.memory.stored, &state_.memory.current, &state_.memory.user, &state_.memory.factory})
      if (model == Model::advanced) m->max_pwm_rate = 0;
  }

  Bytes send(const Bytes& bytes) {
    Bytes replies;
    for (const std::uint8_t byte : bytes) {
      now_ns_ += 10 * kTickNs;
      out_.clear();
      program_.receive(state_, byte, now_ns_, out_);
      for (int i = 0; i < out_.count; ++i) {
        const auto view = out_.view(out_.replies[i]);
        replies.insert(replies.end(), view.begin(), view.end());
      }
    }
    return replies;
  }
  void tick(int ticks) {
    now_ns_ += 60 * kTickNs;
    state_.watchdog.next_clock_ns = std::numeric_limits<std::int64_t>::max() / 2;
    state_.watchdog.expired = false;
    for (; ticks > 0; --ticks) {
      scenario_.next();
      out_.clear();
      program_.tick(state_, scenario_.inputs(), now_ns_ += kTickNs, out_);
    }
  }

 private:
  static ProgramParams params(Model model) {
    ProgramParams p;
    p.model = model;
    p.row_write_ns = 0;
    return p;
  }
  Program program_;
  ProgramState state_;
  Scenario scenario_;
  Output out_;
  std::int64_t now_ns_ = 0;
};

void replay(const std::string& name, Model model, int least_replies) {
  std::ifstream in(VSA_SOURCE_DIR "/tests/firmware/data/command_transcript.txt");
  Replay unit(model);
  int frames = 0, replies = 0;
  for (std::string line; std::getline(in, line);) {
    std::istringstream row(line);
    std::string who, sent, answered;
    int ticks = 0;
    row >> who >> sent >> answered >> ticks;
    if (who != name) continue;
    ASSERT_TRUE(row) << line;
    ASSERT_EQ(text_of(unit.send(bytes_of(sent))), answered) << "frame " << frames << ": " << sent;
    unit.tick(ticks);
    ++frames;
    replies += answered != "-" ? 1 : 0;
  }
  EXPECT_GE(replies, least_replies);
}

TEST(Transcript, TheMakerProAnswersAsThePublicProgram) { replay("maker_pro", Model::maker_pro, 500); }
TEST(Transcript, TheAdvancedUnitAnswersAsThePublicProgram) { replay("advanced", Model::advanced, 300); }

}  // namespace
