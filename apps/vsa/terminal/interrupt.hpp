// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vsa::app {

/// From now on the first SIGINT, SIGTERM or SIGHUP is noted, so that a loop can end in good order; one that comes more than half a second
/// later ends the process.
void catch_interrupts();

/// Makes SIGPIPE and SIGXFSZ errors of the write that met them. Call once, first.
void survive_broken_pipes();
/// Standard input, output and error that the caller has closed are /dev/null, for reading only: else the first files that are opened get
/// their numbers, and messages are written into them. What can't be written is an error still.
void fill_closed_standard_files();
/// Throws std::runtime_error where standard output didn't take all of what was written: call last.
void see_all_written();

/// The signal that was noted, 0 for none.
[[nodiscard]] int interrupted() noexcept;

}  // namespace vsa::app
