// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A robot's faults on purpose, by the service /model/M/vsa/faults: request a StringMsg "ACTUATOR words" or "all words"
// (vsa/config/faults_text.hpp), reply a StringMsg: "ok: …", or "refused: …" with what is wrong and nothing changed.
#pragma once

#include <memory>
#include <string>

#include "vsa/host/robot.hpp"

namespace vsa::topics {

class FaultService {
 public:
  /// Throws InputError where the transport takes no such name.
  FaultService(host::Robot& robot, const std::string& model);
  ~FaultService();  ///< nobody is served any more once it is gone
  FaultService(FaultService&&) noexcept;
  FaultService& operator=(FaultService&&) noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsa::topics
