// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One function compiled once more for the machine's widest registers. Not by a source of its own, as the kernels of lanes are: there
// every function needs a name that tells its instruction set, and those of one unit are plain double.
#pragma once

namespace vsa::device {

// Sanitizers would take a minute more for the same lines.
#if defined(VSA_LANES_X86) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// Whether this machine has what `widest` is compiled for.
inline const bool kHasAvx512 =
    __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");

/// f() in AVX-512's 32 registers, with choices by mask: of one unit 7 % faster, and the same bits. What isn't inlined here stays code
/// for any machine.
template <class F>
[[gnu::flatten, gnu::noinline, gnu::target("avx512f,avx512dq,avx512vl")]] auto widest(const F& f) noexcept {
  return f();
}
#else
inline constexpr bool kHasAvx512 = false;
template <class F>
auto widest(const F& f) noexcept {
  return f();
}
#endif

}  // namespace vsa::device
