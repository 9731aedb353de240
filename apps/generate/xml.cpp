// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "vsa/xml_escape.hpp"

namespace vsa::generate {
namespace {

std::string start(std::string_view tag, Xml::Attributes attributes) {
  std::string out = fmt::format("<{}", tag);
  for (const auto& [name, value] : attributes) out += fmt::format(" {}=\"{}\"", name, xml_escaped(value));
  return out;
}

}  // namespace

std::string number(double value) {
  const double tiny = 1e-12;  // what trigonometry leaves of a zero
  return fmt::format("{:.9g}", value > -tiny && value < tiny ? 0.0 : value);
}

std::string numbers(std::initializer_list<double> values) {
  std::string out;
  for (const double value : values) out += fmt::format("{}{}", out.empty() ? "" : " ", number(value));
  return out;
}

Xml::Xml() : text_("<?xml version=\"1.0\"?>\n") {}

void Xml::line(const std::string& text) {
  text_.append(2 * stack_.size(), ' ');
  text_ += text;
  text_ += '\n';
}

Xml& Xml::open(std::string_view tag, Attributes attributes) {
  line(fmt::format("{}>", start(tag, attributes)));
  stack_.emplace_back(tag);
  return *this;
}

Xml& Xml::close() {
  const std::string tag = stack_.back();
  stack_.pop_back();
  line(fmt::format("</{}>", tag));
  return *this;
}

Xml& Xml::leaf(std::string_view tag, const std::string& text, Attributes attributes) {
  line(fmt::format("{}>{}</{}>", start(tag, attributes), xml_escaped(text), tag));
  return *this;
}

Xml& Xml::empty(std::string_view tag, Attributes attributes) {
  line(fmt::format("{}/>", start(tag, attributes)));
  return *this;
}

Xml& Xml::comment(std::string_view text) {
  line(fmt::format("<!-- {} -->", text));
  return *this;
}

Xml& Xml::pose(std::initializer_list<double> values) {
  if (std::any_of(values.begin(), values.end(), [](double v) { return v != 0; })) leaf("pose", numbers(values));
  return *this;
}

const std::string& Xml::text() const {
  assert(stack_.empty());
  return text_;
}

}  // namespace vsa::generate
