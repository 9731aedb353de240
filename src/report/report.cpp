// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/report/report.hpp"

#include <utility>

#include "vsa/config/actuator_type.hpp"
#include "vsa/errors.hpp"
#include "vsa/page/page.hpp"

namespace vsa::report {

Curve curve(std::string name, std::vector<double> x, std::vector<double> y, Curve::Style style, int color) {
  Curve c;
  c.name = c.group = std::move(name);
  c.x = std::move(x);
  c.y = std::move(y);
  c.style = style;
  c.color = color;
  return c;
}

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
