// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "config/document.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "config/met.hpp"
#include "vsa/config/text.hpp"

namespace vsa::config {
namespace {

const std::vector<std::string> kGroups{"type",   "evidence", "elastic", "drive",    "drive_2", "tendon", "shaft",
                                       "sensor", "sensor_2", "control", "firmware", "limits",  "physics"};
const std::vector<std::string> kTypeKeys{"name", "title", "description", "rank", "base", "mass_kg"};
const std::vector<std::string> kRanks{"measured", "published", "symbolic"};
const std::vector<std::string> kStatedKeys{"value", "unit", "source"};
const std::vector<std::string> kItemKeys{"value", "unit", "bounds", "source"};
const std::vector<std::string> kEvidenceKeys{"calibrated_on"};
const std::vector<std::string> kEvidenceParts{"value", "source"};

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

Scalar scalar(const toml::node& node) {
  if (const auto* v = node.as_floating_point()) return v->get();
  if (const auto* v = node.as_integer()) return v->get();
  if (const auto* v = node.as_boolean()) return v->get();
  if (const auto* v = node.as_string()) return v->get();
  return {};
}

std::string node_text(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array()) return "an array";
  const Scalar value = scalar(node);
  return std::holds_alternative<std::monostate>(value) ? "a date or time" : scalar_text(value);
}

class DocumentReader {
 public:
  DocumentReader(Document& document, Problems& problems) : doc_(document), problems_(problems) {}

  void read(const toml::table& root) {
    for (const auto& [key, node] : root) {
      std::string group(key.str());
      if (group == "preset" && !root.contains("type")) {
        met_old_spelling(doc_.place(line_of(node)) + ": " + renamed_text("[preset]", "[type]"), doc_.notices);
        group = "type";
      }
      const toml::table* table = node.as_table();
      if (std::find(kGroups.begin(), kGroups.end(), group) == kGroups.end()) {
        unknown(line_of(node), group, group, kGroups, "unknown table");
      } else if (table == nullptr) {
        add(line_of(node), group, node_text(node), "must be a table", "[" + group + "]");
      } else if (group == "type") {
        read_type(*table);
      } else if (group == "evidence") {
        read_evidence(*table);
      } else {
        read_group(group, *table);
      }
    }
    if (doc_.name.empty()) missing("type.name");
    if (doc_.title.empty()) missing("type.title");
    if (doc_.law.empty() && doc_.base.empty()) missing("elastic.law");
  }

 private:
  void add(int line, std::string key, std::string value, std::string message, std::string allowed = {}) {
    problems_.add({doc_.place(line), std::move(key), std::move(value), std::move(message), std::move(allowed)});
  }
  void missing(const std::string& key) {
    if (std::find(doc_.broken.begin(), doc_.broken.end(), key) == doc_.broken.end()) add(0, key, "", "is missing", "a text");
  }
  void unknown(int line, const std::string& key, std::string_view word, const std::vector<std::string>& known, const char* what) {
    add(line, key, "", what + did_you_mean(word, known), join(known));
  }

  std::string text_at(const toml::node& node, const std::string& key) {
    const auto* text = node.as_string();
    if (text != nullptr && !trim(text->get()).empty()) return text->get();
    add(line_of(node), key, node_text(node), "must be a text that is not empty");
    doc_.broken.push_back(key);
    return {};
  }

  void read_type(const toml::table& table) {
    for (const auto& [name, node] : table) {
      const std::string key = "type." + std::string(name.str());
      if (name == "name") {
        doc_.name = text_at(node, key);
      } else if (name == "title") {
        doc_.title = text_at(node, key);
      } else if (name == "description") {
        doc_.description = text_at(node, key);
      } else if (name == "base") {
        doc_.base = text_at(node, key);
        doc_.base_line = line_of(node);
      } else if (name == "rank") {
        doc_.rank = text_at(node, key);
        if (std::find(kRanks.begin(), kRanks.end(), doc_.rank) == kRanks.end())
          add(line_of(node), key, node_text(node), "is no rank", join(kRanks));
      } else if (name == "mass_kg") {
        doc_.mass_kg = stated(node, key, "kg");
      } else {
        unknown(line_of(node), key, name.str(), kTypeKeys, "unknown key");
      }
    }
  }

  /// None: its problems are told.
  std::optional<Stated> stated(const toml::node& node, const std::string& key, const std::string& unit) {
    constexpr double kLeast = 1e-6, kMost = 1e6;
    const std::string form = "{ value = …, unit = \"" + unit + "\", source = … }";
    const toml::table* table = node.as_table();
    if (table == nullptr) {
      add(line_of(node), key, node_text(node), "must be a table", form);
      return std::nullopt;
    }
    const std::size_t before = problems_.list().size();
    for (const auto& [name, part] : *table) {
      if (std::find(kStatedKeys.begin(), kStatedKeys.end(), std::string(name.str())) == kStatedKeys.end())
        unknown(line_of(part), key + "." + std::string(name.str()), name.str(), kStatedKeys, "unknown key");
    }
    Stated out;
    const auto value = (*table)["value"].value<double>();
    if (!value || !(*value >= kLeast && *value <= kMost))
      add(line_of(node), key + ".value", value ? number_text(*value) : "", value ? "is out of range" : "is missing, or no number",
          range_text(kLeast, kMost) + " " + unit);
    out.value = value.value_or(0);
    if ((*table)["unit"].value_or(std::string()) != unit)
      add(line_of(node), key + ".unit", (*table)["unit"].value_or(std::string()), "is missing or the wrong unit", unit);
    out.source = (*table)["source"].value_or(std::string());
    if (trim(out.source).empty()) add(line_of(node), key + ".source", "", "is missing", "where the value comes from");
    return problems_.list().size() == before ? std::optional(out) : std::nullopt;
  }

  void read_evidence(const toml::table& table) {
    const std::string key = "evidence.calibrated_on";
    for (const auto& [name, node] : table) {
      const toml::table* item = node.as_table();
      if (name != "calibrated_on") {
        unknown(line_of(node), "evidence." + std::string(name.str()), name.str(), kEvidenceKeys, "unknown key");
      } else if (item == nullptr) {
        add(line_of(node), key, node_text(node), "must be a table", "{ value = [\"stiffness.0.6903\", …], source = … }");
      } else {
        doc_.evidence = evidence(*item, key, line_of(node));
      }
    }
    if (!table.contains("calibrated_on")) add(line_of(table), key, "", "is missing", "a list of experiments, [] for none");
  }

  Evidence evidence(const toml::table& table, const std::string& key, int line) {
    Evidence out;
    for (const auto& [name, node] : table) {
      const std::string part = key + "." + std::string(name.str());
      if (name == "value") {
        experiments(node, part, out.calibrated_on);
      } else if (name == "source") {
        out.source = text_at(node, part);
      } else {
        unknown(line_of(node), part, name.str(), kEvidenceParts, "unknown key");
      }
    }
    if (!table.contains("value")) add(line, key + ".value", "", "is missing", "a list of experiments, [] for none");
    if (!table.contains("source")) add(line, key + ".source", "", "is missing", "how the values were found");
    return out;
  }

  void experiments(const toml::node& node, const std::string& key, std::vector<std::string>& out) {
    const toml::array* list = node.as_array();
    if (list == nullptr) return add(line_of(node), key, node_text(node), "must be a list", "[\"stiffness.0.6903\", …]");
    for (const toml::node& element : *list) {
      const auto* text = element.as_string();
      if (text == nullptr || !names_experiment(text->get())) {
        add(line_of(element), key, node_text(element), "names no experiment", std::string(kExperimentNames));
      } else if (std::find(out.begin(), out.end(), text->get()) != out.end()) {
        add(line_of(element), key, node_text(element), "is named twice");
      } else {
        out.push_back(text->get());
      }
    }
  }

  void read_group(const std::string& group, const toml::table& table) {
    for (const auto& [name, node] : table) {
      const std::string key = group + "." + std::string(name.str());
      if (key == "elastic.law") {
        doc_.law = text_at(node, key);
        doc_.law_line = line_of(node);
      } else if (key == "control.kind") {
        doc_.controller = text_at(node, key);
        doc_.controller_line = line_of(node);
      } else if (const toml::table* item = node.as_table()) {
        read_item(key, *item, line_of(node));
      } else {
        doc_.broken.push_back(key);
        add(line_of(node), key, node_text(node), "must be a table",
            "{ value = …, unit = …, bounds = [lowest, highest], source = … }");
      }
    }
  }

  void read_item(const std::string& key, const toml::table& table, int line) {
    Item item;
    item.key = key;
    item.line = line;
    for (const auto& [name, node] : table) {
      const std::string part = key + "." + std::string(name.str());
      if (name == "value") {
        item.value = scalar(node);
        if (std::holds_alternative<std::monostate>(item.value)) {
          add(line_of(node), part, node_text(node), "must be a number, a text, true or false");
        }
      } else if (name == "unit") {
        item.unit = text_at(node, part);
      } else if (name == "source") {
        item.source = text_at(node, part);
      } else if (name == "bounds") {
        item.bounds = bounds(node, part);
      } else {
        unknown(line_of(node), part, name.str(), kItemKeys, "unknown key");
      }
    }
    if (!table.contains("value")) add(line, key + ".value", "", "is missing");
    if (!table.contains("source")) add(line, key + ".source", "", "is missing", "where the value comes from");
    const bool whole = !std::holds_alternative<std::monostate>(item.value);
    if (whole) doc_.items.push_back(std::move(item));
    if (!whole) doc_.broken.push_back(key);
  }

  std::optional<std::array<double, 2>> bounds(const toml::node& node, const std::string& key) {
    const toml::array* pair = node.as_array();
    if (pair != nullptr && pair->size() == 2) {
      const auto low = (*pair)[0].value<double>(), high = (*pair)[1].value<double>();
      const bool numbers = (*pair)[0].is_number() && (*pair)[1].is_number() && low && high;
      if (numbers && std::isfinite(*low) && std::isfinite(*high) && *low <= *high) return std::array<double, 2>{*low, *high};
    }
    add(line_of(node), key, node_text(node), "must be two finite numbers in order", "[lowest, highest]");
    // Without usable bounds the schema's alone hold; this problem stops the type anyway.
    return std::nullopt;
  }

  Document& doc_;
  Problems& problems_;
};

}  // namespace

std::string Document::place(int line) const { return line > 0 ? file + ":" + std::to_string(line) : file; }

std::string Document::place(const Item& item) const {
  return item.file.empty() ? place(item.line) : item.file + ":" + std::to_string(item.line);
}

void inherit(Document& to, const Document& base) {
  const bool same_law = to.law.empty() || to.law == base.law;
  if (to.law.empty()) to.law = base.law;
  const auto controller = [](const Document& d) { return d.controller.empty() ? std::string("qbmove") : d.controller; };
  const bool same_controller = to.controller.empty() || to.controller == controller(base);
  const bool own_preset = !same_controller && (to.controller == "torque_servo" || base.controller == "torque_servo");
  if (to.controller.empty()) to.controller = base.controller;
  const auto known = [&](const std::string& key) {
    return std::any_of(to.items.begin(), to.items.end(), [&](const Item& i) { return i.key == key; }) ||
           std::find(to.broken.begin(), to.broken.end(), key) != to.broken.end();
  };
  for (const Item& item : base.items) {
    const bool of_law = item.key.rfind("elastic.", 0) == 0 || item.key == "limits.preset_max";
    const bool of_controller = item.key.rfind("control.", 0) == 0 || item.key.rfind("firmware.", 0) == 0;
    if (known(item.key) || (of_law && !same_law) || (of_controller && !same_controller)) continue;
    if (own_preset && item.key == "limits.preset_max") continue;
    to.items.push_back(item);
    Item& copy = to.items.back();
    if (copy.file.empty()) {
      copy.file = base.file;
      copy.source = "as " + base.name + ": " + copy.source;
    }
  }
}

std::string scalar_text(const Scalar& value) {
  if (const auto* v = std::get_if<double>(&value)) return number_text(*v);
  if (const auto* v = std::get_if<std::int64_t>(&value)) return std::to_string(*v);
  if (const auto* v = std::get_if<bool>(&value)) return *v ? "true" : "false";
  if (const auto* v = std::get_if<std::string>(&value)) return '"' + *v + '"';
  return {};
}

Document read_document(std::string_view text, std::string file, Problems& problems) {
  Document document;
  document.file = std::move(file);
  try {
    const toml::table root = toml::parse(text);
    document.readable = true;
    DocumentReader(document, problems).read(root);
  } catch (const toml::parse_error& error) {
    problems.add({document.place(static_cast<int>(error.source().begin.line)), "", "", std::string(error.description()), ""});
  }
  return document;
}

}  // namespace vsa::config
