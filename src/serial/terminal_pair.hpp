// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A pseudo-terminal: our end, the client's end, which we keep open too, and a watch that tells when a client closed it.
#pragma once

#include <cstdint>
#include <string>

#include "serial/descriptor.hpp"

namespace vsa::serial {

class TerminalPair {
 public:
  TerminalPair();  ///< raw. Throws std::system_error.

  [[nodiscard]] int ours() const noexcept { return ours_.get(); }
  [[nodiscard]] int watch() const noexcept { return watch_.get(); }  ///< readable: somebody may have closed the client's end
  [[nodiscard]] const std::string& device() const noexcept { return device_; }

  [[nodiscard]] std::int64_t clients_baud_Hz() const noexcept;  ///< what the client's end is set to; 0: hung up

  /// Reads what the watch has to tell; true: somebody closed the client's end.
  [[nodiscard]] bool somebody_left() const noexcept;

  /// Closes our copy of the client's end and takes a lock (TIOCEXCL) off it: from now until take_hold, `deserted` tells.
  void let_go() noexcept;
  /// Nobody has the client's end open. What a dead client wrote can then be read to its end.
  [[nodiscard]] bool deserted() const noexcept;
  /// Opens it again. False: somebody came and locked it meanwhile; once that one has gone the pair is lost.
  [[nodiscard]] bool take_hold(bool clients) noexcept;

  /// Only while there are no clients: as new.
  void restore() noexcept;

 private:
  void add_watch() noexcept;
  [[nodiscard]] bool open_theirs() noexcept;

  Descriptor ours_, theirs_, watch_;
  std::string device_;
  int watch_id_ = -1;
  int locked_ = 0;
};

}  // namespace vsa::serial
