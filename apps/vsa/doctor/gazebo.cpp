// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Where a Gazebo is and what it would find. Classic is its server's executable; gz-sim is one more command of gz or ign, which look
// for it in share/gz (GZ_CONFIG_PATH) and share/ignition (IGN_CONFIG_PATH): sim8.yaml, gazebo6.yaml.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <string_view>

#include "doctor/checks.hpp"

namespace vsa::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLibrary = "libvsa-robot.so";
constexpr const char* kSource = ". PREFIX/share/vsa/setup.sh";

std::optional<fs::path> find_executable(const char* name) {
  for (const fs::path& directory : directories_of("PATH")) {
    std::error_code none;
    const fs::path file = directory / name;
    if (fs::is_regular_file(file, none) && access(file.c_str(), X_OK) == 0) return file;
  }
  return std::nullopt;
}

/// What a command prints, both streams; none: it can't be started or fails.
struct Said {
  bool done = false;
  std::string text;
};
Said say(const std::string& command) {
  Said said;
  FILE* pipe = popen((command + " 2>&1 < /dev/null").c_str(), "re");
  if (pipe == nullptr) return said;
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) said.text.append(buffer.data(), n);
  said.done = pclose(pipe) == 0;
  return said;
}

std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string version_of(std::initializer_list<const char*> packages) {
  if (!find_executable("pkg-config")) return "";
  for (const char* package : packages) {
    const Said said = say(std::string("pkg-config --modversion ") + package);
    if (said.done) return " " + said.text.substr(0, said.text.find('\n'));
  }
  return "";
}

/// The newest "sim8.yaml" of a command's configurations.
std::optional<fs::path> configuration(const fs::path& executable, const char* variable, const char* folder, const char* stem) {
  std::vector<fs::path> places = directories_of(variable);
  if (places.empty()) places.push_back(executable.parent_path().parent_path() / "share" / folder);
  std::vector<fs::path> found;
  for (const fs::path& place : places) {
    std::error_code none;
    for (fs::directory_iterator at(place, none), end; !none && at != end; at.increment(none)) {
      const std::string name = at->path().filename().string();
      if (name.rfind(stem, 0) == 0 && at->path().extension() == ".yaml") found.push_back(at->path());
    }
  }
  // By their names alone, wherever they are: sim10 is above sim9.
  const auto last = std::max_element(found.begin(), found.end(), [](const fs::path& a, const fs::path& b) {
    const std::string x = a.filename().string(), y = b.filename().string();
    return std::pair(x.size(), x) < std::pair(y.size(), y);
  });
  return last == found.end() ? std::nullopt : std::optional(*last);
}

void check_command(Findings& findings, Host& host, const char* command, const char* variable, const char* folder,
                   const char* stem) {
  const auto executable = find_executable(command);
  const auto config = executable ? configuration(*executable, variable, folder, stem) : std::nullopt;
  host.found = config.has_value();
  if (config) findings.ok(host.name, fmt::format("{} with {}", executable->string(), config->string()));
}

/// What ldd says is missing.
struct Missing {
  std::vector<std::string> libraries;
  std::string symbol;  ///< the first that the file itself needs; the simulator's own libraries find theirs in its process
};

Missing missing(const std::string& ldd, const fs::path& file) {
  constexpr std::string_view kUndefined = "undefined symbol: ";
  Missing out;
  for (std::size_t at = 0; at < ldd.size();) {
    const std::size_t end = std::min(ldd.find('\n', at), ldd.size());
    const std::string line = ldd.substr(at, end - at);
    at = end + 1;
    if (line.find("=> not found") != std::string::npos) {
      const std::size_t from = line.find_first_not_of(" \t");
      out.libraries.push_back(line.substr(from, line.find(' ', from) - from));
    } else if (out.symbol.empty() && line.rfind(kUndefined, 0) == 0 && line.find("(" + file.string() + ")") != std::string::npos) {
      out.symbol = line.substr(kUndefined.size(), line.find_first_of(" \t", kUndefined.size()) - kUndefined.size());
    }
  }
  return out;
}

void check_library(Findings& findings, const Host& host, const fs::path& file) {
  const std::string what = std::string("plug-in for ") + host.name;
  const std::string build = "build the plug-in against this machine's Gazebo: docs/howto/gazebo.md";
  if (!find_executable("ldd")) {
    findings.note(what, file.string() + ", which wasn't tried: there is no ldd here");
    return;
  }
  const Said said = say("ldd -r " + quoted(file.string()));
  const Missing lacks = missing(said.text, file);
  if (!said.done && said.text.find("=>") == std::string::npos) {
    findings.problem(what, file.string() + " can't be loaded: " + said.text.substr(0, said.text.find('\n')), build);
  } else if (said.text.find(host.library_mark) == std::string::npos) {
    // setup.sh names one directory for gz-sim and for Fortress: the plug-in in it is for the one that is here.
    if (!host.found) return;
    findings.problem(what, file.string() + " is another Gazebo's plug-in",
                     std::string("put the directory of its own first in ") + host.plugin_path);
  } else if (!lacks.libraries.empty()) {
    findings.problem(what, fmt::format("{} lacks {}", file.string(), fmt::join(lacks.libraries, ", ")),
                     "install that, or " + build);
  } else if (!lacks.symbol.empty()) {
    findings.problem(
        what, fmt::format("{} was built for other versions of its libraries: none has {}", file.string(), lacks.symbol), build);
  } else {
    findings.ok(what, file.string());
  }
}

}  // namespace

std::vector<Host> check_hosts(Findings& findings) {
  std::vector<Host> hosts{
      {"Gazebo Classic", "GAZEBO_PLUGIN_PATH", "GAZEBO_MODEL_PATH", "libgazebo_physics"},
      {"gz-sim", "GZ_SIM_SYSTEM_PLUGIN_PATH", "GZ_SIM_RESOURCE_PATH", "libgz-sim"},
      {"gz-sim (Fortress)", "IGN_GAZEBO_SYSTEM_PLUGIN_PATH", "IGN_GAZEBO_RESOURCE_PATH", "libignition-gazebo"},
  };
  if (const auto server = find_executable("gzserver")) {
    hosts[0].found = true;
    findings.ok(hosts[0].name, server->string() + version_of({"gazebo"}));
  }
  check_command(findings, hosts[1], "gz", "GZ_CONFIG_PATH", "gz", "sim");
  check_command(findings, hosts[2], "ign", "IGN_CONFIG_PATH", "ignition", "gazebo");
  const bool any = std::any_of(hosts.begin(), hosts.end(), [](const Host& h) { return h.found; });
  if (!any) findings.note("Gazebo", "neither gzserver, nor gz or ign with gz-sim, on PATH", "vsa run needs none");
  return hosts;
}

void check_plugins(Findings& findings, const std::vector<Host>& hosts) {
  for (const Host& host : hosts) {
    std::optional<fs::path> file;
    for (const fs::path& directory : directories_of(host.plugin_path)) {
      std::error_code none;
      if (!file && fs::exists(directory / kLibrary, none)) file = directory / kLibrary;
    }
    if (file) {
      check_library(findings, host, *file);
    } else if (host.found) {
      const std::string value = value_of(host.plugin_path);
      findings.problem(std::string("plug-in for ") + host.name,
                       fmt::format("no {} on {} ({})", kLibrary, host.plugin_path, value.empty() ? "unset" : value), kSource);
    }
  }
}

void check_model_paths(Findings& findings, const std::vector<Host>& hosts) {
  const auto look = [&](const char* variable, bool needed) {
    bool ours = false;
    for (const fs::path& directory : directories_of(variable)) {
      std::error_code none;
      if (!fs::is_directory(directory, none))
        findings.note(variable, directory.string() + " is no directory", "take it out of the list");
      ours = ours || fs::exists(directory / "qbmove" / "model.sdf", none);
    }
    if (ours) {
      findings.ok(variable, "has vsasim's models");
    } else if (needed) {
      findings.problem(variable, "vsasim's models aren't on it, so model:// finds none", kSource);
    }
  };
  for (const Host& host : hosts) look(host.model_path, host.found);
  look("SDF_PATH", false);
}

}  // namespace vsa::app
