// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A chart as a picture of its own: for documents, where the page's interactive charts can't be. Coordinates are rounded to a tenth
// of a pixel, so that small changes of the data leave most of a committed file as it was.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "vsa/report/report.hpp"

namespace vsa::report {
namespace {

constexpr double kWidth = 760, kHeight = 460;
constexpr double kLeft = 74, kRight = 16, kTop = 66, kBottom = 54;
constexpr double kLetter = 6.6;  // px, about a letter's width at 12 px
constexpr const char* kGrey = "#6b7680";
constexpr std::array<const char*, 6> kColors{"#0072b2", "#d55e00", "#009e73", "#e69f00", "#cc79a7", "#56b4e9"};  // Okabe and Ito

/// Text in an element: control characters, of which XML allows few, are spaces.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const char* entity = c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : nullptr;
    if (entity != nullptr) out += entity;
    if (entity == nullptr) out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out;
}

std::string px(double v) {
  return fmt::format("{:.1f}", std::abs(v) < 0.05 ? 0.0 : v);  // whatever decimal point the locale has
}

std::string color_of(const Curve& c) { return c.color < 0 ? kGrey : kColors[static_cast<std::size_t>(c.color) % kColors.size()]; }

std::size_t letters(const std::string& utf8) {
  return static_cast<std::size_t>(std::count_if(utf8.begin(), utf8.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

/// "0.25" with as many decimals as the steps of the axis need.
std::string tick_text(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  std::string out = fmt::format("{:.{}f}", std::abs(value) < 1e-9 * step ? 0.0 : value, decimals);
  if (out[0] == '-') out.replace(0, 1, "−");
  return out;
}

/// One axis: data to pixels, and where its marks are.
class Axis {
 public:
  Axis(double low, double high, double from_px, double to_px, bool log) : from_(from_px), to_(to_px), log_(log) {
    low_ = log ? std::log10(low) : low;
    high_ = log ? std::log10(high) : high;
    if (!(high_ > low_)) {
      const double half = low_ == 0 ? 1 : 0.5 * std::abs(low_);
      low_ -= half;
      high_ += half;
    }
    const double margin = 0.04 * (high_ - low_);
    low_ -= margin;
    high_ += margin;
  }
  [[nodiscard]] double at(double v) const { return from_ + ((log_ ? std::log10(v) : v) - low_) / (high_ - low_) * (to_ - from_); }
  [[nodiscard]] bool draws(double v) const { return std::isfinite(v) && (!log_ || v > 0); }

  struct Mark {
    double value;
    std::string text;
  };
  [[nodiscard]] std::vector<Mark> marks(int about) const {
    if (log_) return decades();
    const double rough = (high_ - low_) / about, power = std::pow(10, std::floor(std::log10(rough)));
    double step = 10 * power;
    for (const double nice : {5.0, 2.0, 1.0}) step = nice * power >= rough ? nice * power : step;
    std::vector<Mark> out;
    for (double k = std::ceil(low_ / step); k * step <= high_; k += 1) out.push_back({k * step, tick_text(k * step, step)});
    return out;
  }

 private:
  [[nodiscard]] std::vector<Mark> decades() const {
    constexpr double kFew = 2.2;  // decades; over more of them 2 and 5 would run into each other
    std::vector<Mark> out;
    for (double k = std::floor(low_); k <= high_; k += 1) {
      for (const double m : {1.0, 2.0, 5.0}) {
        if (m > 1 && high_ - low_ > kFew) continue;
        const double value = m * std::pow(10, k);
        if (std::log10(value) < low_ || std::log10(value) > high_) continue;
        out.push_back({value, fmt::format("{:g}", value)});
      }
    }
    return out;
  }

  double low_ = 0, high_ = 1, from_, to_;
  bool log_;
};

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void add(double v, bool positive) {
    if (!std::isfinite(v) || (positive && v <= 0)) return;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  [[nodiscard]] Axis axis(double from_px, double to_px, bool log) const {
    if (low > high) return {1, 10, from_px, to_px, log};  // nothing to draw
    return {low, high, from_px, to_px, log};
  }
};

std::string text_at(double x, double y, const std::string& text, const char* anchor, const char* more = "") {
  return "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" text-anchor=\"" + anchor + "\"" + more + ">" + escaped(text) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const std::string& color, const char* more = "") {
  return "<line x1=\"" + px(x1) + "\" y1=\"" + px(y1) + "\" x2=\"" + px(x2) + "\" y2=\"" + px(y2) + "\" stroke=\"" + color + "\"" +
         more + "/>\n";
}

const char* dashes(Curve::Style s) {
  if (s == Curve::Style::dashed) return " stroke-dasharray=\"7 4\"";
  return s == Curve::Style::dotted ? " stroke-dasharray=\"2 3\"" : "";
}

std::string ring(double x, double y, const std::string& color) {
  return "<circle cx=\"" + px(x) + "\" cy=\"" + px(y) + "\" r=\"2.8\" fill=\"none\" stroke=\"" + color +
         "\" stroke-width=\"1.2\"/>\n";
}

class Drawing {
 public:
  explicit Drawing(const Chart& chart) : chart_(chart), x_(x_axis()), y_(y_axis()) {}

  [[nodiscard]] std::string svg() const {
    const std::string size = "width=\"" + px(kWidth) + "\" height=\"" + px(kHeight) + "\"";
    std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" " + size + " viewBox=\"0 0 " + px(kWidth) + ' ' + px(kHeight) +
                      "\" role=\"img\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\" fill=\"#1d242b\">\n";
    out += "<title>" + escaped(chart_.title) + "</title>\n<rect " + size + " fill=\"#ffffff\"/>\n";  // readable on a dark page too
    out += text_at(kLeft, 22, chart_.title, "start", " font-size=\"14\" font-weight=\"bold\"") + legend() + frame();
    for (const bool bands : {true, false}) {
      for (const Curve& c : chart_.curves) {
        if ((c.style == Curve::Style::band) == bands) out += curve(c);
      }
    }
    return out + "</svg>\n";
  }

 private:
  [[nodiscard]] Axis x_axis() const {
    Range r;
    for (const Curve& c : chart_.curves) {
      for (std::size_t i = 0; i < c.x.size(); ++i) {
        if (std::isfinite(c.y[i])) r.add(c.x[i], chart_.x_log);
      }
    }
    if (chart_.x_range) r = {(*chart_.x_range)[0], (*chart_.x_range)[1]};
    return r.axis(kLeft, kWidth - kRight, chart_.x_log);
  }
  [[nodiscard]] Axis y_axis() const {
    Range r;
    for (const Curve& c : chart_.curves) {
      for (std::size_t i = 0; i < c.y.size(); ++i) {
        const double e = c.error.empty() || !std::isfinite(c.error[i]) ? 0 : c.error[i];
        r.add(c.y[i] - e, chart_.y_log);
        r.add(c.y[i] + e, chart_.y_log);
      }
    }
    if (chart_.y_range) r = {(*chart_.y_range)[0], (*chart_.y_range)[1]};
    return r.axis(kHeight - kBottom, kTop, chart_.y_log);
  }

  [[nodiscard]] std::string frame() const {
    const double right = kWidth - kRight, low = kHeight - kBottom;
    std::string out;
    for (const Axis::Mark& m : x_.marks(8)) {
      out += line(x_.at(m.value), kTop, x_.at(m.value), low, "#e3e7ea") + text_at(x_.at(m.value), low + 17, m.text, "middle");
    }
    for (const Axis::Mark& m : y_.marks(7)) {
      out += line(kLeft, y_.at(m.value), right, y_.at(m.value), "#e3e7ea") + text_at(kLeft - 7, y_.at(m.value) + 4, m.text, "end");
    }
    out += "<rect x=\"" + px(kLeft) + "\" y=\"" + px(kTop) + "\" width=\"" + px(right - kLeft) + "\" height=\"" + px(low - kTop) +
           "\" fill=\"none\" stroke=\"#9aa5ae\"/>\n";
    out += text_at(0.5 * (kLeft + right), kHeight - 14, chart_.x_label, "middle");
    const std::string turn = " transform=\"rotate(-90 18 " + px(0.5 * (kTop + low)) + ")\"";
    return out + text_at(18, 0.5 * (kTop + low), chart_.y_label, "middle", turn.c_str());
  }

  /// One entry a group, in a row that breaks where it is full.
  [[nodiscard]] std::string legend() const {
    std::string out;
    std::set<std::string> seen;
    double x = kLeft, y = 42;
    for (const Curve& c : chart_.curves) {
      const std::string& name = c.group.empty() ? c.name : c.group;
      if (!seen.insert(name).second) continue;
      const double width = 40 + kLetter * static_cast<double>(letters(name));
      if (x > kLeft && x + width > kWidth - kRight) {
        x = kLeft;
        y += 16;
      }
      const std::string color = color_of(c);
      out += c.style == Curve::Style::markers
                 ? ring(x + 11, y - 4, color)
                 : line(x, y - 4, x + 22, y - 4, color, (std::string(" stroke-width=\"1.8\"") + dashes(c.style)).c_str());
      out += text_at(x + 28, y, name, "start");
      x += width;
    }
    return out;
  }

  [[nodiscard]] bool draws(const Curve& c, std::size_t i) const { return x_.draws(c.x[i]) && y_.draws(c.y[i]); }

  [[nodiscard]] std::string curve(const Curve& c) const {
    if (c.style == Curve::Style::band) return band(c);
    const std::string color = color_of(c);
    std::string out, points;
    const auto flush = [&] {
      if (!points.empty() && c.style != Curve::Style::markers) {
        out += "<polyline points=\"" + points + "\" fill=\"none\" stroke=\"" + color + "\" stroke-width=\"1.8\"" + dashes(c.style) +
               "/>\n";
      }
      points.clear();
    };
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      if (!draws(c, i)) {
        flush();  // a gap
        continue;
      }
      const double x = x_.at(c.x[i]), y = y_.at(c.y[i]);
      points += (points.empty() ? "" : " ") + px(x) + ',' + px(y);
      if (c.style == Curve::Style::markers) out += ring(x, y, color);
      if (!c.error.empty() && y_.draws(c.y[i] - c.error[i])) {
        out += line(x, y_.at(c.y[i] - c.error[i]), x, y_.at(c.y[i] + c.error[i]), color);
      }
    }
    flush();
    return out;
  }

  [[nodiscard]] std::string band(const Curve& c) const {
    std::string out, upper, lower;
    const auto flush = [&] {
      if (!upper.empty()) out += "<polygon points=\"" + upper + lower + "\" fill=\"" + color_of(c) + "\" fill-opacity=\"0.2\"/>\n";
      upper.clear();
      lower.clear();
    };
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      if (!draws(c, i) || !y_.draws(c.y[i] - c.error[i])) {
        flush();
        continue;
      }
      const std::string x = px(x_.at(c.x[i]));
      upper += (upper.empty() ? "" : " ") + x + ',' + px(y_.at(c.y[i] + c.error[i]));
      lower.insert(0, ' ' + x + ',' + px(y_.at(c.y[i] - c.error[i])));
    }
    flush();
    return out;
  }

  const Chart& chart_;
  Axis x_, y_;
};

}  // namespace

std::string to_svg(const Chart& chart) {
  for (const Curve& c : chart.curves) {
    const bool error_fits = c.error.size() == c.x.size() || (c.error.empty() && c.style != Curve::Style::band);
    if (c.x.size() != c.y.size() || !error_fits) {
      throw std::invalid_argument("report: curve \"" + c.name + "\" has x, y and error of different lengths");
    }
  }
  return Drawing(chart).svg();
}

}  // namespace vsa::report
