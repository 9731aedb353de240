// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A processor that sleeps takes its time to wake: microseconds on a desktop, up to milliseconds in a virtual machine. Linux lets a
// program ask for none of it while a file is open (PM QoS, /dev/cpu_dma_latency), which is what programs that measure latencies
// do. Idle processors then spin, which costs power, so a user has to ask for it.
#pragma once

#include <memory>
#include <string>

namespace vsa::serial {

/// Keeps this machine's processors from sleeping while it lives.
class ProcessorsAwake {
 public:
  /// Throws InputError if the system has no such file or doesn't let us open it (it is root's, as a rule).
  explicit ProcessorsAwake(const std::string& device = "/dev/cpu_dma_latency");
  ~ProcessorsAwake();
  ProcessorsAwake(const ProcessorsAwake&) = delete;
  ProcessorsAwake& operator=(const ProcessorsAwake&) = delete;

 private:
  class File;
  std::unique_ptr<File> file_;
};

}  // namespace vsa::serial
