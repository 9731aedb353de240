// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Units whose ticks may be made side by side (lanes/loop.hpp), and what the ticks of a type have in common.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "device/lanes/table.hpp"
#include "device/numbers.hpp"
#include "vsa/drive/bridge.hpp"
#include "vsa/firmware/controller.hpp"

namespace vsa::device {

class Unit;
struct UnitState;
struct UnitConfig;

class PlainTicks {
 public:
  /// `like`: whose table of duties serves here, too, where it is of the same bridges; null: nobody's.
  explicit PlainTicks(const UnitConfig& config, const PlainTicks* like = nullptr);

  /// Whether the ticks of a unit of this type from then on are plain: nothing but time and references will change what they do.
  [[nodiscard]] bool plain(const UnitState& state, std::int64_t now_ns) const noexcept;
  /// What the bridges make of these duties, V, looked up; false: not at this supply and limit.
  [[nodiscard]] bool volts(const std::array<std::int32_t, 2>& duty_pct, std::int32_t limit_pct, double supply_V,
                           std::array<double, 2>& volts) const noexcept;
  /// But for the places of a block's numbers.
  [[nodiscard]] const TickStep& common() const noexcept { return common_; }

 private:
  bool program_ = false;  // one that has such ticks
  double supply_V_ = 0;
  MilliVolt supply_{};
  struct Bridges {
    double supply_V = 0;
    std::int32_t limit_pct = 0;
    std::array<drive::BridgeParams, 2> bridge;
    std::array<int, 2> polarity{};
    bool operator==(const Bridges&) const = default;
  };
  /// What the bridges make of duties of −100 … 100 %, V.
  struct Duties {
    explicit Duties(const Bridges& bridges) noexcept;
    Bridges of;
    std::array<std::array<double, 2 * kFull + 1>, 2> volts{};
  };
  std::shared_ptr<const Duties> duties_;
  TickStep common_;
};

}  // namespace vsa::device
