// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/study/leave_one_out.hpp"

#include <algorithm>
#include <limits>

#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/page/json.hpp"

namespace vsa::study {
namespace {

using Parsed = page::Json;

constexpr const char* kWhatItIs = "results.json of vsa identify, with cross-validation";

/// One object's members, each problem with the file and the key.
class Fields {
 public:
  Fields(const Parsed& object, std::string at, const std::string& file) : object_(object), at_(std::move(at)), file_(file) {
    if (!object.is_object()) fail("", "isn't an object");
  }
  [[nodiscard]] const Parsed& member(const char* key) const {
    const auto it = object_.find(key);
    if (it == object_.end()) fail(key, "is missing");
    return *it;
  }
  [[nodiscard]] std::string text(const char* key) const {
    const Parsed& value = member(key);
    if (!value.is_string()) fail(key, "isn't a text");
    return value.get<std::string>();
  }
  /// null: it isn't determined.
  [[nodiscard]] double number(const char* key) const {
    const Parsed& value = member(key);
    if (value.is_null()) return std::numeric_limits<double>::quiet_NaN();
    if (!value.is_number()) fail(key, "isn't a number");
    return value.get<double>();
  }
  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    throw InputError({file_, at_ + key, "", what, kWhatItIs});
  }

 private:
  const Parsed& object_;
  std::string at_, file_;
};

Parsed parse(const std::filesystem::path& file) {
  const auto text = read_file(file);
  if (!text) throw InputError({file.string(), "", "", "can't be read", kWhatItIs});
  return page::read_json(*text, file.string(), kWhatItIs);
}

void add_parameter(LeaveOneOut& out, const Parsed& parameter) {
  const Fields f(parameter, "parameters.", out.file);
  out.fitted.push_back(f.text("name"));
  const Parsed& interval = f.member("interval_95");
  if (!interval.is_array() || interval.size() != 2) f.fail("interval_95", "isn't a pair of numbers");
  const auto end = [&](std::size_t i) {
    if (interval[i].is_null()) return std::numeric_limits<double>::quiet_NaN();
    if (!interval[i].is_number()) f.fail("interval_95", "isn't a pair of numbers");
    return interval[i].get<double>();
  };
  const Parsed& keys = f.member("keys");
  if (!keys.is_array()) f.fail("keys", "isn't a list");
  for (const Parsed& key : keys) {
    if (!key.is_string()) f.fail("keys", "holds what isn't a text");
    out.intervals.push_back({key.get<std::string>(), end(0), end(1)});
  }
}

/// None: it was held.
const LeaveOneOut::Interval* fitted(const LeaveOneOut& record, const std::string& key) {
  const auto same = [&](const LeaveOneOut::Interval& i) { return i.key == key; };
  const auto it = std::find_if(record.intervals.begin(), record.intervals.end(), same);
  return it == record.intervals.end() ? nullptr : &*it;
}

}  // namespace

std::filesystem::path record_name(const std::string& type) { return std::filesystem::path("data") / type / "leave_one_out.json"; }

LeaveOneOut read_leave_one_out(const std::filesystem::path& file) {
  const Parsed root = parse(file);
  LeaveOneOut out;
  out.file = file.string();
  const Fields all(root, "", out.file);
  out.command = all.text("command");
  const Parsed& parameters = all.member("parameters");
  if (!parameters.is_array() || parameters.empty()) all.fail("parameters", "holds no parameter");
  for (const Parsed& p : parameters) add_parameter(out, p);
  const Parsed& rows = all.member("leave_one_preset_out");
  if (!rows.is_array() || rows.empty()) all.fail("leave_one_preset_out", "holds no preset that was left out");
  for (const Parsed& row : rows) {
    const Fields f(row, "leave_one_preset_out.", out.file);
    out.rows.push_back({f.number("preset"), f.number("rms_rad"), f.number("rms_rad_fitted_to_all")});
  }
  const Parsed& values = all.member("identified_values");
  if (!values.is_object()) all.fail("identified_values", "isn't an object");
  const Fields f(values, "identified_values.", out.file);
  for (const auto& [key, value] : values.items()) out.values.push_back({key, f.text(key.c_str())});
  return out;
}

std::vector<std::string> differences(const LeaveOneOut& record, const config::ActuatorType& type) {
  std::vector<std::string> changed, unknown;
  for (const config::Entry& e : type.entries) {
    const auto same = [&](const LeaveOneOut::Value& v) { return v.key == e.key; };
    const auto it = std::find_if(record.values.begin(), record.values.end(), same);
    if (it == record.values.end()) {
      unknown.push_back(e.key + " isn't in the record");
    } else if (it->text != e.value && fitted(record, e.key) == nullptr) {
      changed.push_back(e.key + " was " + it->text + " and is " + e.value);
    }
  }
  changed.insert(changed.end(), unknown.begin(), unknown.end());
  return changed;
}

std::vector<std::string> fitted_elsewhere(const LeaveOneOut& record, const config::ActuatorType& type) {
  std::vector<std::string> out;
  for (const config::Entry& e : type.entries) {
    const LeaveOneOut::Interval* const i = fitted(record, e.key);
    if (i != nullptr && (e.number < i->low || e.number > i->high)) out.push_back(e.key);
  }
  return out;
}

}  // namespace vsa::study
