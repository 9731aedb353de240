// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The transport and the stock messages under one name, whatever Gazebo calls them: ignition-transport 8 (Gazebo Classic 11), 11
// (Fortress, the embedded simulator), gz-transport 13 and later (VSA_GZ_TRANSPORT).
#pragma once

#ifdef VSA_GZ_TRANSPORT
#include <gz/msgs/actuators.pb.h>
#include <gz/msgs/double.pb.h>
#include <gz/msgs/joint_trajectory.pb.h>
#include <gz/msgs/model.pb.h>
#include <gz/msgs/stringmsg.pb.h>
#include <gz/msgs/time.pb.h>

#include <gz/transport/Node.hh>
#include <gz/transport/TopicUtils.hh>

#define VSA_HAS_JOINT_TRAJECTORY 1
namespace vsa::topics {
namespace msgs = gz::msgs;
namespace transport = gz::transport;
inline constexpr const char* kAddressVariable = "GZ_IP";
}  // namespace vsa::topics
#else
#include <ignition/msgs/actuators.pb.h>
#include <ignition/msgs/double.pb.h>
#include <ignition/msgs/model.pb.h>
#include <ignition/msgs/stringmsg.pb.h>
#include <ignition/msgs/time.pb.h>

#include <ignition/transport/Node.hh>
#include <ignition/transport/TopicUtils.hh>

#if __has_include(<ignition/msgs/joint_trajectory.pb.h>)
#include <ignition/msgs/joint_trajectory.pb.h>
#define VSA_HAS_JOINT_TRAJECTORY 1
#endif
namespace vsa::topics {
namespace msgs = ignition::msgs;
namespace transport = ignition::transport;
inline constexpr const char* kAddressVariable = "IGN_IP";
}  // namespace vsa::topics
#endif
