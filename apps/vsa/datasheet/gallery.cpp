// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "datasheet/gallery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "datasheet/page.hpp"
#include "vsa/units.hpp"

namespace vsa::app {
namespace {

using experiment::PresetColumn;

constexpr int kPicturePoints = 40, kPresets = 24;
constexpr double kMostPreset = 0.9;         // of the attainable one, as the sheet's last
constexpr double kLeastPictureLoad = 0.01;  // of the peak torque: where a picture's logarithmic axis begins

/// On the benches' pinion, where a linear actuator is one among others.
study::DataSheet turning(study::DataSheet d) {
  const experiment::Specimen& mounted = d.simulated.specimen;
  if (d.simulated.linear()) d.computed = experiment::data_sheet(mounted.library.load(mounted.type, mounted.overrides));
  return d;
}

/// σ against load up to the softest preset's peak torque: the least and the most over presets.
void add_picture(const study::DataSheet& d, report::Cards::Card& card) {
  const experiment::Workspace workspace(d.computed.type.unit);
  const double most = d.computed.columns.front().weaker().peak.torque_Nm;
  for (int i = 0; i < kPicturePoints; ++i) {
    const double load = most * std::pow(kLeastPictureLoad, 1 - static_cast<double>(i) / (kPicturePoints - 1));
    double low = std::nan(""), high = std::nan("");
    for (int k = 0; k <= (d.has_preset() ? kPresets : 0); ++k) {
      const double stiffness = workspace.stiffness_under(kMostPreset * d.computed.attainable_preset * k / kPresets, load);
      low = std::fmin(low, stiffness);
      high = std::fmax(high, stiffness);
    }
    if (!std::isfinite(low) || !shown(low, high)) continue;
    card.x.push_back(load);
    card.low.push_back(low);
    card.high.push_back(high);
  }
}

report::Cards::Card card_of(const study::DataSheet& d) {
  const experiment::DataSheet& s = d.computed;
  const PresetColumn& soft = s.columns.front();
  report::Cards::Card card;
  card.title = s.type.title;
  card.subtitle = fmt::format("{}, law {}", s.type.name, s.type.law);
  card.tag = s.type.rank.empty() ? "no rank" : s.type.rank;
  card.link = sheet_file(d);
  add_picture(d.simulated.linear() ? turning(d) : d, card);
  const auto [low, high] = stiffness_at_rest(d);
  card.figures = {{"stiffness", span_text(low, high) + " N·m/rad"},
                  {"peak torque", number(soft.weaker().peak.torque_Nm) + " N·m"},
                  {"speed, no load", number(soft.weaker().no_load_speed_rad_per_s) + " rad/s"},
                  {"elastic energy", number(s.most_energy_J) + " J"}};
  const auto& steps = d.simulated.preset_step;
  if (d.simulated.linear())
    for (auto& figure : card.figures)
      for (std::string& words : figure) words = sliding(words);
  card.figures.push_back({"stiffens in", steps.empty() ? "no preset" : number(steps[0].up.rise_s) + " s"});
  if (s.type.mass_kg) card.figures.push_back({"mass", number(s.type.mass_kg->value) + " kg"});
  return card;
}

}  // namespace

std::vector<study::DataSheet> comparable(std::vector<study::DataSheet> sheets) {
  for (study::DataSheet& d : sheets) d = turning(std::move(d));
  return sheets;
}

std::string sheet_file(const study::DataSheet& d) { return d.computed.type.name + ".html"; }

std::string span_text(double low, double high) {
  const std::string a = number(low), b = number(high);
  return a == b ? a : a + " … " + b;
}

std::array<double, 2> stiffness_at_rest(const study::DataSheet& d) {
  const double soft = d.computed.columns.front().stiffness_at_rest_Nm_per_rad;
  return {soft, d.has_preset() ? d.computed.stiffest_Nm_per_rad : soft};
}

report::Report gallery_page(const std::vector<study::DataSheet>& sheets, const std::string& command) {
  report::Cards cards;
  cards.x_label = "load [N·m]";
  cards.y_label = "stiffness [N·m/rad]";
  for (const study::DataSheet& d : sheets) cards.cards.push_back(card_of(d));
  cards.caption =
      "Pictures: stiffness that the law gives under a load that the motors move, from the softest preset to 90 % of the largest; "
      "all "
      "axes are the same (linear actuators: on a pinion of 0.05 m). Numbers: stiffness at rest; time from 10 to 90 % of the "
      "preset's way without load, simulated; the rest "
      "from "
      "law and drive, but the mass, which the type's file states.";
  report::Report out;
  out.title = "Actuator types";
  out.subtitle = fmt::format("{} of them; a card leads to its data sheet", sheets.size());
  out.links = {{"Comparison", kComparisonFile}};
  out.sections = {{"", {std::move(cards)}}};
  out.footer =
      "Ranks: measured: recordings of the hardware; published: constants from public sources; symbolic: a law with numbers that "
      "something real could have.\n" +
      command + " · vsa " VSA_VERSION;
  return out;
}

}  // namespace vsa::app
