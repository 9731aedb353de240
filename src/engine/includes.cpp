// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "includes.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <set>

namespace vsa::engine {
namespace {

namespace fs = std::filesystem;

bool known_version(const std::string& version) {
  return version.size() == 3 && version.compare(0, 2, "1.") == 0 && version[2] >= '0' && version[2] <= '9';
}

/// What an include's directory holds: the last <sdf> of its model.config, as libsdformat takes it.
fs::path model_file(const fs::path& found) {
  std::error_code ignored;
  if (!fs::is_directory(found, ignored)) return found;
  tinyxml2::XMLDocument config;
  fs::path file = "model.sdf";
  if (config.LoadFile((found / "model.config").c_str()) == tinyxml2::XML_SUCCESS && config.RootElement() != nullptr) {
    for (auto* e = config.RootElement()->FirstChildElement("sdf"); e != nullptr; e = e->NextSiblingElement("sdf"))
      if (e->GetText() != nullptr) file = e->GetText();
  }
  return found / file;
}

void collect_uris(const tinyxml2::XMLElement& element, std::vector<std::string>& uris) {
  if (std::string_view(element.Name()) == "include") {
    const auto* uri = element.FirstChildElement("uri");
    if (uri != nullptr && uri->GetText() != nullptr) uris.emplace_back(uri->GetText());
    return;
  }
  for (auto* e = element.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) collect_uris(*e, uris);
}

class Walk {
 public:
  Walk(ReadContext& context, const fs::path& top) : c_(context) {
    std::error_code ignored;
    if (!top.empty()) open_.push_back(fs::weakly_canonical(top, ignored).string());
  }

  void file(const fs::path& path) {
    tinyxml2::XMLDocument xml;
    if (xml.LoadFile(path.c_str()) == tinyxml2::XML_SUCCESS) document(xml, path.string());  // what is broken, libsdformat reports
  }

  void document(const tinyxml2::XMLDocument& xml, const std::string& label) {
    const tinyxml2::XMLElement* root = xml.RootElement();
    if (root == nullptr || std::string_view(root->Name()) != "sdf") return;
    const char* version = root->Attribute("version");
    if (version != nullptr && !known_version(version)) {
      c_.problems.add(
          {label, "sdf@version", version, "isn't a version that can be read", "1.6 … 1.9; older ones from 1.0 are converted"});
      return;
    }
    std::vector<std::string> uris;
    collect_uris(*root, uris);
    for (const std::string& uri : uris) {
      const fs::path found = c_.finder.find(uri, c_.base);
      if (!found.empty()) enter(model_file(found), uri, label);
    }
  }

 private:
  void enter(const fs::path& path, const std::string& uri, const std::string& from) {
    std::error_code ignored;
    const std::string key = fs::weakly_canonical(path, ignored).string();
    if (std::find(open_.begin(), open_.end(), key) != open_.end()) {
      c_.problems.add({from, "include/uri", uri, "includes a file that includes it: a circle", "files that don't lead back"});
      return;
    }
    if (!done_.insert(key).second) return;
    open_.push_back(key);
    file(path);
    open_.pop_back();
  }

  ReadContext& c_;
  std::vector<std::string> open_;  // from the world down to the file being read
  std::set<std::string> done_;
};

}  // namespace

bool check_includes(const SdfSource& source, ReadContext& context) {
  const std::size_t before = context.problems.list().size();
  Walk walk(context, source.path);
  tinyxml2::XMLDocument xml;
  const bool readable = source.path.empty() ? xml.Parse(source.text.data(), source.text.size()) == tinyxml2::XML_SUCCESS
                                            : xml.LoadFile(source.path.c_str()) == tinyxml2::XML_SUCCESS;
  if (readable) walk.document(xml, source.label());
  return context.problems.list().size() == before;
}

}  // namespace vsa::engine
