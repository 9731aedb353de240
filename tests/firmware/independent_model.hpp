// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// A second statement of the controller, written from docs/explanation/4-firmware.md in mathematicians' terms: exact integers, floor
// division, residues modulo 2ⁿ. Nothing of the library's arithmetic is used. The maker pro only.
#pragma once

#include "scenario.hpp"

namespace vsa::firmware::test {

class IndependentUnit {
 public:
  void zero() noexcept;
  void tick(const Scenario& in) noexcept;
  [[nodiscard]] TickRecord record() const noexcept;

  std::array<std::int64_t, 2> next_reference{};
  std::uint8_t next_onoff = 0;

 private:
  void encoder(const Scenario& in, int i) noexcept;
  void motor(const Scenario& in, int i) noexcept;
  void analog(const Scenario& in) noexcept;
  std::int64_t position_error(const Memory& m, int i) noexcept;
  std::int64_t position_pid(const Memory& m, int i) noexcept;
  std::int64_t double_pid(const Memory& m, int i) noexcept;
  std::int64_t current_pid(const Scenario& in, int i) noexcept;

  std::array<std::int64_t, 3> position_{}, position_before_{}, last_{}, turns_{}, doubts_{};
  std::array<std::int64_t, 2> reference_{}, reference_before_{};
  std::array<std::int64_t, 2> sum_{}, current_sum_{}, current_error_{};
  std::array<std::int64_t, 2> filter_{}, current_{}, current_before_{};
  std::array<std::int64_t, 2> duty_{}, sign_{1, 1};
  std::array<bool, 2> forward_{};
  std::int64_t supply_ = 0, limit_ = 0;
  std::uint8_t onoff_ = 0;
  bool fresh_ = true, samples_to_zero_ = false;
};

}  // namespace vsa::firmware::test
