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

}  // namespace

std::string Problem::text() const {
  std::string out;
  if (!file.empty()) out += file + ": ";
  if (!key.empty()) out += key;
  if (!value.empty()) out += (key.empty() ? "" : " = ") + value;
  if (!key.empty() || !value.empty()) out += ": ";
  out += message;
  if (!allowed.empty()) out += " (allowed: " + allowed + ")";
  return out;
}

InputError::InputError(std::vector<Problem> problems) : std::runtime_error(join(problems)), problems_(std::move(problems)) {}

InputError::InputError(Problem problem) : InputError(std::vector<Problem>{std::move(problem)}) {}

}  // namespace vsa
