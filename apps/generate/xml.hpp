// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Writes indented XML, the same bytes everywhere: numbers have at most nine significant digits, lines end in \n.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vsa::generate {

/// At most nine significant digits, never "-0".
[[nodiscard]] std::string number(double value);
[[nodiscard]] std::string numbers(std::initializer_list<double> values);

class Xml {
 public:
  using Attributes = std::initializer_list<std::pair<std::string_view, std::string>>;

  Xml();
  Xml& open(std::string_view tag, Attributes attributes = {});
  Xml& close();
  Xml& leaf(std::string_view tag, const std::string& text, Attributes attributes = {});
  Xml& leaf(std::string_view tag, double value) { return leaf(tag, number(value)); }
  Xml& empty(std::string_view tag, Attributes attributes);
  Xml& comment(std::string_view text);
  /// x y z roll pitch yaw; left out when all are zero.
  Xml& pose(std::initializer_list<double> values);

  /// The document; every element must be closed.
  [[nodiscard]] const std::string& text() const;

 private:
  void line(const std::string& text);
  std::string text_;
  std::vector<std::string> stack_;
};

}  // namespace vsa::generate
