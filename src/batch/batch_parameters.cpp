// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Giving copies parameters of their own: all is made and checked first, by all threads, then the copies go on with it.
#include <cmath>
#include <map>
#include <set>

#include "batch/batch_impl.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::batch {
namespace {

/// What is made for copies that have parameters of their own is kept for one in so many, and the rest made again when its turn comes:
/// all of it beside what they still have would be its memory twice, and the allocator wouldn't give that back.
constexpr std::size_t kKeptShare = 8;
constexpr std::size_t kMostProblems = 10;  ///< of many copies the same is wrong

std::string who_text(const std::string& who) { return who.empty() ? "" : who + ": "; }

void check(const Spread& s, Problems& problems) {
  const Distribution& d = s.draw;
  const auto say = [&](const char* message, const char* allowed) {
    problems.add({"", who_text(s.who) + s.key, config::number_text(d.a) + ", " + config::number_text(d.b), message, allowed});
  };
  if (!std::isfinite(d.a) || !std::isfinite(d.b)) return say("aren't finite", "two numbers");
  using Kind = Distribution::Kind;
  if (d.kind == Kind::uniform && d.a > d.b) say("nothing lies between them", "low, high");
  if (d.kind == Kind::log_uniform && !(d.a > 0 && d.a <= d.b)) say("have no logarithms to draw from", "0 < low ≤ high");
  if (d.kind == Kind::normal && d.b < 0) say("no spread is below 0", "mean, standard deviation ≥ 0");
}

[[noreturn]] void refuse(const std::map<std::size_t, std::vector<Problem>>& by_copy) {
  std::vector<Problem> out;
  std::size_t all = 0;
  for (const auto& [copy, problems] : by_copy) {
    all += problems.size();
    for (Problem p : problems) {
      if (out.size() == kMostProblems) break;
      p.key = "copy " + std::to_string(copy) + ", " + p.key;
      out.push_back(std::move(p));
    }
  }
  if (all > out.size()) out.push_back({"", "", "", "and " + std::to_string(all - out.size()) + " more", ""});
  throw InputError(std::move(out));
}

}  // namespace

void Batch::Impl::set(std::span<const Setting> settings) {
  std::vector<CopyChanges> all_changes;
  std::map<std::size_t, std::size_t> place;
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> known;
  for (const Setting& s : settings) {
    check_copy(s.copy);
    const auto [at, fresh] = place.try_emplace(s.copy, all_changes.size());
    if (fresh) all_changes.push_back({s.copy, {}});
    const auto [owners, unknown] = known.try_emplace({s.who, s.key});
    if (unknown) owners->second = book.owners(worlds.front(), s.who, s.key);
    for (const std::size_t owner : owners->second) all_changes[at->second].changes.push_back({owner, &s.key, s.value});
  }
  change(all_changes);
}

void Batch::Impl::randomize(std::uint64_t seed, std::span<const Spread> what, std::span<const std::size_t> which) {
  Problems problems;
  const engine::World& world = worlds.front();
  std::vector<std::vector<std::size_t>> owners;
  std::set<std::pair<std::size_t, std::string>> seen;
  for (const Spread& s : what) {
    batch::check(s, problems);
    owners.push_back(book.owners(world, s.who, s.key));
    for (const std::size_t owner : owners.back())
      if (!seen.emplace(owner, s.key).second)
        problems.add({"", book.owner_name(world, s.key, owner) + ": " + s.key, "", "is drawn twice", "each parameter once"});
  }
  problems.throw_if_any();
  std::vector<CopyChanges> out;
  for (const std::size_t copy : which) {
    out.push_back({copy, {}});
    for (std::size_t k = 0; k < what.size(); ++k) {
      for (const std::size_t owner : owners[k]) {
        double value = drawn(what[k].draw, seed, copy, book.owner_name(world, what[k].key, owner), what[k].key);
        if (what[k].draw.times_nominal) value *= book.nominal(world, owner, what[k].key);
        out.back().changes.push_back({owner, &what[k].key, book.rounded(world, owner, what[k].key, value)});
      }
    }
  }
  change(out);
}

void Batch::Impl::change(const std::vector<CopyChanges>& changes) {
  const auto made = [&](std::size_t worker, std::size_t item) {
    return book.with(worlds[worker], parameters[changes[item].copy], changes[item].changes);
  };
  const std::size_t kept = copies() / kKeptShare + 1;
  std::vector<CopyParameters> next(changes.size());
  std::vector<std::vector<Problem>> problems(changes.size());
  crew.run(changes.size(), [&](std::size_t worker, std::size_t item) {
    try {
      CopyParameters checked = made(worker, item);
      if (item < kept || !has_own_parameters(changes[item].copy)) next[item] = std::move(checked);
    } catch (const InputError& error) {
      problems[item] = error.problems();
    }
  });
  std::map<std::size_t, std::vector<Problem>> by_copy;
  for (std::size_t k = 0; k < changes.size(); ++k)
    if (!problems[k].empty()) by_copy[changes[k].copy] = std::move(problems[k]);
  if (!by_copy.empty()) refuse(by_copy);
  std::vector<std::size_t> which;
  for (const CopyChanges& c : changes) which.push_back(c.copy);
  use(which, [&](std::size_t worker, std::size_t item) { return next[item].of ? std::move(next[item]) : made(worker, item); });
}

/// As World::set_parameters does with a World by itself.
void Batch::Impl::use(std::span<const std::size_t> which, const NextParameters& next) {
  parameters_differ = true;
  crew.run(which.size(), [&](std::size_t worker, std::size_t item) {
    const std::size_t copy = which[item];
    engine::World& world = worlds[worker];
    take(world, copy);
    CopyParameters to = next(worker, item);
    world.set_parameters(*to.of);
    put(worker, copy);
    parameters[copy] = std::move(to);
  });
}

}  // namespace vsa::batch
