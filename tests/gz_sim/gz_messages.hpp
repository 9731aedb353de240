// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What tests say to gz-sim over the transport, beside the robot's own messages (src/topics/stock.hpp).
#pragma once

#include "topics/messages.hpp"
#ifdef VSA_GZ_TRANSPORT
#include <gz/msgs/boolean.pb.h>
#include <gz/msgs/entity.pb.h>
#include <gz/msgs/entity_factory.pb.h>
#include <gz/msgs/log_playback_control.pb.h>
#include <gz/msgs/world_control.pb.h>
#else
#include <ignition/msgs/boolean.pb.h>
#include <ignition/msgs/entity.pb.h>
#include <ignition/msgs/entity_factory.pb.h>
#include <ignition/msgs/log_playback_control.pb.h>
#include <ignition/msgs/world_control.pb.h>
#endif

namespace vsa::test {

namespace msgs = topics::msgs;
using topics::transport::Node;

/// A service of gz-sim that answers yes or no. False: no answer within 5 s, or no.
template <class Request>
[[nodiscard]] bool ask(Node& node, const std::string& service, const Request& request) {
  msgs::Boolean reply;
  bool answered = false;
  return node.Request(service, request, 5000, reply, answered) && answered && reply.data();
}

}  // namespace vsa::test
