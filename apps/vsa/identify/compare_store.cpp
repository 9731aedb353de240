// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Fits and comparisons as JSON.
#include <cmath>
#include <limits>

#include "identify/compare_output.hpp"
#include "vsa/files.hpp"
#include "vsa/page/json.hpp"

namespace vsa::app {
namespace {

using page::Json;

Json number(double v) {
  if (std::isfinite(v)) return v;
  return std::isnan(v) ? "nan" : v > 0 ? "inf" : "-inf";
}
double number_in(const Json& j) {
  if (j.is_number()) return j.get<double>();
  const std::string word = j.get<std::string>();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  return word == "inf" ? kInfinite : word == "-inf" ? -kInfinite : std::numeric_limits<double>::quiet_NaN();
}

Json numbers(const std::vector<double>& values) {
  Json out = Json::array();
  for (const double v : values) out.push_back(number(v));
  return out;
}
std::vector<double> numbers_in(const Json& j) {
  std::vector<double> out;
  for (const Json& v : j) out.push_back(number_in(v));
  return out;
}

Json record_json(const identify::FitRecord& r) {
  Json estimates = Json::array();
  for (const identify::Estimate& e : r.estimates) {
    estimates.push_back({{"name", e.name},
                         {"unit", e.unit},
                         {"value", number(e.value)},
                         {"interval_95", {number(e.low), number(e.high)}},
                         {"at_bound", e.at_bound}});
  }
  return {{"asked", r.asked},
          {"estimates", estimates},
          {"rms_rad", numbers(r.rms_rad)},
          {"weighted_squares", number(r.weighted_squares)},
          {"points", number(r.points)},
          {"independent_points", number(r.independent)},
          {"residual_autocorrelation", numbers(r.autocorrelation)},
          {"without_effect", r.without_effect},
          {"unseparated", r.unseparated},
          {"start_weighted_rms", numbers(r.start_rms)},
          {"seconds", number(r.seconds)},
          {"evaluations", r.evaluations}};
}

identify::FitRecord record_in(const Json& j) {
  identify::FitRecord r;
  r.asked = j.at("asked").get<std::string>();
  for (const Json& e : j.at("estimates")) {
    r.estimates.push_back({e.at("name").get<std::string>(), e.at("unit").get<std::string>(), number_in(e.at("value")),
                           number_in(e.at("interval_95").at(0)), number_in(e.at("interval_95").at(1)),
                           e.at("at_bound").get<bool>()});
  }
  r.rms_rad = numbers_in(j.at("rms_rad"));
  r.weighted_squares = number_in(j.at("weighted_squares"));
  r.points = number_in(j.at("points"));
  r.independent = number_in(j.at("independent_points"));
  r.autocorrelation = numbers_in(j.at("residual_autocorrelation"));
  r.without_effect = j.at("without_effect").get<std::vector<std::string>>();
  r.unseparated = j.at("unseparated").get<std::vector<std::vector<std::string>>>();
  r.start_rms = numbers_in(j.at("start_weighted_rms"));
  r.seconds = number_in(j.at("seconds"));
  r.evaluations = j.at("evaluations").get<std::size_t>();
  return r;
}

}  // namespace

std::string fit_json(const identify::FitRecord& record) { return page::results_text(record_json(record)); }

std::optional<identify::FitRecord> stored_fit(const std::filesystem::path& file, const std::string& asked) {
  try {
    identify::FitRecord r = record_in(Json::parse(read_file(file).value_or("")));
    if (r.asked == asked) return r;
  } catch (const Json::exception&) {  // nothing there, or nothing of ours: it is fitted again
  }
  return std::nullopt;
}

std::string comparison_json(const Compared& c) {
  const std::vector<identify::FitRequest> all = identify::requests(c.comparison);
  Json recordings = Json::array(), hypotheses = Json::array();
  for (const identify::Observation& o : c.comparison.recordings)
    recordings.push_back({{"file", o.name}, {"preset", o.preset}, {"weight_per_rad", o.weight}});
  for (std::size_t h = 0; h < c.comparison.hypotheses.size(); ++h) {
    const identify::Hypothesis& hypothesis = c.comparison.hypotheses[h];
    Json set = Json::object(), fits = Json::array();
    for (const config::Override& o : hypothesis.specimen.overrides) set[o.key] = o.value;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].hypothesis != h) continue;
      Json fit = record_json(c.records[i]);
      fit["without"] = all[i].without ? Json(c.comparison.recordings[*all[i].without].name) : Json(nullptr);
      fits.push_back(std::move(fit));
    }
    hypotheses.push_back({{"name", hypothesis.name},
                          {"title", hypothesis.title},
                          {"base", hypothesis.specimen.type},
                          {"set", set},
                          {"free_parameters", hypothesis.free.size()},
                          {"rms_rad", numbers(c.rows[h].rms_rad)},
                          {"left_out_rms_rad", numbers(c.rows[h].left_out_rms_rad)},
                          {"aicc", page::real(c.rows[h].aicc)},
                          {"seconds", c.rows[h].seconds},
                          {"fits", fits}});
  }
  const Json out{{"title", c.comparison.title}, {"command", c.command}, {"recordings", recordings}, {"hypotheses", hypotheses}};
  return page::results_text(out);
}

}  // namespace vsa::app
