// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// TOML files that users wrote, read strictly: a key that nobody asks for is a mistake, and all mistakes of a file are told together,
// each with place and key. For the project's own rooms; whoever includes it needs toml++.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vsa/config/actuator_type.hpp"
#include "vsa/errors.hpp"

namespace vsa::config {

/// Throws InputError: can't be read, or no TOML (with the line).
[[nodiscard]] toml::table parse_toml(const std::filesystem::path& file);

/// "FILE:LINE" of what stands there.
[[nodiscard]] std::string place_of(const std::filesystem::path& file, const toml::node& node);

/// One table whose keys are asked for one by one; what is wrong with one is a problem, and the answer is then none. A value that isn't
/// there is none without a problem, but for need().
class TomlSection {
 public:
  /// `place` is the problems' file, `scope` leads their keys: "motion.". Null: an empty table. Table and problems must outlive it.
  TomlSection(const toml::table* table, std::string place, std::string scope, Problems& problems);

  /// A key that has to be there.
  TomlSection& need(const char* key, std::string_view allowed);
  [[nodiscard]] const toml::node* find(const char* key);           ///< the key counts as asked for; null: it isn't there
  [[nodiscard]] std::optional<std::string> text(const char* key);  ///< not empty
  [[nodiscard]] std::optional<bool> flag(const char* key);         ///< true or false
  [[nodiscard]] std::optional<double> number(const char* key, double min, double max);       ///< finite, ends included
  [[nodiscard]] std::optional<std::int64_t> whole(const char* key, double min, double max);  ///< likewise, without a fraction
  /// Of a list; a wrong one is a problem and `min`; empty: not there.
  [[nodiscard]] std::vector<double> numbers(const char* key, double min, double max);
  [[nodiscard]] std::vector<std::string> texts(const char* key);  ///< of a list; empty: not there
  [[nodiscard]] std::optional<std::string> word(const char* key, const std::vector<std::string>& words);  ///< one of these
  /// { "group.key" = number, text or true/false }
  [[nodiscard]] std::vector<Override> overrides(const char* key);
  [[nodiscard]] const toml::table* table(const char* key);                ///< null: it isn't there
  [[nodiscard]] std::vector<const toml::table*> tables(const char* key);  ///< of [[key]]

  /// After the last question: every other key is unknown.
  void refuse_others() const;
  /// A problem of this place, with the scope before its key.
  void add(const std::string& key, const std::string& value, const std::string& message, const std::string& allowed) const;

 private:
  std::optional<double> checked(const std::string& key, const toml::node& node, double min, double max, bool whole) const;
  const toml::node* wrong(const char* key, const toml::node& node, const std::string& allowed) const;

  const toml::table* table_;
  std::string place_, scope_;
  Problems& problems_;
  std::vector<std::string> asked_;
};

}  // namespace vsa::config
