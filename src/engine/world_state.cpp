// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A World's state as numbers: its clock, its bodies, its robots; in memory and in a file.
#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <string>
#include <system_error>

#include "engine/world_check.hpp"
#include "engine/world_impl.hpp"
#include "vsa/bits.hpp"
#include "vsa/device/parameter_hash.hpp"
#include "vsa/files.hpp"
#include "vsa/host/unit_kind.hpp"
#include "vsa/output_file.hpp"
#include "vsa/state_io.hpp"

namespace vsa::engine {
namespace {

struct WorldClock {
  std::int64_t time_ns = 0, steps = 0;
  static auto fields(auto& s, auto&& visit) { return visit("time", "ns", s.time_ns, "steps", "", s.steps); }
  [[nodiscard]] const char* impossible() const noexcept {
    constexpr std::int64_t kLatest = 4'000'000'000'000'000'000;
    return time_ns >= 0 && time_ns <= kLatest && steps >= 0 && steps <= kLatest ? nullptr : "a time and steps of 0 … 4e18";
  }
};
constexpr std::size_t kClockSize = 4;

constexpr std::string_view kMagic = "VSASTATE";
constexpr std::uint64_t kVersion = 3;  // 1: without kinds and parameters; 2: without parameters
constexpr std::size_t kLeastHeader = 5;

/// Magic, version, layout, count, hash of the numbers; kinds; a hash of the links' parameters and of each actuator's.
std::size_t header_numbers(std::uint64_t version, const World& world) {
  return kLeastHeader + (version > 1 ? 1 : 0) + (version > 2 ? 1 + world.actuators().size() : 0);
}

const host::ActuatorConfig& config_of(const World& world, const ActuatorRef& a) {
  return world.robot(a.robot).config().actuators[a.index];
}

/// Of all actuators' units: other types may have the same layout, and a state means something else to them.
std::uint64_t hash_of_kinds(const World& world) {
  std::vector<double> kinds;
  for (const ActuatorRef& a : world.actuators())
    for (const int word : host::kind_of(config_of(world, a).unit)) kinds.push_back(word);
  return vsa::state_hash(kinds);
}

/// As a state's layout begins its names.
std::string actuator_key(const World& world, std::size_t k) {
  const ActuatorRef& a = world.actuators()[k];
  return fmt::format("robot[{}]/{}", a.robot, config_of(world, a).name);
}

/// Numbers that aren't kept with a state and without which it means something else: first of the links, then of each actuator.
std::vector<std::uint64_t> hashes_of_parameters(const World& world, std::span<const LinkParameters> links) {
  std::vector<double> bodies;
  for (const LinkParameters& link : links) {
    bodies.insert(bodies.end(), {link.mass_kg, link.friction ? 1.0 : 0.0, link.friction.value_or(0)});
    bodies.insert(bodies.end(), link.inertia_kgm2.begin(), link.inertia_kgm2.end());
  }
  std::vector<std::uint64_t> hashes{vsa::state_hash(bodies)};
  for (const ActuatorRef& a : world.actuators()) hashes.push_back(device::parameter_hash(config_of(world, a).unit));
  return hashes;
}

/// Eight bytes, the lowest first, on every machine.
void put_word(std::string& out, std::uint64_t word) {
  for (int k = 0; k < 64; k += 8) out.push_back(static_cast<char>((word >> k) & 0xFF));
}
std::uint64_t word_at(std::string_view in, std::size_t index) {
  std::uint64_t word = 0;
  for (std::size_t k = 8; k-- > 0;) word = (word << 8) | static_cast<unsigned char>(in[8 * index + k]);
  return word;
}

/// With "robot[i]/" before the names of what is wrong.
template <class Work>
void within_robot(std::size_t robot, Work&& work) {
  try {
    work();
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& p : problems) p.key = fmt::format("robot[{}]/{}", robot, p.key);
    throw InputError(std::move(problems));
  }
}

[[noreturn]] void refuse(const std::filesystem::path& file, std::string_view key, const std::string& value,
                         std::string_view message, const std::string& allowed) {
  throw InputError(Problem{file.string(), std::string(key), value, std::string(message), allowed});
}

}  // namespace

StateLayout World::Impl::state_layout() const {
  StateLayout out;
  out.append("world.", state::layout_of<WorldClock>());
  out.append("physics/", physics->state_layout());
  for (std::size_t i = 0; i < robots.size(); ++i) out.append(fmt::format("robot[{}]/", i), robots[i].seat->state_layout());
  return out;
}

std::size_t World::Impl::state_size() const {
  std::size_t size = kClockSize + physics->state_size();
  for (const RobotSlot& slot : robots) size += slot.seat->state_size();
  return size;
}

void World::Impl::save(std::span<double> out) const {
  check_state_size(out.size(), state_size());
  const WorldClock clock{time_ns, steps};
  state::Writer writer(out);
  state::walk_fields(writer, clock);
  std::span<double> rest = out.subspan(kClockSize);
  physics->save(rest.first(physics->state_size()));
  rest = rest.subspan(physics->state_size());
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const std::size_t size = robots[i].seat->state_size();
    within_robot(i, [&] { robots[i].seat->save(rest.first(size)); });
    rest = rest.subspan(size);
  }
}

/// Robots but the first are looked at before anything changes; the first looks by itself.
void World::Impl::restore(std::span<const double> in) {
  check_state_size(in.size(), state_size());
  WorldClock clock;
  state::Reader reader(in);
  state::walk_fields(reader, clock);
  StateFault fault = reader.fault();
  const std::span<const double> bodies = in.subspan(kClockSize, physics->state_size());
  for (std::size_t k = 0; k < bodies.size() && !fault.there(); ++k)
    if (!(std::abs(bodies[k]) <= kMostState)) fault = {kClockSize + k, bodies[k], "is out of range", "", -kMostState, kMostState};
  if (fault.there()) throw_if_any(fault, state_layout());
  const auto each_robot = [&](std::size_t first, auto&& work) {
    std::span<const double> rest = in.subspan(kClockSize + bodies.size());
    for (std::size_t i = 0; i < robots.size(); ++i) {
      const std::size_t size = robots[i].seat->state_size();
      if (i >= first) within_robot(i, [&] { work(*robots[i].seat, rest.first(size)); });
      rest = rest.subspan(size);
    }
  };
  each_robot(1, [](seat::Seat& seat, std::span<const double> numbers) { seat.check(numbers); });
  each_robot(0, [](seat::Seat& seat, std::span<const double> numbers) { seat.restore(numbers); });
  physics->restore(bodies);
  put_here.clear();
  time_ns = clock.time_ns;
  steps = clock.steps;
}

StateLayout World::state_layout() const { return impl_->state_layout(); }
std::size_t World::state_size() const { return impl_->state_size(); }
void World::save(std::span<double> out) const { impl_->save(out); }
void World::restore(std::span<const double> in) { impl_->restore(in); }

std::uint64_t World::state_hash() const {
  std::vector<double> numbers(state_size());
  save(numbers);
  return vsa::state_hash(numbers);
}

void World::save_file(const std::filesystem::path& file) const {
  std::vector<double> numbers(state_size());
  save(numbers);
  std::string text(kMagic);
  for (const std::uint64_t word :
       {kVersion, state_layout().hash(), std::uint64_t{numbers.size()}, vsa::state_hash(numbers), hash_of_kinds(*this)})
    put_word(text, word);
  for (const std::uint64_t hash : hashes_of_parameters(*this, impl_->physics->bodies()->links())) put_word(text, hash);
  for (const double v : numbers) put_word(text, bits_as<std::uint64_t>(v));
  write_whole(file, text);
}

void World::restore_file(const std::filesystem::path& file) {
  const StateLayout ours = state_layout();
  const std::optional<std::string> text = read_file(file);
  if (!text) refuse(file, "", "", std::string("can't be read: ") + std::generic_category().message(errno), "a file of save_file()");
  if (text->size() < 8 * kLeastHeader || text->compare(0, kMagic.size(), kMagic) != 0)
    refuse(file, "", fmt::format("{} bytes", text->size()), "is no world's state", "a file of save_file()");
  const std::uint64_t version = word_at(*text, 1), layout = word_at(*text, 2), count = word_at(*text, 3);
  if (version < 1 || version > kVersion)
    refuse(file, "version", fmt::format("{}", version), "isn't known", fmt::format("1 … {}", kVersion));
  const std::size_t header = header_numbers(version, *this);
  if (layout != ours.hash() || count != ours.size())
    refuse(file, "layout", fmt::format("{:016x}, {} numbers", layout, count), "is of another world",
           fmt::format("{:016x}, {} numbers", ours.hash(), ours.size()));
  if (text->size() != 8 * (header + count))
    refuse(file, "", fmt::format("{} bytes", text->size()), "has another length", fmt::format("{}", 8 * (header + count)));
  if (header > kLeastHeader && word_at(*text, kLeastHeader) != hash_of_kinds(*this))
    refuse(file, "actuators", "", "are of other kinds than this world's",
           "the same controllers, firmware models and dialects, and numbers of motors");
  if (version > 2) {
    const std::vector<std::uint64_t> hashes = hashes_of_parameters(*this, impl_->physics->bodies()->links());
    Problems problems;
    for (std::size_t k = 0; k < hashes.size(); ++k) {
      if (word_at(*text, kLeastHeader + 1 + k) == hashes[k]) continue;
      const bool links = k == 0;
      problems.add({file.string(), links ? "links" : actuator_key(*this, k - 1), "",
                    links ? "had other masses, inertias or friction when the state was saved"
                          : "had other parameters when the state was saved",
                    "a state goes on with the parameters that it was saved under"});
    }
    problems.throw_if_any();
  }
  std::vector<double> numbers(count);
  for (std::size_t k = 0; k < count; ++k) numbers[k] = bits_as<double>(word_at(*text, header + k));
  if (vsa::state_hash(numbers) != word_at(*text, 4)) refuse(file, "", "", "is damaged", "numbers with the hash of its header");
  try {
    restore(numbers);
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& p : problems) p.file = file.string();
    throw InputError(std::move(problems));
  }
}

}  // namespace vsa::engine
