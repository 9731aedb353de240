// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Writes indented XML, the same bytes everywhere: numbers have at most nine significant digits, lines end in \n.
#pragma once

#include <tinyxml2.h>

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>

namespace vsa::generate {

/// At most nine significant digits, never "-0".
[[nodiscard]] std::string number(double value);
[[nodiscard]] std::string numbers(std::initializer_list<double> values);

/// tinyxml2's printer, in sentences as the models need them. A tag must live until its element is closed.
class Xml {
 public:
  using Attributes = std::initializer_list<std::pair<const char*, std::string>>;

  Xml();
  Xml& open(const char* tag, Attributes attributes = {});
  Xml& close();
  Xml& leaf(const char* tag, const std::string& text, Attributes attributes = {});
  Xml& leaf(const char* tag, double value) { return leaf(tag, number(value)); }
  Xml& empty(const char* tag, Attributes attributes) { return open(tag, attributes).close(); }
  Xml& comment(const std::string& text);
  /// x y z roll pitch yaw; left out when all are zero.
  Xml& pose(std::initializer_list<double> values);

  /// The document; every element must be closed.
  [[nodiscard]] std::string text() const { return printer_->CStr(); }

 private:
  std::unique_ptr<tinyxml2::XMLPrinter> printer_;
};

}  // namespace vsa::generate
