// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The stable name of a pseudo-terminal: a symbolic link, and elsewhere a locked file (PathLock) that says its owner lives.
#pragma once

#include <string>

#include "vsa/serial/path_lock.hpp"

namespace vsa::serial {

class PortLink {
 public:
  /// Takes the name; doesn't make the link yet. Throws InputError: a living program has it, or something else is in its place.
  explicit PortLink(const std::string& path);
  ~PortLink();
  PortLink(const PortLink&) = delete;
  PortLink& operator=(const PortLink&) = delete;

  /// Makes the link or moves it, in one step: nobody ever finds it missing or half done. Throws InputError.
  void point_to(const std::string& target);
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  std::string path_, target_;
  PathLock lock_;  // goes after the link
};

}  // namespace vsa::serial
