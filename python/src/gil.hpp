// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Long work without Python's lock, the GIL.
//
// While Python shuts down it ends each daemon thread that asks for the lock, by an unwinding (glibc's pthread_exit) from within that
// call. Our destructors can't let it through (std::terminate), and what it destroys on its way is Python's, whose lock the thread
// hasn't got. So it is caught where it begins, and the thread stays there until the process ends.
#pragma once

#include <chrono>

#include "bind.hpp"

namespace vsa::python {

[[noreturn]] void stay() noexcept;

/// work(), which calls one function of Python's and owns nothing itself: where Python ends the thread in it, the thread stays.
template <class Work>
auto or_stay(const Work& work) {
  try {
    return work();
  } catch (...) {  // Python's functions throw nothing: it is the unwinding
    stay();
  }
}

/// Other threads of Python run as long as it lives. Of the thread that made it.
class OthersRun {
 public:
  OthersRun() : mine_(PyEval_SaveThread()) {}
  ~OthersRun() { take_lock(); }
  OthersRun(const OthersRun&) = delete;
  OthersRun& operator=(const OthersRun&) = delete;

  /// For loops: about 20 times a second Python's signal handlers run, and what they raise (KeyboardInterrupt) is thrown.
  void look() {
    const auto now = Clock::now();
    if (now >= next_) handle(now);
  }

  /// They wait as long as it lives.
  class Pause {
   public:
    explicit Pause(OthersRun& of) : of_(of) { of_.take_lock(); }
    ~Pause() { of_.mine_ = PyEval_SaveThread(); }
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;

   private:
    OthersRun& of_;
  };

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kEvery{50};
  void handle(Clock::time_point now);
  void take_lock() noexcept {
    or_stay([this] { PyEval_RestoreThread(mine_); });
  }

  PyThreadState* mine_;
  Clock::time_point next_ = Clock::now() + kEvery;
};

/// Sets a flag that says "one thread has this to itself", for as long as it lives. Made and destroyed with the lock.
class Mark {
 public:
  explicit Mark(bool& flag) : flag_(flag) { flag_ = true; }
  ~Mark() { flag_ = false; }
  Mark(const Mark&) = delete;
  Mark& operator=(const Mark&) = delete;

 private:
  bool& flag_;
};

}  // namespace vsa::python
