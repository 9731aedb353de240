// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "terminal/table.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

namespace vsa::app {
namespace {

constexpr std::size_t kGap = 2, kLeastLast = 30, kIndent = 4, kUsualWidth = 80;

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, display_width(text)), ' ');
}

std::vector<std::size_t> column_widths(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size() - 1, 0);
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < widths.size(); ++c) widths[c] = std::max(widths[c], display_width(row[c]));
  }
  return widths;
}

void trim_end(std::string& line) { line.erase(line.find_last_not_of(' ') + 1); }

}  // namespace

std::size_t display_width(std::string_view utf8) {
  const auto starts = [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; };
  return static_cast<std::size_t>(std::count_if(utf8.begin(), utf8.end(), starts));
}

std::vector<std::string> wrap(std::string_view text, std::size_t width) {
  std::vector<std::string> lines(1);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string word(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (word.empty()) continue;
    std::string& line = lines.back();
    if (line.empty()) {
      line = word;
    } else if (width == 0 || display_width(line) + 1 + display_width(word) <= width) {
      line += ' ' + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

std::string table_text(const std::vector<std::vector<std::string>>& rows, std::size_t width) {
  const std::vector<std::size_t> widths = column_widths(rows);
  std::size_t left = 0;
  for (std::size_t w : widths) left += w + kGap;
  const bool own_lines = width != 0 && width < left + kLeastLast;
  const std::size_t indent = own_lines ? kIndent : left;
  const std::size_t last_width = width == 0 ? 0 : std::max(kLeastLast, width - std::min(width, indent));
  std::string out;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < widths.size(); ++c) line += padded(row[c], widths[c] + kGap);
    const std::vector<std::string> last = wrap(row.back(), last_width);
    for (std::size_t i = 0; i < last.size(); ++i) {
      if (i > 0 || own_lines) {
        trim_end(line);
        out += line + '\n';
        line = std::string(indent, ' ');
      }
      line += last[i];
    }
    trim_end(line);
    out += line + '\n';
  }
  return out;
}

std::size_t terminal_width() {
  if (isatty(STDOUT_FILENO) == 0) return 0;
  winsize size{};
  const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : kUsualWidth;
}

}  // namespace vsa::app
