// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vsa::serial {

/// A path for one program at a time, by the flock of a file elsewhere (lock_path): of a port its owner's, of a file that is replaced as
/// a whole its writer's. The kernel takes the lock off however the owner ends; a killed one leaves the file. Its text: the owner's
/// process, then the path, each on a line.
class PathLock {
 public:
  /// `taken`: what the other one does, "another program serves this port". Throws InputError: a living program has it, or the file
  /// can't be had. Removes what killed owners of other paths left, where nothing is at the path any more.
  PathLock(const std::string& path, const std::string& taken);
  ~PathLock();  ///< removes the file
  PathLock(const PathLock&) = delete;
  PathLock& operator=(const PathLock&) = delete;

  [[nodiscard]] int get() const noexcept { return fd_; }          ///< of the file that is locked
  [[nodiscard]] bool is_new() const noexcept { return is_new_; }  ///< no: a killed owner had left it

 private:
  void take(const std::string& path, const std::string& taken);

  std::string lock_;
  int fd_ = -1;
  bool is_new_ = false;
};

}  // namespace vsa::serial
