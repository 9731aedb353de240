// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The robots of one model in Gazebo: an arm and the hand nested in it may have a plug-in each, and still be one kinematic tree. Gazebo
// calls the plug-ins one after the other, before its step; whichever comes first steps them all (seat/seat_group.hpp), the others find
// it done.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "vsa/seat/driven_tree.hpp"
#include "vsa/seat/seat_group.hpp"

namespace vsa::plugins {

/// Links as trees of bodies, for the mobility of driven joints and what else moves them, which no Gazebo tells.
class LinkTrees {
 public:
  virtual ~LinkTrees() = default;
  /// Where the links are now.
  virtual void look() = 0;
  /// Where joints without actuators are, into tree_.
  virtual void feel() = 0;
  /// False: some of the links are gone, with a model nested in this one; then the trees are found anew.
  [[nodiscard]] virtual bool are_there() const { return true; }
  /// Of driven joints that move each other; none where the links aren't trees of hinges, sliders and fixed joints.
  [[nodiscard]] const std::vector<std::vector<std::size_t>>& trees() const noexcept { return tree_.trees(); }
  /// B of one of them, as of the last look().
  void mobility(std::size_t tree, std::span<double> out) noexcept { tree_.mobility(tree, out); }
  /// How far those without actuators have turned (seat::DrivenTree::turned_rad); before foresee().
  [[nodiscard]] double turned_rad() {
    feel();
    return tree_.turned_rad();
  }
  /// Tells the driven joints how they are accelerated by all else (seat::DrivenTree::foresee).
  void foresee(std::span<host::JointIn* const> driven, double dt_s) { tree_.foresee(driven, dt_s); }
  void forget() noexcept { tree_.forget(); }

 protected:
  seat::DrivenTree tree_;
};

/// A plug-in's robot, as the others of its model see it.
class ModelRobot {
 public:
  using Joints = std::vector<std::uint64_t>;  ///< as the host numbers them
  enum class Links { of_own_model, of_outermost_model };

  virtual ~ModelRobot() = default;
  [[nodiscard]] virtual seat::Seat* seat() noexcept = 0;  ///< null: loading failed; such a robot isn't added
  /// Of its actuators.
  [[nodiscard]] virtual const Joints& driven() const noexcept = 0;
  [[nodiscard]] virtual std::unique_ptr<LinkTrees> link_trees(Links links, const Joints& driven) = 0;
  virtual void tell(std::int64_t time_ns) = 0;  ///< before a step: where its joints are, into seat()->in()
  virtual void apply() = 0;                     ///< after it: seat()->torques() to the host
};

/// Of one outermost model.
class ModelRobots {
 public:
  /// Those of a model that is known by this key; they live as long as one of them holds them. From any thread.
  [[nodiscard]] static std::shared_ptr<ModelRobots> of(const seat::JointKey& model);

  /// From then on it steps with the others, until remove().
  void add(ModelRobot& robot);
  void remove(ModelRobot& robot);
  /// Steps all, but where another has done so since this one asked last.
  void step(const ModelRobot& asking, std::int64_t time_ns, std::int64_t dt_ns);
  /// The trees are found anew: a robot's joints are others than they were.
  void find_anew() noexcept { joined_ = false; }
  /// The next step is the first: after a reset.
  void forget() noexcept;

  /// For hosts with threads: held by whoever uses a robot of the model.
  [[nodiscard]] std::mutex& mutex() noexcept { return mutex_; }

 private:
  struct Member {
    ModelRobot* robot = nullptr;
    bool stepped = false;  ///< by another
  };
  struct Links {
    std::unique_ptr<LinkTrees> trees;
    std::size_t first, count;  ///< which of all driven joints are theirs
  };
  struct Tree {
    LinkTrees* links;
    std::size_t tree;  ///< of those
  };
  void join();
  void take(Links links, seat::SeatGroup::Trees& trees);
  void foresee(double dt_s);

  std::mutex mutex_;
  std::vector<Member> members_;
  std::vector<Links> links_;
  std::vector<Tree> trees_;
  std::vector<host::JointIn*> in_;  ///< of all driven joints
  seat::SeatGroup group_;
  bool joined_ = false;
};

}  // namespace vsa::plugins
