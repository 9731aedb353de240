// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sweep/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sweep/columns.hpp"
#include "vsa/config/text.hpp"
#include "vsa/not_a_number.hpp"
#include "vsa/quantile.hpp"

namespace vsa::sweep {
namespace {

using report::Chart;
using report::Curve;

constexpr int kClasses = 5;
constexpr std::size_t kMostLines = 400;  // of parallel coordinates: more is a grey area

std::string digits(double v) { return std::isfinite(v) ? fmt::format("{:.4g}", v) : "–"; }

/// Which fifth of all values a value is in: by rank, so that each has as many.
class Fifths {
 public:
  explicit Fifths(std::vector<double> values) {
    std::erase_if(values, [](double v) { return !std::isfinite(v); });
    std::sort(values.begin(), values.end());
    for (int k = 1; k < kClasses && !values.empty(); ++k)
      edges_.push_back(values[std::min(values.size() - 1, values.size() * static_cast<std::size_t>(k) / kClasses)]);
    if (!values.empty()) least_ = values.front(), most_ = values.back();
  }
  [[nodiscard]] int of(double v) const {
    return static_cast<int>(std::upper_bound(edges_.begin(), edges_.end(), v) - edges_.begin());
  }
  [[nodiscard]] std::string name(int k) const {
    if (edges_.empty()) return "none";
    const auto i = static_cast<std::size_t>(k);
    return digits(k == 0 ? least_ : edges_[i - 1]) + " … " + digits(i == edges_.size() ? most_ : edges_[i]);
  }

 private:
  std::vector<double> edges_;
  double least_ = kNaN, most_ = kNaN;
};

struct Sheet {
  Sheet(const Plan& p, const Results& results) : plan(p), all(columns(p, results)) {}
  [[nodiscard]] const Column& axis(std::size_t k) const { return all[2 + k]; }
  [[nodiscard]] const Column& measure(std::size_t m) const { return all[2 + plan.axes().size() + m]; }
  const Plan& plan;
  std::vector<Column> all;
};

/// A measure where an axis has one value: medians and quartiles over all else.
Chart by_numbers(const Sheet& sheet, std::size_t k, std::size_t m) {
  const Column &x = sheet.axis(k), &y = sheet.measure(m);
  Chart chart{y.name + " by " + x.name, x.name, y.name, {}, ""};
  if (sheet.plan.axes()[k].kind != Axis::Kind::listed) {
    chart.curves.push_back(report::curve("a run each", x.numbers, y.numbers, Curve::Style::markers, 0));
    return chart;
  }
  std::map<double, std::vector<double>> groups;
  for (std::size_t r = 0; r < x.numbers.size(); ++r) groups[x.numbers[r]].push_back(y.numbers[r]);
  Curve median = report::curve("median", {}, {}, Curve::Style::line, 0),
        low = report::curve("quartiles", {}, {}, Curve::Style::dotted, 0);
  Curve high = low;
  low.group = high.group = "quartiles";
  for (const auto& [value, found] : groups) {
    const Quartiles q = quartiles(found);
    for (Curve* c : {&median, &low, &high}) c->x.push_back(value);
    median.y.push_back(q.median);
    low.y.push_back(q.low);
    high.y.push_back(q.high);
  }
  chart.curves = {median, low, high};
  return chart;
}

report::Table by_words(const Sheet& sheet, std::size_t k) {
  report::Table out{"By " + sheet.axis(k).name, {sheet.axis(k).name, "runs"}, {}, "Median and quartiles over all else."};
  std::map<std::string, std::vector<std::size_t>> groups;
  for (std::size_t r = 0; r < sheet.axis(k).texts.size(); ++r) groups[sheet.axis(k).texts[r]].push_back(r);
  for (std::size_t m = 0; m < sheet.plan.measures().size(); ++m) out.head.push_back(sheet.measure(m).name);
  for (const auto& [word, runs] : groups) {
    std::vector<std::string> row{word, std::to_string(runs.size())};
    for (std::size_t m = 0; m < sheet.plan.measures().size(); ++m) {
      std::vector<double> values;
      for (const std::size_t r : runs) values.push_back(sheet.measure(m).numbers[r]);
      const Quartiles q = quartiles(values);
      row.push_back(fmt::format("{} ({} … {})", digits(q.median), digits(q.low), digits(q.high)));
    }
    out.rows.push_back(std::move(row));
  }
  return out;
}

/// Over two axes of numbers, coloured by the measure's fifths; where an axis is a list, the median of each cell.
Chart map_of(const Sheet& sheet, std::size_t a, std::size_t b, std::size_t m) {
  const Column &x = sheet.axis(a), &y = sheet.axis(b), &z = sheet.measure(m);
  std::map<std::pair<double, double>, std::vector<double>> cells;
  for (std::size_t r = 0; r < x.numbers.size(); ++r) cells[{x.numbers[r], y.numbers[r]}].push_back(z.numbers[r]);
  std::vector<double> medians;
  for (const auto& [at, values] : cells) medians.push_back(quartiles(values).median);
  const Fifths fifths(medians);
  Chart chart{z.name, x.name, y.name, {}, "Coloured by fifths: each colour has as many points."};
  for (int k = 0; k < kClasses; ++k) chart.curves.push_back(report::curve(fifths.name(k), {}, {}, Curve::Style::markers, k));
  std::size_t at = 0;
  for (const auto& [place, values] : cells) {
    const double median = medians[at++];
    if (!std::isfinite(median)) continue;
    Curve& curve = chart.curves[static_cast<std::size_t>(fifths.of(median))];
    curve.x.push_back(place.first);
    curve.y.push_back(place.second);
  }
  std::erase_if(chart.curves, [](const Curve& c) { return c.x.empty(); });
  return chart;
}

/// Every axis and measure a vertical line from its least to its most; a run a line across, coloured by the first measure's fifths.
Chart parallel(const Sheet& sheet) {
  struct Line {
    const Column* column;
    double least = kNaN, most = kNaN;
  };
  std::vector<Line> lines;
  std::string list;  // an axis has no place for so many names
  for (std::size_t c = 2; c + 2 < sheet.all.size(); ++c) {
    const Column& column = sheet.all[c];
    if (!column.is_number) continue;
    Line line{&column};
    for (const double v : column.numbers) {
      if (!std::isfinite(v)) continue;
      line.least = std::isnan(line.least) ? v : std::min(line.least, v);
      line.most = std::isnan(line.most) ? v : std::max(line.most, v);
    }
    if (!(line.least < line.most)) continue;
    lines.push_back(line);
    list += fmt::format(" {}: {}, {} … {}.", lines.size(), column.name, digits(line.least), digits(line.most));
  }
  const std::vector<double>& first = sheet.measure(0).numbers;
  const Fifths fifths(first);
  Chart chart{"All at once", "axes and measures, listed below", "from the least to the most", {}, ""};
  const std::size_t every = std::max<std::size_t>(1, (first.size() + kMostLines - 1) / kMostLines);
  chart.caption = "A run a line, coloured by the fifths of " + sheet.measure(0).name +
                  (every > 1 ? "; every " + std::to_string(every) + "th run" : "") + "." + list;
  for (int k = 0; k < kClasses; ++k) chart.curves.push_back(report::curve(fifths.name(k), {}, {}, Curve::Style::line, k));
  for (std::size_t r = 0; r < first.size(); r += every) {
    if (!std::isfinite(first[r])) continue;
    Curve& curve = chart.curves[static_cast<std::size_t>(fifths.of(first[r]))];
    for (std::size_t l = 0; l < lines.size(); ++l) {
      curve.x.push_back(static_cast<double>(l + 1));
      curve.y.push_back((lines[l].column->numbers[r] - lines[l].least) / (lines[l].most - lines[l].least));
    }
    curve.x.push_back(kNaN);
    curve.y.push_back(kNaN);
  }
  std::erase_if(chart.curves, [](const Curve& c) { return c.x.empty(); });
  return chart;
}

report::Table failures(const Results& results) {
  constexpr std::size_t kShown = 50;
  report::Table out{"Failed", {"run", "error"}, {}, ""};
  std::size_t count = 0;
  for (const Outcome& o : results.outcomes)
    if (!o.error.empty() && ++count <= kShown) out.rows.push_back({std::to_string(o.run), o.error});
  if (count > kShown) out.caption = fmt::format("And {} more.", count - kShown);
  return out;
}

}  // namespace

Quartiles quartiles(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  std::sort(values.begin(), values.end());
  return {values.size(), quantile(values, 0.25), quantile(values, 0.5), quantile(values, 0.75)};
}

report::Report summary(const Plan& plan, const Results& results, const std::string& command) {
  const Sheet sheet(plan, results);
  std::size_t failed = 0;
  for (const Outcome& o : results.outcomes) failed += o.error.empty() ? 0 : 1;
  report::Report out;
  out.title = plan.title().empty() ? "Sweep" : plan.title();
  out.subtitle = fmt::format("{} runs: {} points × {} repetitions", plan.runs(), plan.points(), plan.repetitions());
  out.footer = command;
  using Verdict = report::Figure::Verdict;
  out.sections.push_back({"Runs",
                          {report::Figures{{{"made", fmt::format("{} of {}", results.outcomes.size() - failed, plan.runs()), "",
                                             results.outcomes.size() == plan.runs() ? Verdict::good : Verdict::none},
                                            {"failed", std::to_string(failed), "", failed > 0 ? Verdict::bad : Verdict::good}}}}});
  if (failed > 0) out.sections[0].blocks.emplace_back(failures(results));
  std::vector<std::size_t> numbers;
  report::Section words{"By names", {}};
  for (std::size_t k = 0; k < plan.axes().size(); ++k) {
    if (sheet.axis(k).is_number) {
      numbers.push_back(k);
    } else {
      words.blocks.emplace_back(by_words(sheet, k));
    }
  }
  if (!words.blocks.empty()) out.sections.push_back(std::move(words));
  for (std::size_t m = 0; m < plan.measures().size() && !numbers.empty(); ++m) {
    report::Section section{sheet.measure(m).name, {}};
    for (const std::size_t k : numbers) section.blocks.emplace_back(by_numbers(sheet, k, m));
    for (std::size_t i = 0; i < numbers.size(); ++i)
      for (std::size_t j = i + 1; j < numbers.size(); ++j) section.blocks.emplace_back(map_of(sheet, numbers[i], numbers[j], m));
    out.sections.push_back(std::move(section));
  }
  if (!numbers.empty()) out.sections.push_back({"Parallel coordinates", {parallel(sheet)}});
  return out;
}

}  // namespace vsa::sweep
