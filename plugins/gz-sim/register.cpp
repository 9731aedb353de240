// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The library's entry, apart from the system: a program that links an entry takes other plug-ins' registrations for its own, and
// they don't load.
#include "robot_system.hpp"
#ifdef VSA_GZ_TRANSPORT
#include <gz/plugin/Register.hh>
#else
#include <ignition/plugin/Register.hh>
#endif

#ifdef VSA_GZ_TRANSPORT
VSA_ADD_PLUGIN(vsa::plugins::SimRobot, vsa::plugins::sim::System, vsa::plugins::SimRobot::ISystemConfigure,
               vsa::plugins::SimRobot::ISystemConfigureParameters, vsa::plugins::SimRobot::ISystemReset,
               vsa::plugins::SimRobot::ISystemPreUpdate)
#else
VSA_ADD_PLUGIN(vsa::plugins::SimRobot, vsa::plugins::sim::System, vsa::plugins::SimRobot::ISystemConfigure,
               vsa::plugins::SimRobot::ISystemPreUpdate)
#endif
VSA_ADD_PLUGIN_ALIAS(vsa::plugins::SimRobot, "vsa::Robot")
