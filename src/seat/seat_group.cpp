// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/seat/seat_group.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "vsa/errors.hpp"
#include "vsa/grouped.hpp"

namespace vsa::seat {
namespace {

using Place = host::RobotGroup::Joint;

std::vector<Place> places_of(const std::vector<Seat*>& seats) {
  std::vector<Place> out;
  for (std::size_t r = 0; r < seats.size(); ++r)
    for (std::size_t i = 0; i < seats[r]->in().size(); ++i) out.push_back({r, i});
  return out;
}

void check(const SeatGroup::Trees& trees, std::size_t actuators) {
  Problems problems;
  std::vector<bool> seen(actuators);
  for (const auto& tree : trees) {
    for (const std::size_t k : tree) {
      if (k >= actuators || seen[k])
        problems.add({"", "tree", std::to_string(k), k < actuators ? "is in a tree already" : "no such actuator",
                      "each number below " + std::to_string(actuators) + " once"});
      if (k < actuators) seen[k] = true;
    }
  }
  problems.throw_if_any();
}

/// Seats by those that have a tree in common, through others, too.
std::vector<std::vector<std::size_t>> tied(std::size_t seats, const std::vector<std::vector<Place>>& trees) {
  std::vector<int> mark(seats);
  std::iota(mark.begin(), mark.end(), 0);
  for (const auto& tree : trees) {
    for (const Place& place : tree) {
      const int a = mark[place.robot], b = mark[tree.front().robot];
      std::replace(mark.begin(), mark.end(), std::max(a, b), std::min(a, b));
    }
  }
  return grouped(mark);
}

}  // namespace

SeatGroup::SeatGroup(std::vector<Seat*> seats, const Trees& trees) : seats_(std::move(seats)), own_(seats_.size()) {
  const std::vector<Place> all = places_of(seats_);
  check(trees, all.size());
  std::vector<std::vector<Place>> places;
  for (const auto& tree : trees) {
    places.emplace_back();
    for (const std::size_t k : tree) places.back().push_back(all[k]);
    sizes_.push_back(tree.size() * tree.size());
  }
  for (const std::vector<std::size_t>& members : tied(seats_.size(), places)) {
    const auto at = [&](std::size_t seat) {
      return static_cast<std::size_t>(std::find(members.begin(), members.end(), seat) - members.begin());
    };
    std::vector<Trees> own(members.size());
    std::vector<std::size_t> common;
    std::vector<std::vector<Place>> common_places;
    for (std::size_t t = 0; t < places.size(); ++t) {
      if (places[t].empty() || at(places[t].front().robot) == members.size()) continue;
      const std::size_t first = places[t].front().robot;
      if (std::all_of(places[t].begin(), places[t].end(), [&](const Place& p) { return p.robot == first; })) {
        own_[first].push_back(t);
        own[at(first)].emplace_back();
        for (const Place& p : places[t]) own[at(first)].back().push_back(p.actuator);
      } else {
        common.push_back(t);
        common_places.emplace_back();
        for (const Place& p : places[t]) common_places.back().push_back({at(p.robot), p.actuator});
      }
    }
    host::RobotGroup group(members.size(), std::move(common_places));
    for (std::size_t i = 0; i < members.size(); ++i) seats_[members[i]]->join(own[i], group.shared(i));
    if (members.size() == 1) {
      alone_.push_back(members.front());
    } else {
      together_.push_back({members, {}, std::move(group), std::move(common)});
      together_.back().parts.reserve(members.size());
      for (const std::size_t r : members) together_.back().seats.push_back(seats_[r]);
    }
  }
}

SeatGroup SeatGroup::another(const std::vector<Seat*>& seats) const {
  if (seats.size() != seats_.size())
    throw InputError(
        Problem{"", "seats", std::to_string(seats.size()), "one for each of the group's", std::to_string(seats_.size())});
  SeatGroup out;
  out.seats_ = seats;
  out.own_ = own_;
  out.alone_ = alone_;
  out.sizes_ = sizes_;
  for (const Together& t : together_) {
    out.together_.push_back({t.members, {}, t.group.another(), t.trees});
    out.together_.back().parts.reserve(t.members.size());
    for (const std::size_t r : t.members) out.together_.back().seats.push_back(seats[r]);
  }
  return out;
}

void SeatGroup::fill(const std::vector<std::size_t>& trees, std::span<double> out, const Mobility& mobility) const {
  for (const std::size_t t : trees) {
    mobility(t, out.first(sizes_[t]));
    out = out.subspan(sizes_[t]);
  }
}

void SeatGroup::update(const Mobility& mobility) {
  for (std::size_t r = 0; r < seats_.size(); ++r)
    if (seats_[r]->wants_mobility()) fill(own_[r], seats_[r]->mobility(), mobility);
  for (Together& t : together_) fill(t.trees, t.group.mobility(), mobility);
}

void SeatGroup::step(std::int64_t dt_ns, device::Holder* holder) {
  for (const std::size_t r : alone_) seats_[r]->step(dt_ns, Part(holder, own_[r]).get());
  for (Together& t : together_) {
    t.parts.clear();
    for (const std::size_t r : t.members) t.parts.emplace_back(holder, own_[r]);
    for (std::size_t i = 0; i < t.parts.size(); ++i) t.group.steps()[i].holder = t.parts[i].get();
    Seat::step_together(t.seats, t.group, dt_ns, Part(holder, t.trees).get());
  }
}

}  // namespace vsa::seat
