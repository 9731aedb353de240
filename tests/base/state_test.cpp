// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Structs as numbers: kinds, layout, refusals, and that no member is forgotten.
#include "vsa/state.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <span>

#include "vsa/errors.hpp"
#include "vsa/state_io.hpp"

namespace {

using vsa::InputError;
using vsa::StateKind;
using vsa::state::Capped;
using vsa::state::Reader;
using vsa::state::Room;
using vsa::state::Writer;

enum class Colour : std::uint8_t { red, green, blue };
constexpr int choices(Colour) noexcept { return 3; }

struct Inner {
  double length = 0;
  vsa::Ticks ticks{};
  static auto fields(auto& s, auto&& visit) { return visit("length", "m", s.length, "ticks", "", s.ticks); }
};

struct Everything {
  double real = 0;
  float single = 0;
  std::int8_t small = 0;
  std::uint32_t large = 0;
  std::int64_t wide = 0;
  std::uint64_t unsigned_wide = 0;
  bool flag = false;
  Colour colour = Colour::red;
  std::array<std::int16_t, 3> three{};
  std::array<std::uint8_t, 13> text{};
  std::array<Inner, 2> inner{};
  std::optional<double> maybe;
  std::vector<Inner> list;

  static auto fields(auto& s, auto&& visit) {
    return visit("real", "V", s.real, "single", "", s.single, "small", "", s.small, "large", "", s.large, "wide", "ns", s.wide,
                 "unsigned_wide", "", s.unsigned_wide, "flag", "", s.flag, "colour", "", s.colour, "three", "A", s.three, "text",
                 "", s.text, "inner", "", s.inner, "maybe", "s", s.maybe, "list", "", Capped{s.list, 3});
  }
  [[nodiscard]] const char* impossible() const noexcept { return large == 666 ? "another large" : nullptr; }
};

struct Forgetful {
  double kept = 0;
  std::optional<double> forgotten;
  static auto fields(auto& s, auto&& visit) { return visit("kept", "", s.kept); }
};
class Hidden {
 public:
  static auto fields(auto& s, auto&& visit) { return visit("kept", "", s.kept_); }

 private:
  double kept_ = 0;
  [[maybe_unused]] std::array<double, 2> forgotten_{};
};
static_assert(vsa::state::names_all<Everything>() && vsa::state::names_all<Inner>());
static_assert(!vsa::state::names_all<Forgetful>(), "a forgotten member is noticed");
static_assert(!vsa::state::names_all<Hidden>(), "and one of a class");

std::vector<double> numbers(const Everything& e) {
  std::vector<double> out(vsa::state::size_of(e), 7.0);
  Writer writer(out);
  vsa::state::walk_fields(writer, e);
  EXPECT_FALSE(writer.fault().there());
  EXPECT_EQ(writer.at(), out.size());
  return out;
}

/// What is wrong, or "".
std::string load(const std::vector<double>& in, Everything& e) {
  Reader reader(in);
  vsa::state::walk_fields(reader, e);
  try {
    throw_if_any(reader.fault(), vsa::state::layout_of(e));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

Everything some() {
  Everything e;
  e.real = -0.0;
  e.single = std::bit_cast<float>(0xFF800001U);  // a signalling NaN with its sign
  e.small = -128;
  e.large = 4294967295U;
  e.wide = std::numeric_limits<std::int64_t>::min() + 1;
  e.unsigned_wide = std::numeric_limits<std::uint64_t>::max();
  e.flag = true;
  e.colour = Colour::blue;
  e.three = {-32768, 0, 32767};
  for (std::size_t i = 0; i < e.text.size(); ++i) e.text[i] = static_cast<std::uint8_t>(255 - i);
  e.inner[1] = {std::bit_cast<double>(0x7FF0000000000123ULL), {-5}};
  e.maybe = 0.25;
  e.list = {{1, {1}}, {2, {2}}};
  return e;
}

TEST(StateNumbers, ComeBackBitForBit) {
  const Everything e = some();
  const std::vector<double> saved = numbers(e);
  Everything back;
  ASSERT_EQ(load(saved, back), "");
  EXPECT_EQ(vsa::first_difference(numbers(back), saved), std::nullopt);
  EXPECT_TRUE(std::signbit(back.real));
  EXPECT_EQ(std::bit_cast<std::uint32_t>(back.single), 0xFF800001U);
  EXPECT_EQ(back.wide, e.wide);
  EXPECT_EQ(back.unsigned_wide, e.unsigned_wide);
  EXPECT_EQ(back.text, e.text);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(back.inner[1].length), 0x7FF0000000000123ULL);
  EXPECT_EQ(back.maybe, 0.25);
  ASSERT_EQ(back.list.size(), 2u);
  EXPECT_EQ(back.list[1].ticks.value, 2);
}

TEST(StateNumbers, ComeBackWithoutTheRoomThatNothingTakes) {
  for (const bool maybe : {false, true}) {
    for (std::size_t items = 0; items <= 3; ++items) {
      Everything e = some();
      if (!maybe) e.maybe.reset();
      e.list.resize(items);
      std::vector<double> out(vsa::state::size_of(e) + 1, 7.0);
      Writer writer(out, Room::left_out);
      vsa::state::walk_fields(writer, e);
      EXPECT_EQ(writer.at(), vsa::state::size_of(e) - 2 * (3 - items) - (maybe ? 0 : 1));
      EXPECT_EQ(out[writer.at()], 7.0) << "what is behind stays";
      Everything back = some();  // has more
      Reader reader(out, Room::left_out);
      vsa::state::walk_fields(reader, back);
      ASSERT_FALSE(reader.fault().there());
      EXPECT_EQ(reader.at(), writer.at());
      EXPECT_EQ(vsa::first_difference(numbers(back), numbers(e)), std::nullopt);
      Reader cut(std::span<const double>(out).first(writer.at() - 1), Room::left_out);
      vsa::state::walk_fields(cut, back);
      EXPECT_TRUE(cut.fault().there());
    }
  }
}

struct Page {
  bool written = false;
  float gain = 0;
  double length = 0;
  static auto fields(auto& s, auto&& visit) { return visit("written", "", s.written, "gain", "", s.gain, "length", "m", s.length); }
  [[nodiscard]] bool alike(const Page& o) const noexcept {
    return written == o.written && std::bit_cast<std::uint32_t>(gain) == std::bit_cast<std::uint32_t>(o.gain) && length == o.length;
  }
};
struct Pages {
  Page first, second;
  double between = 0;
  Page third, fourth;
  static auto fields(auto& s, auto&& visit) {
    return visit("first", "", s.first, "second", "", s.second, "between", "", s.between, "third", "", s.third, "fourth", "",
                 s.fourth);
  }
};

/// As numbers without room, and back into something else.
std::vector<double> tight(const Pages& p) {
  std::vector<double> out(vsa::state::size_of<Pages>(), 7.0);
  Writer writer(out, Room::left_out);
  vsa::state::walk_fields(writer, p);
  EXPECT_FALSE(writer.fault().there());
  out.resize(writer.at());
  Pages back{{true, 9, 9}, {true, 8, 8}, 7, {true, 6, 6}, {true, 5, 5}};
  Reader reader(out, Room::left_out);
  vsa::state::walk_fields(reader, back);
  EXPECT_FALSE(reader.fault().there());
  EXPECT_EQ(reader.at(), writer.at());
  std::vector<double> all(vsa::state::size_of<Pages>()), again = all;
  Writer one(all), other(again);
  vsa::state::walk_fields(one, p);
  vsa::state::walk_fields(other, back);
  EXPECT_EQ(vsa::first_difference(all, again), std::nullopt);
  return out;
}

TEST(StateNumbers, WithoutRoomAStructLikeTheOneBeforeItIsOneNumber) {
  EXPECT_EQ(vsa::state::size_of<Pages>(), 13u);
  EXPECT_EQ(tight({}).size(), 9u);
  EXPECT_EQ(tight({{true, 1, 2}, {true, 1, 2}, 3, {true, 1, 2}, {true, 1, 3}}).size(), 11u) << "the third stands behind a number";
  EXPECT_EQ(tight({{true, 1, 2}, {false, 1, 2}, 3, {true, 1, 2}, {true, 1, 2}}).size(), 11u);
  EXPECT_EQ(tight({{true, 0.0F, 2}, {true, -0.0F, 2}, 3, {}, {}}).size(), 11u) << "to the bit";
  const std::vector<double> good = tight({});
  for (std::size_t n = 0; n < good.size(); ++n) {
    Pages back;
    Reader cut(std::span<const double>(good).first(n), Room::left_out);
    vsa::state::walk_fields(cut, back);
    EXPECT_TRUE(cut.fault().there()) << n;
  }
  std::vector<double> repeated(good);
  repeated.insert(repeated.begin() + 4, {0, 0});  // the second, whole
  repeated[3] = 0;
  Pages taken;
  Reader whole(repeated, Room::left_out);
  vsa::state::walk_fields(whole, taken);
  EXPECT_TRUE(whole.fault().there()) << "a state has one form";
  std::vector<double> no_number(good);
  no_number[2] = std::nan("");
  Reader unlike(no_number, Room::left_out);
  vsa::state::walk_fields(unlike, taken);
  EXPECT_TRUE(unlike.fault().there());
  Pages with_it;
  with_it.first.length = with_it.second.length = std::nan("");
  EXPECT_EQ(tight(with_it).size(), 11u);
  for (const std::size_t first_of_its_kind : {0u, 5u}) {  // there is none before it that it could be like
    std::vector<double> bad = good;
    bad[first_of_its_kind] = vsa::state::kAsBefore;
    Pages back;
    Reader reader(bad, Room::left_out);
    vsa::state::walk_fields(reader, back);
    EXPECT_TRUE(reader.fault().there()) << first_of_its_kind;
  }
}

struct Rare {
  std::array<double, 3> held{};
  Page page, copy;
  static constexpr bool kSeldom = true;
  static auto fields(auto& s, auto&& visit) { return visit("held", "", s.held, "page", "", s.page, "copy", "", s.copy); }
};
struct Written {
  std::vector<Inner> list;
  std::array<Rare, 2> rare{};
  double often = 0;
  static auto fields(auto& s, auto&& visit) {
    return visit("list", "", Capped{s.list, 3}, "rare", "", s.rare, "often", "", s.often);
  }
};

TEST(StateNumbers, WrittenAgainAndAgainAreThoseOfAFirstTime) {
  const auto write = [](vsa::state::Rewriter& to, const Written& w) {
    to.begin();
    vsa::state::walk_fields(to, w);
    return std::vector<double>(to.numbers().begin(), to.numbers().end());
  };
  const std::size_t most = vsa::state::size_of<Written>();
  vsa::state::Rewriter again(2, most);
  Written w;
  for (int k = 0; k < 200; ++k) {
    w.often = k;
    if (k % 5 == 0) w.rare[0].held[1] = k;
    if (k % 7 == 0) w.rare[1].held[2] = -k;
    if (k % 11 == 0) w.rare[0].page.length = k;  // one number more, or one less
    if (k % 13 == 0) w.rare[0].copy = w.rare[0].page;
    if (k % 3 == 0) w.list.resize(static_cast<std::size_t>(k / 3 % 4));  // what follows moves
    if (k % 50 == 49) again.assign(std::vector<double>(most, 7.0));      // somebody else's state
    vsa::state::Rewriter first(2, most);
    again.own()[0] = first.own()[0] = k;
    again.own()[1] = first.own()[1] = 0;
    ASSERT_EQ(write(again, w), write(first, w)) << k;
  }
}

TEST(StateNumbers, ManyWideIntegersAndFloatsComeBack) {
  for (std::uint64_t k = 0; k < 2000; ++k) {
    const std::uint64_t bits = k * 0x9E3779B97F4A7C15ULL;
    Everything e, back;
    e.unsigned_wide = bits;
    e.wide = static_cast<std::int64_t>(~bits);
    e.single = std::bit_cast<float>(static_cast<std::uint32_t>(bits >> 32));
    ASSERT_EQ(load(numbers(e), back), "") << bits;
    EXPECT_EQ(back.unsigned_wide, e.unsigned_wide);
    EXPECT_EQ(back.wide, e.wide);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(back.single), std::bit_cast<std::uint32_t>(e.single));
  }
}

TEST(StateNumbers, HaveALayoutWithoutGaps) {
  const vsa::StateLayout layout = vsa::state::layout_of(Everything{});
  std::size_t next = 0;
  for (const vsa::StateEntry& e : layout.entries()) {
    EXPECT_EQ(e.offset, next) << e.name;
    next += e.count;
    EXPECT_EQ(layout.find(e.name), &e) << "one name, one entry";
  }
  EXPECT_EQ(next, vsa::state::size_of(Everything{}));
  const vsa::StateEntry* wide = layout.find("wide");
  ASSERT_NE(wide, nullptr);
  EXPECT_EQ(wide->count, 2u);
  EXPECT_EQ(wide->unit, "ns");
  EXPECT_EQ(layout.find("text")->count, 3u) << "six bytes a number";
  EXPECT_EQ(layout.find("inner[1].length")->unit, "m");
  EXPECT_EQ(layout.find("maybe.value")->unit, "s");
  ASSERT_NE(layout.find("list[2].ticks"), nullptr);
  const std::vector<double> saved = numbers(some());
  EXPECT_EQ(saved[wide->offset] * 4294967296.0, -9223372036854775808.0);
  EXPECT_EQ(saved[wide->offset + 1], 1.0);
  EXPECT_EQ(saved[layout.find("list.count")->offset], 2.0);
  EXPECT_EQ(saved[layout.find("list[2].length")->offset], 0.0);
  EXPECT_EQ(layout.name_at(layout.find("three")->offset + 2), "three, number 2");
}

TEST(StateNumbers, ThatNoStateHasAreRefusedByName) {
  const vsa::StateLayout layout = vsa::state::layout_of(Everything{});
  const std::vector<double> good = numbers(some());
  const double nan = std::nan("");
  const struct {
    const char* name;
    double value;
    const char* allowed;
  } wrong[] = {{"small", 0.5, "-128 … 127"},     {"small", 128, "-128 … 127"}, {"small", -0.0, "-128 … 127"},
               {"small", nan, "-128"},           {"flag", 2, "0 … 1"},         {"colour", 3, "0 … 2"},
               {"single", 0.1, "single"},        {"wide", 2147483648.0, "…"},  {"three", 1e300, "32767"},
               {"text", 281474976710656.0, "…"}, {"text", -1, "0 …"},          {"list.count", 4, "0 … 3"},
               {"list[2].length", 1, "0"},       {"maybe.given", -1, "0 … 1"}, {"large", 666, "another"},
               {"single", 1e39, "single"},       {"unsigned_wide", -1, "0 …"}, {"inner[0].ticks", 40000, "32767"}};
  for (const auto& w : wrong) {
    std::vector<double> bad = good;
    bad[layout.find(w.name)->offset] = w.value;
    Everything e;
    const std::string said = load(bad, e);
    EXPECT_NE(said.find(w.allowed), std::string::npos) << w.name << ": " << said;
    EXPECT_TRUE(said.find(w.name) != std::string::npos || std::string(w.name) == "large") << said;
  }
}

TEST(StateNumbers, MoreThanThereIsRoomForCantBeSaved) {
  Everything e;
  e.list.resize(4);
  std::vector<double> out(vsa::state::size_of(e));
  Writer writer(out);
  vsa::state::walk_fields(writer, e);
  ASSERT_TRUE(writer.fault().there());
  EXPECT_EQ(vsa::state::layout_of(e).name_at(writer.fault().offset), "list.count");
}

TEST(StateNumbers, HashAndComparisonKnowEveryBit) {
  const std::vector<double> a = numbers(some());
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::vector<double> b = a;
    b[i] = std::bit_cast<double>(std::bit_cast<std::uint64_t>(b[i]) ^ (1ULL << (i % 64)));
    EXPECT_NE(vsa::state_hash(a), vsa::state_hash(b)) << i;
    EXPECT_EQ(vsa::first_difference(a, b), i);
  }
  EXPECT_EQ(vsa::first_difference(a, std::span(a).first(3)), 3u);
  EXPECT_EQ(vsa::first_difference(a, a), std::nullopt);
  vsa::StateLayout one, other;
  one.add("a", "rad", StateKind::real, 1);
  other.add("a", "deg", StateKind::real, 1);
  EXPECT_NE(one.hash(), other.hash());
}

}  // namespace
