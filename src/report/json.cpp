// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The page's data; web/src/report/main.js reads them.
#include "vsa/page/json.hpp"

#include <stdexcept>

#include "vsa/report/report.hpp"

namespace vsa::report {
namespace {

using page::Json;

template <class Range, class F>
Json array(const Range& range, F&& f) {
  Json out = Json::array();
  for (const auto& item : range) out.push_back(f(item));
  return out;
}

Json numbers(const std::vector<double>& list) {
  constexpr int kDigits = 6;  // more than a chart shows
  return array(list, [](double v) { return page::number(v, kDigits); });
}

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

Json curve(const Curve& c) {
  const bool error_fits = c.error.size() == c.x.size() || (c.error.empty() && c.style != Curve::Style::band);
  if (c.x.size() != c.y.size() || !error_fits) {
    throw std::invalid_argument("report: curve \"" + c.name + "\" has x, y and error of different lengths");
  }
  return {{"name", c.name},    {"group", c.group},  {"style", style(c.style)},  {"color", c.color},
          {"x", numbers(c.x)}, {"y", numbers(c.y)}, {"error", numbers(c.error)}};
}

void put_range(Json& to, const char* key, const std::optional<std::array<double, 2>>& range) {
  if (range) to[key] = Json::array({(*range)[0], (*range)[1]});
}

Json bar(const Bars::Bar& b) {
  return {{"label", b.label}, {"value", page::number(b.value)}, {"text", b.text}, {"note", b.note}, {"link", b.link}};
}

Json card(const Cards::Card& c) {
  if (c.low.size() != c.x.size() || c.high.size() != c.x.size())
    throw std::invalid_argument("report: card \"" + c.title + "\" has x, low and high of different lengths");
  return {{"title", c.title},      {"subtitle", c.subtitle},  {"tag", c.tag},        {"link", c.link}, {"x", numbers(c.x)},
          {"low", numbers(c.low)}, {"high", numbers(c.high)}, {"figures", c.figures}};
}

Json figure(const Figure& f) { return {{"label", f.label}, {"value", f.value}, {"note", f.note}, {"verdict", verdict(f.verdict)}}; }

struct BlockJson {
  Json operator()(const Text& t) const { return {{"kind", "text"}, {"text", t.text}}; }
  Json operator()(const Table& t) const {
    Json out{{"kind", "table"}, {"title", t.title}, {"head", t.head}, {"rows", t.rows}, {"caption", t.caption}};
    if (!t.links.empty()) out["links"] = t.links;
    return out;
  }
  Json operator()(const Chart& c) const {
    Json out{{"kind", "chart"},  {"title", c.title}, {"x_label", c.x_label}, {"y_label", c.y_label},
             {"y_log", c.y_log}, {"x_log", c.x_log}, {"caption", c.caption}, {"curves", array(c.curves, curve)}};
    put_range(out, "x_range", c.x_range);
    put_range(out, "y_range", c.y_range);
    return out;
  }
  Json operator()(const Bars& b) const {
    return {{"kind", "bars"}, {"title", b.title}, {"bars", array(b.bars, bar)}, {"caption", b.caption}};
  }
  Json operator()(const Cards& c) const {
    return {
        {"kind", "cards"}, {"x_label", c.x_label}, {"y_label", c.y_label}, {"cards", array(c.cards, card)}, {"caption", c.caption}};
  }
  Json operator()(const Figures& f) const { return {{"kind", "figures"}, {"figures", array(f.figures, figure)}}; }
};

Json section(const Section& s) {
  const auto block = [](const Block& b) { return std::visit(BlockJson{}, b); };
  return {{"title", s.title}, {"blocks", array(s.blocks, block)}};
}

}  // namespace

std::string to_json(const Report& report) {
  Json out{{"format", 1},
           {"title", report.title},
           {"subtitle", report.subtitle},
           {"footer", report.footer},
           {"one_page", report.one_page},
           {"sections", array(report.sections, section)}};
  if (!report.links.empty()) out["links"] = report.links;
  return page::text(out);
}

}  // namespace vsa::report
