// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// How a struct becomes numbers (vsa/state.hpp). It names all its members once, in their order,
//
//   struct MotorState {
//     double angle = 0, speed = 0;
//     static auto fields(auto& s, auto&& visit) { return visit("angle", "rad", s.angle, "speed", "rad/s", s.speed); }
//   };
//
// and everything else follows: layout, size, saving, loading with its checks. A member that isn't named doesn't compile. A struct
// with bounds of its own says what is wrong with it: `const char* impossible() const noexcept`, null where nothing is. An
// enumeration tells how many values it has, `constexpr int choices(E)`. One that changes seldom may say so, `static constexpr bool
// kSeldom = true`: it is trivially copyable and has no Capped, and who writes states again and again then passes it by. One of which
// a struct has several after each other that are often equal tells whether they are, `bool alike(const S&) const noexcept`, to the
// bit; it begins with a flag and has no Capped. A state without the room that nothing takes then has it once.
//
// Members: numbers, flags, enumerations, the quantities of vsa/units.hpp, such structs, std::array and std::optional of them;
// std::vector, whose length is the object's own and stays; Capped, whose length is part of the state.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "vsa/state.hpp"
#include "vsa/units.hpp"

namespace vsa::state {

/// Items (size(), resize(), operator[]) of which a state may have up to `most`; beyond that it can't be saved.
template <class Items>
struct Capped {
  Items& items;      ///< the container
  std::size_t most;  ///< a count that a state may have
};
template <class Items>
Capped(Items&, std::size_t) -> Capped<Items>;  ///< its items by reference

// ------------------------------------------------------------------------------------------------ which members a struct has

template <class T>
inline constexpr bool kOptional = false;  ///< a std::optional
template <class T>
inline constexpr bool kOptional<std::optional<T>> = true;

/// Stands for any member but an optional, to count how many there are.
struct AnyMember {
  template <class T>
  requires(!kOptional<T>) operator T() const;  // never called
};
/// Says that it changes seldom.
template <class T>
inline constexpr bool kSeldom = requires {
  requires T::kSeldom;
};

/// Says that it is often equal to the member before it.
template <class T>
inline constexpr bool kAlike = requires(const T& v) {
  { v.alike(v) } -> std::same_as<bool>;
};

/// Whether an aggregate takes so many members.
template <class T, std::size_t... I>
constexpr bool takes(std::index_sequence<I...>) {
  return requires { T{(static_cast<void>(I), AnyMember{})...}; };
}
/// Members of an aggregate.
template <class T, std::size_t N = 0>
constexpr std::size_t member_count() {
  if constexpr (takes<T>(std::make_index_sequence<N + 1>{})) {
    return member_count<T, N + 1>();
  } else {
    return N;
  }
}

/// Counts what fields() names.
struct FieldCount {
  template <class... A>
  /// Of one fields().
  constexpr auto operator()(A&&...) const {
    return std::integral_constant<std::size_t, sizeof...(A) / 3>{};
  }
};
/// The size of a class with these members in this order.
struct FieldBytes {
  template <class... A>
  constexpr auto operator()(A&&...) const {
    return std::integral_constant<std::size_t, bytes_of<std::remove_cvref_t<A>...>()>{};
  }

 private:
  template <class Name, class Unit, class Member, class... Rest>
  static constexpr std::size_t end_of(std::size_t at) {
    const std::size_t end = (at + alignof(Member) - 1) / alignof(Member) * alignof(Member) + sizeof(Member);
    if constexpr (sizeof...(Rest) > 0) {
      return end_of<Rest...>(end);
    } else {
      return end;
    }
  }
  template <class... A>
  static constexpr std::size_t bytes_of() {
    return end_of<A...>(0);
  }
};

/// Names its members by fields().
template <class T>
inline constexpr bool kDescribed = requires(T& t) {
  T::fields(t, FieldCount{});
};

/// Whether fields() names all of them. A class that is no aggregate has its size to tell by.
template <class T>
constexpr bool names_all() {
  if constexpr (std::is_aggregate_v<T>) {
    return decltype(T::fields(std::declval<T&>(), FieldCount{}))::value == member_count<T>();
  } else {
    constexpr std::size_t end = decltype(T::fields(std::declval<T&>(), FieldBytes{}))::value;
    return (end + alignof(T) - 1) / alignof(T) * alignof(T) == sizeof(T);
  }
}

// ----------------------------------------------------------------------------------------------------------- a single number

/// A quantity of units.hpp.
template <class T>
inline constexpr bool kQuantity =
    std::is_same_v<T, Raw> || std::is_same_v<T, Ticks> || std::is_same_v<T, MilliAmp> || std::is_same_v<T, MilliVolt>;
template <class T>
inline constexpr bool kLeaf = std::is_arithmetic_v<T> || std::is_enum_v<T> || kQuantity<T>;  ///< one or two numbers

/// As numbers of vsa/state.hpp.
template <class T>
constexpr StateKind kind() {
  if constexpr (kQuantity<T>) return kind<decltype(T::value)>();
  if constexpr (std::is_enum_v<T>) return StateKind::choice;
  if constexpr (std::is_same_v<T, bool>) return StateKind::flag;
  if constexpr (std::is_same_v<T, double>) return StateKind::real;
  if constexpr (std::is_same_v<T, float>) return StateKind::single;
  return sizeof(T) > 4 ? StateKind::wide : StateKind::whole;
}
template <class T>
inline constexpr std::size_t kSlots = kLeaf<T>&& kind<T>() == StateKind::wide ? 2 : 1;  ///< how many

/// A float's value; of a NaN the sign and the payload, which a conversion would make quiet.
[[nodiscard]] double widened(float v) noexcept;
/// None: no float has that value.
[[nodiscard]] std::optional<float> narrowed(double v) noexcept;

/// A member's number or numbers; `at` has room for kSlots<T>.
template <class T>
void put(double* at, const T& v) noexcept {
  if constexpr (kQuantity<T>) {
    put(at, v.value);
  } else if constexpr (std::is_enum_v<T>) {
    *at = static_cast<double>(static_cast<int>(v));
  } else if constexpr (std::is_same_v<T, float>) {
    *at = widened(v);
  } else if constexpr (kSlots<T> == 2) {
    at[0] = static_cast<double>(v >> 32);
    at[1] = static_cast<double>(static_cast<std::uint32_t>(v & 0xFFFFFFFF));
  } else {
    *at = static_cast<double>(v);
  }
}

/// Whether a number is an integer from low to high; −0 is none.
[[nodiscard]] inline bool is_whole(double v, double low, double high) noexcept {
  return v >= low && v <= high && std::trunc(v) == v && !(v == 0 && std::signbit(v));
}

/// Of the number that a member may have.
template <class T>
[[nodiscard]] constexpr std::pair<double, double> range() noexcept {
  if constexpr (std::is_enum_v<T>) {
    return {0.0, choices(T{}) - 1};
  } else if constexpr (kSlots<T> == 2) {
    return std::is_signed_v<T> ? std::pair{-2147483648.0, 2147483647.0} : std::pair{0.0, 4294967295.0};
  } else {
    return {std::numeric_limits<T>::lowest(), std::numeric_limits<T>::max()};
  }
}

/// What is wrong with the numbers, where it is.
template <class T>
[[nodiscard]] StateFault get(const double* at, T& v) noexcept {
  if constexpr (kQuantity<T>) {
    return get(at, v.value);
  } else if constexpr (std::is_same_v<T, double>) {
    v = *at;
  } else if constexpr (std::is_same_v<T, float>) {
    const std::optional<float> x = narrowed(*at);
    if (!x) return {0, *at, "is no float's value", "single precision"};
    v = *x;
  } else {
    constexpr auto bounds = range<T>();
    if (!is_whole(at[0], bounds.first, bounds.second))
      return {0, at[0], "is no such whole number", "", bounds.first, bounds.second};
    if constexpr (kSlots<T> == 2) {
      if (!is_whole(at[1], 0, 4294967295.0)) return {1, at[1], "is no such whole number", "", 0, 4294967295.0};
      using Unsigned = std::make_unsigned_t<T>;
      v = static_cast<T>((static_cast<Unsigned>(static_cast<T>(at[0])) << 32) | static_cast<Unsigned>(at[1]));
    } else if constexpr (std::is_enum_v<T>) {
      v = static_cast<T>(static_cast<int>(at[0]));
    } else {
      v = static_cast<T>(at[0]);
    }
  }
  return {};
}

inline constexpr std::size_t kBytesPerNumber = 6;  ///< of a packed array of bytes
inline constexpr std::size_t kFewBytes = 8;        ///< up to so many stand as numbers of their own
/// Numbers that so many bytes take.
[[nodiscard]] constexpr std::size_t packed(std::size_t bytes) noexcept { return (bytes + kBytesPerNumber - 1) / kBytesPerNumber; }
void put_bytes(double* at, std::span<const std::uint8_t> bytes) noexcept;                      ///< `at` has room for packed()
[[nodiscard]] StateFault get_bytes(const double* at, std::span<std::uint8_t> bytes) noexcept;  ///< none: no such bytes

}  // namespace vsa::state
