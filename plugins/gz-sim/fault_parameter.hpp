// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A robot's faults as the world's parameter "model.M.vsa.faults", a StringMsg of the words that the service of faults takes; "" is
// "all none". What is refused is put back. From Harmonic on: older ones have no parameters, and include nothing of this.
#pragma once

#include <string>

#include "compat.hpp"
#include "vsa/seat/seat.hpp"

namespace vsa::plugins {

class FaultParameter {
 public:
  using Registry = gz::transport::parameters::ParametersRegistry;

  void declare(Registry& registry, const std::string& model);
  /// Once a round: looks now and then, and gives what is new to the seat.
  void look(seat::Seat& seat);
  void reset();  ///< which ends the faults

 private:
  Registry* registry_ = nullptr;
  std::string name_, faults_;  ///< the parameter's; its value, as far as it was taken
  int rounds_to_look_ = 0;
};

}  // namespace vsa::plugins
