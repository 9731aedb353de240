// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "export/export.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "terminal/exit_codes.hpp"
#include "terminal/output_files.hpp"
#include "vsa/engine/mjcf.hpp"

namespace vsa::app {
namespace {

constexpr const char* kNotes =
    R"(A world as MuJoCo's own format, for machines without SDF: NAME.xml is what moves, which MuJoCo's own programs open, too;
NAME.vsa.xml has the actuators, the bodies' looks and the joints' ends. `vsa run NAME.xml` moves bit for bit as the world that it
was made of. Where no SDF can be read, NAME.xml beside NAME.sdf stands for it.

Example:
  vsa export --mjcf my_arm.sdf --out .)";

struct ExportOptions {
  std::string world, out;
};

int run_export(const ExportOptions& options) {
  const std::vector<engine::ExportedFile> files = engine::export_mjcf(options.world);
  make_directory(options.out, "--out");
  for (const engine::ExportedFile& file : files) {
    const std::filesystem::path path = std::filesystem::path(options.out) / file.name;
    write_whole(path, file.bytes);
    std::cout << path.string() << '\n';
  }
  return std::cout.flush() ? kDone : kFailed;
}

}  // namespace

void setup_export(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* sub = app.add_subcommand("export", "Write a world in MuJoCo's format, for machines that read no SDF");
  sub->add_option("--mjcf", options->world, "The world: a file, or the name of a built-in one")->required()->type_name("WORLD");
  sub->add_option("--out", options->out, "Directory to write to; made where it is missing")->required()->type_name("DIR");
  sub->footer(kNotes);
  sub->callback([options, &exit_code] { exit_code = run_export(*options); });
}

}  // namespace vsa::app
