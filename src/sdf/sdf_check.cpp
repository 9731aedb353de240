// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// SDF's texts, compared with libsdformat's own description of every element. libsdformat tells what it doesn't know, but
//   takes the first of what counts once, and no word of the second;
//   reads a number up to what is none: "-1 rad", "0.3kg", a fourth number of a vector, a whole one's "1e3" as 1;
//   takes of a whole number its last 32 bits: 4294967296 for 0;
//   reads a <world> and passes over the <model> beside it.
// What is left out whole, or for renderers only, may hold what it likes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "sdf/read_context.hpp"
#include "sdf/xml_place.hpp"
#include "vsa/config/text.hpp"

namespace vsa::reader {
namespace {

using tinyxml2::XMLElement;

constexpr std::array<std::string_view, 15> kNotRead{
    "plugin",    "sensor",           "light",   "gui",  "scene",     "material", "actor", "audio_sink", "battery", "audio_source",
    "projector", "particle_emitter", "gripper", "road", "population"};

/// Least and most that a whole number may be.
using Whole = std::optional<std::array<double, 2>>;
constexpr Whole kInt{{-2147483648.0, 2147483647.0}}, kUnsigned{{0.0, 4294967295.0}}, kNotWhole{};

/// What the text of a type is: how many numbers, and of what kind.
struct NumberType {
  std::string_view name;
  std::size_t count;  // 0: libsdformat counts them itself
  Whole whole;
  const char* is_not;

  [[nodiscard]] std::string allowed() const {
    if (count != 1) return "numbers with blanks between, and nothing else";
    return whole ? config::range_text((*whole)[0], (*whole)[1]) : "a number and nothing else, in SI units";
  }
};

constexpr std::array<NumberType, 10> kNumberTypes{{{"double", 1, kNotWhole, "isn't a number"},
                                                   {"float", 1, kNotWhole, "isn't a number"},
                                                   {"int", 1, kInt, "isn't a whole number in range"},
                                                   {"unsigned int", 1, kUnsigned, "isn't a whole number in range"},
                                                   {"vector2d", 2, kNotWhole, "isn't two numbers"},
                                                   {"vector2i", 2, kInt, "isn't two whole numbers in range"},
                                                   {"vector3", 3, kNotWhole, "isn't three numbers"},
                                                   {"quaternion", 4, kNotWhole, "isn't four numbers"},
                                                   {"pose", 0, kNotWhole, "isn't of numbers"},
                                                   {"color", 0, kNotWhole, "isn't of numbers"}}};

bool is_hexadecimal(std::string_view text) {
  if (text.substr(0, 1) == "-" || text.substr(0, 1) == "+") text.remove_prefix(1);
  return text.size() > 2 && (text.substr(0, 2) == "0x" || text.substr(0, 2) == "0X") &&
         text.find_first_not_of("0123456789abcdefABCDEF", 2) == std::string_view::npos;
}

/// SDF writes limits as inf; whether a number may be infinite is for its reader to say.
bool is_not_finite(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (text[0] == '-' || text[0] == '+') text.erase(0, 1);
  return text == "inf" || text == "infinity" || text == "nan";
}

bool is_number(const std::string& text, const Whole& whole) {
  const bool hexadecimal = is_hexadecimal(text);
  if (!whole) return hexadecimal || is_not_finite(text) || config::parse_number(text);
  if (!hexadecimal && text.find_first_of("eE") != std::string::npos) return false;
  const std::optional<double> value = hexadecimal ? std::strtod(text.c_str(), nullptr) : config::parse_number(text);
  return value && *value == std::trunc(*value) && *value >= (*whole)[0] && *value <= (*whole)[1];
}

bool fits(const std::string& text, const NumberType& type) {
  std::istringstream in(text);
  std::size_t count = 0;
  for (std::string word; in >> word; ++count)
    if (!is_number(word, type.whole)) return false;
  return type.count == 0 || count == type.count;
}

class SdfCheck {
 public:
  SdfCheck(ReadContext& c, const std::string& file) : c_(c), file_(file) {}

  /// `described`: the element that `parent` is, as libsdformat describes it.
  void children(const XMLElement& parent, const sdf::ElementPtr& described) {
    std::vector<std::string_view> seen;
    for (const XMLElement* e = parent.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const std::string_view name = e->Name();
      if (std::find(kNotRead.begin(), kNotRead.end(), name) != kNotRead.end()) continue;
      const bool ours = name == "vsa:mimic" || name == "vsa:initial_position";
      const sdf::ElementPtr d = described->HasElementDescription(e->Name()) ? described->GetElementDescription(e->Name()) : nullptr;
      if (!d && !ours) continue;  // others' extensions, and what libsdformat complains of
      if (std::find(seen.begin(), seen.end(), name) != seen.end() && (ours || once(parent, *e, *d))) repeated(parent, *e);
      seen.push_back(name);
      if (!d) continue;
      value(*e, *d);
      // A model in a model is described as the one around it.
      children(*e, d->ReferenceSDF().empty() ? d : described);
    }
  }

  void beside_world(const XMLElement& root) {
    if (root.FirstChildElement("world") == nullptr) return;
    for (const XMLElement* e = root.FirstChildElement("model"); e != nullptr; e = e->NextSiblingElement("model"))
      c_.problems.add(
          {line_of(*e, file_), path_of(*e), "", "stands beside <world>, and isn't in it", "a <model> within the <world>"});
    if (const XMLElement* actor = root.FirstChildElement("actor")) c_.notes.add("actors are left out", place_of(*actor, file_));
  }

 private:
  /// Of several <physics> of a world the one with default="true" counts; of <state>s, which it may have several of, the first is read.
  static bool once(const XMLElement& parent, const XMLElement& e, const sdf::Element& described) {
    if (is(parent, "sdf") || (is(parent, "world") && is(e, "physics"))) return false;
    const std::string& required = described.GetRequired();
    return required == "0" || required == "1" || is(e, "state");
  }

  void repeated(const XMLElement& parent, const XMLElement& e) {
    std::string_view name = e.Name();
    if (name.substr(0, 4) == "vsa:") name.remove_prefix(4);
    c_.notes.add(fmt::format("of several <{}> in one <{}> the first counts", name, parent.Name()),
                 line_of(e, file_) + ": " + path_of(parent));
  }

  void value(const XMLElement& e, const sdf::Element& described) {
    const std::string text(config::trim(texts_of(e)));
    if (text.empty()) return;
    if (!described.GetValue()) return c_.notes.add("text where a file has none is left out", place_of(e, file_));
    const std::string& type = described.GetValue()->GetTypeName();
    const auto* const numbers =
        std::find_if(kNumberTypes.begin(), kNumberTypes.end(), [&](const NumberType& t) { return t.name == type; });
    if (numbers != kNumberTypes.end() && !fits(text, *numbers))
      c_.problems.add({line_of(e, file_), path_of(e), text, numbers->is_not, numbers->allowed()});
  }

  ReadContext& c_;
  const std::string& file_;
};

}  // namespace

void check_sdfs(ReadContext& c, const sdf::ElementPtr& described) {
  if (!described) return;
  for (const SdfText& sdf : c.files.sdfs) {
    SdfCheck check(c, sdf.file);
    check.beside_world(*sdf.xml->RootElement());
    check.children(*sdf.xml->RootElement(), described);
  }
}

}  // namespace vsa::reader
