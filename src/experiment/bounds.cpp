// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/experiment/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vsa/config/text.hpp"
#include "vsa/config/toml_section.hpp"
#include "vsa/errors.hpp"

namespace vsa::experiment {
namespace {

using Item = config::TomlSection;

constexpr double kAny = std::numeric_limits<double>::max();
constexpr const char* kCalibrated = "calibrated";
constexpr const char* kPredicted = "predicted";

std::string needed(Item& item, const char* key) { return item.need(key, "some text").text(key).value_or(""); }
double number(Item& item, const char* key) { return item.need(key, "a number").number(key, -kAny, kAny).value_or(0); }

Bound read_bound(Item& item, const std::string& place) {
  Bound b;
  b.place = place;
  b.quantity = needed(item, "quantity");
  b.min = item.number("min", -kAny, kAny);
  b.max = item.number("max", -kAny, kAny);
  b.why = needed(item, "why");
  if (const auto kind = item.text("kind")) {
    if (*kind == kCalibrated) b.kind = Kind::calibrated;
    if (*kind == kPredicted) b.kind = Kind::predicted;
    if (!b.kind) item.add("kind", '"' + *kind + '"', "is no kind", "calibrated, predicted; left out: by the type's [evidence]");
  }
  if (!b.min && !b.max) item.add(b.quantity, "", "has no bound", "min, max or both");
  if (b.min && b.max && *b.min > *b.max) item.add(b.quantity, bound_text(b), "no value can hold it", "min up to max");
  return b;
}

Published read_published(Item& item, const std::string&) {
  Published p;
  p.preset = number(item, "preset");
  p.rms_2015_rad = number(item, "rms_2015_rad");
  p.rms_2015_branches_rad = number(item, "rms_2015_branches_rad");
  p.repeatability_rad = number(item, "repeatability_rad");
  p.source = needed(item, "source");
  return p;
}

template <class What>
std::vector<What> read_all(Item& top, const char* key, const std::string& file, Problems& problems,
                           What (*read)(Item&, const std::string&)) {
  std::vector<What> out;
  for (const toml::table* table : top.tables(key)) {
    const std::string place = config::place_of(file, *table);
    Item item(table, place, "", problems);
    out.push_back(read(item, place));
    item.refuse_others();
  }
  return out;
}

}  // namespace

BoundsFile read_bounds(const std::filesystem::path& file) {
  const toml::table root = config::parse_toml(file);
  Problems problems;
  Item top(&root, file.string(), "", problems);
  BoundsFile out{read_all(top, "bound", file.string(), problems, read_bound),
                 read_all(top, "published", file.string(), problems, read_published)};
  top.refuse_others();
  problems.throw_if_any();
  return out;
}

const char* kind_text(Kind kind) { return kind == Kind::predicted ? kPredicted : kCalibrated; }

Kind kind_of(const std::optional<config::Evidence>& evidence, std::string_view quantity) {
  return evidence && !config::covers(*evidence, quantity) ? Kind::predicted : Kind::calibrated;
}

void check_kinds(const std::vector<Bound>& bounds, const std::optional<config::Evidence>& evidence) {
  Problems problems;
  for (const Bound& b : bounds) {
    if (b.kind != Kind::predicted || !evidence || !config::covers(*evidence, b.quantity)) continue;
    problems.add({b.place, "kind", std::string(kPredicted), "the type was calibrated on " + b.quantity + ", by its [evidence]",
                  "calibrated, or no kind"});
  }
  problems.throw_if_any();
}

std::vector<Verdict> judge(const std::vector<Bound>& bounds, const std::map<std::string, double>& quantities,
                           const std::optional<config::Evidence>& evidence) {
  check_kinds(bounds, evidence);
  std::vector<std::string> names;
  for (const auto& [name, value] : quantities) names.push_back(name);
  Problems problems;
  std::vector<Verdict> out;
  for (const Bound& b : bounds) {
    const auto it = quantities.find(b.quantity);
    if (it == quantities.end()) {
      problems.add({"", "quantity", b.quantity, "isn't among the results", config::nearest(b.quantity, names)});
      continue;
    }
    const double v = it->second;
    out.push_back({b, v, std::isfinite(v) && (!b.min || v >= *b.min) && (!b.max || v <= *b.max),
                   b.kind.value_or(kind_of(evidence, b.quantity))});
  }
  problems.throw_if_any();
  return out;
}

bool all_held(const std::vector<Verdict>& verdicts) {
  return std::all_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return v.held; });
}

Count count(const std::vector<Verdict>& verdicts, Kind kind) {
  Count out;
  for (const Verdict& v : verdicts) {
    if (v.kind != kind) continue;
    ++out.all;
    out.held += v.held ? 1 : 0;
  }
  return out;
}

std::string bound_text(const Bound& b) {
  if (b.min && b.max) return config::range_text(*b.min, *b.max);
  return b.max ? "at most " + config::number_text(*b.max) : "at least " + config::number_text(b.min.value_or(std::nan("")));
}

}  // namespace vsa::experiment
