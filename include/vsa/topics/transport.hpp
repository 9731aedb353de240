// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vsa::topics {

/// Keeps ignition-transport on this machine: sets IGN_IP to 127.0.0.1 where it is unset. The transport reads it once, when a
/// process makes its first node, so call it early and from one thread (it changes the environment); every class here that makes a
/// node calls it. Who wants the network sets IGN_IP to that interface's address. The discovery's UDP sockets (10317, 10318) stay on
/// all addresses. Throws InputError where there can be no topics.
void prefer_loopback();

/// Why there can be no topics, a line: this build has none, or no network interface is up, without which ignition-transport throws
/// whatever it comes across. Empty: nothing is known to be in the way.
[[nodiscard]] std::string why_no_topics();

/// Ends the process as std::exit does, but where it talked by topics without the destructors of static objects: ignition-transport 11
/// keeps two callbacks of its discovery in such objects (Discovery::registrationCb) and leaves the thread that calls them running, so
/// that a program that ends while another robot tells of itself would crash now and then.
[[noreturn]] void leave(int exit_code);

}  // namespace vsa::topics
