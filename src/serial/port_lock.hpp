// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The file (serial::lock_path) whose flock says that a port's owner lives. The kernel takes the lock off however the owner ends; a
// killed one leaves the file. Its text: the owner's process, then the port's path, each on a line.
#pragma once

#include <string>

#include "serial/descriptor.hpp"

namespace vsa::serial {

class PortLock {
 public:
  /// Throws InputError: a living program has it, or the file can't be had. Removes what killed owners of other ports left, where
  /// the port is gone, too.
  explicit PortLock(const std::string& port);
  ~PortLock();  ///< removes the file
  PortLock(const PortLock&) = delete;
  PortLock& operator=(const PortLock&) = delete;

  [[nodiscard]] int get() const noexcept { return fd_.get(); }
  [[nodiscard]] bool is_new() const noexcept { return is_new_; }  ///< no: a killed owner had left it

 private:
  void take(const std::string& port);

  std::string path_;
  Descriptor fd_;
  bool is_new_ = false;
};

}  // namespace vsa::serial
