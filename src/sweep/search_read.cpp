// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "sweep/plan_parts.hpp"
#include "vsa/config/text.hpp"

namespace vsa::sweep {
namespace {

using config::TomlSection;

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

}  // namespace

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
    search.objectives.push_back(read_objective({t, config::place_of(file, *t), "objective.", problems}, out.measures));
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

}  // namespace vsa::sweep
