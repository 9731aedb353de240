// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "frank.hpp"

namespace vsa::engine {

/// Where the baton's middle is in a hand's own frame: what slipping changes.
inline std::array<double, 3> baton_in_hand(const World& w, const std::string& forearm) {
  const Pose hand = pose(w, forearm), baton = pose(w, "baton::link");
  Pose back = hand;
  for (std::size_t i = 1; i < 4; ++i) back.quaternion[i] = -back.quaternion[i];
  return turned(back,
                {baton.position[0] - hand.position[0], baton.position[1] - hand.position[1], baton.position[2] - hand.position[2]});
}

/// Sum of the forces' sizes between the baton and a model or link whose scoped name begins so.
inline double grip_N(const World& w, const std::string& begins) {
  std::vector<Contact> contacts;
  w.contacts(contacts);
  double sum = 0;
  for (const Contact& c : contacts) {
    const std::string& a = w.links()[c.link].name;
    const std::string& b = w.links()[c.other].name;
    if (a != "baton::link" && b != "baton::link") continue;
    if (a.rfind(begins, 0) != 0 && b.rfind(begins, 0) != 0) continue;
    sum += std::hypot(c.force_N[0], c.force_N[1], c.force_N[2]);
  }
  return sum;
}

inline double baton_lean_rad(const World& w) { return std::acos(std::min(1.0, turned(pose(w, "baton::link"), {0, 0, 1})[2])); }

}  // namespace vsa::engine
