// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/config/notices.hpp"

#include <memory>
#include <mutex>
#include <utility>

#include "config/met.hpp"

namespace vsa::config {
namespace {

std::mutex guard;
std::shared_ptr<const NoticeListener> listening;  // shared: one that is replaced may be running

}  // namespace

void listen_to_notices(NoticeListener listener) {
  auto next = listener ? std::make_shared<const NoticeListener>(std::move(listener)) : nullptr;
  const std::scoped_lock lock(guard);
  listening = std::move(next);
}

void met_old_spelling(std::string notice, std::vector<std::string>& notices) {
  std::shared_ptr<const NoticeListener> listener;
  {
    const std::scoped_lock lock(guard);
    listener = listening;
  }
  if (listener) (*listener)(notice);
  notices.push_back(std::move(notice));
}

}  // namespace vsa::config
