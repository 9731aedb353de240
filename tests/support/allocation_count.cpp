// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Counts every allocation of this test program, and lets one fail. Apart from the tests: a compiler that sees both warns of the
// mismatch.
#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> count{0};
thread_local long until_failure = 0;  // 0: none fails
}  // namespace

long allocation_count();
long allocation_count() { return count.load(); }

/// The nth allocation of this thread from now on fails; 0: none.
void fail_allocation(long nth);
void fail_allocation(long nth) { until_failure = nth; }

// Also what libraries take without `new`, as Eigen does; sanitizers have a malloc of their own.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" void* __libc_malloc(std::size_t size) noexcept;
extern "C" void* malloc(std::size_t size) noexcept {
  count.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
// NOLINTNEXTLINE(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" void* __libc_calloc(std::size_t number, std::size_t size) noexcept;
extern "C" void* calloc(std::size_t number, std::size_t size) noexcept {
  count.fetch_add(1, std::memory_order_relaxed);
  return __libc_calloc(number, size);
}
#endif

void* operator new(std::size_t size) {
  count.fetch_add(1, std::memory_order_relaxed);
  if (until_failure > 0 && --until_failure == 0) throw std::bad_alloc();
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  count.fetch_add(1, std::memory_order_relaxed);
  return std::malloc(size);
}
void operator delete(void* p, const std::nothrow_t&) noexcept { std::free(p); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
