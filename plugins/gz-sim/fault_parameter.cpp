// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "compat.hpp"

#ifdef VSA_HAS_PARAMETERS
#include <gz/msgs/stringmsg.pb.h>

#include "fault_parameter.hpp"
#include "vsa/errors.hpp"
#include "vsa/scoped_name.hpp"

namespace vsa::plugins {
namespace {

using gz::msgs::StringMsg;

constexpr int kRounds = 50;

}  // namespace

void FaultParameter::declare(Registry& registry, const std::string& model) {
  name_ = "model." + joined_by(model, ".") + ".vsa.faults";
  // Of a model that was removed and is back, the parameter is there already.
  if (!registry.DeclareParameter(name_, StringMsg()) && !registry.SetParameter(name_, StringMsg())) return;
  registry_ = &registry;
}

void FaultParameter::look(seat::Seat& seat) {
  if (registry_ == nullptr || rounds_to_look_-- > 0) return;
  rounds_to_look_ = kRounds - 1;
  StringMsg value;
  if (!registry_->Parameter(name_, value) || value.data() == faults_) return;
  try {
    seat.apply_faults(value.data().empty() ? "all none" : value.data(), name_);
    faults_ = value.data();
  } catch (const InputError& error) {
    const std::string text = seat.model() + ": refused: " + error.what();
    VSA_WARNING << "vsa::Robot: " << text << std::endl;
    value.set_data(faults_);
    registry_->SetParameter(name_, value);
  }
}

void FaultParameter::reset() {
  if (registry_ != nullptr) registry_->SetParameter(name_, StringMsg());
  faults_.clear();
}

}  // namespace vsa::plugins
#endif
