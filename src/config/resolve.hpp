// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// One parameter: what the file says and what an override says, checked against what is allowed.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/document.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/config/schema.hpp"

namespace vsa::config {

struct Spec {
  std::string key;
  std::string unit;  ///< of a number; "?": unknown because the law is, not checked
  Kind kind = Kind::number;
  double min = 0, max = 0;
  std::string_view words;
  std::string_view meaning;
};

/// "0 … 100", or the words.
[[nodiscard]] std::string allowed_text(const Spec& spec);

/// The parameters of one file. Remembers which were asked for, so that the rest is unknown.
class Resolver {
 public:
  Resolver(const Document& document, const std::vector<Override>& overrides, Problems& problems);

  [[nodiscard]] bool has(std::string_view key) const;
  /// In the file itself or by an override, not only in its base.
  [[nodiscard]] bool has_own(std::string_view key) const;
  /// Its base's number, where it has none of its own and no override; none: the base has none either, or no number.
  [[nodiscard]] std::optional<double> inherited(std::string_view key) const;
  /// It has no value that could be judged: missing or wrong, and reported.
  [[nodiscard]] bool failed(std::string_view key) const;
  /// The value (a word's index, 0 or 1 for a switch), with its entry added to entries(); none: absent, or wrong and reported.
  [[nodiscard]] std::optional<double> resolve(const Spec& spec);
  /// A file's path, with its entry; none: absent, or wrong and reported. The type that names it says where it is: no override does.
  [[nodiscard]] std::optional<std::filesystem::path> resolve_file(const Spec& spec);
  /// The same for a value that the schema gives.
  [[nodiscard]] double use_default(const Spec& spec, std::string_view text, std::string_view source);
  /// The key is known, though it isn't wanted.
  void know(std::string_view key) { asked_.emplace(key); }
  void report_missing(const Spec& spec);
  /// `lenient_group`: its keys are not judged ("elastic." while the law is unknown).
  void report_unknown(std::string_view lenient_group);
  void add(Problem problem) { problems_.add(std::move(problem)); }
  void problem(int line, std::string key, std::string value, std::string message, std::string allowed = {});
  void problem(const Item& item, std::string key, std::string value, std::string message, std::string allowed = {});

  [[nodiscard]] std::vector<Entry>& entries() noexcept { return entries_; }
  [[nodiscard]] int line_of(std::string_view key) const;

 private:
  [[nodiscard]] const Item* find(std::string_view key) const;
  bool check_form(const Spec& spec, const Item& item);
  [[nodiscard]] std::optional<double> from_item(const Spec& spec, const Item& item);
  [[nodiscard]] std::optional<double> from_override(const Spec& spec, const Item* item, const std::string& text);
  [[nodiscard]] std::optional<double> in_range(const Spec& spec, const Item* item, double value, const Problem& at);

  const Document& document_;
  const std::vector<Override>& overrides_;
  Problems& problems_;
  std::vector<Entry> entries_;
  std::set<std::string, std::less<>> asked_, failed_;
};

}  // namespace vsa::config
