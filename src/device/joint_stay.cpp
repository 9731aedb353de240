// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Joints whose units' numbers stay in lanes between steps. The physics of all blocks is there or of none, and with it the loops of
// all their programs or of none; a block without lanes is one unit, which stays with its state.
#include <algorithm>
#include <limits>

#include "device/lanes/table.hpp"
#include "device/plain_ticks.hpp"
#include "vsa/device/joint_trials.hpp"
#include "vsa/device/unit.hpp"

namespace vsa::device {

/// Who has which block, and whether they may stay there.
void JointTrials::find_lodgings() noexcept {
  std::size_t used = 0;
  may_stay_ = false;
  for (std::size_t k = 0; k < groups_.size(); ++k) {
    Group& g = groups_[k];
    std::fill_n(&group_of_[g.first], g.count, k);
    if (g.lanes == nullptr) continue;
    may_stay_ = true;
    g.loop = &loop_memory_[used];
    used += lines(g.lanes->loop_bytes);
  }
  for (const Group& g : groups_) {
    // Who is by himself for now and could be beside others: then they are looked at anew in every step.
    const auto alike = [&](std::size_t i) { return joints_[i].unit == joints_[g.first].unit; };
    const bool beside = (g.first > 0 && alike(g.first - 1)) || (g.first + 1 < joints_.size() && alike(g.first + 1));
    if (g.lanes == nullptr && beside && joints_[g.first].unit->physics().has_lanes()) may_stay_ = false;
  }
}

/// Of every joint in lanes, by its group and its place there.
template <class Asked>
bool JointTrials::all_in_lanes(Asked&& asked) const noexcept {
  for (const Group& g : groups_)
    for (std::size_t l = 0; l < g.count && g.lanes != nullptr; ++l)
      if (!asked(g, l)) return false;
  return true;
}

/// Whether a step, begun by now, is one for the lanes.
bool JointTrials::all_usual() const noexcept {
  return all_in_lanes([this](const Group& g, std::size_t l) {
    const StepPlan& plan = *joints_[g.first + l].plan;
    return plan.whole && !plan.in.placed;
  });
}
bool JointTrials::all_driven() const noexcept {
  constexpr auto kDriven = drive::Terminal::driven;
  return all_in_lanes([this](const Group& g, std::size_t l) {
    return joints_[g.first + l].plan->held[0].terminal == std::array{kDriven, kDriven};
  });
}

/// Whether no program does more than hold its references. What is in lanes is asked no more.
bool JointTrials::all_plain(std::int64_t at_ns) const noexcept {
  for (const Group& g : groups_) {
    const unsigned here = loops_in_lanes_ ? g.opened : ~0U;
    for (std::size_t l = 0; l < g.count && g.lanes != nullptr && here != 0; ++l)
      if ((here >> l & 1U) != 0 && !joints_[g.first].unit->plain_ticks().plain(*joints_[g.first + l].state, at_ns)) return false;
  }
  return true;
}

/// Those that aren't there already. Lanes that nobody needs have the first one's.
void JointTrials::loops_to_lanes(Group& g) noexcept {
  const unsigned here = loops_in_lanes_ ? g.opened : ~0U;
  if (here == 0) return;
  for (std::size_t l = 0; l < static_cast<std::size_t>(g.lanes->width); ++l) {
    const std::size_t whose = l < g.count ? l : 0;
    if ((here >> whose & 1U) == 0) continue;
    const UnitState& s = *joints_[g.first + whose].state;
    g.lanes->put_loop(g.loop, static_cast<int>(l), s);
    for (std::size_t m = 0; m < 2; ++m) g.voltage[m][l] = s.held.voltage[m];
  }
  g.opened = 0;
}

/// The watchdogs count in the states; all of them are looked at when the first one's clock comes.
void JointTrials::run_clocks(std::int64_t at_ns) noexcept {
  if (at_ns < next_clock_ns_) return;
  next_clock_ns_ = std::numeric_limits<std::int64_t>::max();
  states_counted_ = true;
  for (const Group& g : groups_) {
    for (std::size_t i = g.first; i < g.first + g.count && g.lanes != nullptr; ++i) {
      firmware::Watchdog& watchdog = joints_[i].state->program.watchdog;
      watchdog.run_to(at_ns);
      next_clock_ns_ = std::min(next_clock_ns_, watchdog.next_clock_ns);
    }
  }
}

void JointTrials::tick(std::int64_t at_ns) noexcept {
  if (!in_lanes_) return;
  if (!all_usual() || !all_plain(at_ns)) return leave();
  if (!loops_in_lanes_) next_clock_ns_ = at_ns;
  for (Group& g : groups_) {
    if (g.lanes == nullptr) continue;
    loops_to_lanes(g);
    std::array<Row, 2> motor_angle, motor_speed;
    double *const angles[2] = {motor_angle[0].data(), motor_angle[1].data()}, *const speeds[2] = {motor_speed[0].data(),
                                                                                                  motor_speed[1].data()};
    g.lanes->motors(g.block, angles, speeds);
    Row angle{};
    for (std::size_t l = 0; l < static_cast<std::size_t>(g.lanes->width); ++l)
      angle[l] = joints_[g.first + (l < g.count ? l : 0)].plan->in.angle;
    TickStep io = joints_[g.first].unit->plain_ticks().common();
    io.angle = angle.data();
    for (std::size_t m = 0; m < 2; ++m) {
      io.motor_angle[m] = motor_angle[m].data();
      io.motor_speed[m] = motor_speed[m].data();
      io.voltage[m] = g.voltage[m].data();
    }
    g.lanes->tick(g.loop, io);
    g.shown = 0;
    for (std::size_t i = g.first; i < g.first + g.count; ++i) joints_[i].plan->ticked = true;
  }
  loops_in_lanes_ = true;
  run_clocks(at_ns);
}

void JointTrials::take_loop(const Group& g, std::size_t lane) const noexcept {
  UnitState& s = *joints_[g.first + lane].state;
  g.lanes->take_loop(g.loop, static_cast<int>(lane), s);
  for (std::size_t m = 0; m < 2; ++m) s.held.voltage[m] = g.voltage[m][lane];
}

void JointTrials::show(std::size_t joint) const noexcept {
  if (!in_lanes_) return;
  const Group& g = groups_[group_of_[joint]];
  const std::size_t lane = joint - g.first;
  if (g.lanes == nullptr || (g.shown >> lane & 1U) != 0) return;
  g.lanes->take(g.block, static_cast<int>(lane), *joints_[joint].state);
  if (loops_in_lanes_ && (g.opened >> lane & 1U) == 0) take_loop(g, lane);
  g.shown |= 1U << lane;
}

void JointTrials::show() const noexcept {
  for (std::size_t i = 0; i < joints_.size(); ++i) show(i);
}

void JointTrials::leave() noexcept {
  show();
  forget();
}

void JointTrials::forget() noexcept {
  in_lanes_ = loops_in_lanes_ = false;
  states_counted_ = true;
  for (Group& g : groups_) g.opened = g.shown = 0;
}

/// leave(), where a step may have begun with what a state held.
void JointTrials::go_home() noexcept {
  const bool held = loops_in_lanes_;
  leave();
  for (const Group& g : groups_) {
    for (std::size_t i = g.first; i < g.first + g.count && held && g.lanes != nullptr; ++i)
      joints_[i].plan->held[0] = joints_[i].state->held;
  }
}

void JointTrials::open(std::size_t joint) noexcept {
  if (!loops_in_lanes_) return;
  Group& g = groups_[group_of_[joint]];
  const std::size_t lane = joint - g.first;
  if (g.lanes == nullptr || (g.opened >> lane & 1U) != 0) return;
  if ((g.shown >> lane & 1U) == 0) take_loop(g, lane);
  g.opened |= 1U << lane;
}

void JointTrials::observe(std::size_t joint) noexcept {
  if (!in_lanes_) return;
  const Group& g = groups_[group_of_[joint]];
  if (g.lanes == nullptr) return;
  const ShaftMotion& to = joints_[joint].state->reached;
  g.lanes->observe(g.block, static_cast<int>(joint - g.first), to.angle, to.speed);
}

void JointTrials::keep() noexcept {
  kept_.in_lanes = in_lanes_;
  kept_.states_are_old = in_lanes_ && !states_counted_;
  states_counted_ = !in_lanes_;
  if (!in_lanes_) return;
  kept_.loops_in_lanes = loops_in_lanes_;
  kept_.may_stay = may_stay_;
  kept_.next_clock_ns = next_clock_ns_;
  kept_.groups.assign(groups_.begin(), groups_.end());
  for (const Group& g : groups_) {
    if (g.lanes == nullptr) continue;
    std::copy_n(g.block, lines(g.lanes->block_bytes), &kept_.blocks[static_cast<std::size_t>(g.block - memory_.data())]);
    if (loops_in_lanes_)
      std::copy_n(g.loop, lines(g.lanes->loop_bytes), &kept_.loops[static_cast<std::size_t>(g.loop - loop_memory_.data())]);
  }
}

bool JointTrials::in_kept(std::size_t joint) const noexcept {
  return kept_.states_are_old && kept_.groups[group_of_[joint]].lanes != nullptr;
}

void JointTrials::go_back() noexcept {
  forget();
  if (!kept_.in_lanes) return;
  in_lanes_ = true;
  loops_in_lanes_ = kept_.loops_in_lanes;
  may_stay_ = kept_.may_stay;
  next_clock_ns_ = kept_.next_clock_ns;
  groups_.assign(kept_.groups.begin(), kept_.groups.end());
  for (std::size_t k = 0; k < groups_.size(); ++k) {
    Group& g = groups_[k];
    std::fill_n(&group_of_[g.first], g.count, k);
    if (g.lanes == nullptr) continue;
    g.shown = 0;
    std::copy_n(&kept_.blocks[static_cast<std::size_t>(g.block - memory_.data())], lines(g.lanes->block_bytes), g.block);
    if (loops_in_lanes_)
      std::copy_n(&kept_.loops[static_cast<std::size_t>(g.loop - loop_memory_.data())], lines(g.lanes->loop_bytes), g.loop);
  }
}

}  // namespace vsa::device
