// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// From an element to a seat; its steps and snapshots.
#include "vsa/seat/seat.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/state_io.hpp"
#include "vsa/units.hpp"

namespace vsa::seat {
namespace {

const Joint* find(const Model& model, const std::string& name) {
  const auto it = std::find_if(model.joints.begin(), model.joints.end(), [&](const Joint& j) { return j.name == name; });
  return it == model.joints.end() ? nullptr : &*it;
}

void check_joints(const host::RobotConfig& config, const Model& model, Problems& problems) {
  const auto is_named = [&](const Joint& joint) {
    return std::any_of(config.actuators.begin(), config.actuators.end(),
                       [&](const host::ActuatorConfig& a) { return a.joint == joint.name; });
  };
  std::vector<std::string> names;  // those that messages may offer, and those of which there is more to say
  for (const Joint& joint : model.joints)
    if (joint.refusal.empty() || is_named(joint)) names.push_back(joint.name);
  config::check_joints(config, names, model.where, problems);
  for (const host::ActuatorConfig& a : config.actuators) {
    const Joint* joint = find(model, a.joint);
    if (joint == nullptr) continue;
    const std::string key = "actuator[" + a.name + "]/joint";
    const bool slides = a.unit.actuator.linear();
    if (!joint->refusal.empty()) {
      problems.add({model.where, key, a.joint, joint->refusal, "a joint with one axis that follows no other"});
    } else if (joint->slides && !slides) {
      problems.add({model.where, key, a.joint, "is prismatic: " + a.type + " turns its joint",
                    "a revolute or continuous joint, or a linear actuator, whose law has its shaft in m"});
    } else if (!joint->slides && slides) {
      problems.add({model.where, key, a.joint, "turns: " + a.type + " is a linear actuator",
                    "a prismatic joint, or <override key=\"shaft.pinion_m\" value=\"…\"/>, a rack on a pinion"});
    }
  }
}

/// An actuator whose text gives no equilibrium starts where its joint does, so that its springs aren't wound up.
void start_with_joints(host::RobotConfig& config, const Model& model, Problems& problems) {
  for (host::ActuatorConfig& a : config.actuators) {
    const Joint* joint = find(model, a.joint);
    const double start = joint == nullptr ? 0 : joint->start_rad.value_or(0);
    if (start == 0 || a.equilibrium_given) continue;
    if (!joint->slides && std::abs(start) > kPi)
      problems.add({model.where, "actuator[" + a.name + "]/initial@equilibrium_rad", "",
                    "is needed: its joint starts at " + config::number_text(start) + " rad",
                    "an equilibrium near the joint's start"});
    a.initial_equilibrium_rad = start;
    config::check_start(a, "actuator[" + a.name + "], which starts where its joint does", model.where, problems);
  }
}

host::Robot make_robot(const Model& model, const Options& options) {
  host::RobotConfig config =
      model.robot ? *model.robot : config::parse_plugin(model.xml, model.where, options.types, options.actuator);
  Problems problems;
  check_joints(config, model, problems);
  start_with_joints(config, model, problems);
  if (!options.makes_substeps) config::check_one_step(config, model.where, problems);
  problems.throw_if_any();
  return host::Robot(std::move(config));
}

std::vector<std::size_t> joints_of(const host::Robot& robot, const Model& model) {
  std::vector<std::size_t> out;
  for (const host::ActuatorConfig& a : robot.config().actuators)
    out.push_back(static_cast<std::size_t>(find(model, a.joint) - model.joints.data()));
  return out;
}

std::vector<DrivenJoints::Joint> driven(const host::Robot& robot, const Model& model, const std::vector<std::size_t>& joints) {
  std::vector<DrivenJoints::Joint> out;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Joint& joint = model.joints[joints[i]];
    if (joint.key.world != nullptr) out.push_back({joint.key, joint.name, robot.config().actuators[i].name});
  }
  return out;
}

}  // namespace

// Not as one expression in the constructor, of which GCC 14 warns wrongly (maybe-uninitialized).
Seat::Own Seat::Own::of(std::size_t joints) {
  Own own;
  own.now.in.resize(joints);
  own.watch = host::MobilityWatch(joints);
  return own;
}

Seat::Seat(const Model& model, const Options& options)
    : model_(model.name),
      robot_(make_robot(model, options)),
      joints_(joints_of(robot_, model)),
      driven_(model.where, driven(robot_, model, joints_)),
      report_(options.report),
      watches_pace_(options.watches_pace),
      own_(Own::of(robot_.size())),
      kept_(own_),
      loaded_(own_),
      torques_(robot_.size(), 0.0),
      own_size_(state::size_of(own_)) {
  for (const std::string& notice : robot_.config().notices) tell(notice);
}

Seat::Seat(const Seat& other, host::Robot robot)
    : model_(other.model_),
      robot_(std::move(robot)),
      joints_(other.joints_),
      driven_("", {}),
      watches_pace_(other.watches_pace_),
      own_(other.own_),
      kept_(other.kept_),
      loaded_(other.own_),
      torques_(other.torques_),
      own_size_(other.own_size_) {}

Seat::~Seat() { disconnect(); }

std::unique_ptr<Seat> Seat::clone() const { return std::unique_ptr<Seat>(new Seat(*this, robot_.clone())); }

void Seat::tell(const std::string& line) const {
  if (report_) report_(line);
}

void Seat::join(const std::vector<std::vector<std::size_t>>& trees, const std::vector<std::size_t>& shared) {
  if (trees.empty() && shared.empty() && robot_.size() > 0)
    tell(model_ +
         ": no tree of hinges, sliders and fixed joints (a loop, a ball joint, another model's link): its joints are solved one "
         "by one with their types' shaft.inertia_kgm2");
  robot_.join(trees, shared);
  own_.mobility.resize(robot_.mobility_size());
  own_.watch.again();
  kept_ = loaded_ = own_;
  own_size_ = state::size_of(own_);
}

void Seat::stop(const std::string& why) {
  own_.now.stopped = true;
  std::fill(torques_.begin(), torques_.end(), 0.0);
  tell(model_ + ": " + why + ": its actuators give no torque until the world is reset");
}

bool Seat::can_step(std::int64_t dt_ns) {
  if (own_.now.stopped) return false;
  if (dt_ns <= 0 || dt_ns > host::kLongestStep_ns) {
    stop("a step of " + std::to_string(dt_ns) + " ns is outside 1 ns … 16 ms");
    return false;
  }
  for (std::size_t i = 0; i < own_.now.in.size(); ++i) {
    if (std::isfinite(own_.now.in[i].angle_rad) && std::isfinite(own_.now.in[i].speed_rad_per_s)) continue;
    stop("joint " + robot_.config().actuators[i].joint + " is no longer at a finite angle or speed");
    return false;
  }
  return true;
}

void Seat::step(std::int64_t dt_ns, device::Holder* holder) {
  if (!can_step(dt_ns)) return;
  robot_.advance(own_.now.time_ns, dt_ns, own_.now.in, torques_, own_.mobility, holder);
  stepped(dt_ns);
}

void Seat::step_together(std::span<Seat* const> seats, host::RobotGroup& group, std::int64_t dt_ns, device::Holder* holder) {
  bool all = true;
  for (Seat* seat : seats) all = seat->can_step(dt_ns) && all;
  for (std::size_t i = 0; i < seats.size(); ++i) {
    Seat& seat = *seats[i];
    if (!all && !seat.stopped()) seat.stop("another robot on its kinematic tree has stopped");
    host::RobotGroup::Step& step = group.steps()[i];
    step = {&seat.robot_, seat.own_.now.time_ns, seat.own_.now.in, seat.torques_, seat.own_.mobility, step.holder};
  }
  if (!all) return;
  group.advance(dt_ns, holder);
  for (Seat* seat : seats) seat->stepped(dt_ns);
}

void Seat::stepped(std::int64_t dt_ns) {
  for (host::JointIn& joint : own_.now.in) joint.placed = false;
  own_.now.time_ns += dt_ns;
  if (watches_pace_ && !ports_.all().empty() && pace_.fell_behind(Clock::now(), own_.now.time_ns))
    tell(model_ + ": slower than real time: units on serial ports answer in time, but move more slowly than a client expects");
}

void Seat::moved(std::size_t actuator) {
  if (actuator >= own_.now.in.size())
    throw InputError(Problem{"", "actuator", std::to_string(actuator), "there is no such actuator",
                             "0 … " + std::to_string(own_.now.in.size() - 1)});
  host::JointIn& in = own_.now.in[actuator];
  if (std::isfinite(in.angle_rad) && std::isfinite(in.speed_rad_per_s))
    robot_.relocate(actuator, in.angle_rad, in.speed_rad_per_s);  // else the next step says so
  in.placed = true;
  own_.watch.again();
}

void Seat::reset() {
  robot_.reset();
  pace_.stood();
  own_.now.time_ns = 0;
  own_.now.stopped = false;
  own_.watch.again();
  std::fill(torques_.begin(), torques_.end(), 0.0);
}

struct Seat::Snapshot {
  std::shared_ptr<const host::Robot::Snapshot> robot;
  Own own;
};

std::shared_ptr<const Seat::Snapshot> Seat::snapshot() const {
  return std::make_shared<const Snapshot>(Snapshot{robot_.snapshot(), own_});
}

void Seat::check(const Snapshot& snapshot) const { robot_.check(*snapshot.robot); }

void Seat::restore(const Snapshot& snapshot) {
  robot_.restore(*snapshot.robot);
  set_own(snapshot.own);
}

/// Of a seat whose trees were joined otherwise B is no B of these.
void Seat::set_own(const Own& own) {
  const std::size_t numbers = own_.mobility.size();
  own_ = own;
  if (own.mobility.size() != numbers) {
    own_.mobility.assign(numbers, 0.0);
    own_.watch.again();
  }
  std::fill(torques_.begin(), torques_.end(), 0.0);  // the next step's; one that has stopped makes none
  last_told_ = -1;
  pace_.stood();
}

const char* Seat::Moment::impossible() const noexcept {
  constexpr std::int64_t kLatestNs = 4'000'000'000'000'000'000 - host::kLongestStep_ns;
  return time_ns >= 0 && time_ns <= kLatestNs ? nullptr : "a time of 0 … 4e18 ns";
}

StateLayout Seat::state_layout() const {
  StateLayout out = robot_.state_layout();
  out.append("host.", state::layout_of(own_));
  return out;
}

void Seat::save(std::span<double> out) const {
  check_state_size(out.size(), state_size());
  robot_.save(out.first(robot_.state_size()));
  state::Writer writer(out.last(own_size_));
  state::walk_fields(writer, own_);
}

void Seat::read_own(std::span<const double> in) {
  check_state_size(in.size(), state_size());
  state::Reader reader(in.last(own_size_));
  state::walk_fields(reader, loaded_);
  StateFault fault = reader.fault();
  if (!fault.there()) return;
  fault.offset += robot_.state_size();
  throw_if_any(fault, state_layout());
}

void Seat::check(std::span<const double> in) {
  read_own(in);
  robot_.check(in.first(robot_.state_size()));
}

void Seat::restore(std::span<const double> in) {
  read_own(in);
  robot_.restore(in.first(robot_.state_size()));
  set_own(loaded_);
}

void Seat::save_tight(state::Rewriter& out) const {
  state::walk_fields(out, own_);
  robot_.save_tight(out);
}

std::size_t Seat::restore_tight(std::span<const double> in) {
  state::Reader reader(in, state::Room::left_out);
  state::walk_fields(reader, loaded_);
  throw_if_any(reader.fault(), {});
  const std::size_t count = reader.at() + robot_.restore_tight(in.subspan(reader.at()));
  set_own(loaded_);
  return count;
}

void Seat::keep() {
  robot_.keep();
  kept_ = own_;
}

void Seat::go_back() {
  robot_.go_back();
  own_ = kept_;
}

}  // namespace vsa::seat
