// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A serial port that software for the hardware opens: a pseudo-terminal under a stable name, in raw mode, with units behind it.
//
// A thread of its own reads what a client writes, hands it to the line and writes the answers. It never waits for a client: what
// the pseudo-terminal (about 11 kB on Linux 6) and the buffer here don't hold is dropped and counted, as a full tty would.
//
// We keep the client's end open too, so that the port lives on while nobody uses it. When a client has gone and no other has the
// port open, answers that nobody read are thrown away, a lock it left (TIOCEXCL) is taken off, and raw mode is set again.
//
// What a pseudo-terminal can't do: a second opener can't be told apart; both write to the same units and share what comes back.
// In the microseconds between a client's end and our look, the next one may find that one's answers (host libraries throw pending
// input away before they ask) or its lock (EBUSY), or lose settings of its own, where that one didn't leave raw mode. Bytes take no time on the way. The line is told the rate that the client's end
// is set to when its bytes are read: a client that changes it just after a write has sent that at the new one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "vsa/bus/serial_line.hpp"

namespace vsa::serial {

/// Where the port stands, and how much of a client that doesn't read is kept.
struct VirtualPortOptions {
  std::string path;                        ///< the link's name, see port_path
  std::size_t most_held_bytes = 64 << 10;  ///< answers kept for a client that doesn't read
};

/// What a port has done since it was made.
struct PortCounters {
  std::uint64_t exchanges = 0;           ///< times that bytes went to the line, or that the line spoke unasked
  std::uint64_t bytes_in = 0;            ///< from clients
  std::uint64_t bytes_out = 0;           ///< to clients
  std::uint64_t bytes_dropped = 0;       ///< answers that no client made room for
  std::uint64_t clients_gone = 0;        ///< times that the last client closed the port
  std::int64_t longest_exchange_ns = 0;  ///< in the line: its lock and its work
  std::int64_t longest_service_ns = 0;   ///< from a request's arrival in our thread to its answer in the terminal
};

/// A serial port that software for the hardware opens: a pseudo-terminal under a stable name, with units behind it, served by a
/// thread of its own.
class VirtualPort {
 public:
  /// Serves at once. `line` must outlive the port, and may be locked by others for microseconds only. Throws InputError for a path
  /// that can't be had, std::system_error where the system has no pseudo-terminal left.
  VirtualPort(bus::SerialLine& line, const VirtualPortOptions& options);
  /// Ends the thread and removes the link.
  ~VirtualPort();
  VirtualPort(const VirtualPort&) = delete;
  VirtualPort& operator=(const VirtualPort&) = delete;

  [[nodiscard]] const std::string& path() const noexcept;  ///< of the link that clients open
  [[nodiscard]] PortCounters counters() const noexcept;    ///< since the port was made

 private:
  class Server;
  std::unique_ptr<Server> server_;
};

}  // namespace vsa::serial
