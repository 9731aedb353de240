// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/report/report.hpp"

#include "vsa/config/preset.hpp"
#include "vsa/errors.hpp"
#include "vsa/page/page.hpp"

namespace vsa::report {

std::string page_template() {
  const std::filesystem::path name = std::filesystem::path("web") / "report.html";
  const auto found = config::find_data(name);
  if (!found) {
    std::string looked;
    for (const auto& d : config::data_directories()) looked += (looked.empty() ? "" : ", ") + (d / name).string();
    throw InputError(Problem{"", "", "", "the report page's template is nowhere: " + looked, "set VSA_DATA_DIR"});
  }
  return page::read_template(*found);
}

void write_report(const Report& report, const std::filesystem::path& file) { page::write(file, page_template(), to_json(report)); }

}  // namespace vsa::report
