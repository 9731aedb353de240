// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Warnings, once a kind: "sensors are left out: m::a/sensor[imu] and 11 more".
#pragma once

#include <string>
#include <vector>

namespace vsa::reader {

class Notes {
 public:
  void add(const std::string& what, const std::string& where);
  [[nodiscard]] std::vector<std::string> texts() const;

 private:
  struct Note {
    std::string what, first;
    int more = 0;
  };
  std::vector<Note> notes_;
};

}  // namespace vsa::reader
