// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// gz-sim under one name: Fortress (6) calls itself ignition, Harmonic (8) and later gz.
#pragma once

#ifdef VSA_GZ_TRANSPORT
#include <gz/common/Console.hh>
#include <gz/sim/EntityComponentManager.hh>
#include <gz/sim/EventManager.hh>
#include <gz/sim/System.hh>
#include <gz/sim/Util.hh>
#include <gz/sim/components/ChildLinkName.hh>
#include <gz/sim/components/Gravity.hh>
#include <gz/sim/components/Inertial.hh>
#include <gz/sim/components/Joint.hh>
#include <gz/sim/components/JointAxis.hh>
#include <gz/sim/components/JointForceCmd.hh>
#include <gz/sim/components/JointPosition.hh>
#include <gz/sim/components/JointType.hh>
#include <gz/sim/components/JointVelocity.hh>
#include <gz/sim/components/Link.hh>
#include <gz/sim/components/Model.hh>
#include <gz/sim/components/Name.hh>
#include <gz/sim/components/ParentEntity.hh>
#include <gz/sim/components/ParentLinkName.hh>
#include <gz/sim/components/Physics.hh>
#include <gz/sim/components/Pose.hh>
#include <gz/transport/parameters/Registry.hh>

#define VSA_ADD_PLUGIN GZ_ADD_PLUGIN
#define VSA_ADD_PLUGIN_ALIAS GZ_ADD_PLUGIN_ALIAS
#define VSA_ERROR gzerr
#define VSA_WARNING gzwarn
#define VSA_HAS_RESET 1
#define VSA_HAS_PARAMETERS 1
namespace vsa::plugins {
namespace sim = gz::sim;
namespace math = gz::math;
}  // namespace vsa::plugins
#else
#include <ignition/common/Console.hh>
#include <ignition/gazebo/EntityComponentManager.hh>
#include <ignition/gazebo/EventManager.hh>
#include <ignition/gazebo/System.hh>
#include <ignition/gazebo/Util.hh>
#include <ignition/gazebo/components/ChildLinkName.hh>
#include <ignition/gazebo/components/Gravity.hh>
#include <ignition/gazebo/components/Inertial.hh>
#include <ignition/gazebo/components/Joint.hh>
#include <ignition/gazebo/components/JointAxis.hh>
#include <ignition/gazebo/components/JointForceCmd.hh>
#include <ignition/gazebo/components/JointPosition.hh>
#include <ignition/gazebo/components/JointType.hh>
#include <ignition/gazebo/components/JointVelocity.hh>
#include <ignition/gazebo/components/Link.hh>
#include <ignition/gazebo/components/Model.hh>
#include <ignition/gazebo/components/Name.hh>
#include <ignition/gazebo/components/ParentEntity.hh>
#include <ignition/gazebo/components/ParentLinkName.hh>
#include <ignition/gazebo/components/Physics.hh>
#include <ignition/gazebo/components/Pose.hh>

#define VSA_ADD_PLUGIN IGNITION_ADD_PLUGIN
#define VSA_ADD_PLUGIN_ALIAS IGNITION_ADD_PLUGIN_ALIAS
#define VSA_ERROR ignerr
#define VSA_WARNING ignwarn
namespace vsa::plugins {
namespace sim = ignition::gazebo;
namespace math = ignition::math;
}  // namespace vsa::plugins
#endif
