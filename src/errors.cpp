// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/errors.hpp"

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

/// What somebody gave, on one line and without what would steer a terminal; a text that goes on and on is cut, between characters.
std::string shown(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool begins = (byte & 0xC0U) != 0x80U;  // a character of UTF-8
    if (begins && out.size() > kLongestShown) return out + "… (" + std::to_string(text.size()) + " bytes)";
    if (byte >= 0x20 && byte != 0x7F) {
      out += c;
      continue;
    }
    constexpr char kDigits[] = "0123456789abcdef";
    out += "\\x";
    out += kDigits[byte >> 4];
    out += kDigits[byte & 0xFU];
  }
  return out;
}

}  // namespace

std::string Problem::text() const {
  std::string out;
  if (!file.empty()) out += shown(file) + ": ";
  if (!key.empty()) out += shown(key);
  if (!value.empty()) out += (key.empty() ? "" : " = ") + shown(value);
  if (!key.empty() || !value.empty()) out += ": ";
  out += message;
  if (!allowed.empty()) out += " (allowed: " + allowed + ")";
  return out;
}

InputError::InputError(std::vector<Problem> problems) : std::runtime_error(join(problems)), problems_(std::move(problems)) {}

InputError::InputError(Problem problem) : InputError(std::vector<Problem>{std::move(problem)}) {}

}  // namespace vsa
