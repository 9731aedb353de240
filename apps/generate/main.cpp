// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// vsa-generate DESCRIPTION OUTDIR [ROS2DIR]: writes the models and worlds, and the bridges for ROS 2. Exit codes: 0 done, 1 can't
// write, 2 bad usage or description.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "generate.hpp"
#include "vsa/errors.hpp"

namespace {

void write(const vsa::generate::Files& files, const std::filesystem::path& out) {
  for (const auto& [name, content] : files) {
    std::filesystem::create_directories((out / name).parent_path());
    std::ofstream file(out / name, std::ios::binary);
    file << content;
    if (!file.flush()) throw std::runtime_error(fmt::format("can't write {}", (out / name).string()));
  }
  fmt::print("{} files in {}\n", files.size(), out.string());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    fmt::print(stderr, "usage: vsa-generate DESCRIPTION.toml OUTDIR [ROS2DIR]\n");
    return 2;
  }
  try {
    const auto files = vsa::generate::generate(vsa::generate::read_description(argv[1]));
    write(files, argv[2]);
    if (argc == 4) write(vsa::generate::bridges(files), argv[3]);
  } catch (const vsa::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "vsa-generate: {}\n", error.what());
    return 1;
  }
  return 0;
}
