// Copyright 2026 The vsasim authors. SPDX-License-Identifier: Apache-2.0
#include "vsa/fmu/resources.hpp"

#include <array>
#include <cstdio>

#include "vsa/config/text.hpp"
#include "vsa/errors.hpp"
#include "vsa/files.hpp"
#include "vsa/hash.hpp"
#include "vsa/output_file.hpp"

namespace vsa::fmu {
namespace fs = std::filesystem;
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

[[noreturn]] void refuse_uri(std::string_view uri, const char* message) {
  throw InputError({"", "resource location", std::string(uri), message, "file:///PATH of the unzipped resources folder"});
}

std::string unescaped(std::string_view uri, std::string_view path) {
  std::string out;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] != '%') {
      out += path[i];
      continue;
    }
    const int high = i + 2 < path.size() ? hex_digit(path[i + 1]) : -1, low = high < 0 ? -1 : hex_digit(path[i + 2]);
    if (low < 0) refuse_uri(uri, "has a % without two hexadecimal digits");
    out += static_cast<char>(16 * high + low);
    i += 2;
  }
  return out;
}

}  // namespace

Resources read_resources(const fs::path& folder) {
  Resources out;
  std::error_code error;
  if (!fs::is_directory(folder, error)) throw InputError({folder.string(), "", "", "is no folder", "the FMU's unzipped resources"});
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->is_directory()) continue;
    auto text = read_file(it->path());
    if (!text) throw InputError({it->path().string(), "", "", "can't be read", "the FMU's unzipped resources"});
    out[it->path().lexically_relative(folder).generic_string()] = std::move(*text);
  }
  if (error) throw InputError({folder.string(), "", "", "can't be read: " + error.message(), "the FMU's unzipped resources"});
  return out;
}

void write_resources(const Resources& resources, const fs::path& folder) {
  for (const auto& [name, bytes] : resources) {
    const fs::path file = folder / name;
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    if (error) throw OutputError(file.parent_path().string() + ": can't be made: " + error.message());
    OutputFile out(file);
    out.append(bytes);
    out.close();
  }
}

std::string token_of(const Resources& resources) {
  std::uint64_t a = fnv1a("vsasim"), b = fnv1a("fmu");
  for (const auto& [name, bytes] : resources) {
    const std::string head = name + '\n' + std::to_string(bytes.size()) + '\n';
    a = fnv1a(bytes, fnv1a(head, a));
    b = fnv1a(head, fnv1a(bytes, b));
  }
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "{%08x-%04x-%04x-%04x-%012llx}", static_cast<unsigned>(a >> 32),
                static_cast<unsigned>(a >> 16 & 0xFFFF), static_cast<unsigned>(a & 0xFFFF), static_cast<unsigned>(b >> 48),
                static_cast<unsigned long long>(b & 0xFFFFFFFFFFFFULL));
  return text.data();
}

fs::path path_of_uri(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  if (colon == std::string_view::npos || uri.find('/') < colon) {
    if (uri.empty()) refuse_uri(uri, "is empty");
    return uri;
  }
  if (uri.substr(0, colon) != "file") refuse_uri(uri, "isn't on this machine");
  std::string_view rest = uri.substr(colon + 1);
  if (rest.substr(0, 2) == "//") {
    rest.remove_prefix(2);
    const std::string_view host = rest.substr(0, rest.find('/'));
    if (!host.empty() && host != "localhost") refuse_uri(uri, "is on another machine");
    rest.remove_prefix(host.size());
  }
  if (rest.empty() || rest.front() != '/') refuse_uri(uri, "has no absolute path");
  return unescaped(uri, rest);
}

std::string toml_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20) throw InputError({"", "text", std::string(text), "has a control character", ""});
    out += c;
  }
  return out + '"';
}

}  // namespace vsa::fmu
