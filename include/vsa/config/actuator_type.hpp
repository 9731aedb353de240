// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Actuator types: TOML files in which every value carries its unit, bounds and source.
//
//   [type]
//   name = "qbmove_maker_pro"
//   title = "qbmove maker pro (paper, Table I)"
//   rank = "published"                  optional: measured, published or symbolic
//   base = "sea_example"                optional: a type that has all that this file hasn't
//   mass_kg = { value = 0.45, unit = "kg", source = "leaflet" }      optional, of the whole actuator; not the base's
//   [elastic]
//   law = "two_sinh"
//   k1_Nm = { value = 0.022, unit = "N·m", bounds = [1e-6, 10.0], source = "Table I" }
//   [control]
//   kind = "position_servo"             optional: "qbmove" (the default), "position_servo", "torque_servo", "motor_voltages"
//   [drive]
//   friction_Nm = { value = 0.8, unit = "N·m", bounds = [0.0, 100.0], source = "Table I" }
//   [evidence]
//   calibrated_on = { value = ["stiffness.0.6903"], source = "vsa identify" }      optional, see config/evidence.hpp
//
// The unit must be the schema's (config/schema.hpp), the bounds must lie within the schema's, the value within the bounds; words
// and switches have value and source only. An override ("drive.friction_Nm" = "0.7") replaces a value and passes the same checks.
// In every Problem `file` is "path:line" where the line is known, and `key` is "group.name".
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vsa/config/evidence.hpp"
#include "vsa/config/schema.hpp"
#include "vsa/config/stated.hpp"
#include "vsa/device/unit.hpp"
#include "vsa/elastic/law.hpp"
#include "vsa/errors.hpp"

namespace vsa::config {

/// One parameter as the type gives it: as texts for listings (`vsa actuators NAME`) and reports, and as numbers to work with.
struct Entry {
  std::string key;           ///< "drive.friction_Nm"
  std::string value;         ///< as text, shortest that reads back the same
  std::string unit;          ///< as the schema or the law writes it
  std::string bounds;        ///< "0 … 100" or the list of allowed words
  std::string meaning;       ///< one line for people
  std::string source;        ///< where the value came from, as the file says
  Kind kind = Kind::number;  ///< how `value` is to be read
  double number = 0;         ///< the value: itself, 0 or 1 for a switch, a word's index
  double min = 0,            ///< number, integer: lower bound, included
      max = 0;               ///< upper bound, included
};

/// A type as it was read from its TOML file: the unit that it describes, and all that can be told of its values.
struct ActuatorType {
  std::string name;            ///< its file's stem
  std::string title;           ///< one line for people
  std::string description;     ///< may be empty
  std::filesystem::path file;  ///< that it was read from
  std::string law;             ///< as files name it: "two_sinh"
  std::string controller;      ///< "qbmove", "position_servo", "torque_servo" or "motor_voltages"
  std::string rank;            ///< on what its numbers stand: "measured", "published", "symbolic"; empty: its file doesn't say
  std::string base;            ///< the type that it differs from; empty: it is whole
  std::optional<Evidence> evidence;  ///< none: the type doesn't say
  std::optional<Stated> mass_kg;     ///< of the whole actuator; none: the type doesn't say, and no base does it for it
  std::vector<Entry> entries;        ///< all that has a value, in the schema's order
  std::vector<std::string> notices;  ///< old spellings in its file
  std::vector<std::string> remarks;  ///< what its law says of what it was made of
  device::UnitConfig unit;           ///< valid: what device::validate() asks for holds
};

/// Numbers of a file, each row in the order of the columns that were asked for.
struct LawRows {
  std::vector<double> values;      ///< row by row
  std::filesystem::path file;      ///< for messages
  std::vector<std::size_t> lines;  ///< each row's
};

/// What a law's factory reads its own keys with: number("k1_Nm", "N·m", min, max, meaning). Every key asked for is required.
/// Problems are collected, not thrown: number() is NaN then, and what the factory returns or throws is dropped. A factory whose
/// values are fine one by one but not together throws InputError with keys of its own ("C_m"), and a file where it is one of rows();
/// nothing else.
class LawReader {
 public:
  virtual ~LawReader() = default;
  /// Between `min` and `max`, ends included.
  virtual double number(std::string_view key, std::string_view unit, double min, double max, std::string_view meaning) = 0;
  /// The rows of a CSV file that the type names, seen from its own: elastic.KEY = { value = "FILE.csv", source = "…" }. None where
  /// there are problems.
  virtual LawRows rows(const elastic::LawFile& file) = 0;
  /// What users should know of the law made; `vsa actuators NAME` prints it.
  virtual void remark(std::string text) = 0;
};

/// Makes a law of what it reads. It may be called by several threads at once.
using LawFactory = std::function<std::shared_ptr<const elastic::Transmission>(LawReader&)>;

/// The laws that a type's file may name, by name; users add their own.
class LawRegistry {
 public:
  /// The library's (elastic::laws()) and those of the shared libraries that $VSA_LAW_PATH names (vsa/elastic/law_module.hpp).
  /// Throws InputError: a library that can't be used, with its file, or a name that is taken.
  [[nodiscard]] static LawRegistry standard();
  void add(std::string name, LawFactory factory);                     ///< replaces one of that name
  void add(const elastic::Law& law);                                  ///< which outlives this
  [[nodiscard]] const LawFactory* find(std::string_view name) const;  ///< null: no such law
  [[nodiscard]] std::vector<std::string> names() const;               ///< sorted

 private:
  std::map<std::string, LawFactory, std::less<>> factories_;
};

/// Those of LawRegistry::standard(): the library's by name, then those of $VSA_LAW_PATH. Throws as it does.
[[nodiscard]] std::vector<const elastic::Law*> standard_laws();

/// A value that replaces a type's.
struct Override {
  std::string key,  ///< "drive.friction_Nm"
      value;        ///< as a file would have it
};
/// "drive.friction_Nm=0.7" → an override. Throws InputError with every text that has no key or no value. `from`: "--set".
[[nodiscard]] std::vector<Override> parse_overrides(const std::vector<std::string>& texts, const std::string& from);

struct Document;

/// A type's file, read once, to make the type with one set of overrides after the other. Several threads may make types of it at
/// once; so the laws' factories are called.
class TypeFile {
 public:
  /// As TypeLibrary::open makes it.
  TypeFile(std::shared_ptr<const Document> document, LawRegistry laws) : document_(std::move(document)), laws_(std::move(laws)) {}
  /// Throws as TypeLibrary::load.
  [[nodiscard]] ActuatorType make(const std::vector<Override>& overrides = {}) const;

 private:
  std::shared_ptr<const Document> document_;
  LawRegistry laws_;
};

/// Reads actuator types from directories, first match wins. A type's name is its file's name without ".toml".
class TypeLibrary {
 public:
  /// Empty: $VSA_ACTUATOR_PATH (colon-separated), then actuators/ of every data directory. Otherwise only the directories given.
  /// For one more release $VSA_PRESET_PATH and presets/ are searched after them, see notices().
  explicit TypeLibrary(std::vector<std::filesystem::path> directories = {}, LawRegistry laws = LawRegistry::standard());

  [[nodiscard]] std::vector<std::string> names() const;  ///< of all directories, sorted
  /// A type's file. Throws InputError: unknown name.
  [[nodiscard]] std::filesystem::path find(std::string_view name) const;
  /// Throws InputError: unknown name (with the names there are), or all problems of the file and the overrides at once.
  [[nodiscard]] ActuatorType load(std::string_view name, const std::vector<Override>& overrides = {}) const;
  /// The same in two halves.
  [[nodiscard]] TypeFile open(std::string_view name) const;
  /// Whatever directory it lies in.
  [[nodiscard]] ActuatorType load_file(const std::filesystem::path& file, const std::vector<Override>& overrides = {}) const;
  /// The same from text; `file` is what problems call it, its stem the name that the type must have.
  [[nodiscard]] ActuatorType load_text(std::string_view text, const std::filesystem::path& file,
                                       const std::vector<Override>& overrides = {}) const;
  /// In the order that they are searched.
  [[nodiscard]] const std::vector<std::filesystem::path>& directories() const noexcept { return directories_; }
  [[nodiscard]] const std::vector<std::string>& notices() const noexcept { return notices_; }  ///< old spellings met

 private:
  void search_standard_directories();

  std::vector<std::filesystem::path> directories_;
  std::vector<std::string> notices_;
  LawRegistry laws_;
};

/// Where data (actuators/, models/, web/) are looked for, in this order:
///   1. $VSA_DATA_DIR, if set: then nowhere else
///   2. ../share/vsa beside the executable's directory: an installation, or build/PRESET/bin with build/PRESET/share/vsa
///   3. of a program linked to an installation (find_package(vsasim)): that
[[nodiscard]] std::vector<std::filesystem::path> data_directories();

/// The first of them that exists and has actuators/. Throws InputError where none has.
[[nodiscard]] std::filesystem::path data_directory();

/// The first data directory that has `relative` ("models", "web/replay.html"); none: empty. Of the program's own
/// directory and its installation's either may lack something, so ask for what you need.
[[nodiscard]] std::optional<std::filesystem::path> find_data(const std::filesystem::path& relative);

}  // namespace vsa::config
