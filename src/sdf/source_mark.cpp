// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/sdf/source_mark.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "vsa/config/text.hpp"
#include "vsa/files.hpp"
#include "vsa/hash.hpp"

namespace vsa::reader {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kOpen = "<!-- written of SDF ", kClose = " -->";
constexpr std::size_t kDigits = 16;

std::string cut_out(std::string text, std::string_view begin, std::string_view end) {
  for (std::size_t at = 0; (at = text.find(begin, at)) != std::string::npos;) {
    const std::size_t last = text.find(end, at);
    text.erase(at, last == std::string::npos ? last : last + end.size() - at);
  }
  return text;
}

/// Without comments, and with the line ends of this system.
std::string plain(std::string text) {
  std::erase(text, '\r');
  return cut_out(std::move(text), "<!--", "-->");
}

/// Without those of materials' scripts: nobody reads them, and Gazebo's own, which many models name, are on some machines only.
std::vector<std::string> uris_in(const std::string& whole) {
  const std::string text = cut_out(whole, "<script>", "</script>");
  constexpr std::string_view kBegin = "<uri>", kEnd = "</uri>";
  std::vector<std::string> out;
  for (std::size_t at = 0; (at = text.find(kBegin, at)) != std::string::npos;) {
    at += kBegin.size();
    const std::size_t end = std::min(text.find(kEnd, at), text.size());
    out.emplace_back(config::trim(std::string_view(text).substr(at, end - at)));
  }
  return out;
}

class Walk {
 public:
  Walk(const Finder& finder, SeenFiles& seen) : finder_(finder), seen_(seen) {}

  void file(const fs::path& path) {
    if (!done_.insert(path.lexically_normal().string()).second) return;
    seen_.reads(path);
    const auto bytes = read_file(path);
    whole_ = whole_ && bytes.has_value();
    if (!bytes) return;
    if (path.extension() != ".sdf" && path.extension() != ".urdf") {
      hash_ = fnv1a(*bytes, hash_);
      return;
    }
    const std::string text = plain(*bytes);
    hash_ = fnv1a(text, hash_);
    for (const std::string& uri : uris_in(text)) named(finder_.find(uri, path.parent_path()));
  }
  [[nodiscard]] bool whole() const { return whole_; }
  [[nodiscard]] std::uint64_t hash() const { return hash_; }

 private:
  /// One that isn't found is its name, which stands in the file that names it.
  void named(const fs::path& path) {
    if (path.empty()) return;
    std::error_code none;
    if (!fs::is_directory(path, none)) return file(path);
    std::vector<fs::path> models;
    for (const auto& entry : fs::directory_iterator(path, none))
      if (entry.path().extension() == ".sdf") models.push_back(entry.path());
    std::sort(models.begin(), models.end());
    for (const fs::path& model : models) file(model);
  }

  const Finder& finder_;
  SeenFiles& seen_;
  std::set<std::string> done_;
  std::uint64_t hash_ = fnv1a("");
  bool whole_ = true;
};

}  // namespace

std::optional<std::string> source_mark(const fs::path& sdf, const Finder& finder, SeenFiles& seen) {
  Walk walk(finder, seen);
  walk.file(sdf);
  if (!walk.whole()) return std::nullopt;
  std::string digits(kDigits, '0');
  std::uint64_t left = walk.hash();
  for (std::size_t i = kDigits; i-- > 0; left >>= 4U) digits[i] = "0123456789abcdef"[left & 15U];
  return digits;
}

std::string with_source_mark(std::string mjcf, std::string_view mark) {
  const std::size_t line = mjcf.find('\n');
  const std::string comment = std::string(kOpen) + std::string(mark) + std::string(kClose) + "\n";
  return line == std::string::npos ? mjcf : mjcf.insert(line + 1, comment);
}

std::optional<std::string> source_mark_in(std::string_view mjcf) {
  constexpr std::size_t kHead = 4096;  // it stands near the beginning
  mjcf = mjcf.substr(0, kHead);
  const std::size_t at = mjcf.find(kOpen);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view rest = mjcf.substr(at + kOpen.size());
  return rest.substr(std::min(kDigits, rest.size()), kClose.size()) == kClose ? std::optional(std::string(rest.substr(0, kDigits)))
                                                                              : std::nullopt;
}

}  // namespace vsa::reader
