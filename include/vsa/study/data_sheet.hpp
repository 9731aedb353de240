// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What a data sheet holds: what law and drive tell, and what the benches show.
#pragma once

#include <optional>
#include <string>

#include "vsa/experiment/datasheet.hpp"
#include "vsa/study/characterization.hpp"

namespace vsa::study {

/// A data sheet: what law and drive tell, and what the benches show. A plan where the simulated part is one.
struct DataSheet {
  experiment::DataSheet computed;  ///< by law and drive alone
  Characterization simulated;      ///< speed and preset steps, as plan_characterization() has them

  /// "rad" …; empty: the law has no stiffness preset.
  [[nodiscard]] std::string preset_unit() const { return simulated.preset_unit(); }
  /// Whether there are columns beside that of preset 0.
  [[nodiscard]] bool has_preset() const { return !preset_unit().empty() && computed.columns.size() > 1; }
  /// M g r of the load bench, N·m; none where nothing ran on it.
  [[nodiscard]] std::optional<double> nominal_load_Nm() const;
};

/// Computes, and plans what is to be run. Throws InputError: an unknown type or override.
[[nodiscard]] DataSheet plan_data_sheet(const experiment::Specimen& specimen);
/// As run() of a characterization.
[[nodiscard]] std::optional<DataSheet> run(DataSheet plan, const OnProgress& on_progress = {}, unsigned threads = 0);

}  // namespace vsa::study
