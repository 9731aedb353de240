// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// The FMU's documentation page and its icon.
#include <lodepng.h>
#include <tinyxml2.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/fmu_package/package.hpp"

namespace vsa::fmu {
namespace {

constexpr const char* kStyle =
    "body{font-family:sans-serif;max-width:70em;margin:2em auto;padding:0 1em}"
    "td,th{text-align:left;padding:.15em .8em .15em 0;border-bottom:1px solid #ddd;vertical-align:top}";

void element(tinyxml2::XMLPrinter& html, const char* name, const std::string& text) {
  html.OpenElement(name, true);
  html.PushText(text.empty() ? " " : text.c_str());
  html.CloseElement(true);
}

void row(tinyxml2::XMLPrinter& html, const char* cell, const std::vector<std::string>& texts) {
  html.OpenElement("tr", true);
  for (const std::string& text : texts) element(html, cell, text);
  html.CloseElement();
}

void table(tinyxml2::XMLPrinter& html, const Model& model, const char* title, std::initializer_list<Causality> causalities) {
  element(html, "h2", title);
  html.OpenElement("table");
  row(html, "th", {"name", "reference", "unit", "start", "range", "meaning"});
  const std::vector<Variable>& all = model.variables();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Variable& v = all[i];
    bool wanted = false;
    for (const Causality c : causalities) wanted = wanted || v.causality == c;
    if (!wanted) continue;
    const bool starts = v.causality == Causality::parameter || v.causality == Causality::input;
    std::string range = v.min && v.max ? config::range_text(*v.min, *v.max) : "";
    if (!v.words.empty()) range = config::join(v.words);
    row(html, "td", {v.name, std::to_string(i), v.unit, starts ? value_text(v, v.start) : "", range, v.description});
  }
  html.CloseElement();
}

}  // namespace

std::string documentation_page(const Model& model, const PackagePlan& plan) {
  tinyxml2::XMLPrinter html;
  html.PushUnknown("DOCTYPE html");
  html.OpenElement("html");
  html.OpenElement("head");
  html.OpenElement("meta");
  html.PushAttribute("charset", "utf-8");
  html.CloseElement();
  element(html, "title", plan.name);
  element(html, "style", kStyle);
  html.CloseElement();
  html.OpenElement("body");
  element(html, "h1", plan.name);
  element(html, "p", plan.title);
  element(html, "p", plan.note);
  element(html, "p", "Written by vsasim " VSA_VERSION ". More on coupling, steps and limits: docs/howto/fmu.md of vsasim.");
  table(html, model, "Inputs", {Causality::input});
  table(html, model, "Outputs", {Causality::output, Causality::independent});
  table(html, model, "Parameters", {Causality::parameter});
  html.CloseElement();
  html.CloseElement();
  return html.CStr();
}

std::string icon_png() {
  constexpr unsigned kSize = 96;
  // Two springs on one shaft: a wave above, one below, and a disk between.
  std::vector<std::uint8_t> pixels(4 * kSize * kSize, 255);
  for (unsigned y = 0; y < kSize; ++y) {
    for (unsigned x = 0; x < kSize; ++x) {
      const double u = x + 0.5, v = y + 0.5, wave = 10 * std::sin(u * 0.6);
      const bool spring = std::abs(v - (20 + wave)) < 3.5 || std::abs(v - (76 - wave)) < 3.5;
      const double r = std::hypot(u - 48, v - 48);
      const bool disk = r < 14 && r > 5;
      if (!spring && !disk) continue;
      std::uint8_t* p = &pixels[4 * (y * kSize + x)];
      p[0] = disk ? 200 : 30;
      p[1] = disk ? 90 : 80;
      p[2] = disk ? 20 : 150;
    }
  }
  std::vector<std::uint8_t> png;
  if (const unsigned error = lodepng::encode(png, pixels, kSize, kSize); error != 0)
    throw std::runtime_error(std::string("icon: ") + lodepng_error_text(error));
  return {png.begin(), png.end()};
}

}  // namespace vsa::fmu
