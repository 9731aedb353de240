// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <tuple>

#include "sweep/plan_impl.hpp"
#include "vsa/config/find_file.hpp"
#include "vsa/config/text.hpp"
#include "vsa/config/toml_section.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"

namespace vsa::sweep {
namespace {

namespace fs = std::filesystem;
using config::TomlSection;

constexpr double kAny = std::numeric_limits<double>::max();
constexpr double kMostSamples = Plan::kMostRuns;

constexpr const char* kParts[] = {"scenario", "study", "set", "motion", "command"};
constexpr const char* kOutside[] = {"speed", "low_latency", "view", "view_port", "view_records", "paused", "topics"};

std::optional<Value> value_of(const toml::node& node) {
  if (const auto whole = node.value_exact<std::int64_t>()) return Value(*whole);
  if (const auto number = node.value_exact<double>()) return std::isfinite(*number) ? std::optional<Value>(*number) : std::nullopt;
  if (const auto flag = node.value_exact<bool>()) return Value(*flag);
  if (const auto text = node.value_exact<std::string>()) return Value(*text);
  return std::nullopt;
}

std::vector<Value> listed(TomlSection& s) {
  std::vector<Value> out;
  const toml::node* node = s.find("list");
  if (node == nullptr) return out;
  if (!node->is_array() || node->as_array()->empty()) {
    s.add("list", "", "isn't a list with values", "[1.0, 2.0], [\"a\", \"b\"]");
    return out;
  }
  for (const toml::node& item : *node->as_array()) {
    const auto value = value_of(item);
    if (!value) s.add("list[" + std::to_string(out.size()) + "]", "", "isn't a value", "a number, a text, true or false");
    out.push_back(value.value_or(Value(0.0)));
  }
  return out;
}

std::optional<std::array<double, 2>> pair_of(TomlSection& s, const char* key) {
  const toml::node* node = s.find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_array() || node->as_array()->size() != 2) {
    s.add(key, "", "isn't a pair of numbers", "[from, to]");
    return std::array<double, 2>{0, 1};
  }
  const auto numbers = s.numbers(key, -kAny, kAny);
  return std::array<double, 2>{numbers[0], numbers[1]};
}

/// a, …, b; exact at both ends, and to 14 digits between.
std::vector<Value> spaced(double a, double b, std::size_t count, bool log) {
  std::vector<Value> out;
  for (std::size_t i = 0; i < count; ++i) {
    const double part = count == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(count - 1);
    const double between = log ? a * std::pow(b / a, part) : a + (b - a) * part;
    // A third of 0.3 is to be read as 0.1.
    const double short_one = config::parse_number(fmt::format("{:.14g}", between)).value_or(between);
    out.emplace_back(i == 0 ? a : i + 1 == count ? b : short_one);
  }
  return out;
}

void read_spaced(TomlSection& s, Axis& axis, const char* key, bool log) {
  const auto ends = pair_of(s, key);
  if (!ends) return;
  const auto count = s.need("count", "how many values, 2 …").whole("count", 2, kMostSamples);
  const auto [a, b] = *ends;
  if (a == b) s.add(key, config::number_text(a), "is empty: both ends are the same", "from < to");
  if (log && !(a > 0 && b > 0)) s.add(key, "", "a logarithmic range needs numbers above 0", "0 < from, to");
  if (count && (!log || (a > 0 && b > 0))) axis.values = spaced(a, b, static_cast<std::size_t>(*count), log);
}

void read_drawn(TomlSection& s, Axis& axis, const char* key) {
  const auto ends = pair_of(s, key);
  if (!ends) return;
  const std::string way = key;
  axis.kind = way == "random" ? Axis::Kind::random : way == "sobol" ? Axis::Kind::sobol : Axis::Kind::searched;
  std::tie(axis.a, axis.b) = std::tie((*ends)[0], (*ends)[1]);
  if (axis.kind != Axis::Kind::sobol) {
    std::vector<std::string> laws{"uniform", "log_uniform"};
    if (axis.kind == Axis::Kind::random) laws.emplace_back("normal");
    const auto law = s.word("law", laws).value_or("uniform");
    axis.law = law == "normal" ? Axis::Law::normal : law == "log_uniform" ? Axis::Law::log_uniform : Axis::Law::uniform;
  }
  if (axis.law == Axis::Law::normal) {
    if (!(axis.b >= 0)) s.add(key, "", "a standard deviation below 0", "[mean, standard deviation ≥ 0]");
  } else if (!(axis.a < axis.b) || (axis.law == Axis::Law::log_uniform && !(axis.a > 0))) {
    s.add(key, "", "is empty", axis.law == Axis::Law::uniform ? "[from, to], from < to" : "[from, to], 0 < from < to");
  }
}

/// One, or a list of those that go together.
void read_keys(TomlSection& s, Axis& axis) {
  constexpr const char* kAllowed = "scenario.…, set.…, motion.…, command.N.…, or a parameter of actuators or links; a list of them";
  const toml::node* node = s.need("key", kAllowed).find("key");
  if (node != nullptr && node->is_array()) {
    axis.keys = s.texts("key");
    if (axis.keys.empty()) s.add("key", "[]", "is empty", kAllowed);
  } else {
    axis.keys = {s.text("key").value_or("")};
  }
  if (axis.keys.empty()) axis.keys.emplace_back();
  std::size_t parameters = 0;
  for (const std::string& key : axis.keys) {
    const std::string first = key.substr(0, key.find('.'));
    parameters += std::find(std::begin(kParts), std::end(kParts), first) == std::end(kParts) ? 1 : 0;
    for (const char* name : kOutside)
      if (key == std::string("scenario.") + name) s.add("key", key, "changes none of a run's numbers", "another key");
  }
  axis.parameter = parameters > 0;
  if (axis.parameter && parameters < axis.keys.size())
    s.add("key", config::join(axis.keys), "mixes the scenario's keys and parameters", "one kind");
}

Axis read_axis(TomlSection s) {
  Axis axis;
  read_keys(s, axis);
  axis.name = s.text("name").value_or(axis.keys.front());
  axis.of = s.text("of").value_or("");
  axis.factor = s.flag("factor").value_or(false);
  if (!axis.parameter && !axis.of.empty()) s.add("of", axis.of, "is for parameters; this key is the scenario's", "no of");
  if (!axis.parameter && axis.factor) s.add("factor", "true", "is for parameters; this key is the scenario's", "no factor");
  int ways = 0;
  std::string found;
  for (const char* way : {"list", "range", "log", "random", "sobol", "search"}) {
    if (s.find(way) == nullptr) continue;
    ++ways;
    found += (found.empty() ? "" : ", ") + std::string(way);
  }
  if (ways != 1)
    s.add("list", found, ways == 0 ? "nothing says which values" : "several say which values",
          "one of list, range, log, random, sobol, search");
  axis.values = listed(s);
  if (axis.factor && std::any_of(axis.values.begin(), axis.values.end(), [](const Value& v) { return v.index() >= 2; }))
    s.add("list", "", "a factor is a number", "numbers");
  read_spaced(s, axis, "range", false);
  read_spaced(s, axis, "log", true);
  read_drawn(s, axis, "random");
  read_drawn(s, axis, "sobol");
  read_drawn(s, axis, "search");
  s.refuse_others();
  return axis;
}

Measure read_study_measure(TomlSection s) {
  Measure m;
  m.name = s.need("name", "the column's name, with its unit").text("name").value_or("");
  m.value = s.need("value", "a place in the study's results.json, or a quantity's name").text("value").value_or("");
  s.refuse_others();
  return m;
}

Measure read_measure(TomlSection s) {
  Measure m;
  s.need("name", "the column's name, with its unit")
      .need("signal", config::join(signal_names("world")) + "; docs/reference/sweep-files.md");
  m.name = s.text("name").value_or("");
  m.signal = s.text("signal").value_or("");
  m.statistic = s.word("statistic", statistic_names()).value_or("last");
  m.actuator = s.text("actuator").value_or("");
  m.joint = s.text("joint").value_or("");
  m.link = s.text("link").value_or("");
  m.from_s = s.number("from_s", 0, scenario::kLongest_s).value_or(0);
  if (const auto to = s.number("to_s", 0, scenario::kLongest_s)) m.to_s = *to;
  if (!(m.from_s < m.to_s)) s.add("to_s", config::number_text(m.to_s), "no time is left", "above from_s");
  if (int{!m.actuator.empty()} + int{!m.joint.empty()} + int{!m.link.empty()} > 1)
    s.add("actuator", m.actuator, "a signal is of one thing", "actuator, joint or link");
  const bool settles = m.statistic == "settle_s", quantile = m.statistic == "quantile";
  if (settles) m.band = s.need("band", "how far from its last value it may be, above 0").number("band", 0, kAny).value_or(1);
  if (quantile) m.order = s.need("order", "0 … 1").number("order", 0, 1).value_or(0);
  const auto of_actuators = signal_names("actuator");
  const bool one = !m.actuator.empty() || !m.joint.empty() || !m.link.empty() ||
                   std::find(of_actuators.begin(), of_actuators.end(), m.signal) == of_actuators.end();
  if (!one && (settles || m.statistic == "last" || m.statistic == "first" || m.statistic == "integral"))
    s.add("statistic", m.statistic, "needs one actuator",
          "actuator = its name, or mean, min, max, peak, range, rms, std, quantile");
  s.refuse_others();
  return m;
}

template <class Item>
void refuse_twice(const std::vector<Item>& items, const char* key, const std::string& file, std::set<std::string>& names,
                  Problems& problems) {
  for (const Item& item : items) {
    if (!item.name.empty() && !names.insert(item.name).second)
      problems.add({file, key, item.name, "two columns of one name", "names that differ"});
  }
}

std::uint64_t hashed(std::uint64_t h, std::string_view text) {
  for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
  return (h ^ 0xFFU) * 0x100000001B3ULL;
}

std::string shown(const toml::table& table) {
  std::ostringstream out;
  out << table;
  return out.str();
}

/// What a key of the scenario names as files, as they are now.
std::string contents(const std::string& key, const std::string& name, const fs::path& beside) {
  const bool world = key == "scenario.world", gait = key == "motion.file", type = key == "scenario.type" || key == "study.type";
  if (!world && !gait && !type) return "";
  try {
    const auto file = world  ? config::find_file(name, "world", "models/worlds", ".sdf", beside)
                      : gait ? config::find_file(name, "gait", "models/gaits", ".toml", beside)
                             : config::find_file(name, "type", "actuators", ".toml", beside);
    return read_file(file).value_or("");
  } catch (const InputError&) {
    return "";  // Plan::check tells
  }
}

std::uint64_t fingerprint_of(const toml::table& root, const Plan::Impl& plan) {
  std::uint64_t h = hashed(0xCBF29CE484222325ULL, "vsasim sweep 1");
  h = hashed(h, shown(root));
  h = hashed(h, shown(plan.base));
  const fs::path beside = plan.base_file.parent_path();
  for (const char* key : {"scenario.world", "motion.file", "scenario.type", "study.type"}) {
    if (const auto name = plan.base.at_path(key).value<std::string>()) h = hashed(h, contents(key, *name, beside));
  }
  for (const Axis& axis : plan.axes) {
    for (const Value& value : axis.values)
      if (const auto* name = std::get_if<std::string>(&value)) h = hashed(h, contents(axis.keys.front(), *name, beside));
  }
  return h;
}

/// The tables of the scenario that the plan has itself, or those of the file that it names.
void read_base(TomlSection& top, Plan::Impl& out, Problems& problems) {
  bool own = false;
  for (const char* part : kParts) {
    const toml::node* node = top.find(part);
    if (node == nullptr || (std::string(part) == "scenario" && !node->is_table())) continue;
    out.base.insert(part, *node);
    own = own || std::string(part) == "scenario" || std::string(part) == "study";
  }
  out.base_file = out.file;
  if (out.is_study()) {
    for (const char* other : {"scenario", "motion", "command", "start"})
      if (top.find(other) != nullptr) top.add(other, "", "is a scenario's, and this plan has a study", "[study] or [scenario]");
    return;
  }
  const toml::node* named = top.find("scenario");
  if (own) return;
  const auto name = named == nullptr ? std::nullopt : named->value_exact<std::string>();
  if (!name) {
    top.add("scenario", "", "is missing", "a scenario's file, or a table with the world");
    return;
  }
  out.base_file = out.file.parent_path() / *name;
  try {
    toml::table base = config::parse_toml(out.base_file);
    base.erase("record");  // where it goes and how fast is the sweep's matter
    if (toml::table* run = base["scenario"].as_table())
      for (const char* outside : kOutside) run->erase(outside);
    for (auto&& [key, node] : out.base) base.insert_or_assign(key, node);  // the plan's own tables replace the file's
    out.base = std::move(base);
  } catch (const InputError& error) {
    problems.add_all(error);
  }
}

Objective read_objective(TomlSection s, const std::vector<Measure>& measures) {
  Objective out;
  std::vector<std::string> names;
  for (const Measure& m : measures) names.push_back(m.name);
  const std::string name = s.need("measure", config::join(names)).text("measure").value_or("");
  const auto at = std::find(names.begin(), names.end(), name);
  out.measure = static_cast<std::size_t>(at - names.begin());
  if (at == names.end() && !name.empty()) s.add("measure", name, "there is none of that name", config::join(names));
  out.maximize = s.need("goal", "\"minimize\", \"maximize\"").word("goal", {"minimize", "maximize"}).value_or("") == "maximize";
  const std::string over = s.word("over", {"mean", "median", "worst"}).value_or("median");
  out.over = over == "mean" ? Objective::Over::mean : over == "worst" ? Objective::Over::worst : Objective::Over::median;
  s.refuse_others();
  return out;
}

/// [optimize] and [[objective]]; they and searched axes go together.
void read_search(TomlSection& top, const std::string& file, Plan::Impl& out, Problems& problems) {
  const toml::table* table = top.table("optimize");
  const auto objectives = top.tables("objective");
  const auto searched =
      std::count_if(out.axes.begin(), out.axes.end(), [](const Axis& a) { return a.kind == Axis::Kind::searched; });
  if (table == nullptr && objectives.empty() && searched == 0) return;
  if (searched == 0) top.add("vary", "", "nothing is searched", "an axis with search = [from, to]");
  if (objectives.empty()) top.add("objective", "", "is missing", "[[objective]] with measure and goal");
  Search search;
  for (const toml::table* t : objectives)
    search.objectives.push_back(
        read_objective({t, file + ":" + std::to_string(t->source().begin.line), "objective.", problems}, out.measures));
  TomlSection s(table, file, "optimize.", problems);
  const bool several = objectives.size() > 1;
  const std::vector<std::string> known =
      several ? std::vector<std::string>{"nsga2", "nspso", "maco"} : std::vector<std::string>{"pso", "gaco"};
  search.algorithm = s.word("algorithm", known).value_or(known.front());
  search.population = static_cast<unsigned>(s.whole("population", 8, 1e6).value_or(search.population));
  search.generations = static_cast<unsigned>(s.whole("generations", 1, 1e6).value_or(search.generations));
  if (search.population % 4 != 0) s.add("population", std::to_string(search.population), "isn't a multiple of 4", "8, 12, 16, …");
  s.refuse_others();
  out.search = std::move(search);
}

void count(TomlSection& top, Plan::Impl& out) {
  double cells = 1;
  std::size_t sobol = 0;
  bool drawn = false;
  for (const Axis& axis : out.axes) {
    if (axis.kind == Axis::Kind::listed) cells *= static_cast<double>(std::max<std::size_t>(1, axis.values.size()));
    sobol += axis.kind == Axis::Kind::sobol ? 1 : 0;
    drawn = drawn || axis.kind == Axis::Kind::random || axis.kind == Axis::Kind::sobol;
  }
  if (drawn) top.need("samples", "how many draws of the random and Sobol' axes, 1 …");
  const auto samples = top.whole("samples", 1, kMostSamples);
  if (samples && !drawn)
    top.add("samples", std::to_string(*samples), "no axis is drawn", "an axis with random or sobol, or no samples");
  out.samples = static_cast<std::size_t>(samples.value_or(1));
  constexpr std::size_t kMostSobol = boost::random::default_sobol_table::max_dimension;
  if (sobol > kMostSobol)
    top.add("vary", std::to_string(sobol), "more Sobol' axes than can be", "at most " + std::to_string(kMostSobol));
  double runs = cells * static_cast<double>(out.samples) * static_cast<double>(out.repetitions);
  if (out.search) runs *= static_cast<double>(out.search->population) * (out.search->generations + 1.0);
  if (runs > Plan::kMostRuns) {
    top.add("vary", config::number_text(runs), "runs are more than a plan may have",
            "at most " + config::number_text(Plan::kMostRuns));
    return;
  }
  out.cells = static_cast<std::size_t>(cells);
}

}  // namespace

Plan Plan::load(const fs::path& file) {
  const toml::table root = config::parse_toml(file);
  Problems problems;
  auto impl = std::make_shared<Impl>();
  impl->file = file;
  impl->text = read_file(file).value_or("");
  TomlSection top(&root, file.string(), "", problems);
  impl->title = top.text("title").value_or("");
  if (const auto seed = top.whole("seed", 0, scenario::kLargestSeed)) impl->seed = static_cast<std::uint64_t>(*seed);
  impl->repetitions = static_cast<std::size_t>(top.whole("repetitions", 1, kMostSamples).value_or(1));
  read_base(top, *impl, problems);
  TomlSection start(top.table("start"), file.string(), "start.", problems);
  impl->start.yaw_deg = start.number("yaw_deg", 0, 180).value_or(0);
  impl->start.xy_m = start.number("xy_m", 0, 1e3).value_or(0);
  start.refuse_others();
  TomlSection limits(top.table("limits"), file.string(), "limits.", problems);
  impl->limit_s = limits.number("run_s", 1e-3, 1e7).value_or(impl->limit_s);
  limits.refuse_others();
  const auto vary = top.tables("vary"), measure = top.tables("measure");
  const auto place = [&](const toml::table* t) { return file.string() + ":" + std::to_string(t->source().begin.line); };
  for (const toml::table* t : vary) impl->axes.push_back(read_axis({t, place(t), "vary.", problems}));
  for (const toml::table* t : measure) {
    const TomlSection section(t, place(t), "measure.", problems);
    impl->measures.push_back(impl->is_study() ? read_study_measure(section) : read_measure(section));
  }
  for (const Axis& axis : impl->axes)
    if (impl->is_study() && axis.parameter)
      problems.add({file.string(), "vary.key", config::join(axis.keys), "is no key of a study", "study.…, set.…"});
  if (measure.empty()) top.add("measure", "", "is missing", "[[measure]] with name and signal");
  std::set<std::string> names{"point", "repetition", "error"};
  refuse_twice(impl->axes, "vary.name", file.string(), names, problems);
  refuse_twice(impl->measures, "measure.name", file.string(), names, problems);
  read_search(top, file.string(), *impl, problems);
  count(top, *impl);
  top.refuse_others();
  problems.throw_if_any();
  impl->fingerprint = fingerprint_of(root, *impl);
  return Plan(std::move(impl));
}

}  // namespace vsa::sweep
