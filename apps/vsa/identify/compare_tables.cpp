// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A comparison's table, and its Markdown.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "identify/compare_output.hpp"
#include "vsa/config/text.hpp"

namespace vsa::app {
namespace {

constexpr const char* kCaption =
    "RMS of simulated − recorded deflection; predicted: of the recording, by a fit without it. AICc: more than the least of all "
    "(docs/howto/identify.md). Open: parameters or combinations that the recordings don't determine. Starts: local solutions, and "
    "by how much the worst is above the best.";

std::string rad(double v) { return std::isfinite(v) ? fmt::format("{:.4f}", v) : "–"; }

std::string time_text(double seconds) {
  return seconds < 120 ? fmt::format("{:.0f} s", seconds) : fmt::format("{:.0f} min", seconds / 60);
}

std::string identifiability(const identify::FitRecord& r) {
  std::vector<std::string> out;
  if (r.undetermined() > 0) out.push_back(fmt::format("{} open", r.undetermined()));
  if (r.at_bounds() > 0) out.push_back(fmt::format("{} at bound", r.at_bounds()));
  return out.empty() ? "all" : config::join(out);
}

/// The fit of each hypothesis to all recordings.
std::vector<const identify::FitRecord*> wholes(const Compared& c) {
  const std::vector<identify::FitRequest> all = identify::requests(c.comparison);
  std::vector<const identify::FitRecord*> out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].without) out.push_back(&c.records[i]);
  }
  return out;
}

report::Table estimates_table(const Compared& c) {
  report::Table out{"Estimates", {"hypothesis", "parameter", "unit", "estimate", "95 % interval"}, {}, ""};
  const auto whole = wholes(c);
  for (std::size_t h = 0; h < whole.size(); ++h) {
    for (const identify::Estimate& e : whole[h]->estimates) {
      const bool known = std::isfinite(e.low) && std::isfinite(e.high);
      const std::string interval = e.at_bound ? "at its bound"
                                   : known    ? fmt::format("{:.4g} … {:.4g}", e.low, e.high)
                                              : "not determined";
      out.rows.push_back({c.comparison.hypotheses[h].name, e.name, e.unit, fmt::format("{:.5g}", e.value), interval});
    }
  }
  return out;
}

}  // namespace

report::Table comparison_table(const Compared& c) {
  report::Table out{c.comparison.title.empty() ? "Hypotheses" : c.comparison.title, {"hypothesis"}, {}, kCaption};
  const std::vector<identify::Observation>& recordings = c.comparison.recordings;
  for (const auto& o : recordings) out.head.push_back(fmt::format("RMS {:.4g} [rad]", o.preset));
  for (std::size_t o = 0; recordings.size() > 1 && o < recordings.size(); ++o)
    out.head.push_back(fmt::format("predicted {:.4g} [rad]", recordings[o].preset));
  for (const char* word : {"free", "AICc", "determined", "starts", "time"}) out.head.emplace_back(word);
  double least = std::numeric_limits<double>::infinity();
  for (const identify::Judgement& j : c.rows) {
    if (std::isfinite(j.aicc)) least = std::min(least, j.aicc);
  }
  const auto whole = wholes(c);
  for (std::size_t h = 0; h < c.rows.size(); ++h) {
    const identify::Judgement& j = c.rows[h];
    std::vector<std::string> cells{c.comparison.hypotheses[h].title};
    for (const double v : j.rms_rad) cells.push_back(rad(v));
    for (const double v : j.left_out_rms_rad) cells.push_back(rad(v));
    cells.push_back(std::to_string(c.comparison.hypotheses[h].free.size()));
    cells.push_back(std::isfinite(j.aicc) ? fmt::format("+{:.1f}", j.aicc - least) : "–");
    cells.push_back(identifiability(*whole[h]));
    const std::size_t starts = whole[h]->start_rms.size();
    cells.push_back(starts > 1 ? fmt::format("{}: {:.1f} %", starts, 100 * whole[h]->spread()) : std::to_string(starts));
    cells.push_back(time_text(j.seconds));
    out.rows.push_back(std::move(cells));
  }
  return out;
}

std::string comparison_markdown(const Compared& c) {
  const report::Table table = comparison_table(c), estimates = estimates_table(c);
  return fmt::format("# {}\n\nWritten by `{}`.\n\n{}## {}\n\n{}", table.title, c.command, report::to_markdown(table),
                     estimates.title, report::to_markdown(estimates));
}

}  // namespace vsa::app
