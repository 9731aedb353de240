// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/page/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <set>

#include "vsa/bits.hpp"
#include "vsa/errors.hpp"

namespace vsa::page {

Json number(double value) {
  constexpr double kMost = 1e15;
  if (!std::isfinite(value)) return nullptr;
  if (value == std::trunc(value) && std::abs(value) < kMost) return static_cast<std::int64_t>(value);
  return value;
}

Json number(float value) {
  if (!std::isfinite(value)) return nullptr;
  return number(Json::parse(fmt::format("{}", value)).get<double>());
}

Json number(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  return number(Json::parse(fmt::format("{:.{}g}", value, digits)).get<double>());
}

std::string text(const Json& json) {
  const std::string plain = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string out;
  out.reserve(plain.size());
  // Outside of strings JSON has none of these.
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const std::string_view three(&plain[i], std::min<std::size_t>(3, plain.size() - i));
    if (plain[i] == '<') {
      out += "\\u003c";
    } else if (plain[i] == '>') {
      out += "\\u003e";
    } else if (plain[i] == '&') {
      out += "\\u0026";
    } else if (three == "\u2028" || three == "\u2029") {
      out += three == "\u2028" ? "\\u2028" : "\\u2029";
      i += 2;
    } else {
      out += plain[i];
    }
  }
  return out;
}

Json real(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json reals(const std::vector<double>& values) {
  Json out = Json::array();
  for (const double v : values) out.push_back(real(v));
  return out;
}

Json results_head(const std::string& command) { return {{"program", "vsa " VSA_VERSION}, {"command", command}}; }

std::string results_text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n'; }

namespace {

/// The parser tells of no line: its way through the text does.
struct Counting {
  // NOLINTBEGIN(readability-identifier-naming): iterators have these
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  // NOLINTEND(readability-identifier-naming)
  const char* at;
  std::size_t* line;
  reference operator*() const { return *at; }
  Counting& operator++() {
    if (*at++ == '\n') ++*line;
    return *this;
  }
  bool operator==(const Counting& other) const { return at == other.at; }
  bool operator!=(const Counting& other) const { return at != other.at; }
};

}  // namespace

Json read_json(std::string_view text, const std::string& file, const std::string& allowed) {
  std::size_t line = 1;
  const auto fail = [&](const std::string& key, const char* what) {
    const std::string place = file.empty() ? "" : file + ":" + std::to_string(line);
    throw InputError({place, key, "", what, allowed});
  };
  std::vector<std::set<std::string>> open;  // the keys of each object that has begun
  const auto look = [&](int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) open.emplace_back();
    if (event == Json::parse_event_t::object_end) open.pop_back();
    if (event == Json::parse_event_t::key && !open.back().insert(parsed.get<std::string>()).second)
      fail(well_formed(parsed.get<std::string>()), "is given twice in one object");
    return true;
  };
  Json out = Json::parse(Counting{text.data(), &line}, Counting{text.data() + text.size(), &line}, look, false);
  if (out.is_discarded()) fail("", "isn't JSON");
  return out;
}

std::string well_formed(std::string_view value) {
  return Json::parse(Json(value).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

namespace {

/// Bits: an unsigned number as wide as a value.
template <class Bits, class Value>
std::string base64_of(const std::vector<Value>& values) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  constexpr std::size_t kWidth = sizeof(Value);
  const std::size_t bytes = values.size() * kWidth;
  const auto byte = [&](std::size_t i) -> std::uint32_t {
    if (i >= bytes) return 0;
    return static_cast<std::uint32_t>(bits_as<Bits>(values[i / kWidth]) >> (8 * (i % kWidth))) & 0xFFU;
  };
  std::string out;
  out.reserve((bytes + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes; i += 3) {
    const std::uint32_t three = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
    out += kDigits[three >> 18U];
    out += kDigits[(three >> 12U) & 63U];
    out += i + 1 < bytes ? kDigits[(three >> 6U) & 63U] : '=';
    out += i + 2 < bytes ? kDigits[three & 63U] : '=';
  }
  return out;
}

}  // namespace

std::string base64(const std::vector<float>& values) { return base64_of<std::uint32_t>(values); }
std::string base64_wide(const std::vector<double>& values) { return base64_of<std::uint64_t>(values); }

}  // namespace vsa::page
