// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a tree's solver does with its matrices (device/joint_solver.cpp), many numbers at once. Numbers lie in rows of `stride`, a
// multiple of kBlock, on lines of the cache, with zeros behind the n that count. Each number's sum has one order whatever the set, and
// blocks are as wide for a narrow set as for a wide one, so all give the same bits.
#pragma once

#include <cstddef>

#include "device/lanes/loop.hpp"
#include "device/lanes/table.hpp"

namespace vsa::device::lane_kernel {

/// y += Σ x[k]·row k over `rows` rows of `stride` numbers.
template <class T>
void add_product(const double* matrix, std::size_t rows, std::size_t stride, const double* x, double* y) noexcept {
  for (std::size_t c = 0; c < stride; c += T::kWidth) {
    T sum = load<T>(y + c);
    for (std::size_t k = 0; k < rows; ++k) sum += load<T>(matrix + k * stride + c) * T(x[k]);
    store(sum, y + c);
  }
}

/// x −= factor·row, in blocks from that of `first` to that of last − 1.
template <class T>
void subtract(const double* row, double factor, std::size_t first, std::size_t last, double* x) noexcept {
  const T f = factor;
  for (std::size_t b = first / kBlock * kBlock; b < last; b += kBlock)
    for (std::size_t c = b; c < b + kBlock; c += T::kWidth) store(load<T>(x + c) - load<T>(row + c) * f, x + c);
}

/// x := (L D Lᵀ)⁻¹ x
template <class T>
[[gnu::flatten]] void substitute(const Factor& f, double* x) noexcept {
  for (std::size_t i = 0; i + 1 < f.n; ++i) subtract<T>(f.upper + i * f.stride, x[i], i + 1, f.n, x);
  for (std::size_t c = 0; c < f.stride; c += T::kWidth) store(load<T>(x + c) * load<T>(f.reciprocal + c), x + c);
  for (std::size_t i = f.n; i-- > 1;) subtract<T>(f.lower + i * f.stride, x[i], 0, i, x);
}

}  // namespace vsa::device::lane_kernel
