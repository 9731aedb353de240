// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/urdfdom_reading.hpp"

#include <algorithm>
#include <cctype>

#include "vsa/config/text.hpp"

namespace vsa::reader {

void UrdfReading::problem(Element, std::string key, std::string value, std::string message, std::string allowed) {
  problems.add({file, std::move(key), std::move(value), std::move(message), std::move(allowed)});
}

void UrdfReading::cannot(Element, std::string key, std::string value, const std::string& what, std::string allowed) {
  engine_cannot(file, std::move(key), std::move(value), what, std::move(allowed));
}

UrdfReading::Element UrdfReading::child(Element element, const char* name) {
  return element == nullptr ? nullptr : element->FirstChildElement(name);
}

std::optional<std::string> UrdfReading::attribute(Element element, const char* name) {
  const char* found = element == nullptr ? nullptr : element->Attribute(name);
  return found == nullptr ? std::nullopt : std::optional<std::string>(found);
}

std::vector<UrdfReading::Element> UrdfReading::children(Element element) {
  std::vector<Element> out;
  for (Element e = element->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) out.push_back(e);
  return out;
}

std::string UrdfReading::text(Element element) {
  const char* value = element == nullptr ? nullptr : element->Attribute("value");
  if (element != nullptr && value == nullptr) value = element->GetText();
  return std::string(config::trim(value == nullptr ? "" : value));
}

bool UrdfReading::flag(Element element) {
  std::string word = text(element);
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word == "true" || word == "yes" || word == "1";
}

double UrdfReading::number(Element element, const char* name, double fallback, double min, double max, const std::string& key) {
  const Element found = child(element, name);
  if (found == nullptr) return fallback;
  const auto value = config::parse_number(text(found));
  if (!value) {
    problem(found, key + "/" + name, text(found), "isn't a number", "a finite number");
    return fallback;
  }
  return in_range(*value, fallback, min, max, file, key + "/" + name);
}

std::uint32_t UrdfReading::whole(Element element) {
  const std::string word = text(element);
  const bool hexadecimal = word.size() > 2 && word[0] == '0' && (word[1] == 'x' || word[1] == 'X') && word.size() <= 10 &&
                           word.find_first_not_of("0123456789abcdefABCDEF", 2) == std::string::npos;
  if (hexadecimal) return static_cast<std::uint32_t>(std::stoul(word, nullptr, 16));
  const auto value = config::parse_integer(word);
  constexpr std::int64_t kMost = 0xFFFFFFFF;
  if (value && *value >= 0 && *value <= kMost) return static_cast<std::uint32_t>(*value);
  problem(element, std::string("gazebo/") + element->Name(), word, "isn't a whole number in range", "0 … 4294967295");
  return 0;
}

Vec3 UrdfReading::vector(Element element) {
  const std::string words = text(element);
  if (const auto found = three_numbers(words.c_str())) return *found;
  problem(element, std::string("gazebo/") + element->Name(), words, "isn't three numbers", "x y z");
  return {};
}

}  // namespace vsa::reader
