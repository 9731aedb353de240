// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/notes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vsa::reader {

void Notes::add(const std::string& what, const std::string& where) {
  const auto it = std::find_if(notes_.begin(), notes_.end(), [&](const Note& n) { return n.what == what; });
  if (it == notes_.end()) {
    notes_.push_back({what, where, 0});
  } else {
    ++it->more;
  }
}

std::vector<std::string> Notes::texts() const {
  std::vector<std::string> out;
  for (const Note& n : notes_) {
    out.push_back(n.more == 0 ? fmt::format("{}: {}", n.what, n.first)
                              : fmt::format("{}: {} and {} more", n.what, n.first, n.more));
  }
  return out;
}

}  // namespace vsa::reader
