// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include "sweep/plan_parts.hpp"
#include "vsa/config/text.hpp"

namespace vsa::sweep {

using config::TomlSection;

Measure read_study_measure(TomlSection s) {
  Measure m;
  m.name = s.need("name", "the column's name, with its unit").text("name").value_or("");
  m.value = s.need("value", "a place in the study's results.json, or a quantity's name").text("value").value_or("");
  s.refuse_others();
  return m;
}

Measure read_measure(TomlSection s) {
  Measure m;
  s.need("name", "the column's name, with its unit")
      .need("signal", config::join(signal_names("world")) + "; docs/reference/sweep-files.md");
  m.name = s.text("name").value_or("");
  m.signal = s.text("signal").value_or("");
  m.statistic = s.word("statistic", statistic_names()).value_or("last");
  m.actuator = s.text("actuator").value_or("");
  m.joint = s.text("joint").value_or("");
  m.link = s.text("link").value_or("");
  m.from_s = s.number("from_s", 0, scenario::kLongest_s).value_or(0);
  if (const auto to = s.number("to_s", 0, scenario::kLongest_s)) m.to_s = *to;
  if (!(m.from_s < m.to_s)) s.add("to_s", config::number_text(m.to_s), "no time is left", "above from_s");
  if (int{!m.actuator.empty()} + int{!m.joint.empty()} + int{!m.link.empty()} > 1)
    s.add("actuator", m.actuator, "a signal is of one thing", "actuator, joint or link");
  const bool settles = m.statistic == "settle_s", quantile = m.statistic == "quantile";
  if (settles)
    m.band = s.need("band", "how far from its last value it may be, above 0")
                 .number("band", 0, std::numeric_limits<double>::max())
                 .value_or(1);
  if (quantile) m.order = s.need("order", "0 … 1").number("order", 0, 1).value_or(0);
  const auto of_actuators = signal_names("actuator");
  const bool one = !m.actuator.empty() || !m.joint.empty() || !m.link.empty() ||
                   std::find(of_actuators.begin(), of_actuators.end(), m.signal) == of_actuators.end();
  if (!one && (settles || m.statistic == "last" || m.statistic == "first" || m.statistic == "integral"))
    s.add("statistic", m.statistic, "needs one actuator",
          "actuator = its name, or mean, min, max, peak, range, rms, std, quantile");
  s.refuse_others();
  return m;
}

}  // namespace vsa::sweep
