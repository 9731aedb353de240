// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The robots of one host. Those whose joints move each other, an arm and the hand at its end, step together; the others by themselves.
//
//   SeatGroup group({&arm, &hand}, {{0, 1, 2}});     the arm's actuators 0 and 1, the hand's first: one tree
//   every step: fill each seat's in(), then group.update(…), group.step(dt_ns)
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "vsa/host/robot_group.hpp"
#include "vsa/seat/seat.hpp"

namespace vsa::seat {

/// Seats that one host steps.
class SeatGroup {
 public:
  /// Which actuators move each other, those of all seats numbered through, seat after seat: {{0, 2}, {1}}.
  using Trees = std::vector<std::vector<std::size_t>>;
  /// Fills B of a tree, of which this is the index, by rows, 1/(kg·m²).
  using Mobility = std::function<void(std::size_t tree, std::span<double> out)>;

  SeatGroup() = default;
  /// Joins the seats (Seat::join), which outlive the group. Throws InputError for an actuator that there isn't or that is in two
  /// trees.
  SeatGroup(std::vector<Seat*> seats, const Trees& trees);
  /// Of clones of the seats, in the same order; throws InputError for another number of them.
  [[nodiscard]] SeatGroup another(const std::vector<Seat*>& seats) const;

  /// Once before each step, when the seats' in() are filled. `mobility` is asked where B is due: that of a tree that several seats
  /// drive each time.
  void update(const Mobility& mobility);
  /// Seat::step of all, after update(). Of seats that step together all stop where one does. `holder`: of the group's trees.
  void step(std::int64_t dt_ns, device::Holder* holder = nullptr);

 private:
  /// Some of a holder's trees, numbered as somebody else has them.
  class Part final : public device::Holder {
   public:
    Part(device::Holder* all, const std::vector<std::size_t>& trees) noexcept : all_(all), trees_(&trees) {}
    [[nodiscard]] device::Holder* get() noexcept { return all_ == nullptr ? nullptr : this; }
    [[nodiscard]] bool holds(std::size_t tree) const noexcept override { return all_->holds((*trees_)[tree]); }
    bool holds_else(std::size_t tree, std::span<const double> torques, std::span<double> accelerations,
                    std::span<double> mobility) noexcept override {
      return all_->holds_else((*trees_)[tree], torques, accelerations, mobility);
    }

   private:
    device::Holder* all_;
    const std::vector<std::size_t>* trees_;
  };
  /// Seats that have trees in common.
  struct Together {
    std::vector<std::size_t> members;  ///< into seats_
    std::vector<Seat*> seats;          ///< those
    host::RobotGroup group;            ///< in this order
    std::vector<std::size_t> trees;    ///< of the group
    std::vector<Part> parts{};         ///< of each seat, in the step under way
  };
  void fill(const std::vector<std::size_t>& trees, std::span<double> out, const Mobility& mobility) const;

  std::vector<Seat*> seats_;
  std::vector<std::vector<std::size_t>> own_;  ///< of each seat: the trees that no other drives
  std::vector<std::size_t> alone_;             ///< seats that step by themselves
  std::vector<Together> together_;
  std::vector<std::size_t> sizes_;  ///< of B of each tree
};

}  // namespace vsa::seat
