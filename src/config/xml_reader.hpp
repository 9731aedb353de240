// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
//
// Strict reading of XML elements: every attribute and child is known, or a problem. Keeps tinyxml2 out of other headers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vsa/errors.hpp"

namespace tinyxml2 {
class XMLElement;
}

namespace vsa::config {

/// How problems name a place: "actuator[x]/bus@id".
[[nodiscard]] inline std::string attribute_path(const std::string& path, const std::string& name) { return path + "@" + name; }
[[nodiscard]] inline std::string element_path(const std::string& path, const std::string& name) { return path + "/" + name; }

class XmlReader {
 public:
  XmlReader(std::string_view where, Problems& problems) : where_(where), problems_(problems) {}

  void add(std::string key, std::string value, std::string message, std::string allowed = {});

  /// Reports attributes that aren't in `known`; `children` were reported as such. Those of hosts and XML itself pass: xmlns, and
  /// any with a namespace prefix.
  void check_attributes(const tinyxml2::XMLElement& e, const std::string& path, const std::vector<std::string>& known,
                        const std::vector<std::string>& children = {});
  /// Reports and tells of an attribute that is a child element in our grammar, and shows that: its value. None: there is none.
  std::optional<std::string> child_as_attribute(const tinyxml2::XMLElement& e, const std::string& path, const char* name);
  /// Reports children that aren't in `known`, and text between them. Names that `others` takes are somebody else's to check.
  void check_children(const tinyxml2::XMLElement& e, const std::string& path, const std::vector<std::string>& known,
                      bool (*others)(std::string_view) = nullptr);
  /// The element's text, trimmed; reports child elements.
  [[nodiscard]] std::string text(const tinyxml2::XMLElement& e, const std::string& path);
  /// The only child of that name; null where there is none. A second one is a problem.
  [[nodiscard]] const tinyxml2::XMLElement* only(const tinyxml2::XMLElement& e, const std::string& path, const char* name);

  [[nodiscard]] std::optional<std::string> attribute(const tinyxml2::XMLElement& e, const char* name) const;
  /// A finite number that fills the whole text, within bounds; none: a problem was added.
  [[nodiscard]] std::optional<double> number(const std::string& key, const std::string& text, double min, double max,
                                             std::string_view unit);
  [[nodiscard]] std::optional<int> integer(const std::string& key, const std::string& text, int min, int max);
  /// Reports names that topics, files and columns can't have. True if it is fine.
  bool check_name(const std::string& key, const std::string& name);

 private:
  std::string where_;
  Problems& problems_;
};

}  // namespace vsa::config
