// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/page/page.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/output_file.hpp"

namespace vsa::page {

std::string read_template(const std::filesystem::path& file) {
  const auto problem = [&](const std::string& message) { return InputError(Problem{file.string(), "", "", message, ""}); };
  auto text = read_file(file);
  if (!text) throw problem("can't read the page's template: " + std::system_category().message(errno));
  const std::size_t at = text->find(kMarker);
  if (at == std::string::npos || text->find(kMarker, at + 1) != std::string::npos) {
    throw problem("not a page's template: it must hold " + std::string(kMarker) + " once");
  }
  return std::move(*text);
}

std::string filled(std::string_view page_template, std::string_view json) {
  const std::size_t at = page_template.find(kMarker);
  std::string out(page_template.substr(0, at));
  return out.append(json).append(page_template.substr(at + kMarker.size()));
}

void write(const std::filesystem::path& file, std::string_view page_template, std::string_view json) {
  write_whole(file, filled(page_template, json));
}

}  // namespace vsa::page
