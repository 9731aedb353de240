// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The page's data; web/src/report/main.js reads them.
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "vsa/record/page.hpp"
#include "vsa/report/report.hpp"

namespace vsa::report {
namespace {

using record::json_string;

/// Six digits are more than a chart shows. JSON has no NaN: null is a gap.
std::string number(double value) {
  if (!std::isfinite(value)) return "null";
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6).ptr};
}

/// [f(a),f(b),…]
template <class Range, class F>
std::string array(const Range& range, F&& f) {
  std::string out = "[";
  for (const auto& item : range) {
    if (out.size() > 1) out += ',';
    out += f(item);
  }
  return out + ']';
}

std::string texts(const std::vector<std::string>& list) {
  return array(list, [](const std::string& t) { return json_string(t); });
}

std::string numbers(const std::vector<double>& list) { return array(list, number); }

const char* style(Curve::Style s) {
  switch (s) {
    case Curve::Style::line:
      return "line";
    case Curve::Style::dashed:
      return "dashed";
    case Curve::Style::dotted:
      return "dotted";
    case Curve::Style::markers:
      return "markers";
    case Curve::Style::band:
      return "band";
  }
  return "line";
}

const char* verdict(Figure::Verdict v) {
  switch (v) {
    case Figure::Verdict::none:
      return "none";
    case Figure::Verdict::good:
      return "good";
    case Figure::Verdict::bad:
      return "bad";
  }
  return "none";
}

std::string curve(const Curve& c) {
  const bool error_fits = c.error.size() == c.x.size() || (c.error.empty() && c.style != Curve::Style::band);
  if (c.x.size() != c.y.size() || !error_fits) {
    throw std::invalid_argument("report: curve \"" + c.name + "\" has x, y and error of different lengths");
  }
  return "{\"name\":" + json_string(c.name) + ",\"group\":" + json_string(c.group) + ",\"style\":\"" + style(c.style) +
         "\",\"color\":" + std::to_string(c.color) + ",\"x\":" + numbers(c.x) + ",\"y\":" + numbers(c.y) +
         ",\"error\":" + numbers(c.error) + '}';
}

std::string figure(const Figure& f) {
  return "{\"label\":" + json_string(f.label) + ",\"value\":" + json_string(f.value) + ",\"note\":" + json_string(f.note) +
         ",\"verdict\":\"" + verdict(f.verdict) + "\"}";
}

struct BlockJson {
  std::string operator()(const Text& t) const { return "{\"kind\":\"text\",\"text\":" + json_string(t.text) + '}'; }
  std::string operator()(const Table& t) const {
    return "{\"kind\":\"table\",\"title\":" + json_string(t.title) + ",\"head\":" + texts(t.head) +
           ",\"rows\":" + array(t.rows, texts) + ",\"caption\":" + json_string(t.caption) + '}';
  }
  std::string operator()(const Chart& c) const {
    return "{\"kind\":\"chart\",\"title\":" + json_string(c.title) + ",\"x_label\":" + json_string(c.x_label) +
           ",\"y_label\":" + json_string(c.y_label) + ",\"y_log\":" + (c.y_log ? "true" : "false") +
           ",\"caption\":" + json_string(c.caption) + ",\n\"curves\":" + array(c.curves, curve) + '}';
  }
  std::string operator()(const Figures& f) const { return "{\"kind\":\"figures\",\"figures\":" + array(f.figures, figure) + '}'; }
};

std::string section(const Section& s) {
  const auto block = [](const Block& b) { return '\n' + std::visit(BlockJson{}, b); };
  return "{\"title\":" + json_string(s.title) + ",\"blocks\":" + array(s.blocks, block) + '}';
}

}  // namespace

std::string to_json(const Report& report) {
  return "{\"format\":1,\n\"title\":" + json_string(report.title) + ",\n\"subtitle\":" + json_string(report.subtitle) +
         ",\n\"footer\":" + json_string(report.footer) + ",\n\"one_page\":" + (report.one_page ? "true" : "false") +
         ",\n\"sections\":" + array(report.sections, section) + '}';
}

}  // namespace vsa::report
