// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <utility>

#include "batch/batch_impl.hpp"
#include "vsa/checks.hpp"
#include "vsa/errors.hpp"

namespace vsa::batch {
namespace {

constexpr int kMostSteps = 1'000'000'000;

std::size_t thread_count(std::size_t asked, std::size_t copies) {
  if (asked > Batch::kMostThreads)
    throw InputError(
        Problem{"", "threads", std::to_string(asked), "is out of range", "0 … " + std::to_string(Batch::kMostThreads)});
  const std::size_t there = asked > 0 ? asked : std::max(std::thread::hardware_concurrency(), 1U);
  return std::min(there, std::max<std::size_t>(copies, 1));
}

/// std::bad_alloc that says of what.
class NoMemory : public std::bad_alloc {
 public:
  NoMemory(std::size_t copies, std::size_t threads)
      : text_(std::make_shared<const std::string>("no memory for a batch of copies = " + std::to_string(copies) +
                                                  " on threads = " + std::to_string(threads))) {}
  [[nodiscard]] const char* what() const noexcept override { return text_->c_str(); }

 private:
  std::shared_ptr<const std::string> text_;  // whose copies can't fail
};

/// A clone doesn't step: what the engine fails at is memory.
engine::World clone_of(const engine::World& world) {
  try {
    return world.clone();
  } catch (const engine::SimulationError&) {
    throw std::bad_alloc();
  }
}

/// Never empty: an empty failure is none.
std::string reason(const std::exception& error) {
  const std::string text = error.what();
  return text.empty() ? "an exception without a text was thrown" : text;
}

}  // namespace

Batch::Impl::Impl(const engine::World& world, std::size_t copies, std::size_t threads)
    : crew(thread_count(threads, copies)), book(world) {
  if (copies == 0) throw InputError(Problem{"", "copies", "0", "there is nothing to step", "1 or more"});
  for (std::size_t k = 0; k < crew.size(); ++k) worlds.push_back(clone_of(world));
  for (const engine::JointInfo& joint : world.joints())
    if (joint.one_axis()) joints.push_back(world.joint(joint.name));
  first.resize(world.state_size());
  world.save(first);
  for (std::size_t r = 0; r < world.robot_count(); ++r) own_memories = own_memories && world.robot(r).has_own_memories();
  rooms.assign(crew.size(), first);
  numbers.resize(copies * first.size());
  parameters.assign(copies, book.first());
  failure.resize(copies);
  notices.resize(copies);
  all.resize(copies);
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::size_t n = world.actuators().size();
  for (std::vector<double>* in : {&equilibrium, &preset}) in->assign(copies * n, std::numeric_limits<double>::quiet_NaN());
  for (std::vector<double>* out : {&shaft, &speed, &torque, &stiffness}) out->resize(copies * n);
  motor.resize(2 * copies * n);
  time.resize(copies);
  for (std::vector<double>* out : {&position, &joint_speed}) out->resize(copies * joints.size());
  poses.resize(copies * world.links().size());
  reset(all);
}

void Batch::Impl::check_copy(std::size_t copy) const {
  if (copy >= copies())
    throw InputError(Problem{"", "copy", std::to_string(copy), "there is no such copy", "below " + std::to_string(copies())});
}

void Batch::Impl::check(std::span<const std::size_t> which) const {
  std::vector<bool> seen(copies());
  for (const std::size_t copy : which) {
    check_copy(copy);
    if (seen[copy]) throw InputError(Problem{"", "copy", std::to_string(copy), "is named twice", "each copy once"});
    seen[copy] = true;
  }
}

void Batch::Impl::check_commands(std::span<const std::size_t> which) const {
  Problems problems;
  const auto look = [&](const char* key, const std::vector<double>& values, std::size_t copy) {
    for (std::size_t a = 0; a < actuators(); ++a)
      if (const double v = values[copy * actuators() + a]; std::isinf(v))
        problems.add({"", "copy " + std::to_string(copy) + ", " + worlds.front().actuators()[a].name + ": " + key, Checks::text(v),
                      "isn't finite", "a number, or NaN to leave it"});
  };
  for (const std::size_t copy : which) {
    look("equilibrium", equilibrium, copy);
    look("preset", preset, copy);
  }
  problems.throw_if_any();
}

void Batch::Impl::command(engine::World& world, std::size_t copy) {
  const auto given = [](double v) { return std::isnan(v) ? std::nullopt : std::optional(v); };
  for (std::size_t a = 0; a < actuators(); ++a) {
    const std::size_t at = copy * actuators() + a;
    if (std::isnan(equilibrium[at]) && std::isnan(preset[at])) continue;
    const engine::ActuatorRef& ref = world.actuators()[a];
    world.robot(ref.robot).command(ref.index, given(equilibrium[at]), given(preset[at]));
  }
}

void Batch::Impl::read(const engine::World& world, std::size_t copy) {
  time[copy] = world.time_s();
  for (std::size_t a = 0; a < actuators(); ++a) {
    const std::size_t at = copy * actuators() + a;
    const host::ActuatorReading now = world.read(world.actuators()[a]);
    shaft[at] = now.shaft_rad;
    speed[at] = now.shaft_speed_rad_per_s;
    torque[at] = now.torque_Nm;
    stiffness[at] = now.stiffness_Nm_per_rad;
    for (std::size_t m = 0; m < 2; ++m) motor[2 * at + m] = now.motor_rad[m];
  }
  for (std::size_t j = 0; j < joints.size(); ++j) {
    position[copy * joints.size() + j] = world.joint_angle(joints[j]);
    joint_speed[copy * joints.size() + j] = world.joint_speed(joints[j]);
  }
  const std::size_t links = world.links().size();
  world.poses(std::span(poses).subspan(copy * links, links));
}

void Batch::Impl::take(engine::World& world, std::size_t copy) {
  if (parameters_differ) world.use(*parameters[copy].of);
  world.restore(state(copy));
}

void Batch::Impl::put(std::size_t worker, std::size_t copy) {
  worlds[worker].save(rooms[worker]);
  std::copy(rooms[worker].begin(), rooms[worker].end(), state(copy).begin());
  read(worlds[worker], copy);
}

void Batch::Impl::note(engine::World& world, std::size_t copy) {
  std::vector<std::string>& all_of_it = notices[copy];
  for (std::size_t r = 0; r < world.robot_count(); ++r) {
    for (host::Notice& n : world.robot(r).take_notices()) {
      if (all_of_it.size() < kMostNotices)
        all_of_it.push_back(std::move(n.text));
      else if (all_of_it.size() == kMostNotices)
        all_of_it.emplace_back("more notices were left out");
    }
  }
}

/// A step that fails leaves the world where it was before it; a state that can't be saved leaves the copy where it was before all.
void Batch::Impl::step(std::size_t worker, std::size_t copy, int steps, bool commanded) noexcept {
  engine::World& world = worlds[worker];
  try {
    take(world, copy);
    if (commanded) command(world, copy);
    try {
      for (int k = 0; k < steps; ++k) world.step();
    } catch (const engine::SimulationError& error) {
      failure[copy] = reason(error);
    }
    note(world, copy);
    put(worker, copy);
  } catch (const std::exception& error) {
    failure[copy] = reason(error);
  } catch (...) {  // of a law or an engine of the user's
    failure[copy] = "something was thrown that is no std::exception";
  }
}

void Batch::Impl::step(int steps, std::span<const std::size_t> which, const std::function<void()>& between) {
  if (steps < 1 || steps > kMostSteps)
    throw InputError(Problem{"", "steps", std::to_string(steps), "is out of range", "1 … " + std::to_string(kMostSteps)});
  check_commands(which);
  if (which.empty()) return;
  const int slice = between ? std::max(kLeastSlice, kSlice / static_cast<int>(std::min<std::size_t>(which.size(), kSlice))) : steps;
  for (int left = steps; left > 0; left -= slice) {
    if (left < steps) between();
    crew.run(which.size(), [&](std::size_t worker, std::size_t item) {
      if (failure[which[item]].empty()) step(worker, which[item], std::min(slice, left), left == steps);
    });
  }
}

void Batch::Impl::begin(std::size_t worker, std::size_t copy) {
  engine::World& world = worlds[worker];
  world.use(*book.first().of);
  world.restore(first);
  world.set_parameters(*parameters[copy].of);
  put(worker, copy);
  failure[copy].clear();
}

void Batch::Impl::reset(std::span<const std::size_t> which) {
  std::vector<std::size_t> own;
  for (const std::size_t copy : which)
    if (has_own_parameters(copy)) own.push_back(copy);
  if (!own.empty()) crew.run(own.size(), [&](std::size_t worker, std::size_t item) { begin(worker, own[item]); });
  if (own.size() == which.size()) return;
  engine::World& world = worlds.front();
  if (parameters_differ) world.use(*book.first().of);
  world.restore(first);
  for (const std::size_t copy : which) {
    if (has_own_parameters(copy)) continue;
    std::copy(first.begin(), first.end(), state(copy).begin());
    failure[copy].clear();
    read(world, copy);
  }
}

/// Parameters stay the copy's, those in the programs' memories, too.
void Batch::Impl::restore(std::size_t copy, std::span<const double> from) {
  engine::World& world = worlds.front();
  if (parameters_differ) world.use(*parameters[copy].of);
  world.restore(from);
  if (own_memories)
    for (std::size_t r = 0; r < world.robot_count(); ++r) world.robot(r).renew_memories();
  put(0, copy);
  failure[copy].clear();
}

std::unique_ptr<Batch::Impl> Batch::Impl::made(const engine::World& world, std::size_t copies, std::size_t threads) {
  try {
    return std::make_unique<Impl>(world, copies, threads);
  } catch (const std::bad_alloc&) {
    throw NoMemory(copies, thread_count(threads, copies));
  } catch (const std::length_error&) {  // more numbers than any machine has room for
    throw NoMemory(copies, thread_count(threads, copies));
  }
}

Batch::Batch(const engine::World& world, std::size_t copies, std::size_t threads)
    : impl_("vsa::batch::Batch", Impl::made(world, copies, threads)) {}
Batch::~Batch() = default;
Batch::Batch(Batch&&) noexcept = default;
Batch& Batch::operator=(Batch&&) noexcept = default;

std::size_t Batch::size() const { return impl_->copies(); }
std::size_t Batch::threads() const { return impl_->crew.size(); }
std::size_t Batch::actuators() const { return impl_->actuators(); }
std::size_t Batch::links() const { return world().links().size(); }
const std::vector<engine::JointHandle>& Batch::joints() const { return impl_->joints; }
const engine::World& Batch::world() const { return impl_->worlds.front(); }

std::span<double> Batch::equilibrium() { return impl_->equilibrium; }
std::span<double> Batch::preset() { return impl_->preset; }

void Batch::step(int steps) { impl_->step(steps, impl_->all, {}); }
void Batch::step(int steps, std::span<const std::size_t> which) { step(steps, which, {}); }
void Batch::step(int steps, std::span<const std::size_t> which, const std::function<void()>& between) {
  impl_->check(which);
  impl_->step(steps, which, between);
}
void Batch::reset() { impl_->reset(impl_->all); }
void Batch::reset(std::span<const std::size_t> which) {
  impl_->check(which);
  impl_->reset(which);
}
void Batch::restore(std::size_t copy, std::span<const double> state) {
  impl_->check_copy(copy);
  impl_->restore(copy, state);
}
std::span<const double> Batch::state(std::size_t copy) const {
  impl_->check_copy(copy);
  return impl_->state(copy);
}

void Batch::set(std::size_t copy, std::string_view who, std::string_view key, double value) {
  const Setting one{copy, std::string(who), std::string(key), value};
  impl_->set(std::span(&one, 1));
}
void Batch::set(std::size_t copy, std::string_view who, std::string_view key, std::string_view word) {
  const Setting one{copy, std::string(who), std::string(key), std::string(word)};
  impl_->set(std::span(&one, 1));
}
void Batch::set(std::span<const Setting> settings) { impl_->set(settings); }
void Batch::randomize(std::uint64_t seed, std::span<const Spread> what) { impl_->randomize(seed, what, impl_->all); }
void Batch::randomize(std::uint64_t seed, std::span<const Spread> what, std::span<const std::size_t> which) {
  impl_->check(which);
  impl_->randomize(seed, what, which);
}
void Batch::reset_parameters() { reset_parameters(impl_->all); }
void Batch::reset_parameters(std::span<const std::size_t> which) {
  impl_->check(which);
  impl_->use(which, [this](std::size_t, std::size_t) { return impl_->book.first(); });
}
std::vector<std::string> Batch::owners(const std::string& who, const std::string& key) const {
  std::vector<std::string> out;
  for (const std::size_t owner : impl_->book.owners(world(), who, key)) out.push_back(impl_->book.owner_name(world(), key, owner));
  return out;
}
double Batch::value(std::size_t copy, const std::string& who, const std::string& key) const {
  return values(copy, who, key).front();
}
std::vector<double> Batch::values(std::size_t copy, const std::string& who, const std::string& key) const {
  impl_->check_copy(copy);
  std::vector<double> out;
  for (const std::size_t owner : impl_->book.owners(world(), who, key))
    out.push_back(impl_->book.number(world(), impl_->parameters[copy], owner, key));
  return out;
}
std::string Batch::text(std::size_t copy, const std::string& who, const std::string& key) const {
  impl_->check_copy(copy);
  return impl_->book.text(world(), impl_->parameters[copy], impl_->book.owners(world(), who, key).front(), key);
}
std::shared_ptr<const engine::World::Parameters> Batch::parameters(std::size_t copy) const {
  impl_->check_copy(copy);
  return impl_->parameters[copy].of;
}

const std::string& Batch::failure(std::size_t copy) const {
  impl_->check_copy(copy);
  return impl_->failure[copy];
}
std::vector<Notice> Batch::take_notices() {
  std::vector<Notice> out;
  for (std::size_t copy = 0; copy < size(); ++copy) {
    for (std::string& text : impl_->notices[copy]) out.push_back({copy, std::move(text)});
    impl_->notices[copy].clear();
  }
  return out;
}
Status Batch::status(std::size_t copy) const { return failure(copy).empty() ? Status::running : Status::failed; }

std::span<const double> Batch::time_s() const { return impl_->time; }
std::span<const double> Batch::shaft_rad() const { return impl_->shaft; }
std::span<const double> Batch::shaft_speed_rad_per_s() const { return impl_->speed; }
std::span<const double> Batch::torque_Nm() const { return impl_->torque; }
std::span<const double> Batch::stiffness_Nm_per_rad() const { return impl_->stiffness; }
std::span<const double> Batch::motor_rad() const { return impl_->motor; }
std::span<const double> Batch::joint_position() const { return impl_->position; }
std::span<const double> Batch::joint_speed() const { return impl_->joint_speed; }
std::span<const scene::Pose> Batch::poses() const { return impl_->poses; }

}  // namespace vsa::batch
