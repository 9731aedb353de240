// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/serial/processors_awake.hpp"

#include <fcntl.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

#include "descriptor.hpp"
#include "vsa/errors.hpp"

namespace vsa::serial {

class ProcessorsAwake::File {
 public:
  explicit File(const std::string& device) : file_(open(device.c_str(), O_WRONLY | O_CLOEXEC)) {
    // Documentation of the kernel, power/pm_qos_interface: the wish holds while the file is open.
    const std::int32_t most_us = 0;
    if (!file_ || write(file_.get(), &most_us, sizeof most_us) != sizeof most_us)
      throw InputError(
          {device, "low latency", "on", std::strerror(errno), "a Linux that has this file and lets you write it, as it does root"});
  }

 private:
  Descriptor file_;
};

ProcessorsAwake::ProcessorsAwake(const std::string& device) : file_(std::make_unique<File>(device)) {}
ProcessorsAwake::~ProcessorsAwake() = default;

}  // namespace vsa::serial
