// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Structs to numbers and back (vsa/state_walk.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "vsa/bits.hpp"
#include "vsa/state_walk.hpp"

namespace vsa::state {

/// What becomes of the room that nothing takes: as many zeros, or nothing, so that what follows moves up.
enum class Room { kept, left_out };

/// Stands for a struct equal to the one before it, where room is left out; a struct that isn't begins with a flag, 0 or 1.
inline constexpr double kAsBefore = 2;

/// A state's numbers into a span that has room for all of it. A fault: it has more of something than there is room for.
class Writer : public Sink {
 public:
  static constexpr bool kWantsRoom = false;  ///< whether a walk enters the room that nothing takes
  explicit Writer(std::span<double> out, Room room = Room::kept) noexcept : out_(out), room_(room) {}
  template <class T>
  void leaf(const char*, const char*, const T& v) noexcept {
    put(&out_[at_], v);
    at_ += kSlots<T>;
  }
  template <class A>
  void leaves(const char* name, const char* unit, const A& v) noexcept {
    for (std::size_t i = 0; i < v.size(); ++i) leaf<typename A::value_type>(name, unit, v[i]);
  }
  template <class A>
  void bytes(const char*, const A& v, std::size_t count, std::size_t most) noexcept {
    put_bytes(&out_[at_], {v.data(), count});
    at_ += packed(count);
    blank(packed(most) - packed(count));
  }
  template <class Items>
  std::size_t count(const Items& items, std::size_t most) noexcept {
    const std::size_t count = items.size();
    if (count > most && !fault_.there())
      fault_ = {at_, static_cast<double>(count), "is more than a state as numbers has room for", "", 0, static_cast<double>(most)};
    out_[at_++] = static_cast<double>(count);
    return count;
  }
  /// Leaves room for n numbers, all zero.
  void blank(std::size_t n) noexcept {
    if (room_ == Room::left_out) return;
    std::fill_n(out_.begin() + static_cast<std::ptrdiff_t>(at_), n, 0.0);
    at_ += n;
  }
  template <class S>
  [[nodiscard]] bool alike(const S& before, const S& v) noexcept {
    if (room_ == Room::kept || !v.alike(before)) return false;
    out_[at_++] = kAsBefore;
    return true;
  }
  [[nodiscard]] const StateFault& fault() const noexcept { return fault_; }  ///< none: what was written is a state
  [[nodiscard]] std::size_t at() const noexcept { return at_; }              ///< numbers written so far

 protected:
  void begin_at(std::span<double> out, std::size_t at) noexcept {
    out_ = out;
    at_ = at;
    fault_ = {};
  }
  void pass(std::size_t n) noexcept { at_ += n; }

 private:
  std::span<double> out_;
  Room room_;
  std::size_t at_ = 0;
  StateFault fault_;
};

/// A Writer that fills numbers of its own again and again, of one object's states, without the room that nothing takes. It leaves
/// those of a struct that changes seldom (vsa/state_fields.hpp) where they stand and are still right, by the struct's bytes.
class Rewriter : public Writer {
 public:
  /// For states of up to `most` numbers; before them stand `own` ones, which are whoever's it is.
  Rewriter(std::size_t own, std::size_t most) : Writer({}, Room::left_out), own_(own), numbers_(own + most) { begin(); }
  ~Rewriter() = default;
  Rewriter(const Rewriter&) = delete;
  Rewriter& operator=(const Rewriter&) = delete;
  Rewriter(Rewriter&&) noexcept = default;
  Rewriter& operator=(Rewriter&&) noexcept = default;

  /// The next state is written from the front, behind the own numbers.
  void begin() noexcept {
    begin_at(numbers_, own_);
    next_ = 0;
  }
  /// All up to at(), from elsewhere.
  void assign(std::span<const double> numbers) noexcept {
    std::copy(numbers.begin(), numbers.end(), numbers_.begin());
    begin_at(numbers_, numbers.size());
    seen_.clear();
    bytes_.clear();
  }
  /// For so many more.
  [[nodiscard]] std::size_t room() const noexcept { return numbers_.size() - std::min(at(), numbers_.size()); }
  [[nodiscard]] std::span<double> own() noexcept { return std::span(numbers_).first(own_); }  ///< the own numbers, to be written
  [[nodiscard]] std::span<const double> numbers() const noexcept { return std::span(numbers_).first(at()); }  ///< own ones, too

  /// Whether a struct that changes seldom has the bytes that its numbers, which stand where it comes now, were made of.
  template <class S>
  [[nodiscard]] bool unchanged(const S& s) {
    static_assert(std::is_trivially_copyable_v<S>);
    if (next_ < seen_.size() && seen_[next_].size != sizeof(S)) seen_.resize(next_);
    if (next_ == seen_.size()) {
      seen_.push_back({kNowhere, next_ == 0 ? 0 : seen_.back().bytes + seen_.back().size, sizeof(S)});
      bytes_.resize(seen_.back().bytes + sizeof(S));
    }
    Seen& last = seen_[next_++];
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): padding that differs has it written once more
    if (last.at == at() && std::memcmp(&bytes_[last.bytes], &s, sizeof(S)) == 0) {
      pass(last.count);
      return true;
    }
    std::memcpy(&bytes_[last.bytes], &s, sizeof(S));
    last.at = at();
    return false;
  }
  /// How many numbers the struct is that unchanged() was false for.
  void walked() noexcept { seen_[next_ - 1].count = at() - seen_[next_ - 1].at; }

 private:
  static constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();
  struct Seen {
    std::size_t at, bytes, size;  ///< its numbers; in bytes_
    std::size_t count = 0;        ///< of its numbers
  };
  std::size_t own_, next_ = 0;
  std::vector<double> numbers_;
  std::vector<Seen> seen_;  ///< of each such struct, in the walk's order, what its numbers were made of
  std::vector<std::byte> bytes_;
};

/// A state out of its numbers. The first fault is kept; what is loaded after it is worth nothing.
class Reader : public Sink {
 public:
  static constexpr bool kWantsRoom = false;  ///< whether a walk enters the room that nothing takes
  explicit Reader(std::span<const double> in, Room room = Room::kept) noexcept : in_(in), room_(room) {}
  template <class T>
  void leaf(const char*, const char*, T& v) noexcept {
    if (room(kSlots<T>)) note(get(&in_[at_], v));
    at_ += kSlots<T>;
  }
  template <class A>
  void leaves(const char* name, const char* unit, A& v) noexcept {
    for (auto& element : v) leaf(name, unit, element);
  }
  template <class A>
  void bytes(const char*, A& v, std::size_t count, std::size_t most) noexcept {
    if (room(packed(count))) note(get_bytes(&in_[at_], {v.data(), count}));
    at_ += packed(count);
    blank(packed(most) - packed(count));
  }
  template <class Items>
  std::size_t count(Items& items, std::size_t most) {
    std::uint32_t count = 0;
    if (room(1)) note(get(&in_[at_], count));
    if (count > most) note({0, in_[at_], "is more than there can be", "", 0, static_cast<double>(most)});
    ++at_;
    if (fault_.there()) count = 0;
    items.resize(count);
    return count;
  }
  /// n numbers that a state has not.
  void blank(std::size_t n) noexcept {
    if (room_ == Room::left_out) return;
    if (room(n)) {
      const auto rest = in_.subspan(at_, n);
      const auto it = std::find_if(rest.begin(), rest.end(), [](double v) { return bits_as<std::uint64_t>(v) != 0; });
      if (it != rest.end()) note({static_cast<std::size_t>(it - rest.begin()), *it, "is where nothing is", "0"});
    }
    at_ += n;
  }
  template <class S>
  [[nodiscard]] bool alike(const S& before, S& v) noexcept {
    if (room_ == Room::kept || !room(1)) return false;
    // A state has one form, so that what was read is written the same: what isn't a number is like nothing.
    const bool as_before = in_[at_] == kAsBefore;
    if (as_before) {
      ++at_;
      v = before;
    } else {
      walk_fields(*this, v);
    }
    if (v.alike(before) != as_before && !fault_.there())
      fault_ = {at_ - 1, in_[at_ - 1], as_before ? "stands for what is like nothing" : "ends a repetition of what stands before it",
                as_before ? "all of it" : "2 in its place"};
    return true;
  }
  template <class S>
  void judge(const S& s) noexcept {
    if (fault_.there()) return;
    if (const char* wrong = s.impossible()) fault_ = {at_ - 1, at_ > 0 ? in_[at_ - 1] : 0.0, "ends what can't be", wrong};
  }
  [[nodiscard]] const StateFault& fault() const noexcept { return fault_; }  ///< none: what was read is a state
  [[nodiscard]] std::size_t at() const noexcept { return at_; }              ///< numbers read so far

 private:
  [[nodiscard]] bool room(std::size_t n) noexcept {
    if (at_ + n > in_.size() && !fault_.there())
      fault_ = {in_.size(), static_cast<double>(in_.size()), "numbers are too few for this state", "as many as it says it has"};
    return !fault_.there();
  }
  void note(StateFault fault) noexcept {
    if (fault_.there() || !fault.there()) return;
    fault.offset += at_;
    fault_ = fault;
  }
  std::span<const double> in_;
  Room room_;
  std::size_t at_ = 0;
  StateFault fault_;
};

}  // namespace vsa::state
