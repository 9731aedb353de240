// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

namespace vsa::record::mcap_reader {

/// Throws std::runtime_error(what) unless it is good.
inline void need(bool good, const std::string& what) {
  if (!good) throw std::runtime_error(what);
}

/// Reads MCAP's fields one behind the other; throws where the bytes end too early.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}
  std::string_view take(std::uint64_t n) {
    need(n <= rest_.size(), "cut short");
    const std::string_view out = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return out;
  }
  std::uint64_t number(int bytes) {
    std::uint64_t v = 0;
    int shift = 0;
    for (const char c : take(static_cast<std::uint64_t>(bytes))) {
      v |= static_cast<std::uint64_t>(static_cast<unsigned char>(c)) << shift;
      shift += 8;
    }
    return v;
  }
  int id() { return static_cast<int>(number(2)); }
  std::string text() { return std::string(take(number(4))); }
  std::map<std::string, std::string> texts() {
    Cursor inside(take(number(4)));
    std::map<std::string, std::string> out;
    while (!inside.done()) {
      const std::string key = inside.text();
      need(out.emplace(key, inside.text()).second, "a key twice: " + key);
    }
    return out;
  }
  std::map<int, std::uint64_t> numbers() {
    Cursor inside(take(number(4)));
    std::map<int, std::uint64_t> out;
    while (!inside.done()) {
      const int key = inside.id();
      out[key] = inside.number(8);
    }
    return out;
  }
  [[nodiscard]] bool done() const { return rest_.empty(); }
  [[nodiscard]] std::uint64_t left() const { return rest_.size(); }

 private:
  std::string_view rest_;
};

}  // namespace vsa::record::mcap_reader
