// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Kinematic loops: which joint of each is taken out of the tree and closes it (description::Joint::closes).
//
// The tree takes joints in this order, whatever the file's: first those with something that needs a coordinate (limits, damping, an
// actuator …), then those that start away from 0, then the others; of these fixed ones before hinges before balls, near the ground
// before far from it, then by name. Who comes too late closes a loop; one of the first is refused.
//
//   freedoms of a loop = Σ freedoms of its joints, the closing one among them, − rank of their twists
// where they are at 0: a loop without any is told.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "sdf/reading.hpp"

namespace vsa::reader {
namespace {

using Kind = Joint::Kind;

constexpr double kSameTwist = 1e-3;  // of one: axes in files are rounded

/// A link, or one more for the world, which static links are, too.
std::size_t node(const description::World& world, std::optional<std::size_t> link) {
  return link && !world.links[*link].is_static ? *link : world.links.size();
}

/// Which links hang together.
class Groups {
 public:
  explicit Groups(std::size_t nodes) : of_(nodes) { std::iota(of_.begin(), of_.end(), std::size_t{0}); }
  [[nodiscard]] std::size_t root(std::size_t i) const {
    while (of_[i] != i) i = of_[i];
    return i;
  }
  /// False: they did already.
  bool unite(std::size_t a, std::size_t b) {
    if (root(a) == root(b)) return false;
    of_[root(a)] = root(b);
    return true;
  }

 private:
  std::vector<std::size_t> of_;
};

/// A motion at unit speed: turning, and how the origin is carried along.
struct Twist {
  Vec3 turn, carry;
};
double dot(const Twist& a, const Twist& b) { return a.turn.Dot(b.turn) + a.carry.Dot(b.carry); }

std::size_t rank(std::vector<Twist> twists) {
  std::size_t out = 0;
  for (std::size_t i = 0; i < twists.size(); ++i) {
    const double length = std::sqrt(dot(twists[i], twists[i]));
    if (length < kSameTwist) continue;
    ++out;
    const Twist unit{twists[i].turn / length, twists[i].carry / length};
    for (std::size_t k = i + 1; k < twists.size(); ++k) {
      const double along = dot(twists[k], unit);
      twists[k].turn += unit.turn * -along;
      twists[k].carry += unit.carry * -along;
    }
  }
  return out;
}

class Loops {
 public:
  explicit Loops(Reading& c) : c_(c), world_(c.out), ground_(c.out.links.size()), groups_(ground_ + 1), tree_(ground_ + 1) {}

  void close() {
    std::vector<std::size_t> order(world_.joints.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const std::vector<std::size_t> depth = depths();
    const auto key = [&](std::size_t j) {
      const Joint& joint = world_.joints[j];
      const int needs = !needs_coordinate(j).empty() ? 0 : starts_away(joint) ? 1 : 2;
      const int kind = joint.kind == Kind::fixed ? 0 : joint.kind == Kind::ball ? 2 : 1;
      const auto [near, far] = std::minmax(depth[ends(j)[0]], depth[ends(j)[1]]);
      return std::tuple(needs, kind, near + far, std::cref(joint.name));
    };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const auto one = key(a), two = key(b);
      return std::tie(std::get<0>(one), std::get<1>(one), std::get<2>(one), std::get<3>(one).get()) <
             std::tie(std::get<0>(two), std::get<1>(two), std::get<2>(two), std::get<3>(two).get());
    });
    for (const std::size_t j : order) {
      const auto [a, b] = ends(j);
      if (a == b) continue;  // nothing of it moves: the engine's to refuse
      if (!groups_.unite(a, b)) {
        take_out(j);
        continue;
      }
      tree_[a].push_back({j, b});
      tree_[b].push_back({j, a});
    }
  }

 private:
  struct Step {
    std::size_t joint, to;
  };

  [[nodiscard]] std::array<std::size_t, 2> ends(std::size_t j) const {
    return {node(world_, world_.joints[j].parent), node(world_, world_.joints[j].child)};
  }
  static bool starts_away(const Joint& joint) { return joint.one_axis() && joint.axes[0].start.value_or(0) != 0; }

  /// Joints from the ground; what hangs in the air counts from its first link.
  [[nodiscard]] std::vector<std::size_t> depths() const {
    std::vector<std::vector<std::size_t>> next(ground_ + 1);
    for (std::size_t j = 0; j < world_.joints.size(); ++j) {
      const auto [a, b] = ends(j);
      next[a].push_back(b);
      next[b].push_back(a);
    }
    std::vector<std::size_t> out(ground_ + 1, ground_ + 1);
    const auto spread = [&](std::size_t from) {
      std::vector<std::size_t> open{from};
      out[from] = 0;
      for (std::size_t i = 0; i < open.size(); ++i)
        for (const std::size_t to : next[open[i]])
          if (out[to] > ground_) {
            out[to] = out[open[i]] + 1;
            open.push_back(to);
          }
    };
    spread(ground_);
    for (std::size_t l = 0; l < ground_; ++l)
      if (out[l] > ground_) spread(l);
    return out;
  }

  /// What it has that a joint without a coordinate can't have; empty: it may close a loop.
  [[nodiscard]] std::string needs_coordinate(std::size_t j) const {
    const Joint& joint = world_.joints[j];
    std::vector<std::string> out;
    const auto note = [&](bool has, const char* what) {
      if (has && std::find(out.begin(), out.end(), what) == out.end()) out.emplace_back(what);
    };
    note(joint.kind == Kind::slide, "a slide");
    note(joint.kind == Kind::universal, "two axes");
    for (const Axis& axis : joint.axes) {
      note(axis.range.has_value(), "limits");
      note(axis.damping > 0, "damping");
      note(axis.friction > 0, "friction");
      note(axis.stiffness > 0, "a spring");
    }
    for (const Coupling& k : world_.couplings) note(k.follower == j || k.leader == j, "a mimic");
    note(c_.driven.contains(joint.name), "an actuator");
    return fmt::format("{}", fmt::join(out, ", "));
  }

  /// The tree's joints between those two.
  [[nodiscard]] std::vector<std::size_t> path(std::size_t from, std::size_t to) const {
    std::vector<std::optional<Step>> back(ground_ + 1);
    std::vector<std::size_t> open{from};
    for (std::size_t i = 0; i < open.size() && !back[to]; ++i)
      for (const Step& s : tree_[open[i]])
        if (s.to != from && !back[s.to]) {
          back[s.to] = Step{s.joint, open[i]};
          open.push_back(s.to);
        }
    std::vector<std::size_t> out;
    for (std::size_t at = to; at != from; at = back[at]->to) out.push_back(back[at]->joint);
    return out;
  }

  void take_out(std::size_t j) {
    Joint& joint = world_.joints[j];
    std::vector<std::size_t> loop = path(ends(j)[0], ends(j)[1]);
    if (!c_.engine.loops)
      return c_.problems.add({c_.file, joint.name, "", "closes a kinematic loop: those aren't supported by " + c_.engine.engine,
                              "joints that form a tree"});
    if (const std::string has = needs_coordinate(j); !has.empty()) {
      std::vector<std::string> names{joint.name};
      for (const std::size_t k : loop) names.push_back(world_.joints[k].name);
      std::sort(names.begin(), names.end());
      return c_.problems.add({c_.file, joint.name, "", "closes a kinematic loop and has " + has,
                              fmt::format("one of {} that is revolute, ball or fixed and has no limits, damping, friction, spring, "
                                          "mimic and actuator",
                                          fmt::join(names, ", "))});
    }
    joint.closes = true;
    for (const std::size_t k : loop)
      if (world_.joints[k].kind != Kind::fixed) world_.joints[k].held.push_back("the loop that " + joint.name + " closes");
    loop.push_back(j);
    if (is_stuck(loop)) c_.notes.add("kinematic loops that can't move hold their links still", joint.name);
  }

  [[nodiscard]] bool is_stuck(const std::vector<std::size_t>& loop) const {
    Vec3 centre;
    double size = 0;
    for (const std::size_t j : loop) centre += world_.joints[j].pose.Pos() / static_cast<double>(loop.size());
    for (const std::size_t j : loop) size = std::max(size, (world_.joints[j].pose.Pos() - centre).Length());
    std::vector<Twist> twists;
    for (const std::size_t j : loop) {
      const Joint& joint = world_.joints[j];
      const Vec3 at = size > 0 ? (joint.pose.Pos() - centre) / size : Vec3();
      std::vector<Vec3> axes;
      for (const Axis& a : joint.axes) axes.push_back(a.xyz);
      if (joint.kind == Kind::ball) axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      for (const Vec3& axis : axes) twists.push_back(joint.kind == Kind::slide ? Twist{{}, axis} : Twist{axis, at.Cross(axis)});
    }
    return !twists.empty() && rank(twists) == twists.size();
  }

  Reading& c_;
  description::World& world_;
  std::size_t ground_;
  Groups groups_;
  std::vector<std::vector<Step>> tree_;
};

}  // namespace

bool in_loop(const description::World& world, std::size_t joint) {
  Groups groups(world.links.size() + 1);
  const auto unite = [&](const Joint& j) { return groups.unite(node(world, j.parent), node(world, j.child)); };
  for (std::size_t j = 0; j < world.joints.size(); ++j)
    if (j != joint) unite(world.joints[j]);
  return !unite(world.joints[joint]);
}

void close_loops(Reading& c) {
  Loops(c).close();
  for (const TurnedJoint& t : c.turned) {
    const Joint& joint = c.out.joints[t.joint];
    if (!joint.closes)
      c.problems.add({t.file, t.key, "", fmt::format("joint {} can't start turned: it isn't one with one axis", joint.name),
                      "links' poses that leave it as the model has it"});
  }
}

}  // namespace vsa::reader
