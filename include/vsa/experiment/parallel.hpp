// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Independent jobs on several threads. Each job writes its own result, so the results don't depend on how many threads there are.
#pragma once

#include <cstddef>
#include <functional>

namespace vsa::experiment {

/// Calls job(0) … job(count − 1), each once, on `threads` threads (0: as many as the machine runs at once), and waits for all of
/// them. Where jobs throw, the others still run; then the exception of the lowest index is thrown on.
void run_in_parallel(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& job);

}  // namespace vsa::experiment
