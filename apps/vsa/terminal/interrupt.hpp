// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vsa::app {

/// From now on the first SIGINT or SIGTERM is noted, so that a loop can end in good order; a second one ends the process.
void catch_interrupts();

/// Makes SIGPIPE and SIGXFSZ errors of the write that met them. Call once, first.
void survive_broken_pipes();

/// The signal that was noted, 0 for none.
[[nodiscard]] int interrupted() noexcept;

}  // namespace vsa::app
