// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>
#include <set>

#include "config/build.hpp"
#include "config/met.hpp"
#include "vsa/config/actuator_type.hpp"
#include "vsa/config/text.hpp"
#include "vsa/files.hpp"

namespace vsa::config {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kTypeEnding = ".toml";

void add_path(const char* variable, std::vector<fs::path>& to) {
  const char* path = std::getenv(variable);
  for (const std::string& part : split(path == nullptr ? "" : path, ':')) {
    if (!part.empty()) to.emplace_back(part);
  }
}

/// Without the ending.
std::set<std::string> toml_files(const fs::path& directory) {
  std::set<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(directory, error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() == kTypeEnding) names.insert(it->path().stem().string());
  }
  return names;
}

std::string text_of_type(const fs::path& file) {
  auto text = read_file(file);
  if (!text) throw InputError(Problem{file.string(), "", "", "can't be read: no such file, or no permission", ""});
  return std::move(*text);
}

std::string searched_text(const std::vector<std::string>& names, const std::vector<fs::path>& directories) {
  std::string text = names.empty() ? "none found" : join(names);
  for (const fs::path& d : directories) text += (d == directories.front() ? "; searched " : ", ") + d.string();
  return text;
}

/// A document with what its bases have.
class WithBases {
 public:
  WithBases(const TypeLibrary& library, Problems& problems) : library_(library), problems_(problems) {}

  Document read(std::string_view text, const fs::path& file) {
    Document out = read_document(text, file.string(), problems_);
    if (!out.readable || out.base.empty()) return out;
    under_way_.push_back(out.name);
    if (std::find(under_way_.begin(), under_way_.end(), out.base) != under_way_.end()) {
      problem(out, "goes in a circle: " + join(under_way_, " → ") + " → " + out.base, "a type that isn't made of this one");
    } else if (const auto base = file_of(out)) {
      inherit(out, read(text_of_type(*base), *base));
    }
    return out;
  }

 private:
  /// Beside the document, or in the library.
  std::optional<fs::path> file_of(const Document& document) {
    const fs::path beside = fs::path(document.file).parent_path() / (document.base + std::string(kTypeEnding));
    std::error_code none;
    if (document.base.find('/') == std::string::npos && fs::exists(beside, none)) return beside;
    try {
      return library_.find(document.base);
    } catch (const InputError& error) {
      problem(document, error.problems()[0].message, error.problems()[0].allowed);
      return std::nullopt;
    }
  }
  void problem(const Document& document, const std::string& message, const std::string& allowed) {
    problems_.add({document.place(document.base_line), "type.base", '"' + document.base + '"', message, allowed});
  }

  const TypeLibrary& library_;
  Problems& problems_;
  std::vector<std::string> under_way_;
};

}  // namespace

TypeLibrary::TypeLibrary(std::vector<fs::path> directories, LawRegistry laws)
    : directories_(std::move(directories)), laws_(std::move(laws)) {
  if (directories_.empty()) search_standard_directories();
}

void TypeLibrary::search_standard_directories() {
  add_path("VSA_ACTUATOR_PATH", directories_);
  const std::size_t of_now = directories_.size();
  add_path("VSA_PRESET_PATH", directories_);
  if (directories_.size() > of_now) met_old_spelling(renamed_text("VSA_PRESET_PATH", "VSA_ACTUATOR_PATH"), notices_);
  for (const fs::path& data : data_directories()) {
    directories_.push_back(data / "actuators");
    if (toml_files(data / "presets").empty()) continue;
    directories_.push_back(data / "presets");
    met_old_spelling(renamed_text((data / "presets").string(), "actuators"), notices_);
  }
}

std::vector<std::string> TypeLibrary::names() const {
  std::set<std::string> names;
  for (const fs::path& directory : directories_) names.merge(toml_files(directory));
  return {names.begin(), names.end()};
}

fs::path TypeLibrary::find(std::string_view name) const {
  // Only names of files in the directories are types: "../x" is none, wherever it may lead.
  const std::vector<std::string> known = names();
  if (std::find(known.begin(), known.end(), name) != known.end()) {
    for (const fs::path& directory : directories_) {
      fs::path file = directory / (std::string(name) + std::string(kTypeEnding));
      std::error_code error;
      if (fs::exists(file, error)) return file;
    }
  }
  throw InputError(Problem{"", "type", '"' + std::string(name) + '"', "unknown actuator type" + did_you_mean(name, known),
                           searched_text(known, directories_)});
}

ActuatorType TypeLibrary::load(std::string_view name, const std::vector<Override>& overrides) const {
  return load_file(find(name), overrides);
}

TypeFile TypeLibrary::open(std::string_view name) const {
  const fs::path file = find(name);
  Problems problems;
  auto document = std::make_shared<const Document>(WithBases(*this, problems).read(text_of_type(file), file));
  problems.throw_if_any();
  return {std::move(document), laws_};
}

ActuatorType TypeFile::make(const std::vector<Override>& overrides) const {
  Problems problems;
  ActuatorType type = build_type(*document_, overrides, laws_, problems);
  problems.throw_if_any();
  return type;
}

ActuatorType TypeLibrary::load_file(const fs::path& file, const std::vector<Override>& overrides) const {
  return load_text(text_of_type(file), file, overrides);
}

ActuatorType TypeLibrary::load_text(std::string_view text, const fs::path& file, const std::vector<Override>& overrides) const {
  Problems problems;
  const Document document = WithBases(*this, problems).read(text, file);
  if (!document.readable || (document.law.empty() && !document.base.empty())) problems.throw_if_any();
  ActuatorType type = build_type(document, overrides, laws_, problems);
  if (!document.name.empty() && document.name != file.stem().string()) {
    problems.add({file.string(), "type.name", '"' + document.name + '"', "differs from the file's name", file.stem().string()});
  }
  problems.throw_if_any();
  return type;
}

}  // namespace vsa::config
