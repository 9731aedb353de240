// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "sdf/includes.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <memory>
#include <set>

#include "sdf/input_files.hpp"
#include "sdf/newer_sdf.hpp"
#include "sdf/plugin_places.hpp"
#include "sdf/xml_place.hpp"
#include "vsa/config/text.hpp"

namespace vsa::reader {
namespace {

namespace fs = std::filesystem;

/// Prints elements on the lines that they have in the file, so that what is said of the print is true of the file.
class LinePrinter final : public tinyxml2::XMLPrinter {
 public:
  LinePrinter() : XMLPrinter(nullptr, true) {}
  bool VisitEnter(const tinyxml2::XMLDocument& document) override { return XMLPrinter::VisitEnter(document); }
  bool VisitEnter(const tinyxml2::XMLElement& element, const tinyxml2::XMLAttribute* attribute) override {
    count();
    for (; line_ < element.GetLineNum(); ++line_) Putc('\n');  // in the start tag before it, where that is open still
    counted_ = length();
    return XMLPrinter::VisitEnter(element, attribute);
  }

 private:
  [[nodiscard]] std::size_t length() const { return static_cast<std::size_t>(CStrSize()) - 1; }
  void count() {
    const char* text = CStr();
    line_ += static_cast<int>(std::count(text + counted_, text + length(), '\n'));
  }

  std::size_t counted_ = 0;
  int line_ = 1;
};

std::string printed(const tinyxml2::XMLDocument& xml) {
  LinePrinter printer;
  xml.Print(&printer);
  return printer.CStr();
}

/// What libsdformat would refuse or lose is changed. True where something was.
bool mend(tinyxml2::XMLElement& root, const std::string& label, ReadContext& c) {
  if (has_more_than_root(root, label, c.problems) || is_unexpanded(root, label, c.problems)) return false;
  check_plugin_places(root, label, c.problems);
  const std::string_view name = root.Name();
  if (name == "gazebo" && root.Attribute("version") != nullptr) {
    const std::string version = root.Attribute("version");
    c.problems.add({line_of(root, label), "gazebo@version", version, "is the way that SDF before 1.3 begins",
                    "<sdf version=\"1.2\"> and </sdf> in its place, with SDF 1.2's elements"});
    return false;
  }
  if (name == "sdf") {
    c.files.newer = c.files.newer || is_newer(root);
    return mend_sdf(root, label, c.notes, c.problems);
  }
  if (name != "robot") return false;
  c.files.urdfs.push_back(mend_urdf(root, label, c.files.urdfs.size(), c.notes, c.problems));
  return true;
}

/// The 9 of "1.9"; −1 where it is none that can be read.
int minor_version(const char* text) {
  constexpr int kNewest = 12;
  const auto number =
      text != nullptr && std::string_view(text).substr(0, 2) == "1." ? config::parse_integer(text + 2) : std::nullopt;
  return number && *number >= 0 && *number <= kNewest ? static_cast<int>(*number) : -1;
}

using Uris = std::vector<tinyxml2::XMLElement*>;

void collect_uris(tinyxml2::XMLElement& element, Uris& uris) {
  if (std::string_view(element.Name()) == "include") {
    auto* uri = element.FirstChildElement("uri");
    if (uri != nullptr && uri->GetText() != nullptr) uris.push_back(uri);
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
    auto xml = std::make_unique<tinyxml2::XMLDocument>();
    c_.seen.reads(path);
    if (xml->LoadFile(path.c_str()) != tinyxml2::XML_SUCCESS) return;  // what is broken, libsdformat reports
    if (document(*xml, path.string(), fs::absolute(path).parent_path())) c_.files.replace(path, printed(*xml));
    c_.files.keep(path.string(), std::move(xml));
  }

  /// True where the document was changed.
  bool document(tinyxml2::XMLDocument& xml, const std::string& label, const fs::path& base) {
    tinyxml2::XMLElement* root = xml.RootElement();
    if (root == nullptr) return false;
    bool changed = mend(*root, label, c_);
    if (std::string_view(root->Name()) != "sdf") return changed;
    Uris uris;
    collect_uris(*root, uris);
    for (tinyxml2::XMLElement* element : uris) {
      const std::string uri = element->GetText();
      const fs::path found = c_.finder.find(uri, base);
      if (found.empty()) {
        c_.seen.lost();  // libsdformat may know where it is
        continue;
      }
      const fs::path target = model_file(found, c_.seen);
      enter(target, uri, label);
      if (libsdformat_finds(uri) == target && c_.files.stand_in(target) == target) continue;
      element->SetText(c_.files.stand_in(target).c_str());
      changed = true;
    }
    return changed;
  }

 private:
  /// It looks for a plain path among its own files and in the working directory first.
  [[nodiscard]] fs::path libsdformat_finds(const std::string& uri) const {
    const bool plain = uri.find("://") == std::string::npos || uri.rfind("file://", 0) == 0;
    return plain && !fs::path(uri).is_absolute() ? fs::path() : model_file(c_.finder.find(uri, c_.base), c_.seen);
  }

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

/// What an include's directory holds: as libsdformat, the file of the newest version in its model.config that can be read.
fs::path model_file(const fs::path& found, SeenFiles& seen) {
  std::error_code ignored;
  if (!fs::is_directory(found, ignored)) return found;
  tinyxml2::XMLDocument config;
  fs::path file = "model.sdf";
  int newest = -1;
  seen.reads(found / "model.config");
  if (config.LoadFile((found / "model.config").c_str()) == tinyxml2::XML_SUCCESS && config.RootElement() != nullptr) {
    for (auto* e = config.RootElement()->FirstChildElement("sdf"); e != nullptr; e = e->NextSiblingElement("sdf")) {
      const int minor = minor_version(e->Attribute("version"));
      if (e->GetText() == nullptr || minor < newest) continue;
      newest = minor;
      file = e->GetText();
    }
  }
  const fs::path path = found / file;
  return fs::is_regular_file(path, ignored) ? path : found;  // libsdformat says what is missing
}

bool prepare_files(const SdfSource& source, ReadContext& context) {
  const std::size_t before = context.problems.list().size();
  Walk walk(context, source.path);
  auto xml = std::make_unique<tinyxml2::XMLDocument>();
  const bool readable = source.path.empty() ? xml->Parse(source.text.data(), source.text.size()) == tinyxml2::XML_SUCCESS
                                            : xml->LoadFile(source.path.c_str()) == tinyxml2::XML_SUCCESS;
  if (readable && walk.document(*xml, source.label(), context.base)) context.files.top = printed(*xml);
  context.files.top_is_urdf = readable && xml->RootElement() != nullptr && is(*xml->RootElement(), "robot");
  context.files.top_is_sdf = readable && xml->RootElement() != nullptr && is(*xml->RootElement(), "sdf");
  if (readable) context.files.keep(source.label(), std::move(xml));
  return context.problems.list().size() == before;
}

}  // namespace vsa::reader
