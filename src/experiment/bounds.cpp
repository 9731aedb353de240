// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/experiment/bounds.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"

namespace vsa::experiment {
namespace {

/// One table of an array of tables, its keys read once each; those never asked for are unknown.
class Item {
 public:
  Item(const toml::table& table, std::string place, Problems& problems)
      : table_(table), place_(std::move(place)), problems_(problems) {}

  std::optional<double> number(const char* key, bool required) {
    return read<double>(key, required, "a number", [](double v) { return std::isfinite(v); });
  }
  std::string text(const char* key) {
    return read<std::string>(key, true, "some text", [](const std::string& v) { return !v.empty(); }).value_or("");
  }
  std::optional<std::string> optional_text(const char* key) {
    return read<std::string>(key, false, "some text", [](const std::string& v) { return !v.empty(); });
  }
  [[nodiscard]] std::string place() const { return place_ + ':' + std::to_string(table_.source().begin.line); }
  void refuse_others() {
    for (const auto& [key, node] : table_) {
      const std::string name(key.str());
      if (std::find(asked_.begin(), asked_.end(), name) == asked_.end()) add(name, "", "unknown key", config::join(asked_));
    }
  }
  void add(const std::string& key, const std::string& value, const std::string& message, const std::string& allowed) {
    problems_.add({place(), key, value, message, allowed});
  }

 private:
  template <class T, class Fine>
  std::optional<T> read(const char* key, bool required, const char* what, Fine fine) {
    asked_.emplace_back(key);
    const toml::node* node = table_.get(key);
    if (node == nullptr) {
      if (required) add(key, "", "is missing", what);
      return std::nullopt;
    }
    std::optional<T> value = node->value<T>();
    if (value && fine(*value)) return value;
    add(key, "", "isn't what it should be", what);
    return std::nullopt;
  }

  const toml::table& table_;
  std::string place_;
  Problems& problems_;
  std::vector<std::string> asked_;
};

toml::table parse(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) throw InputError({file.string(), "", "", "can't be read", "a TOML file"});
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& e) {
    throw InputError({fmt::format("{}:{}", file.string(), e.source().begin.line), "", "", std::string(e.description()), "TOML"});
  }
}

constexpr const char* kCalibrated = "calibrated";
constexpr const char* kPredicted = "predicted";

Bound read_bound(Item& item) {
  Bound b;
  b.place = item.place();
  b.quantity = item.text("quantity");
  b.min = item.number("min", false);
  b.max = item.number("max", false);
  b.why = item.text("why");
  if (const auto kind = item.optional_text("kind")) {
    if (*kind == kCalibrated) b.kind = Kind::calibrated;
    if (*kind == kPredicted) b.kind = Kind::predicted;
    if (!b.kind) item.add("kind", '"' + *kind + '"', "is no kind", "calibrated, predicted; left out: by the preset's [evidence]");
  }
  item.refuse_others();
  if (!b.min && !b.max) item.add(b.quantity, "", "has no bound", "min, max or both");
  if (b.min && b.max && *b.min > *b.max) item.add(b.quantity, bound_text(b), "no value can hold it", "min up to max");
  return b;
}

Published read_published(Item& item) {
  Published p;
  p.preset = item.number("preset", true).value_or(0);
  p.rms_2015_rad = item.number("rms_2015_rad", true).value_or(0);
  p.rms_2015_branches_rad = item.number("rms_2015_branches_rad", true).value_or(0);
  p.repeatability_rad = item.number("repeatability_rad", true).value_or(0);
  p.source = item.text("source");
  item.refuse_others();
  return p;
}

template <class Read>
auto read_all(const toml::table& root, const char* key, const std::string& place, Problems& problems, Read read) {
  Item dummy(root, place, problems);
  std::vector<decltype(read(dummy))> out;
  const toml::node* node = root.get(key);
  if (node == nullptr) return out;
  if (!node->is_array_of_tables()) {
    problems.add({place, key, "", "isn't an array of tables", fmt::format("[[{}]]", key)});
    return out;
  }
  for (const toml::node& element : *node->as_array()) {
    Item item(*element.as_table(), place, problems);
    out.push_back(read(item));
  }
  return out;
}

}  // namespace

BoundsFile read_bounds(const std::filesystem::path& file) {
  const toml::table root = parse(file);
  Problems problems;
  for (const auto& [key, node] : root) {
    const std::string name(key.str());
    if (name != "bound" && name != "published") problems.add({file.string(), name, "", "unknown key", "[[bound]], [[published]]"});
  }
  BoundsFile out{read_all(root, "bound", file.string(), problems, read_bound),
                 read_all(root, "published", file.string(), problems, read_published)};
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
    problems.add({b.place, "kind", std::string(kPredicted), "the preset was calibrated on " + b.quantity + ", by its [evidence]",
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
