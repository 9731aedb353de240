// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What `vsa doctor` looks at. Checks only look: none starts a simulator, opens a port or writes a file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vsa::app {

struct Finding {
  enum class Level { ok, note, problem } level = Level::ok;
  std::string what;  ///< the thing looked at
  std::string text;  ///< how it is
  std::string todo;  ///< what to do; empty: nothing
};

class Findings {
 public:
  void ok(std::string what, std::string text) { add({Finding::Level::ok, std::move(what), std::move(text), ""}); }
  void note(std::string what, std::string text, std::string todo = "") {
    add({Finding::Level::note, std::move(what), std::move(text), std::move(todo)});
  }
  void problem(std::string what, std::string text, std::string todo) {
    add({Finding::Level::problem, std::move(what), std::move(text), std::move(todo)});
  }
  [[nodiscard]] const std::vector<Finding>& list() const noexcept { return list_; }

 private:
  void add(Finding finding) { list_.push_back(std::move(finding)); }
  std::vector<Finding> list_;
};

/// Does the world load, and has it robots? With the embedded engine in vsa, from the elements alone in vsa-doctor.
using LoadingCheck = void (*)(Findings& findings, const std::filesystem::path& file);

/// A Gazebo, as far as it is there, and the variables in which it looks.
struct Host {
  const char* name;
  const char* plugin_path;
  const char* model_path;
  const char* library_mark;  ///< part of the name of a library that only its plug-ins need
  bool found = false;
};

/// `pages`: of a program that writes them; vsa-doctor has none.
void check_data(Findings& findings, bool pages);
[[nodiscard]] std::vector<Host> check_hosts(Findings& findings);
void check_plugins(Findings& findings, const std::vector<Host>& hosts);
void check_model_paths(Findings& findings, const std::vector<Host>& hosts);
void check_network(Findings& findings);
void check_ports(Findings& findings, const std::filesystem::path& devices);
/// Throws InputError where there is no such file.
void check_world(Findings& findings, const std::vector<Host>& hosts, const std::string& world, LoadingCheck check_loading);

/// The directories of a variable such as PATH, without empty ones; none where it is unset.
[[nodiscard]] std::vector<std::filesystem::path> directories_of(const char* variable);
/// Value of a variable; empty where it is unset.
[[nodiscard]] std::string value_of(const char* variable);

}  // namespace vsa::app
