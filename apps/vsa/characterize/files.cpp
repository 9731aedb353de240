// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "characterize/output.hpp"
#include "vsa/output_file.hpp"

namespace vsa::app {

std::vector<std::string> write_characterization(const study::Characterization& c, const std::string& command,
                                                const std::filesystem::path& directory) {
  std::vector<std::string> files{"report.html", "results.json"};
  const auto csv = [&](const std::string& name, const experiment::BenchRun& run) {
    write_whole(directory / name, study::csv_text(run, c.linear()));
    files.push_back(name);
  };
  for (const auto& r : c.stiffness) csv(study::csv_name(c, r), r.run);
  for (const auto& r : c.speed) csv(study::csv_name(c, r), r.run);
  for (const auto& r : c.preset_step) csv(study::csv_name(r), r.run);
  write_whole(directory / files[1], study::to_json(c, command));
  report::write_report(characterization_report(c, command), directory / files[0]);
  return files;
}

}  // namespace vsa::app
