// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vsa::serial {

/// Where a virtual port of this name is: a name with a '/' is a path, as it is; any other lies in $XDG_RUNTIME_DIR, or in /tmp
/// where there is none, and starts with "vsa-" ("arm" and "vsa-arm" are the same port).
[[nodiscard]] std::string port_path(std::string_view name);

/// The file whose lock (flock) says that the port at this path is served: in /run/lock, or where that can't be written in the place
/// above. All names of one place have the same: "vsa-", the port's name, and a hash of its directory. Never beside the link:
/// programs for the hardware list what lies in /dev.
[[nodiscard]] std::string lock_path(std::string_view port);

/// Whether it is the link of a virtual port whose owner was killed. The terminal that it points to may be anybody's by now.
[[nodiscard]] bool is_left_behind(const std::string& port);

/// The serial ports of this machine that vsasim knows.
struct PortList {
  std::vector<std::string> virtual_ports;  ///< "vsa-…" in the place above; those whose owner was killed are left out
  std::vector<std::string> left_behind;    ///< links of such ports whose owner was killed
  std::vector<std::string> devices;        ///< /dev/ttyUSB*, /dev/ttyACM*
};
[[nodiscard]] PortList find_ports();  ///< as they are now

}  // namespace vsa::serial
