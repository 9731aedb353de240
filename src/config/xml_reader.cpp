// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "config/xml_reader.hpp"

#include <tinyxml2.h>

#include <algorithm>

#include "vsa/config/text.hpp"

namespace vsa::config {
namespace {

constexpr std::size_t kLongestName = 128;

bool contains(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

bool is_hosts_own(const std::string& attribute) { return attribute == "xmlns" || attribute.find(':') != std::string::npos; }

std::string unknown(const std::string& word, const std::vector<std::string>& known) {
  return "unknown" + did_you_mean(word, known);
}

}  // namespace

void XmlReader::add(std::string key, std::string value, std::string message, std::string allowed) {
  problems_.add({where_, std::move(key), std::move(value), std::move(message), std::move(allowed)});
}

void XmlReader::check_attributes(const tinyxml2::XMLElement& e, const std::string& path, const std::vector<std::string>& known,
                                 const std::vector<std::string>& children) {
  for (const tinyxml2::XMLAttribute* a = e.FirstAttribute(); a != nullptr; a = a->Next()) {
    const std::string name = a->Name();
    if (is_hosts_own(name) || contains(known, name) || contains(children, name)) continue;
    if (known.empty()) {
      const std::string tag = e.Name();
      add(attribute_path(path, name), '"' + std::string(a->Value()) + '"', "is no attribute: the value is the element's text",
          "<" + tag + ">" + a->Value() + "</" + tag + ">");
    } else {
      add(attribute_path(path, name), a->Value(), "attribute " + unknown(name, known), join(known));
    }
  }
}

std::optional<std::string> XmlReader::child_as_attribute(const tinyxml2::XMLElement& e, const std::string& path, const char* name) {
  auto value = attribute(e, name);
  if (!value) return std::nullopt;
  const std::string tag(name);
  add(attribute_path(path, tag), '"' + *value + '"', "is an element, not an attribute",
      "<" + tag + ">" + *value + "</" + tag + ">");
  return value;
}

void XmlReader::check_children(const tinyxml2::XMLElement& e, const std::string& path, const std::vector<std::string>& known,
                               bool (*others)(std::string_view)) {
  for (const tinyxml2::XMLNode* n = e.FirstChild(); n != nullptr; n = n->NextSibling()) {
    if (const tinyxml2::XMLElement* child = n->ToElement()) {
      const std::string name = child->Name();
      if (!contains(known, name) && (others == nullptr || !others(name)))
        add(element_path(path, name), "", "element " + unknown(name, known), known.empty() ? "none" : join(known));
    } else if (const tinyxml2::XMLText* text_node = n->ToText()) {
      const std::string_view stray = trim(text_node->Value());
      if (!stray.empty()) add(path, std::string(stray), "text is not allowed here");
    }
  }
}

std::string XmlReader::text(const tinyxml2::XMLElement& e, const std::string& path) {
  std::string all;
  for (const tinyxml2::XMLNode* n = e.FirstChild(); n != nullptr; n = n->NextSibling()) {
    if (const tinyxml2::XMLText* part = n->ToText()) all += part->Value();
    if (const tinyxml2::XMLElement* child = n->ToElement())
      add(element_path(path, child->Name()), "", "element unknown: only text is allowed");
  }
  return std::string(trim(all));
}

const tinyxml2::XMLElement* XmlReader::only(const tinyxml2::XMLElement& e, const std::string& path, const char* name) {
  const tinyxml2::XMLElement* first = e.FirstChildElement(name);
  if (first != nullptr && first->NextSiblingElement(name) != nullptr) add(path + "/" + name, "", "is given more than once", "one");
  return first;
}

std::optional<std::string> XmlReader::attribute(const tinyxml2::XMLElement& e, const char* name) const {
  const char* value = e.Attribute(name);
  if (value == nullptr) return std::nullopt;
  return std::string(trim(value));
}

std::optional<double> XmlReader::number(const std::string& key, const std::string& text, double min, double max,
                                        std::string_view unit) {
  const std::string allowed = range_text(min, max) + (unit.empty() ? "" : " ") + std::string(unit);
  const auto value = parse_number(text);
  if (!value) {
    add(key, '"' + text + '"', "must be a finite number", allowed);
  } else if (*value < min || *value > max) {
    add(key, text, "is out of range", allowed);
  } else {
    return value;
  }
  return std::nullopt;
}

std::optional<int> XmlReader::integer(const std::string& key, const std::string& text, int min, int max) {
  const auto value = parse_integer(text);
  if (value && *value >= min && *value <= max) return static_cast<int>(*value);
  add(key, '"' + text + '"', value ? "is out of range" : "must be a whole number", range_text(min, max));
  return std::nullopt;
}

bool XmlReader::check_name(const std::string& key, const std::string& name) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.' ||
           c == ':';
  };
  if (!name.empty() && name.size() <= kLongestName && std::all_of(name.begin(), name.end(), good)) return true;
  add(key, '"' + name + '"', "can't be a name in topics and files",
      "1 … " + std::to_string(kLongestName) + " letters, digits, and _ - . :");
  return false;
}

}  // namespace vsa::config
