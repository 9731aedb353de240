// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsa-generate DESCRIPTION OUTDIR [ROS2DIR]: writes the models and worlds, and the bridges for ROS 2. Exit codes: 0 done, 1 can't
// write, 2 bad usage or description.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "generate.hpp"
#include "vsa/errors.hpp"
#include "vsa/output_file.hpp"

namespace {

namespace fs = std::filesystem;

constexpr const char* kUsage =
    R"(usage: vsa-generate DESCRIPTION.toml OUTDIR [ROS2DIR]
Writes models and worlds of models/robots.toml, or of a copy of it, below OUTDIR, and the robots' bridges for ROS 2 below ROS2DIR.
The worlds' MJCF is written by vsa export --mjcf.
)";

/// A file and what it shall hold.
using Written = std::vector<std::pair<fs::path, std::string_view>>;

void list(Written& all, const vsa::generate::Files& files, const fs::path& out) {
  for (const auto& [name, content] : files) all.emplace_back(out / name, content);
}

int run(const std::vector<std::string_view>& arguments) {
  if (arguments.size() == 1 && (arguments[0] == "--help" || arguments[0] == "-h")) {
    fmt::print("{}", kUsage);
    return 0;
  }
  bool usage = arguments.size() == 2 || arguments.size() == 3;
  for (const std::string_view a : arguments) usage &= !a.empty() && a[0] != '-';
  if (!usage) {
    fmt::print(stderr, "{}", kUsage);
    return 2;
  }
  const auto files = vsa::generate::generate(vsa::generate::read_description(arguments[0]));
  const auto bridges = arguments.size() == 3 ? vsa::generate::bridges(files) : vsa::generate::Files{};
  Written all;
  list(all, files, arguments[1]);
  if (!bridges.empty()) list(all, bridges, arguments[2]);
  for (const auto& [file, content] : all) fs::create_directories(file.parent_path());
  vsa::write_all_whole(all);
  fmt::print("{} files in {}\n", files.size(), arguments[1]);
  if (!bridges.empty()) fmt::print("{} files in {}\n", bridges.size(), arguments[2]);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int code = run({argv + (argc > 0 ? 1 : 0), argv + argc});
    if (std::fflush(stdout) == 0) return code;
    fmt::print(stderr, "vsa-generate: can't write to standard output\n");
  } catch (const vsa::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "vsa-generate: {}\n", error.what());
  }
  return 1;
}
