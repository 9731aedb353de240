// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "terminal/old_spellings.hpp"

#include <iostream>
#include <memory>
#include <mutex>
#include <set>

#include "vsa/config/notices.hpp"

namespace vsa::app {
namespace {

struct Told {
  std::mutex guard;
  std::set<std::string> notices;
};

}  // namespace

void tell_old_spellings(const std::string& program) {
  config::listen_to_notices([program, told = std::make_shared<Told>()](const std::string& notice) {
    const std::scoped_lock lock(told->guard);
    // In one piece, since others write, too.
    if (told->notices.insert(notice).second) std::cerr << program + ": " + notice + '\n';
  });
}

}  // namespace vsa::app
