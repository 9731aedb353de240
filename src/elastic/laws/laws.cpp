// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "elastic/laws/laws.hpp"

#include <array>
#include <string>

#include "vsa/checks.hpp"

namespace vsa::elastic {

std::span<const Law* const> laws() noexcept {
  static constexpr std::array kAll{&kCamRoller, &kLeverPivot, &kLeverSpring,  &kMaccepa, &kSeriesHardening, &kSeriesSpring,
                                   &kTwoCams,   &kTwoExp,     &kTwoQuadratic, &kTwoSinh, &kTwoSinhLinear};
  return kAll;
}

void validate(const Law& law, std::span<const double> values, std::string_view where, Problems& problems) {
  Checks check(where, problems);
  if (values.size() != law.parameters.size()) {
    check.refuse(law.name, std::to_string(values.size()) + " values", "the law has other parameters",
                 std::to_string(law.parameters.size()) + " values");
    return;
  }
  const std::size_t before = problems.list().size();
  for (std::size_t i = 0; i < values.size(); ++i)
    check.within(law.parameters[i].key, values[i], law.parameters[i].min, law.parameters[i].max);
  if (problems.list().size() != before || law.fault == nullptr) return;
  const auto fault = law.fault(values);
  if (!fault) return;
  std::string value;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (law.parameters[i].key == fault->key) value = Checks::text(values[i]);
  check.refuse(fault->key, value, fault->message, fault->allowed);
}

}  // namespace vsa::elastic
