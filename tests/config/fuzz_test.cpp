// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Whatever bytes a user's file has, the answer is parameters or an InputError: seeded mutations of good files, so that most reach
// past the parsers, and noise.
#include <gtest/gtest.h>

#include <random>

#include "support.hpp"

namespace vsa::test {
namespace {

constexpr int kRounds = 3000;

class Mutator {
 public:
  explicit Mutator(std::uint32_t seed) : random_(seed) {}

  std::string mutate(std::string text) {
    for (std::size_t n = 1 + below(4); n > 0 && !text.empty(); --n) {
      const std::size_t at = below(text.size()), length = 1 + below(std::min<std::size_t>(text.size() - at, 20));
      switch (below(6)) {
        case 0:
          text[at] = static_cast<char>(below(256));
          break;
        case 1:
          text.erase(at, length);
          break;
        case 2:
          text.insert(at, text.substr(at, length));
          break;
        case 3:
          text.insert(at, piece());
          break;
        case 4:
          text.replace(at, length, text.substr(below(text.size()), length));
          break;
        default:
          text.resize(at);
      }
    }
    return text;
  }
  std::string noise() {
    std::string text(below(300), ' ');
    for (char& c : text) c = static_cast<char>(below(256));
    return text;
  }
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }

 private:
  std::string piece() {
    static constexpr const char* kPieces[] = {"nan",
                                              "-inf",
                                              "1e999",
                                              "[",
                                              "]",
                                              "{",
                                              "}",
                                              "[[",
                                              "\"",
                                              "'''",
                                              "=",
                                              "\n[drive]\n",
                                              "<",
                                              ">",
                                              "/>",
                                              "&lt;",
                                              "&#0;",
                                              "-",
                                              "9223372036854775808",
                                              "1979-05-27",
                                              "\xff",
                                              "",
                                              "<actuator>",
                                              "<bus/>"};
    return kPieces[below(std::size(kPieces))];
  }

  std::mt19937 random_;
};

/// True where parameters came out, false for an InputError with a text; anything else escapes and fails the test.
template <class Call>
bool answers(Call&& call) {
  const auto problems = problems_of(std::forward<Call>(call));
  for (const Problem& p : problems) EXPECT_FALSE(p.text().empty());
  return problems.empty();
}

bool load_text(const config::TypeLibrary& library, const std::string& name, const std::string& text,
               const std::vector<config::Override>& overrides = {}) {
  return answers([&] { (void)library.load_text(text, name + ".toml", overrides); });
}

std::string type_text(const std::string& name) { return read(source_dir() / "actuators" / (name + ".toml")); }

TEST(Fuzz, MutatedPresetsAreReadOrRefused) {
  Mutator mutator(1);
  const config::TypeLibrary library = shipped();
  int read_well = 0;
  for (const std::string name : {"qbmove_maker_pro_6_1", "sea_example"}) {
    const std::string good = type_text(name);
    for (int i = 0; i < kRounds; ++i) read_well += load_text(library, name, mutator.mutate(good)) ? 1 : 0;
  }
  EXPECT_GT(read_well, kRounds / 50);  // mutations in comments, titles, sources: else the loop only meets the parser
  EXPECT_LT(read_well, kRounds);
}

TEST(Fuzz, NoiseIsNoPreset) {
  Mutator mutator(2);
  for (int i = 0; i < kRounds; ++i) EXPECT_FALSE(load_text(shipped(), "x", mutator.noise()));
}

TEST(Fuzz, DeeplyNestedTomlIsRefused) { EXPECT_FALSE(load_text(shipped(), "x", "a = " + std::string(100000, '['))); }

TEST(Fuzz, MutatedOverridesAreReadOrRefused) {
  Mutator mutator(3);
  const std::string good = type_text("qbmove_maker_pro_6_1");
  for (int i = 0; i < kRounds / 4; ++i) {
    (void)load_text(shipped(), "qbmove_maker_pro_6_1", good, {{mutator.mutate("drive.friction_Nm"), mutator.mutate("0.7")}});
  }
}

TEST(Fuzz, MutatedPluginsAreReadOrRefused) {
  Mutator mutator(4);
  const config::TypeLibrary types = shipped();
  const std::string documentation = read(source_dir() / "docs/reference/config.md");
  const std::size_t from = documentation.find("<plugin");
  const std::string good = documentation.substr(from, documentation.find("</plugin>", from) + 9 - from);
  int read_well = 0;
  for (int i = 0; i < kRounds; ++i) {
    const std::string xml = mutator.mutate(good);
    read_well += answers([&] { (void)config::parse_plugin(xml, "fuzz", types); }) ? 1 : 0;
  }
  EXPECT_GT(read_well, kRounds / 100);
  EXPECT_LT(read_well, kRounds / 2);
}

TEST(Fuzz, NoiseAndDeepNestingAreNoPlugin) {
  Mutator mutator(5);
  const config::TypeLibrary types = shipped();
  for (int i = 0; i < kRounds; ++i) {
    const std::string xml = mutator.noise();
    EXPECT_FALSE(answers([&] { (void)config::parse_plugin(xml, "fuzz", types); }));
  }
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_FALSE(answers([&] { (void)config::parse_plugin(deep, "fuzz", types); }));
}

}  // namespace
}  // namespace vsa::test
