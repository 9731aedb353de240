// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Misuse that the compiler can't see, in every build.
//
//   an object that was moved from   std::logic_error, in words, from whatever is asked of it
//   a broken promise in a function that can't throw (a span of the wrong size in a step)   one line on stderr, and abort
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace vsa {

/// Says "where: what" on stderr and ends the program.
[[noreturn]] void broken_promise(const char* where, const char* what) noexcept;

/// broken_promise() where the promise wasn't kept.
inline void require(bool promise, const char* where, const char* what) noexcept {
  if (!promise) [[unlikely]]
    broken_promise(where, what);
}

/// A std::unique_ptr that knows what it belongs to, for classes that keep their insides behind a pointer.
template <class T>
class Owner {
 public:
  explicit Owner(const char* owner) noexcept : owner_(owner) {}  ///< `owner`: who it belongs to, for messages; a literal
  /// The same with something inside.
  Owner(const char* owner, std::unique_ptr<T> inside) noexcept : inside_(std::move(inside)), owner_(owner) {}
  void take(std::unique_ptr<T> inside) noexcept { inside_ = std::move(inside); }  ///< from now on that is inside
  [[nodiscard]] bool there() const noexcept { return inside_ != nullptr; }        ///< false: it was moved from
  /// What is inside; throws std::logic_error where it was moved from.
  T& operator*() const {
    if (!inside_) [[unlikely]]
      throw std::logic_error(std::string(owner_) + ": used after it was moved from");
    return *inside_;
  }
  T* operator->() const { return &**this; }  ///< likewise

 private:
  std::unique_ptr<T> inside_;
  const char* owner_;
};

}  // namespace vsa
