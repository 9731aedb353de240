// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// What emulated units have stored, kept in a file as a unit's EEPROM keeps it:
//
//   type = "qbmove_maker_pro_6_1"
//   [[unit]]
//   [unit.user]        the page that a power-up loads: the numbers of firmware::Memory by their names
//   [unit.factory]     the page of defaults
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vsa/device/emulation.hpp"
#include "vsa/errors.hpp"
#include "vsa/serial/path_lock.hpp"

namespace vsa::app {

class UnitMemory {
 public:
  /// Reads the file where it is there. Throws InputError: no such file of this program's, of another type or number of units; one that
  /// can't be written, or that another program keeps.
  UnitMemory(std::filesystem::path file, std::string type, std::size_t units);

  /// One a unit; empty: there was no file.
  [[nodiscard]] const std::vector<device::UnitPages>& pages() const noexcept { return pages_; }
  /// What is unusual about them: a client can store what `vsa set` refuses, and a hand can slip.
  [[nodiscard]] const std::vector<Problem>& notices() const noexcept { return notices_.list(); }
  /// Writes them whole where they have changed. Throws OutputError.
  void keep(const device::Emulation& emulation);

 private:
  std::filesystem::path file_;
  std::string type_;
  serial::PathLock lock_;
  std::vector<device::UnitPages> pages_;
  Problems notices_;
};

}  // namespace vsa::app
