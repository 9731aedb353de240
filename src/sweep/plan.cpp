// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sweep/plan.hpp"

#include <boost/random/sobol.hpp>
#include <cmath>
#include <sstream>
#include <utility>

#include "sweep/plan_impl.hpp"
#include "vsa/batch/spread.hpp"
#include "vsa/config/find_file.hpp"
#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/scenario/toml.hpp"

namespace vsa::sweep {
namespace {

using config::TomlSection;

batch::Distribution::Kind kind_of(Axis::Law law) {
  using Kind = batch::Distribution::Kind;
  return law == Axis::Law::normal ? Kind::normal : law == Axis::Law::log_uniform ? Kind::log_uniform : Kind::uniform;
}

/// 0 … 1, of a Sobol' sequence without its first point, which is a corner: Boost leaves it out.
std::vector<double> sobol_point(std::size_t dimensions, std::size_t index) {
  std::vector<double> out(dimensions);
  if (dimensions == 0) return out;
  boost::random::sobol sequence(dimensions);
  sequence.discard(dimensions * index);
  for (double& x : out) x = static_cast<double>(sequence() >> 11) * 0x1p-53;
  return out;
}

}  // namespace

std::string value_text(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return config::number_text(*number);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  return std::get<std::string>(value);
}

double number_of(const Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? 1 : 0;
  return std::get<double>(value);
}

void put(toml::table& scenario, const std::string& key, const Value& value) {
  const auto nowhere = [&](const std::string& what) {
    throw InputError({"", "vary.key", key, what, "a key of the scenario's file"});
  };
  const std::size_t dot = key.find('.');
  if (dot == std::string::npos || dot + 1 == key.size()) nowhere("names no key");
  const std::string part = key.substr(0, dot);
  // The parameters' own keys have points in them.
  std::vector<std::string> rest = config::split(key.substr(dot + 1), '.');
  if (part == "set") rest = {key.substr(dot + 1)};
  if (part == "study" && rest.size() > 1 && (rest[0] == "from" || rest[0] == "hold"))
    rest = {rest[0], key.substr(dot + 2 + rest[0].size())};
  toml::node* at = scenario.get(part);
  if (at == nullptr) {
    if (part == "command") nowhere("the scenario has no commands");
    at = &scenario.insert(part, toml::table{}).first->second;
  }
  const std::string last = rest.back();
  rest.pop_back();
  for (const std::string& word : rest) {
    if (toml::array* list = at->as_array()) {
      const auto index = config::parse_integer(word);
      if (!index || *index < 0 || static_cast<std::size_t>(*index) >= list->size()) nowhere("there is no entry " + word);
      at = list->get(static_cast<std::size_t>(*index));
    } else if (toml::table* table = at->as_table()) {
      toml::node* next = table->get(word);
      at = next != nullptr ? next : &table->insert(word, toml::table{}).first->second;
    } else {
      nowhere(word + " isn't below a table");
    }
  }
  toml::table* table = at->as_table();
  if (table == nullptr) nowhere("isn't in a table");
  std::visit([&](const auto& v) { table->insert_or_assign(last, v); }, value);
}

std::vector<Value> Plan::Impl::values(std::size_t point) const {
  const std::size_t sample = point % samples, candidate = point / (samples * cells);
  std::size_t cell = point / samples % cells, dimensions = 0, searched = 0;
  for (const Axis& axis : axes) {
    dimensions += axis.kind == Axis::Kind::sobol ? 1 : 0;
    searched += axis.kind == Axis::Kind::searched ? 1 : 0;
  }
  const std::vector<double> even = sobol_point(dimensions, sample);
  std::vector<Value> out(axes.size());
  std::size_t next = dimensions;
  for (std::size_t k = axes.size(); k-- > 0;) {
    const Axis& axis = axes[k];
    if (axis.kind == Axis::Kind::listed) {
      out[k] = axis.values[cell % axis.values.size()];
      cell /= axis.values.size();
    } else if (axis.kind == Axis::Kind::searched) {
      --searched;
      const double part = candidates.empty() ? 0.5 : candidates[candidate][searched];
      const bool log = axis.law == Axis::Law::log_uniform;
      out[k] = part <= 0   ? axis.a
               : part >= 1 ? axis.b
               : log       ? axis.a * std::pow(axis.b / axis.a, part)
                           : axis.a + (axis.b - axis.a) * part;
    } else if (axis.kind == Axis::Kind::sobol) {
      out[k] = axis.a + (axis.b - axis.a) * even[--next];
    } else {
      out[k] = batch::drawn({kind_of(axis.law), axis.a, axis.b}, seed, sample, axis.of, axis.keys.front());
    }
  }
  return out;
}

Value Plan::Impl::placed(const std::string& key, const Value& value) const {
  const auto* name = std::get_if<std::string>(&value);
  const bool world = key == "scenario.world", gait = key == "motion.file";
  if (name == nullptr || base_file == file || !(world || gait)) return value;
  const std::filesystem::path beside = file.parent_path();
  try {
    const auto found = world ? config::find_file(*name, key, "models/worlds", ".sdf", beside)
                             : config::find_file(*name, key, "models/gaits", ".toml", beside);
    return std::filesystem::absolute(found).string();
  } catch (const InputError& error) {
    Problem problem = error.problems().front();
    problem.file = file.string();
    throw InputError(std::move(problem));
  }
}

scenario::Scenario Plan::Impl::scenario_with(const std::vector<Value>& with, std::size_t repetition) const {
  constexpr std::uint64_t kApart = 1'000'003;  // between the repetitions' seeds
  toml::table root = base;
  if (const auto gait = root.at_path("motion.file").value<std::string>(); gait && own_motion)
    put(root, "motion.file", placed("motion.file", *gait));
  for (std::size_t k = 0; k < axes.size(); ++k)
    for (const std::string& key : axes[k].keys)
      if (!axes[k].parameter) put(root, key, placed(key, with[k]));
  Problems problems;
  TomlSection top(&root, base_file.string(), "", problems);
  TomlSection run(top.table("scenario"), base_file.string(), "scenario.", problems);
  scenario::Scenario out = scenario::read(top, run, base_file, problems);
  run.refuse_others();
  top.refuse_others();
  if (!out.duration_s) run.need("duration_s", "seconds; a sweep's runs end");
  problems.throw_if_any();
  if (!out.faults.empty())
    out.seed = (out.seed.value_or(seed) + kApart * repetition) % (static_cast<std::uint64_t>(scenario::kLargestSeed) + 1);
  return out;
}

const std::string& Plan::title() const { return impl_->title; }
const std::vector<Axis>& Plan::axes() const { return impl_->axes; }
const std::vector<Measure>& Plan::measures() const { return impl_->measures; }
std::size_t Plan::points() const { return impl_->cells * impl_->samples * candidates(); }
std::size_t Plan::candidates() const { return impl_->search ? impl_->candidates.size() : 1; }
const std::vector<std::vector<double>>& Plan::candidate_list() const { return impl_->candidates; }
std::size_t Plan::most_runs() const {
  const std::size_t each = impl_->cells * impl_->samples * repetitions();
  return impl_->search ? each * impl_->search->population * (impl_->search->generations + 1) : each;
}
const std::optional<Search>& Plan::search() const { return impl_->search; }

Plan Plan::with(std::vector<std::vector<double>> candidates) const {
  auto impl = std::make_shared<Impl>(*impl_);
  impl->candidates = std::move(candidates);
  return Plan(std::move(impl));
}
std::size_t Plan::repetitions() const { return impl_->repetitions; }
std::uint64_t Plan::seed() const { return impl_->seed; }
double Plan::limit_s() const { return impl_->limit_s; }
std::vector<Value> Plan::values(std::size_t point) const { return impl_->values(point); }
std::uint64_t Plan::fingerprint() const { return impl_->fingerprint; }
const std::string& Plan::text() const { return impl_->text; }

std::string Plan::scenario_text(std::size_t run) const {
  const std::vector<Value> with = values(run / repetitions());
  std::ostringstream out;
  out << "# Run " << run << " of " << impl_->file.string() << ".\n";
  for (std::size_t k = 0; k < with.size(); ++k) {
    if (impl_->axes[k].parameter)
      out << "# Not in it: " << config::join(impl_->axes[k].keys) << (impl_->axes[k].of.empty() ? "" : " of " + impl_->axes[k].of)
          << " = " << value_text(with[k]) << (impl_->axes[k].factor ? " times its own\n" : "\n");
  }
  if (impl_->start.yaw_deg > 0 || impl_->start.xy_m > 0)
    out << "# Not in it: the start of repetition " << run % repetitions() << ".\n";
  if (impl_->is_study()) {
    toml::table root = impl_->base;
    for (std::size_t k = 0; k < with.size(); ++k)
      for (const std::string& key : impl_->axes[k].keys) put(root, key, with[k]);
    out << '\n' << root << '\n';
    return out.str();
  }
  const scenario::Scenario s = impl_->scenario_with(with, run % repetitions());
  out << '\n' << scenario::text(s, *s.duration_s);
  return out.str();
}

}  // namespace vsa::sweep
