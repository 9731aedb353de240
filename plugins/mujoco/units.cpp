// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "units.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include "bind.hpp"
#include "versions.hpp"
#include "vsa/actuator/heat.hpp"
#include "vsa/config/faults_text.hpp"
#include "vsa/device/holder.hpp"
#include "vsa/errors.hpp"
#include "vsa/physics/dofs_beside.hpp"
#include "vsa/physics/reach.hpp"
#include "vsa/seat/stiff_trees.hpp"

namespace vsa::mujoco {
namespace {

std::vector<UnitSpec> specs_of(const std::vector<Unit>& units) {
  std::vector<UnitSpec> out;
  for (const Unit& u : units) out.push_back(u.spec);
  return out;
}

std::unique_ptr<seat::Seat> make_seat(std::span<const UnitSpec> specs, const std::vector<seat::Joint>& joints,
                                      const config::TypeLibrary& library) {
  std::vector<std::string> names;
  for (const seat::Joint& j : joints) names.push_back(j.name);
  return std::make_unique<seat::Seat>(seat::Model{"", "vsasim.unit", "", joints, robot_of(specs, names, library)},
                                      seat::Options{library, {}, {}, false, false});
}

/// Checked when the model is loaded, given to the units at the first step.
device::Faults faults_of(const UnitSpec& spec) { return config::read_faults(spec.get("faults"), where(spec) + ": faults"); }

bool is_broken(const UnitSpec& spec) { return !spec.get("faults").empty(); }

// In a state.
constexpr std::size_t kCount = 0, kBegun = 1, kTaken = 2;
/// Behind kTaken two numbers a unit, then two a degree of freedom: what pushed it, all of the first before all of the second.
std::size_t head(std::size_t units, std::size_t dofs) { return kTaken + 2 * units + 2 * dofs; }

/// What a state has at most.
std::size_t size_of(const seat::Seat& seat, std::size_t units, std::size_t dofs) {
  std::size_t out = head(units, dofs);
  const StateLayout layout = seat.state_layout();
  for (const StateEntry& e : layout.entries())
    if (e.name.find(".knot[") == std::string::npos) out += e.count;
  return out;
}

void put(std::span<const double> now, std::span<double> state) {
  if (now.size() > state.size())
    throw InputError({"vsasim.unit", "state", std::to_string(now.size()) + " numbers", "is more than there is room for",
                      "up to " + std::to_string(state.size()) + ": no trajectories"});
  const double before = state[kCount], most = static_cast<double>(state.size());
  std::copy(now.begin(), now.end(), state.begin());
  const std::span<double> rest = state.first(before >= 0 && before <= most ? static_cast<std::size_t>(before) : state.size());
  if (rest.size() > now.size()) std::fill(rest.begin() + static_cast<std::ptrdiff_t>(now.size()), rest.end(), 0.0);
}

std::int64_t step_ns(const mjModel& m) { return std::llround(m.opt.timestep * 1e9); }

}  // namespace

Units::Units(const mjModel& m, std::vector<Unit> units) : units_(std::move(units)), dofs_(static_cast<std::size_t>(m.nv)) {
  const std::vector<UnitSpec> specs = specs_of(units_);
  const config::TypeLibrary library = library_for(specs);
  Problems problems;
  check_options(m, problems);
  std::vector<int> ids;
  std::vector<seat::Joint> joints;
  for (const Unit& u : units_) {
    try {
      const config::ActuatorType type = type_of(u.spec, library);
      volts_.push_back(type.unit.is(control::ServoKind::motor_voltages));
      const int id = joint_of(m, u, controls_of(type), problems);
      if (id < 0) continue;
      ids.push_back(id);
      joints_.push_back({id, m.jnt_qposadr[id], m.jnt_dofadr[id], m.qpos0[m.jnt_qposadr[id]]});
      joints.push_back({joint_name(m, id), {}, {}, joints_.back().start, m.jnt_type[id] == mjJNT_SLIDE});
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
  problems.throw_if_any();
  seat_ = make_seat(specs, joints, library);
  size_ = state_size(specs, dofs_);
  for (const Joint& joint : joints_) driven_.push_back(joint.v);
  trees_ = trees_of(m, ids);
  std::vector<char> stiff;
  for (std::size_t i = 0; i < joints_.size(); ++i)
    stiff.push_back(seat::may_be_stiff(seat_->robot(), i, m.dof_invweight0[joints_[i].v]) ? 1 : 0);
  seat::join_stiff_trees(trees_, stiff, physics::Reach(m).neighbours(driven_));
  for (const auto& tree : trees_) {
    tree_dofs_.emplace_back();
    for (const std::size_t i : tree) tree_dofs_.back().push_back(joints_[i].v);
  }
  beside_ = physics::dofs_beside(m, driven_);
  alone_.resize(driven_.size());
  last_.resize(driven_.size());
  more_.resize(driven_.size());
  mobility_ = Mobility(m);
  seat_->join(trees_);
  for (std::size_t i = 0; i < units_.size(); ++i) {
    if (is_broken(specs[i])) seat_->robot().set_faults(i, faults_of(specs[i]));  // throws here what no unit of that type can have
  }
  here_ = state::Rewriter(head(units_.size(), dofs_), seat_->state_size());
  note();
  first_.assign(here_.numbers().begin(), here_.numbers().end());
}

Units::Units(const Units& other, std::unique_ptr<seat::Seat> seat)
    : units_(other.units_),
      dofs_(other.dofs_),
      joints_(other.joints_),
      volts_(other.volts_),
      trees_(other.trees_),
      tree_dofs_(other.tree_dofs_),
      driven_(other.driven_),
      alone_(other.alone_),
      last_(other.last_),
      more_(other.more_),
      beside_(other.beside_),
      seat_(std::move(seat)),
      size_(other.size_),
      mobility_(other.mobility_),
      here_(head(units_.size(), dofs_), seat_->state_size()),
      there_(true),
      first_(other.first_) {
  here_.assign(first_);
}

Units::~Units() = default;

std::unique_ptr<Units> Units::clone() const { return std::unique_ptr<Units>(new Units(*this, seat_->clone())); }

std::size_t Units::state_size(std::span<const UnitSpec> specs, std::size_t dofs) {
  const config::TypeLibrary library = library_for(specs);
  Problems problems;
  std::vector<seat::Joint> joints;
  for (const UnitSpec& spec : specs) {
    try {
      joints.push_back({"joint of " + spec.name, {}, {}, {}, type_of(spec, library).unit.actuator.linear()});
    } catch (const InputError& error) {
      problems.add_all(error);
    }
  }
  problems.throw_if_any();
  const std::unique_ptr<seat::Seat> seat = make_seat(specs, joints, library);
  std::vector<std::size_t> all(specs.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  seat->join({all});
  return size_of(*seat, specs.size(), dofs);
}

void Units::reset(std::span<double> state) const {
  std::fill(state.begin(), state.end(), 0.0);
  put(first_, state);
}

/// By bits.
bool Units::is_at(std::span<const double> state) const {
  const std::span<const double> here = here_.numbers();
  return there_ && here.size() <= state.size() && std::memcmp(here.data(), state.data(), here.size_bytes()) == 0;
}

void Units::take(std::span<const double> state) {
  there_ = false;  // should anything throw
  const std::size_t first = head(units_.size(), dofs_), count = first + seat_->restore_tight(state.subspan(first));
  if (state[kCount] != static_cast<double>(count))
    throw InputError(
        {"vsasim.unit", "state", std::to_string(state[kCount]), "isn't how many of its numbers count", std::to_string(count)});
  here_.assign(state.first(count));
  there_ = true;
}

void Units::note() {
  here_.begin();
  seat_->save_tight(here_);
  here_.own()[kCount] = static_cast<double>(here_.at());
  there_ = true;
}

/// The first step: what is broken breaks, and where the model has a joint is neither work nor acceleration.
void Units::begin() {
  for (std::size_t i = 0; i < units_.size(); ++i) {
    if (is_broken(units_[i].spec)) seat_->robot().set_faults(i, faults_of(units_[i].spec));
    const host::JointIn& in = seat_->in()[i];
    if (in.angle_rad != joints_[i].start || in.speed_rad_per_s != 0) seat_->moved(i);
  }
}

void Units::command(const mjModel& m, const mjData& d) {
  const std::span<double> head = here_.own();
  const bool first = head[kBegun] == 0;
  for (std::size_t i = 0; i < units_.size(); ++i) {
    const std::vector<int>& actuators = units_[i].actuators;
    std::array<std::optional<double>, 2> said;
    double* taken = &head[kTaken + 2 * i];
    for (std::size_t k = 0; k < actuators.size(); ++k) {
      const double u = control(m, d, actuators[k]);
      if (!std::isfinite(u) || (u == taken[k] && !first)) continue;
      said[k] = taken[k] = u;
    }
    if (!said[0] && !said[1]) continue;
    if (volts_[i]) {
      seat_->robot().command_direct(i, {taken[0], taken[1]});
    } else {
      seat_->robot().command(i, said[0], said[1]);
    }
  }
}

Pushed Units::pushed() noexcept {
  const std::span<double> both = here_.own().last(2 * dofs_);
  return {both.first(dofs_), both.last(dofs_)};
}

/// A robot with one spring that the step hardly resolves is stiff as a whole; of the first step it doesn't know yet.
void Units::find_stiff(const mjModel& m, mjData& d) {
  bool stiff = seat_->robot().is_stiff();
  if (here_.own()[kBegun] == 0) {
    mobility_.of_each(m, d, driven_, alone_);
    for (std::size_t i = 0; i < driven_.size(); ++i)
      stiff = stiff ||
              m.opt.timestep * m.opt.timestep * alone_[i] * seat_->robot().read(i).stiffness_Nm_per_rad > device::kHardlyResolved;
  }
  stiff_.assign(driven_.begin(), stiff ? driven_.end() : driven_.begin());
}

bool Units::held(std::size_t tree) const {
  return std::any_of(tree_dofs_[tree].begin(), tree_dofs_[tree].end(), [this](int v) { return mobility_.held(v); });
}

/// What holds a stiff joint is in B, in this step; what lets go of it isn't, in the next one.
void Units::renew_held() {
  for (std::size_t t = 0; t < trees_.size(); ++t)
    if (held(t)) seat_->moved();
}

/// What holds the trees of stiff joints, while their step is solved.
class Units::Holds final : public device::Holder {
 public:
  Holds(Units& units, const mjModel& m, mjData& d) noexcept : units_(units), m_(m), d_(d) {}
  [[nodiscard]] bool holds(std::size_t tree) const noexcept override { return units_.held(tree); }
  bool holds_else(std::size_t tree, std::span<const double> torques, std::span<double> accelerations,
                  std::span<double> mobility) noexcept override {
    const std::vector<std::size_t>& of = units_.trees_[tree];
    const std::span<double> more = std::span(units_.more_).first(of.size());
    for (std::size_t k = 0; k < of.size(); ++k) more[k] = torques[k] - units_.last_[of[k]];
    return units_.mobility_.holds_else(m_, d_, units_.tree_dofs_[tree], more, accelerations, mobility);
  }

 private:
  Units& units_;
  const mjModel& m_;
  mjData& d_;
};

/// A step of the seat, from here_ to here_.
void Units::step(const mjModel& m, mjData& d) {
  find_stiff(m, d);
  mobility_.look(m, d, stiff_);
  renew_held();
  const bool any_held = std::any_of(stiff_.begin(), stiff_.end(), [this](int v) { return mobility_.held(v); });
  const std::span<const double> free = mobility_.foresee(m, d, pushed());
  for (std::size_t i = 0; i < joints_.size(); ++i)
    seat_->in()[i].free_acceleration_rad_per_s2 = free[static_cast<std::size_t>(joints_[i].v)];
  if (any_held) mobility_.of_each(m, d, driven_, alone_);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    seat_->in()[i].inverse_inertia = any_held ? std::optional(alone_[i]) : std::nullopt;
    if (any_held) last_[i] = seat_->robot().read(i, device::Torques::left_out).mean_torque_Nm;
  }
  seat_->turned(physics::turned_rad(m, d.qvel, beside_, m.opt.timestep));
  if (seat_->wants_mobility()) {
    std::span<double> rest = seat_->mobility();
    for (const std::vector<int>& dofs : tree_dofs_) {
      const std::size_t n = dofs.size() * dofs.size();
      mobility_.of(m, d, dofs, rest.first(n));
      rest = rest.subspan(n);
    }
  }
  Holds holds(*this, m, d);
  seat_->step(step_ns(m), any_held ? &holds : nullptr);
  renew_held();
  here_.own()[kBegun] = 1;
  note();
}

void Units::compute(const mjModel& m, mjData& d, std::span<const double> state) {
  observe(d, state);
  there_ = false;  // should anything throw
  if (!has_one_torque_a_step(m)) {
    Problems problems;
    check_options(m, problems);
    problems.throw_if_any();
  }
  if (here_.own()[kBegun] == 0) begin();
  command(m, d);
  step(m, d);
  computed_ = true;
}

void Units::advance(const mjModel& m, mjData& d, std::span<double> state) {
  if (!computed_) return;
  computed_ = false;
  Mobility::push(m, d, pushed());
  put(here_.numbers(), state);
  seat_->publish(0);
}

void Units::observe(const mjData& d, std::span<const double> state) {
  computed_ = false;
  if (!is_at(state)) take(state);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    host::JointIn& in = seat_->in()[i];
    in.angle_rad = d.qpos[joints_[i].q];
    in.speed_rad_per_s = d.qvel[joints_[i].v];
  }
  seat_->observe();
}

void Units::copy_step(const Units& other) {
  computed_ = false;
  if (!other.computed_) return;
  take(other.here_.numbers());
  computed_ = true;
}

void Units::read(std::size_t unit, std::span<double> out) const {
  const host::ActuatorReading now = seat_->robot().read(unit, device::Torques::left_out);
  const actuator::Ledger l = seat_->robot().ledger(unit);
  const auto put = [&](Reading which, double value) { out[static_cast<std::size_t>(which)] = value; };
  put(Reading::ticks_1, now.measured[0].value);
  put(Reading::ticks_2, now.measured[1].value);
  put(Reading::ticks_shaft, now.measured[2].value);
  put(Reading::current_1_A, now.current_A[0]);
  put(Reading::current_2_A, now.current_A[1]);
  put(Reading::stiffness, now.stiffness_Nm_per_rad);
  put(Reading::preset, now.preset);
  put(Reading::equilibrium, now.equilibrium_rad);
  put(Reading::deflection, now.deflection_rad);
  put(Reading::torque, now.mean_torque_Nm);
  put(Reading::energy_supply, l.supply);
  put(Reading::energy_delivered, l.delivered + l.pending);
  put(Reading::energy_stored, l.stored() - l.stored_at_start);
  put(Reading::energy_lost, actuator::heat(l));
}

}  // namespace vsa::mujoco
