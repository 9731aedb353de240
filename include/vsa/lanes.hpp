// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One number, or several side by side: the physics of a unit is written once over a type T, and
//
//   T = double              one unit
//   T = Pack<W, Isa>        W units of one type, one in each lane
//
// Every operation here is one IEEE operation (or a choice) in each lane, and nothing is contracted (-ffp-contract=off), so a lane has
// the bits of the scalar path, whatever its neighbours do and whatever the instruction set. What a branch is for one unit is a mask for
// several: select() chooses lane by lane, any() and all() skip what no lane or every lane asks for.
//
// A Pack is a vector of the compiler's (GCC and Clang both have them, with operators, for every width and target): xsimd would add a
// dependency to the core, whose rooms up to `device` need the standard library alone, and has nothing that is needed here beyond them.
//
// `Isa` is no more than a name: code compiled for several instruction sets has functions of several names, so a linker can't put one
// meant for AVX-512 where a machine without it calls it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace vsa::lanes {

template <class T>
inline constexpr bool kScalar = std::is_same_v<T, double>;  ///< one number, no Pack

// One number.

/// Of one number, as the next ones: any() and all() are the truth itself.
[[nodiscard]] inline bool any(bool m) noexcept { return m; }
[[nodiscard]] inline bool all(bool m) noexcept { return m; }                                   ///< likewise
[[nodiscard]] inline bool same(bool a, bool b) noexcept { return a == b; }                     ///< both true or both false
[[nodiscard]] inline double select(bool m, double a, double b) noexcept { return m ? a : b; }  ///< m ? a : b
[[nodiscard]] inline bool select(bool m, bool a, bool b) noexcept { return m ? a : b; }        ///< likewise
[[nodiscard]] inline double abs(double v) noexcept { return std::abs(v); }                     ///< without its sign bit
/// By sign bits.
[[nodiscard]] inline double copysign(double magnitude, double sign) noexcept { return std::copysign(magnitude, sign); }

// Several.

/// The smallest natural vector of W doubles, and of W truths: all bits or none.
template <int W>
struct Vectors {
  typedef double Number __attribute__((vector_size(8 * W)));    ///< W doubles
  typedef long long Truth __attribute__((vector_size(8 * W)));  ///< W truths
};

/// A truth in each lane, all bits or none, as comparisons of Packs give it.
template <int W, class Isa>
struct Mask {
  typename Vectors<W>::Truth v;  ///< −1 or 0 in each lane

  Mask() = default;
  explicit Mask(typename Vectors<W>::Truth truth) noexcept : v(truth) {}  ///< as it is
  /// The same in all lanes.
  explicit Mask(bool truth) noexcept : v(typename Vectors<W>::Truth{} - static_cast<long long>(truth)) {}
  friend Mask operator&(Mask a, Mask b) noexcept { return Mask(a.v & b.v); }  ///< lane by lane, as the next ones
  friend Mask operator|(Mask a, Mask b) noexcept { return Mask(a.v | b.v); }  ///< or
  friend Mask operator!(Mask a) noexcept { return Mask(~a.v); }               ///< not
  friend Mask operator&(Mask a, bool b) noexcept { return a & Mask(b); }      ///< with the same truth in all lanes
  friend Mask operator|(Mask a, bool b) noexcept { return a | Mask(b); }      ///< with the same truth in all lanes
  [[nodiscard]] bool lane(int i) const noexcept { return v[i] != 0; }         ///< in lane i
  /// Bit i for lane i.
  [[nodiscard]] unsigned bits() const noexcept {
#if defined(__AVX512DQ__)
    if constexpr (W == 8) return static_cast<unsigned>(_mm512_movepi64_mask(reinterpret_cast<__m512i>(v)));
#endif
#if defined(__SSE2__)
    if constexpr (W == 2) return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(v)));
#endif
#if defined(__AVX__)
    if constexpr (W == 4) return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(v)));
#endif
    unsigned all = 0;
    for (int i = 0; i < W; ++i) all |= static_cast<unsigned>(v[i] != 0) << i;
    return all;
  }
};

/// Lane by lane: both true or both false.
template <int W, class Isa>
[[nodiscard]] Mask<W, Isa> same(Mask<W, Isa> a, Mask<W, Isa> b) noexcept {
  return Mask<W, Isa>(~(a.v ^ b.v));
}
/// In one lane or more.
template <int W, class Isa>
[[nodiscard]] bool any(Mask<W, Isa> m) noexcept {
  return m.bits() != 0;
}
/// In every lane.
template <int W, class Isa>
[[nodiscard]] bool all(Mask<W, Isa> m) noexcept {
  return m.bits() == (1U << W) - 1;
}

/// W doubles, one a lane. Every operator works lane by lane, one IEEE operation in each.
template <int W, class Isa_>
struct Pack {
  using Isa = Isa_;                 ///< a name for the instruction set
  using Truth = Mask<W, Isa>;       ///< what comparisons give
  static constexpr int kWidth = W;  ///< how many lanes
  typename Vectors<W>::Number v;    ///< the numbers

  Pack() = default;
  explicit Pack(typename Vectors<W>::Number number) noexcept : v(number) {}  ///< as it is
  // NOLINTNEXTLINE(google-explicit-constructor): a number that all lanes have. x − 0 = x, for −0 too.
  Pack(double all) noexcept : v(all - typename Vectors<W>::Number{}) {}  ///< in all lanes

  friend Pack operator+(Pack a, Pack b) noexcept { return Pack(a.v + b.v); }
  friend Pack operator-(Pack a, Pack b) noexcept { return Pack(a.v - b.v); }
  friend Pack operator*(Pack a, Pack b) noexcept { return Pack(a.v * b.v); }
  friend Pack operator/(Pack a, Pack b) noexcept { return Pack(a.v / b.v); }
  friend Pack operator-(Pack a) noexcept { return Pack(-a.v); }
  friend Truth operator<(Pack a, Pack b) noexcept { return Truth(a.v < b.v); }
  friend Truth operator<=(Pack a, Pack b) noexcept { return Truth(a.v <= b.v); }
  friend Truth operator>(Pack a, Pack b) noexcept { return Truth(a.v > b.v); }
  friend Truth operator>=(Pack a, Pack b) noexcept { return Truth(a.v >= b.v); }
  friend Truth operator==(Pack a, Pack b) noexcept { return Truth(a.v == b.v); }
  friend Truth operator!=(Pack a, Pack b) noexcept { return Truth(a.v != b.v); }
  Pack& operator+=(Pack o) noexcept { return *this = *this + o; }
  Pack& operator-=(Pack o) noexcept { return *this = *this - o; }
  Pack& operator*=(Pack o) noexcept { return *this = *this * o; }

  [[nodiscard]] double lane(int i) const noexcept { return v[i]; }  ///< in lane i
  void set_lane(int i, double to) noexcept { v[i] = to; }           ///< in lane i
};

/// Lane by lane m ? a : b.
template <int W, class Isa>
[[nodiscard]] Pack<W, Isa> select(Mask<W, Isa> m, Pack<W, Isa> a, Pack<W, Isa> b) noexcept {
  return Pack<W, Isa>(m.v ? a.v : b.v);
}
/// Lane by lane m ? a : b.
template <int W, class Isa>
[[nodiscard]] Mask<W, Isa> select(Mask<W, Isa> m, Mask<W, Isa> a, Mask<W, Isa> b) noexcept {
  return Mask<W, Isa>((m.v & a.v) | (~m.v & b.v));
}
/// Lane by lane, by its sign bit.
template <int W, class Isa>
[[nodiscard]] Pack<W, Isa> abs(Pack<W, Isa> p) noexcept {
  using Bits = typename Vectors<W>::Truth;
  return Pack<W, Isa>(reinterpret_cast<typename Vectors<W>::Number>(reinterpret_cast<Bits>(p.v) & 0x7FFFFFFFFFFFFFFFLL));
}
/// Lane by lane, by sign bits.
template <int W, class Isa>
[[nodiscard]] Pack<W, Isa> copysign(Pack<W, Isa> magnitude, Pack<W, Isa> sign) noexcept {
  using Bits = typename Vectors<W>::Truth;
  const Bits kept = reinterpret_cast<Bits>(magnitude.v) & 0x7FFFFFFFFFFFFFFFLL;
  const Bits taken = reinterpret_cast<Bits>(sign.v) & static_cast<long long>(0x8000000000000000ULL);
  return Pack<W, Isa>(reinterpret_cast<typename Vectors<W>::Number>(kept | taken));
}

// Both.

template <class T>
using Truth = decltype(T() < T());  ///< bool, or a Mask

/// The same in all lanes.
template <class T>
[[nodiscard]] Truth<T> truth(bool m) noexcept {
  return Truth<T>(m);
}
/// As std::min, std::max and std::clamp choose, NaN included.
template <class T>
[[nodiscard]] T min(T a, std::type_identity_t<T> b) noexcept {
  return select(b < a, b, a);
}
/// As std::max.
template <class T>
[[nodiscard]] T max(T a, std::type_identity_t<T> b) noexcept {
  return select(a < b, b, a);
}
/// As std::clamp, for low ≤ high; a NaN stays.
template <class T>
[[nodiscard]] T clamp(T v, std::type_identity_t<T> low, std::type_identity_t<T> high) noexcept {
  return select(v < low, low, select(high < v, high, v));
}
/// m ? a : 0.
template <class T>
[[nodiscard]] T where(Truth<T> m, T a) noexcept {
  return select(m, a, T(0.0));
}
[[nodiscard]] inline double where(bool m, double a) noexcept { return m ? a : 0.0; }  ///< of one number

/// A small whole number beside T: int for one, a whole double in each lane for several.
template <class T>
using Count = std::conditional_t<kScalar<T>, int, T>;

// A unit's two sides: its motors, its springs. Of one unit they go side by side in a vector of two, where they are of one kind; of
// several, whose vectors are full, one after the other. `Side` tells which: it picks a side's number, or both as one.

/// Names the vector of both sides.
struct Sides {};
using Both = Pack<2, Sides>;  ///< a number of each side of one unit

/// Of what goes with T, and is the same for all lanes: a parameter.
template <class T>
using Constant = std::conditional_t<std::is_same_v<T, Both>, Both, double>;

/// One side, of one unit or several.
template <class T>
struct OneSide {
  using Number = T;                     ///< of a state
  static constexpr bool kBoth = false;  ///< one alone
  std::size_t i;                        ///< which

  template <class A>
  [[nodiscard]] const A& operator()(const std::array<A, 2>& of) const noexcept {  ///< its element
    return of[i];
  }
  template <class A>
  [[nodiscard]] const A& operator()(const A& first, const A& second) const noexcept {  ///< likewise
    return i == 0 ? first : second;
  }
  template <class A, class F>
  [[nodiscard]] auto operator()(const std::array<A, 2>& of, F&& member) const noexcept {  ///< member(its element)
    return member(of[i]);
  }
  void put(std::array<T, 2>& into, T value) const noexcept { into[i] = value; }  ///< its element
  template <class A, class F>
  void put(std::array<A, 2>& into, T value, F&& member) const noexcept {  ///< member(its element)
    member(into[i]) = value;
  }
  void add(T& to, T value) const noexcept { to += value; }  ///< what it gives to a sum over sides
};

/// Both sides of one unit at once.
struct BothSides {
  using Number = Both;                 ///< of a state
  static constexpr bool kBoth = true;  ///< of one unit

  [[nodiscard]] Both operator()(double first, double second) const noexcept { return Both(Vectors<2>::Number{first, second}); }
  [[nodiscard]] Both operator()(const std::array<double, 2>& of) const noexcept {  ///< its elements
    return (*this)(of[0], of[1]);
  }
  template <class A, class F>
  [[nodiscard]] Both operator()(const std::array<A, 2>& of, F&& member) const noexcept {  ///< member(element) of both
    return (*this)(member(of[0]), member(of[1]));
  }
  /// Its elements, stored as one: who loads them as one has them at once.
  void put(std::array<double, 2>& into, Both value) const noexcept { std::memcpy(into.data(), &value.v, sizeof value.v); }
  template <class A, class F>
  void put(std::array<A, 2>& into, Both value, F&& member) const noexcept {  ///< member(element) of both
    member(into[0]) = value.lane(0);
    member(into[1]) = value.lane(1);
  }
  void add(double& to, Both value) const noexcept {  ///< to a sum over sides: the first, then the second
    to += value.lane(0);
    to += value.lane(1);
  }
};

/// Calls for both sides, of one unit at once.
template <class T, class F>
void each_side(F&& f) noexcept {
  if constexpr (kScalar<T>) {
    f(BothSides{});
  } else {
    f(OneSide<T>{0});
    f(OneSide<T>{1});
  }
}
/// Calls for each of so many sides; `together`: of one unit for both at once.
template <class T, class F>
void each_side(bool together, int count, F&& f) noexcept {
  if constexpr (kScalar<T>) {
    if (together) {
      f(BothSides{});
    } else {
      for (int i = 0; i < count; ++i) f(OneSide<T>{static_cast<std::size_t>(i)});
    }
  } else {
    each_side<T>(f);
  }
}

}  // namespace vsa::lanes
