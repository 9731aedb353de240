// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What follows from a struct's fields() (vsa/state_fields.hpp): its size as numbers and their layout here, saving and loading in
// vsa/state_io.hpp. All of them walk the same way; only what they do with a number differs.
#pragma once

#include <algorithm>
#include <string>

#include "vsa/state_fields.hpp"

namespace vsa::state {

template <class T>
inline constexpr bool kArray = false;  ///< one of those that stand by themselves
template <class T, std::size_t N>
inline constexpr bool kArray<std::array<T, N>> = true;
template <class T>
inline constexpr bool kVector = false;  ///< likewise
template <class T>
inline constexpr bool kVector<std::vector<T>> = true;
template <class T>
inline constexpr bool kCapped = false;  ///< likewise
template <class T>
inline constexpr bool kCapped<Capped<T>> = true;  ///< likewise

template <class Sink, class T>
void walk(Sink& sink, const char* name, const char* unit, T&& v);
template <class Sink, class Before, class T, class... Rest>
void walk_others(Sink& sink, const Before& before, const char* name, const char* unit, T& v, Rest&... rest);

/// Name, unit and value, again and again. A std::tuple of so many takes the compiler ten times as long as this.
template <class Sink, class T, class... Rest>
void walk_members(Sink& sink, const char* name, const char* unit, T& v, Rest&... rest) {
  walk(sink, name, unit, v);
  if constexpr (sizeof...(rest) > 0) walk_others(sink, v, rest...);
}

/// Those behind a member.
template <class Sink, class Before, class T, class... Rest>
void walk_others(Sink& sink, const Before& before, const char* name, const char* unit, T& v, Rest&... rest) {
  if constexpr (kAlike<std::remove_const_t<T>> && std::is_same_v<std::remove_const_t<T>, std::remove_const_t<Before>>) {
    if (!sink.alike(before, v)) walk(sink, name, unit, v);
  } else {
    walk(sink, name, unit, v);
  }
  if constexpr (sizeof...(rest) > 0) walk_others(sink, v, rest...);
}

/// The members of a struct.
template <class Sink, class S>
void walk_fields(Sink& sink, S& s) {
  using T = std::remove_const_t<S>;
  static_assert(names_all<T>(), "a member isn't named in fields(), or not where it stands");
  if constexpr (kSeldom<T>)
    if (sink.unchanged(s)) return;
  T::fields(s, [&sink](auto&&... members) { walk_members(sink, members...); });
  if constexpr (kSeldom<T>) sink.walked();
  if constexpr (requires { s.impossible(); }) sink.judge(s);
}

template <class E>
inline const E kNone{};  ///< a value, for the sizes of it
template <class E>
[[nodiscard]] std::size_t size_of(const E& v = kNone<E>) noexcept;

/// The count, and room for as many as there may be.
template <class Sink, class Items>
void walk_capped(Sink& sink, const char* name, const Capped<Items>& v) {
  using E = std::remove_cvref_t<decltype(v.items[0])>;
  sink.enter(name);
  if (const std::size_t count = sink.count(v.items, v.most); count <= v.most) {
    if constexpr (std::is_same_v<E, std::uint8_t>) {
      sink.bytes("bytes", v.items, count, v.most);
    } else {
      for (std::size_t i = 0; i < v.most; ++i) {
        if constexpr (Sink::kWantsRoom) {
          sink.enter(i);
          walk_fields(sink, kNone<E>);
          sink.leave();
        } else if (i < count) {
          walk_fields(sink, v.items[i]);
        } else {
          sink.blank((v.most - i) * size_of<E>());
          break;
        }
      }
    }
  }
  sink.leave();
}

/// Whether it is given, and its value.
template <class Sink, class T>
void walk_optional(Sink& sink, const char* name, const char* unit, T& v) {
  using E = typename std::remove_const_t<T>::value_type;
  static_assert(kLeaf<E>, "an optional number");
  bool given = v.has_value();
  E value = given ? *v : E{};
  sink.enter(name);
  sink.leaf("given", "", given);
  const bool entered = Sink::kWantsRoom || given;
  if (entered) sink.leaf("value", unit, value);
  if constexpr (!Sink::kWantsRoom) {
    if (!entered) sink.blank(kSlots<E>);
  }
  if constexpr (!std::is_const_v<T>) v = given ? std::optional(value) : std::nullopt;
  sink.leave();
}

/// A member of any kind, by its type.
template <class Sink, class T>
void walk(Sink& sink, const char* name, const char* unit, T&& v) {
  using V = std::remove_cvref_t<T>;
  if constexpr (kLeaf<V>) {
    sink.leaf(name, unit, v);
  } else if constexpr (kOptional<V>) {
    walk_optional(sink, name, unit, v);
  } else if constexpr (kCapped<V>) {
    walk_capped(sink, name, v);
  } else if constexpr (kArray<V> || kVector<V>) {
    using E = typename V::value_type;
    if constexpr (kArray<V> && std::is_same_v<E, std::uint8_t> && sizeof(V) > kFewBytes) {
      sink.bytes(name, v, v.size(), v.size());
    } else if constexpr (kLeaf<E>) {
      sink.leaves(name, unit, v);
    } else {
      for (std::size_t i = 0; i < v.size(); ++i) {
        sink.enter(name, i);
        walk_fields(sink, v[i]);
        sink.leave();
      }
    }
  } else {
    static_assert(kDescribed<V>, "a struct without fields()");
    sink.enter(name);
    walk_fields(sink, v);
    sink.leave();
  }
}

/// What a walk goes into: Sizer, Namer, Writer, Reader. Beside what is here, which most don't care for, a walk calls
///   leaf(name, unit, v)           a number
///   leaves(name, unit, v)         an array of numbers
///   bytes(name, v, count, most)   `count` bytes, with room for `most`
///   count(items, most)            how many items follow; a Reader resizes them
///   blank(n)                      n numbers of room that nothing takes; only where kWantsRoom is false, else the walk goes on to `most`
struct Sink {
  void enter(const char*) noexcept {}               ///< a member that is a struct
  void enter(const char*, std::size_t) noexcept {}  ///< element i of a member that is an array of structs
  void enter(std::size_t) noexcept {}               ///< item i of a Capped
  void leave() noexcept {}                          ///< what was entered last
  /// A struct that changes seldom comes. True: it is gone past.
  template <class S>
  [[nodiscard]] bool unchanged(const S&) noexcept {
    return false;
  }
  /// The struct that changes seldom has been walked, since unchanged() was false.
  void walked() noexcept {}
  /// One that may be alike comes, behind another. True: it is, and gone past.
  template <class S>
  [[nodiscard]] bool alike(const S&, const S&) noexcept {
    return false;
  }
  /// A struct that has impossible() is complete.
  template <class S>
  void judge(const S&) noexcept {}
};

/// Counts the numbers that a state has.
class Sizer : public Sink {
 public:
  static constexpr bool kWantsRoom = true;  ///< whether a walk enters the room that nothing takes
  template <class T>
  void leaf(const char*, const char*, const T&) noexcept {
    size_ += kSlots<T>;
  }
  template <class A>
  void leaves(const char*, const char*, const A& v) noexcept {
    size_ += v.size() * kSlots<typename A::value_type>;
  }
  template <class A>
  void bytes(const char*, const A&, std::size_t, std::size_t most) noexcept {
    size_ += packed(most);
  }
  template <class Items>
  std::size_t count(const Items&, std::size_t) noexcept {
    ++size_;
    return 0;
  }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }  ///< so far

 private:
  std::size_t size_ = 0;
};

/// Of a struct whose size as numbers is the same for all.
template <class E>
std::size_t size_of(const E& v) noexcept {
  Sizer sizer;
  walk_fields(sizer, v);
  return sizer.size();
}

/// The layout of a state: names, units and kinds instead of numbers.
class Namer : public Sink {
 public:
  static constexpr bool kWantsRoom = true;                  ///< whether a walk enters the room that nothing takes
  explicit Namer(StateLayout& layout) : layout_(layout) {}  ///< its entries go there
  void enter(const char* name) { open(*name == '\0' ? prefix_ : prefix_ + name + "."); }
  void enter(const char* name, std::size_t i) { open(prefix_ + name + "[" + std::to_string(i) + "]."); }
  void enter(std::size_t i) { open(prefix_.substr(0, prefix_.empty() ? 0 : prefix_.size() - 1) + "[" + std::to_string(i) + "]."); }
  void leave() {
    prefix_ = std::move(outer_.back());
    outer_.pop_back();
  }
  template <class T>
  void leaf(const char* name, const char* unit, const T&) {
    layout_.add(prefix_ + name, unit, kind<T>(), kSlots<T>);
  }
  template <class A>
  void leaves(const char* name, const char* unit, const A& v) {
    using E = typename A::value_type;
    layout_.add(prefix_ + name, unit, kind<E>(), v.size() * kSlots<E>);
  }
  template <class A>
  void bytes(const char* name, const A&, std::size_t, std::size_t most) {
    layout_.add(prefix_ + name, "", StateKind::bytes, packed(most));
  }
  template <class Items>
  std::size_t count(const Items&, std::size_t) {
    layout_.add(prefix_ + "count", "", StateKind::whole, 1);
    return 0;
  }

 private:
  void open(std::string next) {
    outer_.push_back(std::move(prefix_));
    prefix_ = std::move(next);
  }
  StateLayout& layout_;
  std::string prefix_;
  std::vector<std::string> outer_;
};

/// The layout of one of them.
template <class S>
[[nodiscard]] StateLayout layout_of(const S& s = kNone<S>) {
  StateLayout out;
  Namer namer(out);
  walk_fields(namer, s);
  return out;
}

}  // namespace vsa::state
