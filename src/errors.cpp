// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/errors.hpp"

#include "vsa/utf8.hpp"

namespace vsa {
namespace {

std::string join(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& p : problems) {
    if (!text.empty()) text += '\n';
    text += p.text();
  }
  return text;
}

constexpr std::size_t kLongestShown = 300;

/// On one line, in UTF-8, and without what would steer a terminal: control characters, those of two bytes too, and what is no
/// character, as \xNN.
std::string shown(const std::string& text) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0U;
    const auto before = i > 0 ? static_cast<unsigned char>(text[i - 1]) : 0U;
    const bool c1 = (byte == 0xC2 && next >= 0x80 && next < 0xA0) || (before == 0xC2 && byte >= 0x80 && byte < 0xA0);
    const std::size_t length = utf8_length(text, i);
    if (byte >= 0x20 && byte != 0x7F && !c1 && length > 0) {
      out.append(text, i, length);
      i += length - 1;
      continue;
    }
    out += "\\x";
    out += kDigits[byte >> 4];
    out += kDigits[byte & 0xFU];
  }
  return out;
}

/// What goes on and on is cut, between characters of UTF-8 where it has any.
std::string shortened(const std::string& text) {
  if (text.size() <= kLongestShown) return text;
  std::size_t end = kLongestShown;
  while (end > kLongestShown - 4 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end) + "… (" + std::to_string(text.size()) + " bytes)";
}

}  // namespace

std::string Problem::text() const {
  std::string out;
  if (!file.empty()) out += shown(file) + ": ";
  if (!key.empty()) out += shown(shortened(key));
  if (!value.empty()) out += (key.empty() ? "" : " = ") + shown(shortened(value));
  if (!key.empty() || !value.empty()) out += ": ";
  out += message;
  if (!allowed.empty()) out += " (allowed: " + allowed + ")";
  return out;
}

InputError::InputError(std::vector<Problem> problems) : std::runtime_error(join(problems)), problems_(std::move(problems)) {}

InputError::InputError(Problem problem) : InputError(std::vector<Problem>{std::move(problem)}) {}

}  // namespace vsa
