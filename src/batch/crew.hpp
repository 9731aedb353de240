// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Threads that share a list of work: each takes the next few until none is left.
//
// A fork leaves the child without the threads. What they stood on, locks perhaps held and conditions waited for, can't be used or
// destroyed there: it stays where it is, and a child that wants work done gets threads of its own.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <memory>

namespace vsa::batch {

class Crew {
 public:
  /// `count` in all: the caller of run() is one of them. InputError "threads": the system starts fewer.
  explicit Crew(std::size_t count);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  [[nodiscard]] std::size_t size() const noexcept { return count_; }

  /// work(worker, item) once for each item below `items`; returns when all is done. What `work` throws first ends it: no item is begun
  /// any more, and when all threads are through it is thrown here.
  void run(std::size_t items, const std::function<void(std::size_t worker, std::size_t item)>& work);

 private:
  struct Team;
  void leave() noexcept;

  std::size_t count_;
  pid_t process_;
  std::unique_ptr<Team> team_;
};

}  // namespace vsa::batch
