// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "config/resolve.hpp"

#include <algorithm>
#include <cmath>

#include "config/build.hpp"
#include "vsa/config/text.hpp"

namespace vsa::config {
namespace {

bool is_numeric(const Spec& spec) { return spec.kind == Kind::number || spec.kind == Kind::integer; }

/// The unit with a space before it; empty where there is none or nobody knows it.
std::string unit_text(const Spec& spec) {
  return !is_numeric(spec) || spec.unit.empty() || spec.unit == "?" || spec.unit == "1" ? "" : " " + spec.unit;
}

std::optional<double> word_index(std::string_view words, std::string_view word) {
  const std::vector<std::string> list = split(words, '|');
  const auto at = std::find(list.begin(), list.end(), word);
  if (at == list.end()) return std::nullopt;
  return static_cast<double>(at - list.begin());
}

/// The kind's number for a scalar; none where the type is wrong.
std::optional<double> convert(const Spec& spec, const Scalar& value) {
  const auto* whole = std::get_if<std::int64_t>(&value);
  switch (spec.kind) {
    case Kind::number:
      if (const auto* v = std::get_if<double>(&value)) return *v;
      return whole ? std::optional<double>(static_cast<double>(*whole)) : std::nullopt;
    case Kind::integer:
      return whole ? std::optional<double>(static_cast<double>(*whole)) : std::nullopt;
    case Kind::toggle:
      if (const auto* v = std::get_if<bool>(&value)) return *v ? 1.0 : 0.0;
      return std::nullopt;
    case Kind::word:
      if (const auto* v = std::get_if<std::string>(&value)) return word_index(spec.words, *v);
      if (const auto* v = std::get_if<double>(&value)) return word_index(spec.words, number_text(*v));
      return whole ? word_index(spec.words, std::to_string(*whole)) : std::nullopt;
    case Kind::file:
      break;  // no number: see resolve_file()
  }
  return std::nullopt;
}

Scalar scalar_from_text(Kind kind, const std::string& text) {
  if (kind == Kind::number) {
    if (const auto v = parse_number(text)) return *v;
  } else if (kind == Kind::integer) {
    if (const auto v = parse_integer(text)) return *v;
  } else if (kind == Kind::toggle) {
    if (text == "true" || text == "false") return text == "true";
  } else {
    return text;
  }
  return {};
}

std::string kind_text(Kind kind) {
  switch (kind) {
    case Kind::number:
      return "must be a number";
    case Kind::integer:
      return "must be a whole number";
    case Kind::toggle:
      return "must be true or false";
    case Kind::word:
      return "is not one of the words";
    case Kind::file:
      return "must be the name of a file";
  }
  return {};
}

std::string value_text(const Spec& spec, double value) {
  if (spec.kind == Kind::toggle) return value != 0 ? "true" : "false";
  if (spec.kind == Kind::word) return split(spec.words, '|')[static_cast<std::size_t>(value)];
  return spec.kind == Kind::file ? "" : number_text(value);
}

Entry make_entry(const Spec& spec, const Item* item, double value, std::string source) {
  const bool own = item && item->bounds;
  const double min = own ? (*item->bounds)[0] : spec.min, max = own ? (*item->bounds)[1] : spec.max;
  return {.key = spec.key,
          .value = value_text(spec, value),
          .unit = is_numeric(spec) ? spec.unit : "",
          .bounds = is_numeric(spec) ? range_text(min, max) : allowed_text(spec),
          .meaning = std::string(spec.meaning),
          .source = std::move(source),
          .kind = spec.kind,
          .number = value,
          .min = min,
          .max = max};
}

/// The nearest key, of the same group where there is one, as did_you_mean() puts it.
std::string near_key(const std::string& key, const std::set<std::string, std::less<>>& known) {
  const std::string group = key.substr(0, key.find('.') + 1);
  std::vector<std::string> same;
  for (const std::string& k : known) {
    if (!group.empty() && k.compare(0, group.size(), group) == 0) same.push_back(k);
  }
  return did_you_mean(key, same.empty() ? std::vector<std::string>(known.begin(), known.end()) : same);
}

}  // namespace

std::string allowed_text(const Spec& spec) {
  if (spec.kind == Kind::toggle) return "true, false";
  if (spec.kind == Kind::word) return join(split(spec.words, '|'));
  if (spec.kind == Kind::file) return std::string(spec.words);
  return range_text(spec.min, spec.max);
}

Resolver::Resolver(const Document& document, const std::vector<Override>& overrides, Problems& problems)
    : document_(document), overrides_(overrides), problems_(problems) {}

void Resolver::problem(int line, std::string key, std::string value, std::string message, std::string allowed) {
  problems_.add({document_.place(line), std::move(key), std::move(value), std::move(message), std::move(allowed)});
}

void Resolver::problem(const Item& item, std::string key, std::string value, std::string message, std::string allowed) {
  problems_.add({document_.place(item), std::move(key), std::move(value), std::move(message), std::move(allowed)});
}

const Item* Resolver::find(std::string_view key) const {
  const auto same = [&](const Item& item) { return item.key == key; };
  const auto at = std::find_if(document_.items.begin(), document_.items.end(), same);
  return at == document_.items.end() ? nullptr : &*at;
}

int Resolver::line_of(std::string_view key) const {
  const Item* item = find(key);
  return item && item->file.empty() ? item->line : 0;
}

bool Resolver::has_own(std::string_view key) const {
  const auto same = [&](const Override& o) { return o.key == key; };
  const Item* item = find(key);
  return (item != nullptr && item->file.empty()) || std::any_of(overrides_.begin(), overrides_.end(), same);
}

std::optional<double> Resolver::inherited(std::string_view key) const {
  const Item* item = has_own(key) ? nullptr : find(key);
  return item == nullptr ? std::nullopt : convert(Spec{}, item->value);
}

bool Resolver::has(std::string_view key) const { return find(key) != nullptr || has_own(key); }

std::optional<double> Resolver::resolve(const Spec& spec) {
  asked_.insert(spec.key);
  const Item* item = find(spec.key);
  std::optional<double> value;
  std::string source;
  if (item != nullptr) {
    const bool form = check_form(spec, *item);
    value = from_item(spec, *item);
    source = item->source;
    if (!form) value.reset();
  }
  int given = 0;
  for (const Override& o : overrides_) {
    if (o.key != spec.key) continue;
    if (++given == 2) problem(0, std::string(kOverrideMark) + o.key, o.value, "is given more than once");
    if (item && value) source = "override; the type has " + value_text(spec, *value) + ": " + item->source;
    if (!item) source = "override; the type has none";
    value = from_override(spec, item, o.value);
  }
  if (value) entries_.push_back(make_entry(spec, item, *value, source));
  if (!value && (item != nullptr || given > 0)) failed_.insert(spec.key);
  return value;
}

std::optional<std::filesystem::path> Resolver::resolve_file(const Spec& spec) {
  asked_.insert(spec.key);
  for (const Override& o : overrides_) {
    if (o.key == spec.key)
      problem(0, std::string(kOverrideMark) + o.key, '"' + o.value + '"', "a file can't be overridden: use another type");
  }
  const Item* item = find(spec.key);
  if (item == nullptr || !check_form(spec, *item)) return std::nullopt;
  const auto* name = std::get_if<std::string>(&item->value);
  if (name == nullptr || trim(*name).empty()) {
    problem(*item, spec.key, scalar_text(item->value), kind_text(spec.kind), allowed_text(spec));
    return std::nullopt;
  }
  const std::filesystem::path beside = item->file.empty() ? document_.file : item->file;
  const std::filesystem::path file = std::filesystem::absolute(beside.parent_path() / *name).lexically_normal();
  Entry entry = make_entry(spec, item, 0, item->source);
  entry.value = file.string();
  entries_.push_back(std::move(entry));
  return file;
}

double Resolver::use_default(const Spec& spec, std::string_view text, std::string_view source) {
  const double value = convert(spec, scalar_from_text(spec.kind, std::string(text))).value();
  entries_.push_back(make_entry(spec, nullptr, value, "default: " + std::string(source)));
  return value;
}

bool Resolver::check_form(const Spec& spec, const Item& item) {
  const std::size_t before = problems_.list().size();
  if (!is_numeric(spec)) {
    if (item.unit) problem(item, spec.key + ".unit", *item.unit, "has no meaning here: the parameter is not a number");
    if (item.bounds) problem(item, spec.key + ".bounds", "", "has no meaning here: the parameter is not a number");
    return problems_.list().size() == before;
  }
  if (!item.unit) problem(item, spec.key + ".unit", "", "is missing", spec.unit == "?" ? "" : spec.unit);
  // An empty unit was not a text and has been reported.
  if (item.unit && !item.unit->empty() && *item.unit != spec.unit && spec.unit != "?") {
    problem(item, spec.key + ".unit", '"' + *item.unit + '"', "is the wrong unit", spec.unit);
  }
  if (!item.bounds) problem(item, spec.key + ".bounds", "", "is missing", "within " + allowed_text(spec));
  if (item.bounds && ((*item.bounds)[0] < spec.min || (*item.bounds)[1] > spec.max)) {
    problem(item, spec.key + ".bounds", range_text((*item.bounds)[0], (*item.bounds)[1]), "is wider than what the model accepts",
            "within " + allowed_text(spec));
  }
  return problems_.list().size() == before;
}

std::optional<double> Resolver::from_item(const Spec& spec, const Item& item) {
  const Problem at{document_.place(item), spec.key, scalar_text(item.value), "", allowed_text(spec)};
  const std::optional<double> value = convert(spec, item.value);
  if (value) return in_range(spec, &item, *value, at);
  problems_.add({at.file, at.key, at.value, kind_text(spec.kind), at.allowed});
  return std::nullopt;
}

std::optional<double> Resolver::from_override(const Spec& spec, const Item* item, const std::string& text) {
  const Problem at{document_.file, std::string(kOverrideMark) + spec.key, '"' + text + '"', "", allowed_text(spec)};
  const std::optional<double> value = convert(spec, scalar_from_text(spec.kind, text));
  if (value) return in_range(spec, item, *value, at);
  problems_.add({at.file, at.key, at.value, kind_text(spec.kind), at.allowed});
  return std::nullopt;
}

std::optional<double> Resolver::in_range(const Spec& spec, const Item* item, double value, const Problem& at) {
  if (!is_numeric(spec)) return value;
  if (!std::isfinite(value)) {
    problems_.add({at.file, at.key, at.value, "must be finite", at.allowed});
  } else if (value < spec.min || value > spec.max) {
    problems_.add({at.file, at.key, at.value, "is outside of what the model accepts", at.allowed + unit_text(spec)});
  } else if (item && item->bounds && (value < (*item->bounds)[0] || value > (*item->bounds)[1])) {
    const std::string own = range_text((*item->bounds)[0], (*item->bounds)[1]);
    problems_.add({at.file, at.key, at.value, "is outside of the type's own bounds", own + unit_text(spec)});
  } else {
    return value;
  }
  return std::nullopt;
}

bool Resolver::failed(std::string_view key) const {
  const auto& broken = document_.broken;
  return failed_.find(key) != failed_.end() || std::find(broken.begin(), broken.end(), key) != broken.end();
}

void Resolver::report_missing(const Spec& spec) {
  if (has(spec.key) || failed(spec.key)) return;  // wrong, and reported
  failed_.insert(spec.key);
  problem(0, spec.key, "", "is missing (" + std::string(spec.meaning) + ")", allowed_text(spec) + unit_text(spec));
}

void Resolver::report_unknown(std::string_view lenient_group) {
  const auto judged = [&](const std::string& key) {
    const bool lenient = !lenient_group.empty() && key.compare(0, lenient_group.size(), lenient_group) == 0;
    return !lenient && asked_.find(key) == asked_.end();
  };
  for (const Item& item : document_.items) {
    if (judged(item.key)) problem(item, item.key, "", "unknown key" + near_key(item.key, asked_));
  }
  for (const Override& o : overrides_) {
    if (!judged(o.key)) continue;
    const bool law = o.key == "elastic.law", controller = o.key == "control.kind";
    problem(0, std::string(kOverrideMark) + o.key, '"' + o.value + '"',
            law || controller ? std::string(law ? "a law" : "a controller") +
                                    " has parameters of its own and can't be overridden: use another type"
                              : "unknown key" + near_key(o.key, asked_));
  }
}

}  // namespace vsa::config
