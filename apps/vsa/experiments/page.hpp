// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "vsa/report/report.hpp"
#include "vsa/study/tasks.hpp"

namespace vsa::app {

/// A row a type with its best of each task, and its places among them.
[[nodiscard]] report::Table tasks_table(const study::Tasks& tasks);
/// That table, bars from the best to the least, and every preset's results.
[[nodiscard]] report::Report tasks_page(const study::Tasks& tasks, const std::string& command);

}  // namespace vsa::app
