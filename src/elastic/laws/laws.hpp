// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The list; a new law adds a line here and one in laws.cpp.
#pragma once

#include "vsa/elastic/law.hpp"

namespace vsa::elastic {

extern const Law kBiStiffness;
extern const Law kCamRoller;
extern const Law kLeverCardan;
extern const Law kLeverPivot;
extern const Law kLeverSpring;
extern const Law kMaccepa;
extern const Law kMaccepa2;
extern const Law kSeriesHardening;
extern const Law kSeriesSpring;
extern const Law kSeriesTravel;
extern const Law kTable;
extern const Law kTwoCams;
extern const Law kTwoExp;
extern const Law kTwoQuadratic;
extern const Law kTwoSinh;
extern const Law kTwoSinhLinear;

}  // namespace vsa::elastic
