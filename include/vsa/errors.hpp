// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace vsa {

/// One thing wrong in what the user gave. Empty fields are left out of the text.
struct Problem {
  std::string file;     ///< the file, topic or flag it came from
  std::string key;      ///< the key, element path or joint
  std::string value;    ///< what was found there
  std::string message;  ///< what is wrong
  std::string allowed;  ///< what would be right: a range, a list of names

  /// "file: key = value: message (allowed: …)"
  [[nodiscard]] std::string text() const;
};

/// The one exception for bad input. It carries every problem found, so that a user mends them in one go.
class InputError : public std::runtime_error {
 public:
  /// With all problems, at least one; what() is their text.
  explicit InputError(std::vector<Problem> problems);
  explicit InputError(Problem problem);                                                      ///< with one problem
  [[nodiscard]] const std::vector<Problem>& problems() const noexcept { return problems_; }  ///< all that were found

 private:
  std::vector<Problem> problems_;
};

/// Collects problems while reading; throws them together.
class Problems {
 public:
  void add(Problem problem) { list_.push_back(std::move(problem)); }  ///< one more
  /// All of another error's.
  void add_all(const InputError& error) { list_.insert(list_.end(), error.problems().begin(), error.problems().end()); }
  [[nodiscard]] bool empty() const noexcept { return list_.empty(); }                ///< whether none was found
  [[nodiscard]] const std::vector<Problem>& list() const noexcept { return list_; }  ///< those found so far
  /// InputError with all of them; nothing where there are none.
  void throw_if_any() const {
    if (!list_.empty()) throw InputError(list_);
  }

 private:
  std::vector<Problem> list_;
};

}  // namespace vsa
