// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "sweep/plan_impl.hpp"
#include "vsa/batch/batch.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/scenario/player.hpp"
#include "vsa/units.hpp"

namespace vsa::sweep {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::runtime_error beyond(double limit_s) {
  return std::runtime_error(fmt::format("the limit: run_s = {:g} s of wall time", limit_s));
}

/// What a world is made of, as a key to those that were read.
std::string ingredients(const scenario::Scenario& s) {
  std::string out = s.world + '\n' + s.type + '\n' + s.concave + '\n' + s.impossible_inertia + '\n' +
                    (s.step_s ? config::number_text(*s.step_s) : "");
  for (const std::string& set : s.set) out += '\n' + set;
  return out;
}

}  // namespace

struct Runner::Impl {
  explicit Impl(const Plan& p) : plan(p) {}

  engine::World world_of(const scenario::Scenario& s) {
    const std::string key = ingredients(s);
    if (!read || key != read_key) {
      read.emplace(scenario::load_world(s));
      read_key = key;
    }
    return read->clone();
  }

  /// Parameters of actuators and links that the scenario has no place for.
  void set_parameters(engine::World& world, const std::vector<Value>& with) const {
    const std::vector<Axis>& axes = plan.axes();
    std::vector<batch::Setting> settings;
    std::optional<batch::Batch> book;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const Axis& axis = axes[k];
      if (!axis.parameter) continue;
      if (!book) book.emplace(world, 1, 1);
      for (const std::string& key : axis.keys) {
        if (axis.factor) {
          for (const std::string& owner : book->owners(axis.of, key))
            settings.push_back({0, owner, key, number_of(with[k]) * book->value(0, owner, key)});
        } else if (std::holds_alternative<std::string>(with[k]) || std::holds_alternative<bool>(with[k])) {
          settings.push_back({0, axis.of, key, value_text(with[k])});
        } else {
          settings.push_back({0, axis.of, key, number_of(with[k])});
        }
      }
    }
    if (!book) return;
    try {
      book->set(settings);
    } catch (const InputError& error) {  // in which nobody knows of copies
      std::vector<Problem> problems = error.problems();
      for (Problem& p : problems)
        if (constexpr std::string_view kOnly = "copy 0, "; p.key.rfind(kOnly, 0) == 0) p.key.erase(0, kOnly.size());
      throw InputError(std::move(problems));
    }
    world.set_parameters(*book->parameters(0));
  }

  void place(engine::World& world, std::size_t repetition) const {
    const Start& start = plan.impl_->start;
    const std::string model = scenario::travelling_model(world);
    if (start.yaw_deg <= 0 && start.xy_m <= 0) return;
    if (model.empty()) throw InputError({"", "start", "", "no robot of this world flies free", "no start, or a robot that does"});
    const auto drawn = [&](double most, const char* what) {
      return batch::drawn({batch::Distribution::Kind::uniform, -most, most}, plan.impl_->seed, repetition, "start", what);
    };
    world.displace_model(model, drawn(start.yaw_deg, "yaw") * kPi / 180, {drawn(start.xy_m, "x"), drawn(start.xy_m, "y"), 0});
  }

  struct Ready {
    scenario::Scenario scenario;
    engine::World world;
    scenario::Player player;
    Observer observer;
    std::int64_t end_ns;
    Ready(scenario::Scenario s, engine::World w, const Plan& plan)
        : scenario(std::move(s)),
          world(std::move(w)),
          player(scenario, world),
          observer(plan.measures(), world, scenario::travel_window_s(player.gait())),
          end_ns(world.time_ns() + std::llround(*scenario.duration_s * 1e9)) {
      Problems problems;
      for (const Measure& m : plan.measures())
        if (m.from_s >= *scenario.duration_s)
          problems.add({"", "measure.from_s", config::number_text(m.from_s), "the run is over before (" + m.name + ")",
                        "below duration_s = " + config::number_text(*scenario.duration_s)});
      problems.throw_if_any();
    }
    void step() {
      player.apply(world);
      world.step();
      observer.sample(world);
    }
  };
  std::unique_ptr<Ready> ready(const std::vector<Value>& with, std::size_t repetition) {
    scenario::Scenario s = plan.impl_->scenario_with(with, repetition);
    engine::World world = world_of(s);
    set_parameters(world, with);
    place(world, repetition);
    auto out = std::make_unique<Ready>(std::move(s), std::move(world), plan);
    scenario::break_robots(out->world, scenario::seeded_faults(out->scenario));
    return out;
  }
  std::unique_ptr<Ready> ready(std::size_t run) { return ready(plan.values(run / plan.repetitions()), run % plan.repetitions()); }

  Plan plan;
  std::optional<engine::World> read;
  std::string read_key;
};

Runner::Runner(const Plan& plan) : impl_(std::make_unique<Impl>(plan)) {}
Runner::~Runner() = default;

std::optional<Outcome> Runner::run(std::size_t number, const std::function<bool()>& wanted) {
  constexpr unsigned kLook = 16;  // steps between two questions
  const Clock::time_point began = Clock::now();
  const double cpu_began = thread_cpu_s(), limit_s = impl_->plan.limit_s();
  Outcome out;
  out.run = number;
  try {
    if (impl_->plan.impl_->is_study()) {
      const auto in_time = [&] {
        if (seconds_since(began) > limit_s) throw beyond(limit_s);
        return !wanted || wanted();
      };
      auto values = run_study(*impl_->plan.impl_, impl_->plan.values(number / impl_->plan.repetitions()), in_time);
      if (!values) return std::nullopt;
      out.values = std::move(*values);
      out.wall_s = seconds_since(began);
      out.cpu_s = std::numeric_limits<double>::quiet_NaN();  // a study works in a thread of its own
      return out;
    }
    const auto ready = impl_->ready(number);
    for (unsigned n = 0; ready->world.time_ns() < ready->end_ns; ++n) {
      if (n % kLook == 0 && wanted && !wanted()) return std::nullopt;
      if (seconds_since(began) > limit_s) throw beyond(limit_s);
      ready->step();
    }
    out.values = ready->observer.values();
    for (std::size_t i = 0; i < ready->world.robot_count(); ++i) {
      for (const host::Notice& notice : ready->world.robot(i).take_notices())
        if (out.notice.empty()) out.notice = notice.text;
    }
  } catch (const std::exception& error) {
    out.error = error.what();
  }
  out.wall_s = seconds_since(began);
  out.cpu_s = thread_cpu_s() - cpu_began;
  return out;
}

Plan::operator Series() const {
  return {fingerprint(), text(), most_runs(), measures().size(), [plan = *this]() -> MakeRun {
            return [runner = std::make_shared<Runner>(plan)](std::size_t run, const std::function<bool()>& wanted) {
              return runner->run(run, wanted);
            };
          }};
}

double Runner::estimate_s(std::size_t number, double probe_s, const std::function<bool()>& wanted) {
  const Clock::time_point began = Clock::now();
  if (impl_->plan.impl_->is_study()) {
    const auto whole = run(number, wanted);
    return whole ? whole->wall_s : 0;
  }
  const auto ready = impl_->ready(number);
  const double loading_s = seconds_since(began);
  const std::int64_t first_ns = ready->world.time_ns();
  while (ready->world.time_ns() < ready->end_ns && seconds_since(began) < loading_s + probe_s && (!wanted || wanted()))
    ready->step();
  const auto simulated = static_cast<double>(std::max<std::int64_t>(1, ready->world.time_ns() - first_ns));
  return loading_s + (seconds_since(began) - loading_s) * static_cast<double>(ready->end_ns - first_ns) / simulated;
}

// A run's problems with names that only the plan knows: which axis had which value.
void Plan::check() const {
  Problems problems;
  std::set<std::string> told;
  Runner::Impl runner(*this);
  const auto attempt = [&](const std::vector<Value>& with, const std::string& key, const std::string& value) {
    try {
      if (impl_->is_study()) return check_study(*impl_, with);
      static_cast<void>(runner.ready(with, 0));
    } catch (const InputError& error) {
      for (Problem p : error.problems()) {
        if (p.file.empty()) p.file = impl_->file.string();
        if (!told.insert(p.text()).second) continue;
        if (!key.empty()) p.message += " (with " + key + " = " + value + ")";
        problems.add(std::move(p));
      }
    } catch (const std::exception& error) {
      if (told.insert(error.what()).second) problems.add({impl_->file.string(), key, value, error.what(), ""});
    }
  };
  const bool faulty =
      impl_->base.at_path("scenario.faults").is_array() || std::any_of(axes().begin(), axes().end(), [](const Axis& a) {
        return std::find(a.keys.begin(), a.keys.end(), "scenario.faults") != a.keys.end();
      });
  if (repetitions() > 1 && !faulty && impl_->start.yaw_deg <= 0 && impl_->start.xy_m <= 0)
    throw InputError({impl_->file.string(), "repetitions", std::to_string(repetitions()), "nothing differs between them",
                      "[start] of a robot that flies free, faults that draw, or 1"});
  const std::vector<Value> first = impl_->values(0);
  attempt(first, "", "");
  if (!problems.empty()) problems.throw_if_any();
  for (std::size_t k = 0; k < axes().size(); ++k) {
    const Axis& axis = axes()[k];
    std::vector<Value> tried = axis.values;
    if (axis.spaced) tried = {axis.values.front(), axis.values.back()};
    if (axis.kind != Axis::Kind::listed)
      tried = axis.law == Axis::Law::normal ? std::vector<Value>{axis.a - 3 * axis.b, axis.a + 3 * axis.b}
                                            : std::vector<Value>{axis.a, axis.b};
    for (const Value& value : tried) {
      std::vector<Value> with = first;
      with[k] = value;
      attempt(with, axis.name, value_text(value));
    }
  }
  problems.throw_if_any();
}

}  // namespace vsa::sweep
