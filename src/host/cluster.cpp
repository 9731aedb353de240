// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "host/cluster.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "host/state.hpp"

namespace vsa::host {
namespace {

constexpr double kNotTold = std::numeric_limits<double>::quiet_NaN();

/// Groups of buses by the trees between them.
std::vector<std::size_t> group_buses(const ClusterParts& parts) {
  std::vector<std::size_t> group(parts.buses.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  const auto together = [&](const std::vector<std::size_t>& actuators) {
    for (const std::size_t a : actuators) {
      const std::size_t from = group[parts.bus_of[a]], to = group[parts.bus_of[actuators.front()]];
      std::replace(group.begin(), group.end(), std::max(from, to), std::min(from, to));
    }
  };
  for (const auto& tree : parts.trees) together(tree);
  together(parts.shared);
  return group;
}

/// Buses whose joints all move alone go together until their units fill the lanes.
void fill_lanes(std::vector<std::vector<BusLine*>>& buses, std::vector<std::vector<Tree>>& trees,
                const std::vector<std::vector<SharedJoint>>& shared) {
  constexpr std::size_t kLanes = 8, kMost = 64;
  const std::size_t none = buses.size();
  std::size_t into = none;
  for (std::size_t g = 0; g < buses.size(); ++g) {
    const bool alone = std::all_of(trees[g].begin(), trees[g].end(), [](const Tree& t) { return t.joints.size() == 1; });
    const bool client = std::any_of(buses[g].begin(), buses[g].end(), [](BusLine* bus) { return bus->port() != nullptr; });
    if (!alone || client || trees[g].empty() || !shared[g].empty()) continue;
    if (into != none && trees[into].size() + trees[g].size() <= kMost) {
      buses[into].insert(buses[into].end(), buses[g].begin(), buses[g].end());
      std::move(trees[g].begin(), trees[g].end(), std::back_inserter(trees[into]));
      buses[g].clear();
      trees[g].clear();
    } else {
      into = g;
    }
    if (trees[into].size() % kLanes == 0) into = none;
  }
}

Tree make_tree(const ClusterParts& parts, std::vector<std::size_t> actuators) {
  Tree tree(actuators.size());
  for (const std::size_t a : actuators) tree.joints.push_back(parts.joints[a]);
  tree.actuators = std::move(actuators);
  tree.scratch.resize(tree.actuators.size() * tree.actuators.size());
  tree.torques.resize(tree.actuators.size());
  return tree;
}

}  // namespace

bool has_ticks_inside(std::int64_t t_ns, std::int64_t dt_ns) noexcept {
  return device::Unit::first_tick_ns(t_ns + 1) < t_ns + dt_ns;
}

bool is_usable(std::span<const double> matrix, std::size_t n) noexcept {
  for (std::size_t i = 0; i < n; ++i)
    if (!(matrix[i * n + i] > 0 && matrix[i * n + i] <= kMostMobility)) return false;
  return true;
}

double own_mobility(const device::Unit& unit, const JointIn& joint) noexcept {
  return joint.inverse_inertia ? *joint.inverse_inertia : 1.0 / unit.config().actuator.shaft_inertia_kgm2;
}

void begin_step(const device::JointInStep& j, const JointIn& in, double inverse_inertia, std::int64_t t_ns,
                std::int64_t dt_ns) noexcept {
  j.unit->begin_step(*j.state, *j.plan, t_ns, dt_ns,
                     {in.angle_rad, in.speed_rad_per_s, std::max(inverse_inertia, in.inverse_inertia.value_or(0.0)), in.placed,
                      in.free_acceleration_rad_per_s2.value_or(kNotTold)});
}

std::vector<Cluster> make_clusters(const ClusterParts& parts) {
  const std::vector<std::size_t> group = group_buses(parts);
  std::vector<std::vector<BusLine*>> buses(parts.buses.size());
  std::vector<std::vector<Tree>> trees(parts.buses.size());
  for (std::size_t b = 0; b < parts.buses.size(); ++b) buses[group[b]].push_back(parts.buses[b]);
  std::vector<bool> taken(parts.joints.size());
  std::vector<std::vector<SharedJoint>> shared(parts.buses.size());
  for (const std::size_t a : parts.shared) {
    taken[a] = true;
    shared[group[parts.bus_of[a]]].push_back({parts.joints[a], a});
  }
  std::size_t at = 0, index = 0;
  for (const auto& joined : parts.trees) {
    ++index;
    if (joined.empty()) continue;
    for (const std::size_t a : joined) taken[a] = true;
    Tree tree = make_tree(parts, joined);
    tree.joined = true;
    tree.mobility_at = at;
    tree.index = index - 1;
    at += joined.size() * joined.size();
    trees[group[parts.bus_of[joined.front()]]].push_back(std::move(tree));
  }
  // In the order in which the bus has them, which is that of their plans.
  for (const BusLine* bus : parts.buses) {
    for (const BusMember& m : bus->members())
      if (!taken[m.index]) trees[group[parts.bus_of[m.index]]].push_back(make_tree(parts, {m.index}));
  }
  fill_lanes(buses, trees, shared);
  std::vector<Cluster> out;
  for (std::size_t g = 0; g < buses.size(); ++g)
    if (!buses[g].empty()) out.emplace_back(std::move(buses[g]), std::move(trees[g]), std::move(shared[g]));
  return out;
}

Cluster::Cluster(std::vector<BusLine*> buses, std::vector<Tree> trees, std::vector<SharedJoint> shared)
    : buses_(std::move(buses)),
      trees_(std::move(trees)),
      lone_at_(static_cast<std::size_t>(
          std::stable_partition(trees_.begin(), trees_.end(), [](const Tree& t) { return t.joints.size() > 1; }) - trees_.begin())),
      lone_torques_(trees_.size() - lone_at_),
      lone_trials_(lone_torques_.size(), 0),
      shared_(std::move(shared)) {
  for (std::size_t k = lone_at_; k < trees_.size(); ++k) {
    const Tree& tree = trees_[k];
    lone_.push_back(tree.joints.front());
    lone_from_.push_back({tree.actuators.front(), tree.joined ? std::optional(tree.mobility_at) : std::nullopt});
  }
  find_whole();
}

void Cluster::use(std::span<device::StepPlan> plans) noexcept {
  std::size_t next = 0;
  for (BusLine* bus : buses_) {
    next = bus->use(plans, next);
    for (BusMember& m : bus->members()) m.trials = nullptr;  // those of the clusters before
  }
  const auto find_plan = [this](device::JointInStep& joint) {
    for (const BusLine* bus : buses_) {
      for (const BusMember& m : bus->members())
        if (&m.slot->unit == joint.state) joint.plan = m.plan;
    }
  };
  for (Tree& tree : trees_) std::for_each(tree.joints.begin(), tree.joints.end(), find_plan);
  for (SharedJoint& shared : shared_) find_plan(shared.joint);
  for (std::size_t k = 0; k < lone_.size(); ++k) lone_[k] = trees_[lone_at_ + k].joints.front();
  // A client looks at its bus's units when it likes.
  if (std::any_of(buses_.begin(), buses_.end(), [](BusLine* bus) { return bus->port() != nullptr; })) return;
  settle_in(lone_trials_, lone_);
  for (Tree& tree : std::span(trees_).first(lone_at_)) settle_in(tree.solver.trials(), tree.joints);
}

void Cluster::settle_in(device::JointTrials& trials, std::span<const device::JointInStep> joints) {
  trials.stay(joints);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    for (BusLine* bus : buses_) {
      for (BusMember& m : bus->members())
        if (&m.slot->unit == joints[i].state) m.trials = &trials, m.joint = i;
    }
  }
}

void Cluster::exchange(std::span<const std::shared_ptr<device::Unit>> units) noexcept {
  for (Tree& tree : trees_)
    for (std::size_t i = 0; i < tree.joints.size(); ++i) tree.joints[i].unit = units[tree.actuators[i]].get();
  for (SharedJoint& shared : shared_) shared.joint.unit = units[shared.actuator].get();
  for (std::size_t k = 0; k < lone_.size(); ++k) lone_[k].unit = units[lone_from_[k].actuator].get();
  find_whole();
}

void Cluster::find_whole() noexcept {
  whole_ns_ = std::numeric_limits<std::int64_t>::max();
  for (const Tree& tree : trees_)
    for (const device::JointInStep& joint : tree.joints) whole_ns_ = std::min(whole_ns_, joint.unit->substep_ns());
}

template <class Does>
void Cluster::for_each_trials(Does&& does) noexcept {
  does(lone_trials_);
  for (Tree& tree : std::span(trees_).first(lone_at_)) does(tree.solver.trials());
}

void Cluster::leave() noexcept {
  for_each_trials([](device::JointTrials& t) { t.leave(); });
}
void Cluster::forget() noexcept {
  for_each_trials([](device::JointTrials& t) { t.forget(); });
}

void Cluster::keep() noexcept {
  for_each_trials([](device::JointTrials& t) { t.keep(); });
}
void Cluster::go_back() noexcept {
  for_each_trials([](device::JointTrials& t) { t.go_back(); });
}

void Cluster::tick(std::int64_t at_ns) noexcept {
  for (BusLine* bus : buses_) bus->run_line(at_ns);
  for_each_trials([at_ns](device::JointTrials& t) { t.tick(at_ns); });
  for (BusLine* bus : buses_) bus->tick(at_ns);
}

void Cluster::begin_tree(Tree& tree, std::int64_t t_ns, std::int64_t dt_ns, std::span<const JointIn> in,
                         std::span<const double> mobility) noexcept {
  const std::size_t n = tree.joints.size();
  std::span<const double> matrix = tree.scratch;
  const bool given = tree.joined && !mobility.empty() && is_usable(mobility.subspan(tree.mobility_at, n * n), n);
  if (given) {
    matrix = mobility.subspan(tree.mobility_at, n * n);
  } else {
    for (std::size_t i = 0; i < n; ++i) tree.scratch[i * n + i] = own_mobility(*tree.joints[i].unit, in[tree.actuators[i]]);
  }
  tree.solver.set(matrix, dt_ns);
  for (std::size_t i = 0; i < n; ++i) begin_step(tree.joints[i], in[tree.actuators[i]], matrix[i * n + i], t_ns, dt_ns);
}

/// A joint alone is solved by its unit; its tree, which would have to be fetched from far where there are a thousand, isn't asked.
void Cluster::begin_lone(std::int64_t t_ns, std::int64_t dt_ns, std::span<const JointIn> in,
                         std::span<const double> mobility) noexcept {
  for (std::size_t k = 0; k < lone_.size(); ++k) {
    const device::JointInStep& joint = lone_[k];
    const LoneFrom& from = lone_from_[k];
    const bool given = from.mobility_at && !mobility.empty() && is_usable(mobility.subspan(*from.mobility_at, 1), 1);
    begin_step(joint, in[from.actuator], given ? mobility[*from.mobility_at] : own_mobility(*joint.unit, in[from.actuator]), t_ns,
               dt_ns);
  }
}

std::size_t Cluster::advance(std::int64_t t_ns, std::int64_t dt_ns, std::span<const JointIn> in, std::span<double> torques_out,
                             std::span<const double> mobility, device::Holder* holder) noexcept {
  begin(t_ns, dt_ns, in, mobility, holder);
  run(t_ns, dt_ns);
  return end(t_ns + dt_ns, torques_out, holder);
}

/// Then none of its joints goes in the lanes of those that move alone.
bool Cluster::is_held(const device::Holder* holder) const noexcept {
  return holder != nullptr &&
         std::any_of(trees_.begin(), trees_.end(), [&](const Tree& t) { return t.joined && holder->holds(t.index); });
}

void Cluster::begin(std::int64_t t_ns, std::int64_t dt_ns, std::span<const JointIn> in, std::span<const double> mobility,
                    const device::Holder* holder) noexcept {
  const bool foresees = has_ticks_inside(t_ns, dt_ns), by_trees = foresees || is_held(holder);
  if (by_trees || dt_ns > whole_ns_) leave();
  for (Tree& tree : std::span(trees_).first(by_trees ? trees_.size() : lone_at_)) begin_tree(tree, t_ns, dt_ns, in, mobility);
  if (!by_trees) begin_lone(t_ns, dt_ns, in, mobility);
  if (!foresees) return;
  for (Tree& tree : trees_) tree.solver.predict(tree.joints);
}

void Cluster::run(std::int64_t t_ns, std::int64_t dt_ns) noexcept {
  for (std::int64_t at = device::Unit::first_tick_ns(t_ns); at < t_ns + dt_ns; at += firmware::kTickNs) tick(at);
}

std::size_t Cluster::end(std::int64_t end_ns, std::span<double> torques_out, device::Holder* holder) noexcept {
  const bool held = is_held(holder);
  std::size_t unsettled = held ? 0 : lone_trials_.solve_each(lone_, lone_torques_);
  for (std::size_t k = 0; !held && k < lone_.size(); ++k) torques_out[lone_from_[k].actuator] = lone_torques_[k];
  for (Tree& tree : std::span(trees_).first(held ? trees_.size() : lone_at_)) {
    device::Holder* const of_it = held && tree.joined && holder->holds(tree.index) ? holder : nullptr;
    if (!tree.solver.solve(tree.joints, tree.torques, of_it, tree.index)) unsettled += tree.joints.size();
    for (std::size_t i = 0; i < tree.joints.size(); ++i) torques_out[tree.actuators[i]] = tree.torques[i];
  }
  for (BusLine* bus : buses_) bus->end(end_ns);
  return unsettled;
}

}  // namespace vsa::host
