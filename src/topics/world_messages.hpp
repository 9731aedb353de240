// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The messages of a world that no robot needs, beside stock.hpp's.
#pragma once

#ifdef VSA_GZ_TRANSPORT
#include <gz/msgs/boolean.pb.h>
#include <gz/msgs/clock.pb.h>
#include <gz/msgs/world_control.pb.h>
#include <gz/msgs/world_stats.pb.h>
#else
#include <ignition/msgs/boolean.pb.h>
#include <ignition/msgs/clock.pb.h>
#include <ignition/msgs/world_control.pb.h>
#include <ignition/msgs/world_stats.pb.h>
#endif
