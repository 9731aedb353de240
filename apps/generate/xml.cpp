// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "xml.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vsa::generate {
namespace {

class Printer : public tinyxml2::XMLPrinter {
  void PrintSpace(int depth) override {
    for (int i = 0; i < depth; ++i) Write("  ", 2);
  }
};

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

Xml::Xml() : printer_(std::make_unique<Printer>()) { printer_->PushDeclaration("xml version=\"1.0\""); }

Xml& Xml::open(const char* tag, Attributes attributes) {
  printer_->OpenElement(tag);
  for (const auto& [name, value] : attributes) printer_->PushAttribute(name, value.c_str());
  return *this;
}

Xml& Xml::close() {
  printer_->CloseElement();
  return *this;
}

Xml& Xml::leaf(const char* tag, const std::string& text, Attributes attributes) {
  open(tag, attributes);
  printer_->PushText(text.c_str());
  return close();
}

Xml& Xml::comment(const std::string& text) {
  printer_->PushComment(fmt::format(" {} ", text).c_str());
  return *this;
}

Xml& Xml::pose(std::initializer_list<double> values) {
  if (std::any_of(values.begin(), values.end(), [](double v) { return v != 0; })) leaf("pose", numbers(values));
  return *this;
}

}  // namespace vsa::generate
